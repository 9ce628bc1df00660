// JSON values: reading, building, writing. A thin wrapper, so that the JSON library stays in one
// source file. Objects keep the order in which their keys were set (deterministic files).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace palpate {

class Json {
 public:
  Json();  // null
  Json(bool value);
  Json(double value);  // NaN and infinities become null: JSON has none
  Json(std::int64_t value);
  Json(int value) : Json(static_cast<std::int64_t>(value)) {}
  Json(std::size_t value) : Json(static_cast<std::int64_t>(value)) {}
  Json(std::string_view value);
  Json(const std::string& value) : Json(std::string_view(value)) {}
  Json(const char* value) : Json(std::string_view(value)) {}
  Json(const Json& other);
  Json(Json&& other) noexcept;  // `other` is null then
  Json& operator=(Json other) noexcept;
  ~Json();

  static Json object();
  static Json array();
  // Throws palpate::Error with line and column when `text` is not one JSON value; nesting is
  // bounded (512 levels).
  static Json parse(std::string_view text);

  bool isNull() const;
  bool isObject() const;
  bool isArray() const;
  bool isNumber() const;
  bool isString() const;
  bool isBool() const;

  // Typed reading; throws palpate::Error when the value is of another kind, with the key it stands
  // under.
  bool asBool() const;
  double asDouble() const;
  std::int64_t asInteger() const;
  std::string asString() const;

  std::size_t size() const;               // items of an array or object, else 0
  std::vector<std::string> keys() const;  // of an object, in order
  bool contains(std::string_view key) const;
  // The value under `key` (null when absent or no object), or at `index` of an array. Nothing below
  // it is copied, and it stays valid whatever becomes of this one.
  Json at(std::string_view key) const;
  Json at(std::size_t index) const;  // throws std::out_of_range

  // Building; a null value becomes an object or an array. Returns *this for chaining.
  Json& set(std::string_view key, Json value);
  Json& push(Json value);

  // Text with `indent` blanks per level; -1: one line. UTF-8; invalid bytes become U+FFFD.
  std::string text(int indent = 2) const;
  // The same on one line, with every character beyond ASCII, and delete, as \u escapes.
  std::string asciiText() const;

 private:
  struct Impl;
  explicit Json(std::unique_ptr<Impl> impl);
  [[noreturn]] void wrongKind(const char* wanted) const;
  std::unique_ptr<Impl> impl_;  // none: null
};

// An array with what `of` makes of each item.
template <typename Items, typename Of>
Json jsonList(const Items& items, Of of) {
  Json list = Json::array();
  for (const auto& item : items) list.push(of(item));
  return list;
}
// An array of the items.
template <typename Items>
Json jsonList(const Items& items) {
  return jsonList(items, [](const auto& item) { return Json(item); });
}

}  // namespace palpate
