// Writes and reads the noise floor as JSON and as the prior program's XML (noise_floor.h).
#include <algorithm>
#include <string>
#include <utility>

#include "palpate/calibration/noise_floor.h"
#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/core/xml.h"

namespace palpate {
namespace {

class NoiseXmlHandler final : public XmlHandler {
 public:
  explicit NoiseXmlHandler(const std::filesystem::path& name) : name_(name) {}

  void startElement(std::string_view name, const char* const* attributes) override {
    ++depth_;
    text_.clear();
    if (depth_ == 1 && name != "calibration")
      fail("isn't a calibration: its root is <" + std::string(name) + ">");
    if (depth_ != 2 || name != "matrix") return;
    NoiseLine line;
    for (; *attributes != nullptr; attributes += 2)
      if (std::string_view(attributes[0]) == "id") line.matrix = index(attributes[1]);
    if (line.matrix != lines.size())
      fail("its matrices aren't numbered 0, 1, ..: <matrix id=\"" + std::to_string(line.matrix) +
           "\">");
    found_ = 0;
    lines.push_back(line);
  }
  void endElement(std::string_view name) override {
    if (depth_ == 3 && !lines.empty()) {
      NoiseLine& line = lines.back();
      if (name == "slope") take(line.slope);
      if (name == "intercept") take(line.intercept);
      if (name == "RMSE") {
        take(line.rmse);
        line.rmseTrue = line.rmse;
      }
    }
    if (depth_ == 2 && name == "matrix") {
      if (found_ != 3)
        fail("matrix " + std::to_string(lines.size() - 1) + " lacks slope, intercept or RMSE");
      lines.back().valid = true;
    }
    --depth_;
  }
  void text(std::string_view piece) override { text_ += piece; }

  std::vector<NoiseLine> lines;

 private:
  [[noreturn]] void fail(const std::string& what) const { throw FormatError(name_, what); }
  std::size_t index(std::string_view text) const {
    const auto number = parseInteger(text);
    if (!number || *number < 0) fail("<matrix id=\"" + shortened(text) + "\"> isn't a number");
    return static_cast<std::size_t>(*number);
  }
  void take(double& value) {
    const auto number = parseDouble(text_);
    if (!number) fail("'" + shortened(text_) + "' isn't a number");
    value = *number;
    ++found_;
  }

  std::filesystem::path name_;
  std::string text_;
  int depth_ = 0;
  int found_ = 0;
};

}  // namespace

Json jsonOf(const NoiseFloor& floor) {
  const auto texts = [](const std::vector<std::string>& notes) {
    Json list = Json::array();
    for (const std::string& note : notes) list.push(note);
    return list;
  };
  Json matrices = Json::array();
  for (const NoiseLine& line : floor.lines) {
    Json bins = Json::array();
    for (const NoiseBin& bin : line.bins)
      bins.push(Json::object()
                    .set("temperature_c", bin.centreDegC)
                    .set("mean", bin.mean)
                    .set("sd", bin.sd)
                    .set("count", bin.count));
    matrices.push(Json::object()
                      .set("index", line.matrix)
                      .set("slope", line.slope)
                      .set("intercept", line.intercept)
                      .set("rmse", line.rmse)
                      .set("rmse_true", line.rmseTrue)
                      .set("valid", line.valid)
                      .set("at_rest", line.atRest)
                      .set("frames", line.numFrames)
                      .set("outliers", line.numOutliers)
                      .set("least_temperature_c", line.minDegC)
                      .set("most_temperature_c", line.maxDegC)
                      .set("mean_temperature_c", line.meanDegC)
                      .set("spread_c2", line.spreadDegC2)
                      .set("bins", std::move(bins))
                      .set("notes", texts(line.notes)));
  }
  return Json::object()
      .set("matrices", std::move(matrices))
      .set("notes", texts(floor.notes))
      .set("not_at_rest", floor.notAtRest);
}

NoiseFloor noiseFloorFrom(const Json& json) {
  NoiseFloor floor;
  const Json matrices = json.at("matrices");
  if (!matrices.isArray()) throw Error("no noise lines: 'matrices' is missing");
  for (std::size_t m = 0; m < matrices.size(); ++m) {
    const Json one = matrices.at(m);
    for (const char* key : {"slope", "intercept", "rmse"})
      if (!one.at(key).isNumber())
        throw Error("noise line " + std::to_string(m) + " lacks '" + shortened(key) + "'");
    const auto number = [&](const char* key, double otherwise) {
      return one.at(key).isNumber() ? one.at(key).asDouble() : otherwise;
    };
    NoiseLine line;
    line.matrix = m;
    line.slope = one.at("slope").asDouble();
    line.intercept = one.at("intercept").asDouble();
    line.rmse = one.at("rmse").asDouble();
    line.rmseTrue = number("rmse_true", line.rmse);
    line.valid = !one.at("valid").isBool() || one.at("valid").asBool();
    line.atRest = !one.at("at_rest").isBool() || one.at("at_rest").asBool();
    line.numFrames = static_cast<std::size_t>(std::max(number("frames", 0.0), 0.0));
    line.minDegC = number("least_temperature_c", 0.0);
    line.maxDegC = number("most_temperature_c", 0.0);
    line.meanDegC = number("mean_temperature_c", 0.0);
    line.spreadDegC2 = number("spread_c2", 0.0);
    floor.lines.push_back(line);
  }
  if (json.at("not_at_rest").isString()) floor.notAtRest = json.at("not_at_rest").asString();
  return floor;
}

std::string noiseXml(const NoiseFloor& floor) {
  if (!floor.notAtRest.empty())
    throw Error(floor.notAtRest +
                "; these lines are not noise, and an .xml file can't record that: save them as "
                ".json, or record the hand while nothing touches it");
  std::string xml = "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<calibration>\n";
  for (const NoiseLine& line : floor.lines) {
    xml += "  <matrix id=\"" + std::to_string(line.matrix) + "\">\n";
    xml += "    <slope>" + numberText(line.slope) + "</slope>\n";
    xml += "    <intercept>" + numberText(line.intercept) + "</intercept>\n";
    xml += "    <RMSE>" + numberText(line.rmse) + "</RMSE>\n";
    xml += "  </matrix>\n";
  }
  return xml + "</calibration>\n";
}

NoiseFloor parseNoiseXml(std::string_view xml, const std::filesystem::path& name) {
  NoiseXmlHandler handler(name);
  XmlParser parser(handler);
  try {
    parser.push(xml);
    parser.finish();
  } catch (const XmlError& error) {
    throw FormatError(name, error.what(), error.offset());
  }
  if (handler.lines.empty())
    throw FormatError(name, "isn't a noise calibration: it has no <matrix>");
  return {std::move(handler.lines), {}, {}};
}

}  // namespace palpate
