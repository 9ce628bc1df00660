#include "palpate/imports/import_mapping.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/text_file.h"
#include "palpate/core/time.h"
#include "palpate/imports/import_time.h"

namespace palpate {
namespace {

constexpr const char* kMappingFormat = "palpate import mapping 1";
constexpr std::uint64_t kMappingByteLimit = 1u << 20;
constexpr std::size_t kMaxMatrixMappings = 256;

// An object of the file, with its place for messages.
class MappingField {
 public:
  MappingField(Json json, std::string place, const std::filesystem::path& source)
      : json_(std::move(json)), place_(std::move(place)), source_(source) {
    if (!json_.isObject()) fail("is not an object");
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw FormatError(source_, (place_.empty() ? "the mapping" : place_) + " " + what);
  }
  [[noreturn]] void failAt(const char* key, const std::string& what) const {
    throw FormatError(source_, (place_.empty() ? "" : place_ + ".") + key + " " + what);
  }
  void only(std::initializer_list<std::string_view> known) const {
    for (const std::string& key : json_.keys())
      if (std::find(known.begin(), known.end(), key) == known.end())
        fail("has the unknown key " + inQuotes(key));
  }
  bool has(const char* key) const { return json_.contains(key); }
  std::string text(const char* key) const {
    if (!has(key)) return {};
    if (!json_.at(key).isString()) failAt(key, "is not a text");
    return json_.at(key).asString();
  }
  std::optional<double> number(const char* key) const {
    if (!has(key)) return std::nullopt;
    if (!json_.at(key).isNumber() || !std::isfinite(json_.at(key).asDouble()))
      failAt(key, "is not a number");
    return json_.at(key).asDouble();
  }
  MappingField object(const char* key) const {
    return {json_.at(key), (place_.empty() ? "" : place_ + ".") + key, source_};
  }
  const Json& json() const { return json_; }

