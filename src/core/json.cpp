#include "palpate/core/json.h"

#include <cmath>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "palpate/core/error.h"

namespace palpate {

using Value = nlohmann::ordered_json;

struct Json::Impl {
  Value value;
};

namespace {
[[noreturn]] void wrongKind(const char* wanted, const Value& value) {
  throw Error(std::string("JSON: expected ") + wanted + ", found " + value.type_name());
}

// The parser below is recursive-free, but destruction and dump() are not: bound the nesting.
constexpr int kMaxDepth = 512;
}  // namespace

Json::Json() : impl_(std::make_unique<Impl>()) {}
Json::Json(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Json::Json(bool value) : impl_(std::make_unique<Impl>(Impl{Value(value)})) {}
Json::Json(double value)
    : impl_(std::make_unique<Impl>(Impl{std::isfinite(value) ? Value(value) : Value()})) {}
Json::Json(std::int64_t value) : impl_(std::make_unique<Impl>(Impl{Value(value)})) {}
Json::Json(std::string_view value) : impl_(std::make_unique<Impl>(Impl{Value(value)})) {}
Json::Json(const Json& other) : impl_(std::make_unique<Impl>(*other.impl_)) {}
Json::Json(Json&& other) noexcept = default;
Json& Json::operator=(Json other) noexcept {
  impl_.swap(other.impl_);
  return *this;
}
Json::~Json() = default;

Json Json::object() { return Json(std::make_unique<Impl>(Impl{Value::object()})); }
Json Json::array() { return Json(std::make_unique<Impl>(Impl{Value::array()})); }

Json Json::parse(std::string_view text) {
  const auto bounded = [](int depth, Value::parse_event_t, Value&) {
    if (depth > kMaxDepth) throw Error("JSON: nested more than 512 levels deep");
    return true;
  };
  try {
    return Json(std::make_unique<Impl>(Impl{Value::parse(text, bounded)}));
  } catch (const Value::parse_error& error) {
    // "[json.exception.parse_error.101] parse error at line 1, column 2: ..." without its number
    const std::string what = error.what();
    const auto blank = what.find("] ");
    throw Error("JSON: " + (blank == std::string::npos ? what : what.substr(blank + 2)));
  } catch (const Value::exception& error) {
    throw Error(std::string("JSON: ") + error.what());
  }
}

bool Json::isNull() const { return impl_->value.is_null(); }
bool Json::isObject() const { return impl_->value.is_object(); }
bool Json::isArray() const { return impl_->value.is_array(); }
bool Json::isNumber() const { return impl_->value.is_number(); }
bool Json::isString() const { return impl_->value.is_string(); }
bool Json::isBool() const { return impl_->value.is_boolean(); }

bool Json::asBool() const {
  if (!isBool()) wrongKind("true or false", impl_->value);
  return impl_->value.get<bool>();
}
double Json::asDouble() const {
  if (!isNumber()) wrongKind("a number", impl_->value);
  return impl_->value.get<double>();
}
std::int64_t Json::asInteger() const {
  const Value& value = impl_->value;
  if (value.is_number_unsigned() && value.get<std::uint64_t>() > INT64_MAX)
    wrongKind("a whole number below 2^63", value);
  if (!value.is_number_integer()) wrongKind("a whole number", value);
  return value.get<std::int64_t>();
}
std::string Json::asString() const {
  if (!isString()) wrongKind("a string", impl_->value);
  return impl_->value.get<std::string>();
}

std::size_t Json::size() const { return isArray() || isObject() ? impl_->value.size() : 0; }
std::vector<std::string> Json::keys() const {
  std::vector<std::string> names;
  if (isObject())
    for (const auto& item : impl_->value.items()) names.push_back(item.key());
  return names;
}
bool Json::contains(std::string_view key) const {
  return isObject() && impl_->value.contains(std::string(key));
}
Json Json::at(std::string_view key) const {
  if (!contains(key)) return {};
  return Json(std::make_unique<Impl>(Impl{impl_->value.at(std::string(key))}));
}
Json Json::at(std::size_t index) const {
  if (!isArray() || index >= impl_->value.size())
    throw std::out_of_range("JSON: no item " + std::to_string(index));
  return Json(std::make_unique<Impl>(Impl{impl_->value.at(index)}));
}

Json& Json::set(std::string_view key, Json value) {
  if (!isNull() && !isObject()) wrongKind("an object", impl_->value);
  impl_->value[std::string(key)] = std::move(value.impl_->value);
  return *this;
}
Json& Json::push(Json value) {
  if (!isNull() && !isArray()) wrongKind("an array", impl_->value);
  impl_->value.push_back(std::move(value.impl_->value));
  return *this;
}

std::string Json::text(int indent) const {
  return impl_->value.dump(indent, ' ', false, Value::error_handler_t::replace);
}

}  // namespace palpate
