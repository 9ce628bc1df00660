// A value in a JSON file, with its place in the file. The accessors check type and range and throw
// a FormatError that names the place: "hand.json: matrices[2].rows is 0, not in 1..256".
#pragma once

#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/core/json.h>

namespace palpate {

class JsonField {
 public:
  // The whole value of a file. `file` names the file in errors, `rootName` the value ("the scene").
  // Throws FormatError with line and column when `text` is not a JSON.
  static JsonField parse(std::string_view text,
                         const std::filesystem::path& file,
                         std::string rootName);

  // Throws a FormatError: "FILE: PLACE what".
  [[noreturn]] void fail(const std::string& what) const;
  // Checks that this is an object which has no other keys.
  void only(std::initializer_list<std::string_view> known) const;
  bool has(std::string_view key) const { return json_.contains(key); }
  // The value of a key; null when the key is absent.
  JsonField at(std::string_view key) const;
  // The value of a key that must be there.
  JsonField required(std::string_view key) const;
  // The items of an array.
  std::vector<JsonField> items(std::size_t most) const;

  double number(double least, double most) const;
  // The number at a key, or `otherwise` when the key is absent.
  double number(std::string_view key, double otherwise, double least, double most) const;
  std::int64_t integer(std::int64_t least, std::int64_t most) const;
  std::int64_t integer(std::string_view key,
                       std::int64_t otherwise,
                       std::int64_t least,
                       std::int64_t most) const;
  // An index below `count`.
  std::size_t index(std::size_t count) const;
  // An array of exactly `count` numbers.
  std::vector<double> numbers(std::size_t count, double least, double most) const;
  std::string text() const;
  bool flag() const;
  bool isNumber() const { return json_.isNumber(); }
  bool isString() const { return json_.isString(); }

  const Json& json() const { return json_; }

 private:
  JsonField(Json json, std::string place, std::string rootName, std::filesystem::path file);

  Json json_;
  std::string place_;  // "matrices[2].rows"; empty for the whole value
  std::string rootName_;
  std::filesystem::path file_;
};

}  // namespace palpate
