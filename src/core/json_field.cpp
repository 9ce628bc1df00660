#include "palpate/core/json_field.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"

namespace palpate {

JsonField JsonField::parse(std::string_view text,
                           const std::filesystem::path& file,
                           std::string rootName) {
  try {
    return JsonField(Json::parse(text), "", std::move(rootName), file);
  } catch (const FormatError&) {
    throw;
  } catch (const Error& error) {
    throw FormatError(file, error.what());
  }
}

JsonField::JsonField(Json json, std::string place, std::string rootName, std::filesystem::path file)
    : json_(std::move(json)),
      place_(std::move(place)),
      rootName_(std::move(rootName)),
      file_(std::move(file)) {}

void JsonField::fail(const std::string& what) const {
  throw FormatError(file_, (place_.empty() ? rootName_ : place_) + " " + what);
}

void JsonField::only(std::initializer_list<std::string_view> known) const {
  if (!json_.isObject()) fail("isn't a JSON object");
  for (const std::string& key : json_.keys())
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      std::string list;
      for (const std::string_view name : known)
        list += (list.empty() ? "" : ", ") + std::string(name);
      fail("has an unknown key '" + shortened(key) + "' (known: " + list + ")");
    }
}

JsonField JsonField::at(std::string_view key) const {
  return JsonField(
      json_.at(key), place_ + (place_.empty() ? "" : ".") + std::string(key), rootName_, file_);
}

JsonField JsonField::required(std::string_view key) const {
  if (!json_.isObject()) fail("isn't a JSON object");
  if (!has(key)) fail("has no \"" + shortened(key) + "\"");
  return at(key);
}

std::vector<JsonField> JsonField::items(std::size_t most) const {
  if (!json_.isArray()) fail("isn't a JSON array");
  if (json_.size() > most) fail("has more than " + std::to_string(most) + " items");
  std::vector<JsonField> all;
  for (std::size_t i = 0; i < json_.size(); ++i)
    all.push_back(JsonField(json_.at(i), place_ + "[" + std::to_string(i) + "]", rootName_, file_));
  return all;
}

double JsonField::number(double least, double most) const {
  if (!json_.isNumber()) fail("isn't a number");
  const double value = json_.asDouble();
  if (!(value >= least && value <= most))
    fail("is " + numberText(value) + ", not in " + numberText(least) + ".." + numberText(most));
  return value;
}

double JsonField::number(std::string_view key, double otherwise, double least, double most) const {
  return has(key) ? at(key).number(least, most) : otherwise;
}

std::int64_t JsonField::integer(std::int64_t least, std::int64_t most) const {
  const double value = number(static_cast<double>(least), static_cast<double>(most));
  if (value != std::floor(value)) fail("isn't a whole number");
  return static_cast<std::int64_t>(value);
}

std::int64_t JsonField::integer(std::string_view key,
                                std::int64_t otherwise,
                                std::int64_t least,
                                std::int64_t most) const {
  return has(key) ? at(key).integer(least, most) : otherwise;
}

std::size_t JsonField::index(std::size_t count) const {
  if (count == 0) fail("names an item of an empty list");
  return static_cast<std::size_t>(integer(0, static_cast<std::int64_t>(count) - 1));
}

std::vector<double> JsonField::numbers(std::size_t count, double least, double most) const {
  const std::vector<JsonField> parts = items(count);
  if (parts.size() != count)
    fail(count == 3 ? "is not three numbers" : "is not " + std::to_string(count) + " numbers");
  std::vector<double> values;
  for (const JsonField& part : parts) values.push_back(part.number(least, most));
  return values;
}

std::string JsonField::text() const {
  if (!json_.isString()) fail("isn't a text");
  return json_.asString();
}

bool JsonField::flag() const {
  if (!json_.isBool()) fail("is neither true nor false");
  return json_.asBool();
}

}  // namespace palpate
