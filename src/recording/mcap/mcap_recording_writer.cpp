#include "recording/mcap/mcap_recording_writer.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "palpate/core/json.h"
#include "palpate/core/number_text.h"
#include "palpate/core/time.h"
#include "palpate/model/active_taxels.h"
#include "palpate/model/hand_file.h"

#include "recording/mcap/mcap_format.h"
#include "recording/mcap/mcap_messages.h"
#include "recording/profile_meta.h"
#include "recording/sample_columns.h"

namespace palpate {
namespace {

using McapTexts = McapFileWriter::Texts;

// A profile of ROS 2 asks for this key.
McapTexts withQos(McapTexts metadata) {
  metadata["offered_qos_profiles"] = "";
  return metadata;
}

std::string mcapMaskText(const Mask& mask) {
  std::string text;
  for (const auto on : mask) text += on != 0 ? '1' : '0';
  return text;
}

McapTexts mcapSafeTexts(const std::map<std::string, std::string>& texts) {
  McapTexts safe;
  for (const auto& [key, value] : texts) safe[mcapSafeText(key)] = mcapSafeText(value);
  return safe;
}

std::string_view mcapRosProfile(const McapWriteOptions& options) {
  return options.images == McapImages::kRos ? "ros2" : "";
}

// Severity of rcl_interfaces/msg/Log.
std::uint8_t mcapLogLevel(const std::string& kind) {
  constexpr std::uint8_t kInfo = 20;
  constexpr std::uint8_t kWarn = 30;
  return kind == "gap" || kind == "alarm" || kind == "fault" ? kWarn : kInfo;
}

}  // namespace

McapRecordingWriter::McapRecordingWriter(McapFileWriter::Write write,
                                         const HandDescription& hand,
                                         std::optional<bool> counts,
                                         const RecordingMeta& meta,
                                         const Provenance& provenance,
                                         const McapWriteOptions& options)
    : hand_(hand),
      counts_(counts),
      images_(options.images),
      file_(std::move(write),
            mcapRosProfile(options),
            mcapShownText(provenance.program.empty() ? "palpate" : provenance.program),
            options) {
  about_ = mcapSafeTexts({{"program", provenance.program},
                          {"source_file", provenance.sourceFile},
                          {"source_sha256", provenance.sourceSha256},
                          {"filters", provenance.filters},
                          {"calibration", provenance.calibration},
                          {"hand", provenance.hand.empty() ? hand.name : provenance.hand}});
  about_["matrices"] = std::to_string(hand.layout->numMatrices());
  if (counts) about_["value_type"] = *counts ? "counts" : "float";
  requireVersion(hand.layout->hasSquareTaxels() ? mcap_format::kUnfilteredLayoutVersion
                                                : kMcapLayoutVersion);

  RecordingMeta said = writtenMeta({}, hand, meta);
  const std::string json = said["hand_json"];
  const std::string urdf = said["hand_urdf"];
  said.erase("hand_json");
  said.erase("hand_urdf");
  file_.addMetadata(mcap_format::kMetaRecord, mcapSafeTexts(said));
  if (!json.empty()) file_.addAttachment(mcap_format::kHandJson, "application/json", 0, json);
  if (!urdf.empty()) file_.addAttachment(mcap_format::kHandUrdf, "application/xml", 0, urdf);

  const auto schemaOf = [&](const McapSchemaText& schema) {
    return file_.addSchema(schema.name, schema.encoding, schema.data);
  };
  frames_ = file_.addChannel(schemaOf(mcapFrameSchema()), mcap_format::kFrames, "cdr", withQos({}));
  const bool ros = images_ == McapImages::kRos;
  const std::uint16_t imageSchema = schemaOf(ros ? mcapImageSchema() : mcapRawImageSchema());
  for (std::size_t m = 0; m < hand.layout->numMatrices(); ++m) {
    const MatrixLayout& layout = hand.layout->matrix(m);
    McapTexts about = {{"name", mcapShownText(hand.matrixName(m))},
                       {"unit", mcapShownText(hand.unit)},
                       {"rows", std::to_string(layout.rows)},
                       {"columns", std::to_string(layout.columns)},
                       {"pitch_mm", numberText(layout.pitchMm.x)},
                       {"unique_id", mcapSafeText(layout.uniqueId)},
                       {"static_mask", mcapMaskText(layout.staticMask)},
                       {"dynamic_mask", mcapMaskText(layout.dynamicMask)}};
    if (!layout.pitchMm.isSquare()) about["pitch_y_mm"] = numberText(layout.pitchMm.y);
    imageChannels_.push_back(file_.addChannel(imageSchema,
                                              mcap_format::imageTopic(m),
                                              ros ? "cdr" : "protobuf",
                                              withQos(std::move(about))));
    frameIds_.push_back("m" + std::to_string(m));
  }
  events_ = file_.addChannel(schemaOf(mcapEventSchema()), mcap_format::kEvents, "cdr", withQos({}));
  log_ = file_.addChannel(schemaOf(mcapLogSchema()), mcap_format::kLog, "cdr", withQos({}));
}

void McapRecordingWriter::requireVersion(int version) {
  if (version <= version_) return;
  version_ = version;
  about_["layout_version"] = std::to_string(version);
  file_.addMetadata(mcap_format::kAboutRecord, about_);
}

std::uint16_t McapRecordingWriter::valuesChannel(const std::string& topic,
                                                 const std::vector<Column>& columns) {
  if (!valuesSchema_) {
    const McapSchemaText schema = mcapValuesSchema();
    valuesSchema_ = file_.addSchema(schema.name, schema.encoding, schema.data);
  }
  const Json names =
      jsonList(columns, [](const auto& column) { return mcapShownText(column.name); });
  const Json units =
      jsonList(columns, [](const auto& column) { return mcapShownText(column.unit); });
  return file_.addChannel(*valuesSchema_,
                          topic,
                          "cdr",
                          withQos({{"columns", names.text(-1)}, {"units", units.text(-1)}}));
}

void McapRecordingWriter::beginAngles(std::size_t width) {
  angles_ = valuesChannel(mcap_format::kAngles, angleColumns(hand_, width));
  numAngles_ = width;
  const McapSchemaText schema = mcapJointStateSchema();
  jointStates_ = file_.addChannel(file_.addSchema(schema.name, schema.encoding, schema.data),
                                  mcap_format::kJointStates,
                                  "cdr",
                                  withQos({}));
  std::string message;
  CdrWriter cdr(message);
  cdr.time(0);
  const std::size_t begin = message.size();
  cdr.text("");
  joints_ = shownJoints(withSeriesOf(hand_, width, 0));
  cdr.number(static_cast<std::uint32_t>(joints_.size()));
  for (const HandJoint& joint : joints_) cdr.text(mcapShownText(joint.name));
  jointNames_ = message.substr(begin);
}

void McapRecordingWriter::beginTemperatures(std::size_t width) {
  temperatures_ = valuesChannel(mcap_format::kTemperatures, temperatureColumns(hand_, width));
  numTemperatures_ = width;
}

void McapRecordingWriter::beginSamples(std::size_t series, const SeriesDescription& description) {
  if (!sampleSchema_) {
    const McapSchemaText schema = mcapSampleSchema();
    sampleSchema_ = file_.addSchema(schema.name, schema.encoding, schema.data);
  }
  const auto listOf = [&](std::string Column::*text) {
    return jsonList(description.columns,
                    [&](const Column& column) { return mcapSafeText(column.*text); })
        .text(-1);
  };
  samples_[series] = {file_.addChannel(*sampleSchema_,
                                       mcap_format::kSeries + description.name,
                                       "cdr",
                                       withQos({{"columns", listOf(&Column::name)},
                                                {"units", listOf(&Column::unit)},
                                                {"role", mcapSafeText(description.role)},
                                                {"source", mcapSafeText(description.source)}})),
                      description.columns.size()};
  // Earlier programs would leave the series out without a word.
  requireVersion(kMcapLayoutVersion);
}

std::uint16_t McapRecordingWriter::beginSeries(const std::string& name,
                                               const std::vector<Column>& columns) {
  return valuesChannel("/palpate/" + name, columns);
}

void McapRecordingWriter::addValues(std::uint16_t channel,
                                    std::int64_t timeUs,
                                    std::span<const double> values) {
  std::string& out = file_.beginMessage(channel, mcap_format::timeNs(timeUs));
  CdrWriter cdr(out);
  cdr.number(timeUs);
  cdr.sequence(values);
  file_.endMessage();
}

void McapRecordingWriter::addRow(std::uint16_t series,
                                 std::int64_t timeUs,
                                 std::span<const double> values) {
  addValues(series, timeUs, values);
  file_.endGroup();
}

void McapRecordingWriter::addImage(std::size_t matrix, const TactileFrame& frame, bool counts) {
  const MatrixLayout& layout = hand_.layout->matrix(matrix);
  const std::size_t cells = layout.numCells();
  const std::size_t pixelBytes = counts ? sizeof(std::uint16_t) : sizeof(float);
  std::string& out = file_.beginMessage(imageChannels_[matrix], mcap_format::timeNs(frame.hostUs));
  McapImage image;
  image.timeUs = frame.hostUs;
  image.rows = static_cast<std::uint32_t>(layout.rows);
  image.columns = static_cast<std::uint32_t>(layout.columns);
  image.encoding = counts ? "mono16" : "32FC1";
  image.step = static_cast<std::uint32_t>(image.columns * pixelBytes);
  if (images_ == McapImages::kRos)
    appendRosImageHead(out, image, frameIds_[matrix]);
  else
    appendRawImageHead(out, image, frameIds_[matrix]);
  const float* values = frame.allValues().data() + hand_.layout->offset(matrix);
  const std::size_t at = out.size();
  out.resize(at + cells * pixelBytes);
  if (counts) {
    char* to = out.data() + at;
    for (std::size_t k = 0; k < cells; ++k) {
      const auto value = static_cast<std::uint16_t>(static_cast<int>(values[k]));
      std::memcpy(to + 2 * k, &value, sizeof value);
    }
  } else {
    std::memcpy(out.data() + at, values, cells * sizeof(float));
  }
  file_.endMessage();
}

void McapRecordingWriter::addFrame(const TactileFrame& frame) {
  const SensorLayout& layout = *hand_.layout;
  if (frame.values.size() != layout.numCells() ||
      (!frame.filtered.empty() && frame.filtered.size() != layout.numCells()))
    throw std::invalid_argument("McapRecordingWriter: a frame of another layout");
  const bool isCounts = (!counts_ || *counts_) && frame.filtered.empty() && frame.isCounts();
  if (counts_ && *counts_ && !isCounts)
    throw std::invalid_argument("writeMcap: a frame of a recording of counts has another value");
  // Earlier programs would read the values below 0 of filtered frames as 0: the record again, with
  // the version that they refuse, is the one that counts.
  if (!frame.filtered.empty()) requireVersion(mcap_format::kFilteredLayoutVersion);
  std::string& out = file_.beginMessage(frames_, mcap_format::timeNs(frame.hostUs));
  CdrWriter cdr(out);
  cdr.number(frame.hostUs);
  cdr.number(frame.deviceUs ? floorMs(*frame.deviceUs) : mcap_format::kNoDeviceTime);
  cdr.number(static_cast<std::uint8_t>(frame.filtered.empty() ? 0 : 1));
  std::vector<std::uint8_t> active(frame.filtered.empty() ? 0 : (frame.values.size() + 7) / 8);
  std::vector<std::uint8_t> kept(active.size());
  const auto set = [](std::vector<std::uint8_t>& mask, std::size_t k, bool on) {
    mask[k / 8] = static_cast<std::uint8_t>(mask[k / 8] | unsigned{on} << k % 8);
  };
  if (!active.empty())
    for (std::size_t k = 0; k < frame.values.size(); ++k) {
      set(active, k, isActive(frame, k));
      set(kept, k, isKept(frame, k));
    }
  cdr.sequence(std::span<const std::uint8_t>(active));
  cdr.sequence(std::span<const std::uint8_t>(kept));
  file_.endMessage();
  for (std::size_t m = 0; m < layout.numMatrices(); ++m) addImage(m, frame, isCounts);
  file_.endGroup();
}

void McapRecordingWriter::addSample(const Sample& sample) {
  if (sample.series == kAngleSeries) return addAngles(sample);
  if (sample.series == kTemperatureSeries) return addTemperatures(sample);
  const auto known = samples_.find(sample.series);
  if (known == samples_.end())
    throw std::invalid_argument("McapRecordingWriter: a sample of a series that was not begun");
  const SampleChannel& channel = known->second;
  if (sample.values.size() != channel.width)
    throw std::invalid_argument("McapRecordingWriter: a different number of values");
  std::string& out = file_.beginMessage(channel.id, mcap_format::timeNs(sample.hostUs));
  CdrWriter cdr(out);
  cdr.number(sample.hostUs);
  cdr.number(sample.deviceUs.value_or(mcap_format::kNoDeviceTime));
  cdr.sequence(std::span<const double>(sample.values));
  file_.endMessage();
  file_.endGroup();
}

void McapRecordingWriter::addAngles(const Sample& angles) {
  if (!angles_) beginAngles(angles.values.size());
  if (angles.values.size() != numAngles_)
    throw std::invalid_argument("McapRecordingWriter: a different number of angles");
  addValues(*angles_, angles.hostUs, angles.values);
  std::string& out = file_.beginMessage(jointStates_, mcap_format::timeNs(angles.hostUs));
  CdrWriter cdr(out);
  cdr.time(angles.hostUs);
  out += jointNames_;
  std::vector<double> positions;
  for (const HandJoint& joint : joints_) positions.push_back(joint.valueSi(angles.values));
  cdr.sequence(std::span<const double>(positions));
  cdr.sequence(std::span<const double>());
  cdr.sequence(std::span<const double>());
  file_.endMessage();
  file_.endGroup();
}

void McapRecordingWriter::addTemperatures(const Sample& temperatures) {
  if (!temperatures_) beginTemperatures(temperatures.values.size());
  if (temperatures.values.size() != numTemperatures_)
    throw std::invalid_argument("McapRecordingWriter: a different number of temperatures");
  addValues(*temperatures_, temperatures.hostUs, temperatures.values);
  file_.endGroup();
}

void McapRecordingWriter::addEvent(const Event& event) {
  std::string& out = file_.beginMessage(events_, mcap_format::timeNs(event.tUs));
  {
    CdrWriter cdr(out);
    cdr.number(event.tUs);
    cdr.number(event.t1Us);
    cdr.number(std::int32_t{event.matrix.value_or(mcap_format::kNoMatrix)});
    cdr.text(mcapSafeText(event.kind));
    cdr.text(mcapSafeText(event.text));
    cdr.text(mcapSafeText(event.json));
  }
  file_.endMessage();
  std::string& shown = file_.beginMessage(log_, mcap_format::timeNs(event.tUs));
  CdrWriter cdr(shown);
  cdr.time(event.tUs);
  cdr.number(mcapLogLevel(event.kind));
  cdr.text(mcapShownText(event.kind));
  cdr.text(mcapShownText(event.text));
  cdr.text("");
  cdr.text(event.matrix ? "m" + std::to_string(*event.matrix) : "");
  cdr.number(std::uint32_t{0});
  file_.endMessage();
  file_.endGroup();
}

}  // namespace palpate
