#include "palpate/core/json.h"

#include <cmath>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"

namespace palpate {

using Value = nlohmann::ordered_json;

// A value in a tree that several Json objects may share; the tree is copied before a change.
struct Json::Impl {
  explicit Impl(Value given) : root(std::make_shared<Value>(std::move(given))), value(root.get()) {}
  // Refers to a part of `of` without a copy.
  Impl(const Impl& of, Value& part, std::string name)
      : root(of.root), value(&part), where(std::move(name)) {}

  // Returns the value for a change; a shared tree is copied first.
  Value& own() {
    if (root.use_count() != 1) {
      root = std::make_shared<Value>(*value);
      value = root.get();
    }
    return *value;
  }

  // A Json that was moved from is null.
  static const Value& of(const Json& json) {
    static const Value null;
    return json.impl_ ? *json.impl_->value : null;
  }

  std::shared_ptr<Value> root;
  Value* value;
  std::string where;  // the key of the value, for messages; may be empty
};

namespace {

// The parser does not use recursion, but destruction and dump() do, so the nesting is limited.
constexpr std::size_t kMaxDepth = 512;
// A value of two bytes ("0,") takes up to 100 bytes in memory. Models have some 100,000.
constexpr std::size_t kMaxValues = 1'500'000;

[[noreturn]] void throwWrongKind(const std::string& where, const char* wanted, const Value& value) {
  throw Error("JSON: " + (where.empty() ? where : "'" + shortened(where) + "': ") + "expected " +
              wanted + ", found " + value.type_name());
}

// Throws Error for a text that is nested too deep or has too many values. A callback of the parser
// could tell, too, but with one it walks through all items of a list at the end of each.
void requireBounded(std::string_view text) {
  std::size_t depth = 0;
  std::size_t values = 1;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c == '\\') ++i;
      if (c == '"') quoted = false;
    } else if (c == '"') {
      quoted = true;
    } else if (c == '[' || c == '{') {
      ++values;
      if (++depth > kMaxDepth) throw Error("JSON: nested more than 512 levels deep");
    } else if (c == ']' || c == '}') {
      if (depth > 0) --depth;
    } else if (c == ',') {
      ++values;
    }
  }
  if (values > kMaxValues) throw Error("JSON: more than " + std::to_string(kMaxValues) + " values");
}

// Without the first part of "[json.exception.parse_error.101] parse error at line 1, column 2: ..",
// and with little of the text that it may repeat in quotes.
std::string messageOf(const Value::exception& error) {
  std::string what = error.what();
  if (const auto blank = what.find("] "); blank != std::string::npos) what.erase(0, blank + 2);
  const auto first = what.find('\'');
  const auto last = what.rfind('\'');
  if (first == last) return what;
  const std::string repeated = what.substr(first + 1, last - first - 1);
  return what.replace(first + 1, repeated.size(), shortened(repeated));
}

// JSON has no NaN and no infinity.
Value jsonNumber(double number) { return std::isfinite(number) ? Value(number) : Value(); }
Value jsonNumber(std::int64_t number) { return Value(number); }

template <typename Number>
Value jsonNumbers(std::span<const Number> numbers) {
  Value::array_t list;
  list.reserve(numbers.size());
  for (const Number number : numbers) list.push_back(jsonNumber(number));
  return Value(std::move(list));
}

}  // namespace

