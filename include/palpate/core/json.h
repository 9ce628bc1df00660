// JSON values: reading, building and writing. A thin wrapper, so that only one source file includes
// the JSON library. Objects keep the order in which their keys were set, so that files are
// deterministic.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace palpate {

// One JSON value.
class Json {
 public:
  Json();  // null
  Json(bool value);
  // NaN and infinities become null, since JSON has none.
  Json(double value);
  Json(std::int64_t value);
  Json(int value) : Json(static_cast<std::int64_t>(value)) {}
  Json(std::size_t value) : Json(static_cast<std::int64_t>(value)) {}
  Json(std::string_view value);
  Json(const std::string& value) : Json(std::string_view(value)) {}
  Json(const char* value) : Json(std::string_view(value)) {}
  Json(const Json& other);
  Json(Json&& other) noexcept;  // `other` is null afterwards
  Json& operator=(Json other) noexcept;
  ~Json();

  static Json object();
  static Json array();
  // Arrays of numbers. They take one allocation, where push() of each number takes two per number.
  static Json array(std::span<const std::int64_t> values);
  static Json array(std::span<const double> values);  // NaN and infinities become null
  // Throws palpate::Error with line and column when `text` is not one JSON value; palpate::Error
  // when it is nested more than 512 levels deep or has more than 1,500,000 values.
  static Json parse(std::string_view text);

  bool isNull() const;
  bool isObject() const;
  bool isArray() const;
  bool isNumber() const;
  bool isString() const;
  bool isBool() const;

  // Typed access. Throws palpate::Error with the key of the value when the value has another type.
  bool asBool() const;
  double asDouble() const;
  std::int64_t asInteger() const;
  std::string asString() const;

  std::size_t size() const;               // items of an array or object, otherwise 0
  std::vector<std::string> keys() const;  // of an object, in order
  bool contains(std::string_view key) const;
  // Returns the value of `key` (null when it is absent or this is not an object), or at `index` of
  // an array. It shares the data with this value without a copy, and stays valid when this value
  // changes or is destroyed.
  Json at(std::string_view key) const;
  Json at(std::size_t index) const;  // throws std::out_of_range

  // Building: a null value becomes an object or an array. Returns *this for chaining. A chain that
  // begins with a temporary value stays temporary, so that what is made of it is moved, not copied.
  Json& set(std::string_view key, Json value) &;
  Json& push(Json value) &;
  Json&& set(std::string_view key, Json value) && { return std::move(set(key, std::move(value))); }
  Json&& push(Json value) && { return std::move(push(std::move(value))); }

  // Returns the text with `indent` blanks per level; with -1 on one line. UTF-8; invalid bytes
  // become U+FFFD.
  std::string text(int indent = 2) const;
  // Returns the text on one line, with \u escapes for delete and all characters beyond ASCII.
  std::string asciiText() const;

 private:
  struct Impl;
  explicit Json(std::unique_ptr<Impl> impl);
  [[noreturn]] void wrongKind(const char* wanted) const;
  std::unique_ptr<Impl> impl_;  // null pointer: the value is null
};

// Returns an array with the result of `of` for each item.
template <typename Items, typename Of>
Json jsonList(const Items& items, Of of) {
  using Result = std::decay_t<decltype(of(*std::begin(items)))>;
  if constexpr (std::is_arithmetic_v<Result> && !std::same_as<Result, bool>) {
    using Number = std::conditional_t<std::is_integral_v<Result>, std::int64_t, double>;
    std::vector<Number> numbers;
    numbers.reserve(static_cast<std::size_t>(std::distance(std::begin(items), std::end(items))));
    for (const auto& item : items) numbers.push_back(static_cast<Number>(of(item)));
    return Json::array(numbers);
  } else {
    Json list = Json::array();
    for (const auto& item : items) list.push(of(item));
    return list;
  }
}
// Returns an array of the items.
template <typename Items>
Json jsonList(const Items& items) {
  return jsonList(
      items, [](const auto& item) -> const auto& { return item; });
}

// Converts a number that may be missing to JSON.
inline Json orNull(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

}  // namespace palpate