 private:
  Json json_;
  std::string place_;
  const std::filesystem::path& source_;
};

void setText(Json& json, const char* key, const std::string& text) {
  if (!text.empty()) json.set(key, text);
}

void setValues(Json& json, const ValueMapping& values) {
  if (values.scale != 1.0) json.set("scale", values.scale);
  if (values.offset != 0.0) json.set("offset", values.offset);
  setText(json, "unit", values.unit);
}

Json sampleJson(const SampleMapping& sample) {
  Json json = Json::object();
  setText(json, "columns", sample.columns);
  setValues(json, sample.values);
  setText(json, "time", sample.time);
  return json;
}

ValueMapping valuesFrom(const MappingField& field) {
  ValueMapping values;
  values.scale = field.number("scale").value_or(1.0);
  if (values.scale == 0.0) field.failAt("scale", "is 0: every value would be the same");
  values.offset = field.number("offset").value_or(0.0);
  values.unit = field.text("unit");
  return values;
}

SampleMapping sampleFrom(const MappingField& field) {
  field.only({"columns", "scale", "offset", "unit", "time"});
  return {field.text("columns"), valuesFrom(field), field.text("time")};
}

TableOptions textFrom(const MappingField& field) {
  field.only({"delimiter", "decimal", "header"});
  TableOptions text;
  if (field.has("delimiter")) {
    const auto delimiter = delimiterNamed(field.text("delimiter"));
    if (!delimiter) field.failAt("delimiter", "is not comma, semicolon, tab, blank or detect");
    text.delimiter = *delimiter;
  }
  if (field.has("decimal")) {
    const std::string decimal = field.text("decimal");
    if (decimal != "." && decimal != ",") field.failAt("decimal", "is not \".\" or \",\"");
    text.decimal = decimal[0];
  }
  const std::string header = field.text("header");
  if (header == "present")
    text.header = HeaderChoice::kPresent;
  else if (header == "absent")
    text.header = HeaderChoice::kAbsent;
  else if (!header.empty() && header != "detect")
    field.failAt("header", "is not present, absent or detect");
  return text;
}

TimeMapping timeFrom(const MappingField& field) {
  field.only({"column", "unit", "rate_hz", "start"});
  TimeMapping time;
  time.column = field.text("column");
  time.unit = field.text("unit");
  if (!time.unit.empty() && !timeUnitNamed(time.unit))
    field.failAt("unit", "is not s, ms, us, ns, min, h, iso, dmy or mdy");
  time.rateHz = field.number("rate_hz");
  if (time.rateHz && !(*time.rateHz > 0.0 && *time.rateHz <= 1e6))
    field.failAt("rate_hz", "is not above 0 and at most 1000000");
  if (field.has("start")) {
    time.startUs = parseDate(field.text("start"));
    if (!time.startUs) field.failAt("start", "is not a date such as 2026-11-22T10:31:05Z");
  }
  return time;
}

MatrixMapping matrixFrom(const MappingField& field) {
  field.only({"matrix", "columns", "scale", "offset", "unit", "order"});
  MatrixMapping made;
  if (const auto matrix = field.number("matrix")) {
    if (*matrix < 0.0 || *matrix > 255.0 || *matrix != std::floor(*matrix))
      field.failAt("matrix", "is not a whole number from 0 to 255");
    made.matrix = static_cast<std::size_t>(*matrix);
  }
  made.columns = field.text("columns");
  if (made.columns.empty()) field.fail("names no columns");
  made.values = valuesFrom(field);
  const std::string order = field.text("order");
  if (!order.empty() && order != "rows" && order != "columns")
    field.failAt("order", "is not rows or columns");
  made.columnByColumn = order == "columns";
  return made;
}

}  // namespace

Json mappingJson(const ImportMapping& mapping) {
  Json json = Json::object();
  json.set("format", kMappingFormat);
  Json text = Json::object();
  if (mapping.text.delimiter != 0) text.set("delimiter", delimiterName(mapping.text.delimiter));
  if (mapping.text.decimal != '.') text.set("decimal", std::string(1, mapping.text.decimal));
  if (mapping.text.header != HeaderChoice::kDetect)
    text.set("header", mapping.text.header == HeaderChoice::kPresent ? "present" : "absent");
  if (text.size() > 0) json.set("text", std::move(text));
  Json time = Json::object();
  setText(time, "column", mapping.time.column);
  setText(time, "unit", mapping.time.unit);
  if (mapping.time.rateHz) time.set("rate_hz", *mapping.time.rateHz);
  if (mapping.time.startUs) {
    // utcText() has milliseconds; the start may have microseconds.
    std::string start = utcText(*mapping.time.startUs);
    start[10] = 'T';
    const std::int64_t us = (*mapping.time.startUs % kUsPerMs + kUsPerMs) % kUsPerMs;
    const std::string digits = std::to_string(us);
    start += std::string(3 - digits.size(), '0') + digits + "Z";
    time.set("start", start);
  }
  if (time.size() > 0) json.set("time", std::move(time));
  if (mapping.components != ComponentOrder::kFound)
    json.set("components",
             mapping.components == ComponentOrder::kPlanar ? "planar" : "interleaved");
  if (!mapping.matrices.empty())
    json.set("matrices", jsonList(mapping.matrices, [](const MatrixMapping& each) {
               Json matrix = Json::object();
               if (each.matrix) matrix.set("matrix", *each.matrix);
               matrix.set("columns", each.columns);
               setValues(matrix, each.values);
               if (each.columnByColumn) matrix.set("order", "columns");
               return matrix;
             }));
  if (mapping.angles != SampleMapping{}) json.set("angles", sampleJson(mapping.angles));
  if (mapping.temperatures != SampleMapping{})
    json.set("temperatures", sampleJson(mapping.temperatures));
  return json;
}

ImportMapping mappingFromJson(const std::string& text, const std::filesystem::path& source) {
  Json json;
  try {
    json = Json::parse(text);
  } catch (const Error& error) {
    throw FormatError(source, error.what());
  }
  const MappingField field(std::move(json), "", source);
  if (field.text("format") != kMappingFormat)
    field.fail("lacks \"format\": \"" + std::string(kMappingFormat) + "\": not an import mapping");
  field.only({"format", "text", "time", "components", "matrices", "angles", "temperatures"});
  ImportMapping mapping;
  if (field.has("text")) mapping.text = textFrom(field.object("text"));
  if (field.has("time")) mapping.time = timeFrom(field.object("time"));
  if (const std::string order = field.text("components"); order == "planar")
    mapping.components = ComponentOrder::kPlanar;
  else if (order == "interleaved")
    mapping.components = ComponentOrder::kInterleaved;
  else if (!order.empty())
    field.failAt("components", "is not interleaved or planar");
  if (field.has("matrices")) {
    const Json list = field.json().at("matrices");
    if (!list.isArray() || list.size() > kMaxMatrixMappings)
      field.failAt("matrices", "is not a list of at most 256 entries");
    for (std::size_t i = 0; i < list.size(); ++i)
      mapping.matrices.push_back(
          matrixFrom(MappingField(list.at(i), "matrices[" + std::to_string(i) + "]", source)));
  }
  if (field.has("angles")) mapping.angles = sampleFrom(field.object("angles"));
  if (field.has("temperatures")) mapping.temperatures = sampleFrom(field.object("temperatures"));
  return mapping;
}

ImportMapping readMapping(const std::filesystem::path& path) {
  return mappingFromJson(readTextFile(path, kMappingByteLimit), path);
}

void writeMapping(const ImportMapping& mapping,
                  const std::filesystem::path& path,
                  Overwrite overwrite) {
  OutputFile file(path, overwrite);
  file.write(mappingJson(mapping).text() + "\n");
  file.commit();
}

}  // namespace palpate