Json::Json() = default;
Json::Json(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Json::Json(bool value) : impl_(std::make_unique<Impl>(Value(value))) {}
Json::Json(double value) : impl_(std::make_unique<Impl>(jsonNumber(value))) {}
Json::Json(std::int64_t value) : impl_(std::make_unique<Impl>(jsonNumber(value))) {}
Json::Json(std::string_view value) : impl_(std::make_unique<Impl>(Value(value))) {}
// A copy shares no data, so that it may be used in another thread.
Json::Json(const Json& other) {
  if (!other.impl_) return;
  impl_ = std::make_unique<Impl>(*other.impl_->value);
  impl_->where = other.impl_->where;
}
Json::Json(Json&& other) noexcept = default;
Json& Json::operator=(Json other) noexcept {
  impl_.swap(other.impl_);
  return *this;
}
Json::~Json() = default;

Json Json::object() { return Json(std::make_unique<Impl>(Value::object())); }
Json Json::array() { return Json(std::make_unique<Impl>(Value::array())); }
Json Json::array(std::span<const std::int64_t> values) {
  return Json(std::make_unique<Impl>(jsonNumbers(values)));
}
Json Json::array(std::span<const double> values) {
  return Json(std::make_unique<Impl>(jsonNumbers(values)));
}

Json Json::parse(std::string_view text) {
  requireBounded(text);
  try {
    return Json(std::make_unique<Impl>(Value::parse(text)));
  } catch (const Value::exception& error) {
    throw Error("JSON: " + messageOf(error));
  }
}

bool Json::isNull() const { return Impl::of(*this).is_null(); }
bool Json::isObject() const { return Impl::of(*this).is_object(); }
bool Json::isArray() const { return Impl::of(*this).is_array(); }
bool Json::isNumber() const { return Impl::of(*this).is_number(); }
bool Json::isString() const { return Impl::of(*this).is_string(); }
bool Json::isBool() const { return Impl::of(*this).is_boolean(); }

void Json::wrongKind(const char* wanted) const {
  throwWrongKind(impl_ ? impl_->where : std::string(), wanted, Impl::of(*this));
}

bool Json::asBool() const {
  if (!isBool()) wrongKind("true or false");
  return Impl::of(*this).get<bool>();
}
double Json::asDouble() const {
  if (!isNumber()) wrongKind("a number");
  return Impl::of(*this).get<double>();
}
std::int64_t Json::asInteger() const {
  const Value& value = Impl::of(*this);
  if (value.is_number_unsigned() && value.get<std::uint64_t>() > INT64_MAX)
    wrongKind("a whole number below 2^63");
  if (!value.is_number_integer()) wrongKind("a whole number");
  return value.get<std::int64_t>();
}
std::string Json::asString() const {
  if (!isString()) wrongKind("a string");
  return Impl::of(*this).get<std::string>();
}

std::size_t Json::size() const { return isArray() || isObject() ? Impl::of(*this).size() : 0; }
std::vector<std::string> Json::keys() const {
  std::vector<std::string> names;
  if (isObject())
    for (const auto& item : Impl::of(*this).items()) names.push_back(item.key());
  return names;
}
bool Json::contains(std::string_view key) const {
  return isObject() && Impl::of(*this).contains(std::string(key));
}
Json Json::at(std::string_view key) const {
  std::string name(key);
  if (contains(key)) {
    Value& part = impl_->value->at(name);
    return Json(std::make_unique<Impl>(*impl_, part, std::move(name)));
  }
  Json absent(std::make_unique<Impl>(Value()));
  absent.impl_->where = std::move(name);
  return absent;
}
Json Json::at(std::size_t index) const {
  if (!isArray() || index >= Impl::of(*this).size())
    throw std::out_of_range("JSON: no item " + std::to_string(index));
  return Json(std::make_unique<Impl>(*impl_, impl_->value->at(index), impl_->where));
}

Json& Json::set(std::string_view key, Json value) & {
  if (!isNull() && !isObject()) wrongKind("an object");
  Value part = value.impl_ ? std::move(value.impl_->own()) : Value();
  if (!impl_) impl_ = std::make_unique<Impl>(Value());
  impl_->own()[std::string(key)] = std::move(part);
  return *this;
}
Json& Json::push(Json value) & {
  if (!isNull() && !isArray()) wrongKind("an array");
  Value part = value.impl_ ? std::move(value.impl_->own()) : Value();
  if (!impl_) impl_ = std::make_unique<Impl>(Value());
  impl_->own().push_back(std::move(part));
  return *this;
}

std::string Json::text(int indent) const {
  return Impl::of(*this).dump(indent, ' ', false, Value::error_handler_t::replace);
}
std::string Json::asciiText() const {
  return Impl::of(*this).dump(-1, ' ', true, Value::error_handler_t::replace);
}

}  // namespace palpate
