#include "recording/dsa/dsa_document.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"

namespace palpate {
namespace {

constexpr std::int64_t kEndOfStampsMs = 7'258'118'400'000;  // 2200-01-01 [ms since 1970]
constexpr std::size_t kMaxTextBytes = 4096;                 // of a number, a list, a name
constexpr double kLargestNumber = 1e6;                      // of an angle [deg], a temperature [C]
constexpr std::size_t kMaxNumbers = 64;                     // of one angle or temperature sample
constexpr std::uint64_t kMaxUnknown = 100'000;  // elements, attributes that mean nothing

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

}  // namespace

std::uint64_t boundFor(std::uint64_t freeBytes, double ratio, std::uint64_t fileBytes) noexcept {
  const double scaled = ratio * static_cast<double>(fileBytes);
  constexpr double kMaximum = 9.0e18;
  return std::max(freeBytes, static_cast<std::uint64_t>(std::clamp(scaled, 0.0, kMaximum)));
}

std::uint64_t memoryBound(const DsaReadOptions& options,
                          bool compressed,
                          std::uint64_t fileBytes) noexcept {
  return boundFor(options.freeMemoryBytes,
                  compressed ? options.maxMemoryRatio : options.maxMemoryRatioPlain,
                  fileBytes);
}

DsaDocument::DsaDocument(const DsaReadOptions& options, std::uint64_t maxMemoryBytes)
    : options_(options),
      maxMemoryBytes_(maxMemoryBytes),
      nodes_{Node::kDocument},
      sensor_(options.maxMatrices, options.maxPlaces) {}

void DsaDocument::beginFragment(Fragment fragment) {
  switch (fragment) {
    case Fragment::kSensor:
      nodes_ = {Node::kRoot};
      break;
    case Fragment::kFrame:
      nodes_ = {Node::kData};
      break;
    case Fragment::kTemperatures:
      nodes_ = {Node::kTemperatures};
      break;
    case Fragment::kAngles:
      nodes_ = {Node::kAngleList};
      break;
  }
}

void DsaDocument::useLayout(std::shared_ptr<const SensorLayout> layout) {
  startBuilder(std::move(layout));
}

void DsaDocument::startBuilder(std::shared_ptr<const SensorLayout> layout) {
  layout_ = std::move(layout);
  values_.resize(layout_->numCells());
  foreignPlaces_.clear();
  std::uint32_t place = 0;
  for (const MatrixLayout& matrix : layout_->matrices())
    for (const auto exists : matrix.staticMask) {
      if (!exists) foreignPlaces_.push_back(place);
      ++place;
    }
  builder_.emplace(layout_);
}

void DsaDocument::startElement(std::string_view name, const char* const* attributes) {
  for (const Child& child : childrenOf(nodes_.back()))
    if (child.name == name) return enter(child, attributes);
  if (nodes_.back() == Node::kDocument)
    throw Error("the root element is " + inQuotes(name) + ", not \"root\": not a .dsa recording");
  if (firstUnknown_.empty()) firstUnknown_ = inQuotes(name);
  enterUnknown();
}

void DsaDocument::enterUnknown() {
  if (++unknownElements_ > kMaxUnknown)
    throw Error("more than " + std::to_string(kMaxUnknown) + " unknown elements, the first " +
                firstUnknown_);
  nodes_.push_back(Node::kUnknown);
}

void DsaDocument::enter(const Child& child, const char* const* attributes) {
  Series* series = nullptr;
  std::size_t number = 0;
  switch (child.node) {
    case Node::kSensor:
      if (sensorSeen_) throw Error("a second element sensor");
      sensorSeen_ = true;
      break;
    case Node::kMatrix:
      sensor_.beginMatrix();
      break;
    case Node::kData:
      beginPart(frames_);
      break;
    case Node::kTemperatures:
      beginPart(temperatures_);
      break;
    case Node::kAngleList:
      beginPart(angles_);
      break;
    case Node::kFrame:
      series = &frames_;
      number = numFrames();
      break;
    case Node::kTemperature:
      series = &temperatures_;
      number = numTemperatures();
      break;
    case Node::kAngle:
      series = &angles_;
      number = numAngles();
      break;
    case Node::kLeaf:
      beginLeaf(child);
      break;
    case Node::kDocument:
    case Node::kRoot:
    case Node::kIgnored:
    case Node::kUnknown:
      break;
  }
  if (series) {
    timeMs_.reset();
    hasData_ = false;
  }
  if (*attributes) countAttributes(attributes, series, number);
  nodes_.push_back(child.node);
}

void DsaDocument::beginPart(Series& series) {
  if (!layout_) throw Error("element " + std::string(series.element) + " comes before sensor");
  if (series.seen) throw Error("a second element " + std::string(series.element));
  series.seen = true;
}

// Every name is remembered by expat, so a flood of them must end.
void DsaDocument::countAttributes(const char* const* attributes,
                                  Series* series,
                                  std::size_t number) {
  for (; *attributes; attributes += 2) {
    const std::string_view name = attributes[0];
    if (name == "index") {
      if (series && parseInteger(attributes[1]) != static_cast<std::int64_t>(number))
        ++series->badIndices;
    } else if (name != "name" && ++unknownAttributes_ > kMaxUnknown) {
      throw Error("more than " + std::to_string(kMaxUnknown) + " unknown attributes");
    }
  }
}

void DsaDocument::beginLeaf(const Child& child) {
  leaf_ = child.leaf;
  field_ = child.field;
  leafName_ = child.name;
  text_.clear();
  switch (leaf_) {
    case Leaf::kTime:
      if (timeMs_) throw Error(here() + "a second time_stamp");
      break;
    case Leaf::kFrameData:
    case Leaf::kTemperatureData:
    case Leaf::kAngleData:
      if (hasData_) throw Error(here() + "a second " + leafName_);
      hasData_ = true;
      if (leaf_ == Leaf::kFrameData) decoder_.begin(values_);
      break;
    case Leaf::kSensorField:
    case Leaf::kFrameCount:
    case Leaf::kTemperatureCount:
    case Leaf::kAngleCount:
      break;
  }
}

void DsaDocument::text(std::string_view piece) {
  const Node node = nodes_.back();
  if (node == Node::kLeaf) {
    if (leaf_ == Leaf::kFrameData) {
      try {
        decoder_.add(piece);
      } catch (const Error& error) {
        throw Error(here() + error.what());
      }
      return;
    }
    const bool isMask = leaf_ == Leaf::kSensorField &&
                        (field_ == SensorField::kStaticMask || field_ == SensorField::kDynamicMask);
    const std::size_t limit = isMask ? options_.maxPlaces : kMaxTextBytes;
    // Blanks in front mean nothing; within a mask none does.
    if (isMask) {
      std::copy_if(piece.begin(), piece.end(), std::back_inserter(text_), [](char c) {
        return !isBlank(c);
      });
    } else {
      if (text_.empty())
        while (!piece.empty() && isBlank(piece.front())) piece.remove_prefix(1);
      text_ += piece;
    }
    if (text_.size() > limit)
      throw Error(here() + leafName_ + " is longer than " + std::to_string(limit) + " characters");
  } else if (node != Node::kIgnored && node != Node::kUnknown) {
    if (!std::all_of(piece.begin(), piece.end(), isBlank)) ++strayTexts_;
  }
}

void DsaDocument::endElement(std::string_view /*name*/) {
  const Node node = nodes_.back();
  nodes_.pop_back();
  switch (node) {
    case Node::kLeaf:
      endLeaf();
      break;
    case Node::kMatrix:
      sensor_.endMatrix();
      break;
    case Node::kSensor:
      startBuilder(std::make_shared<const SensorLayout>(sensor_.finish()));
      break;
    case Node::kFrame:
    case Node::kTemperature:
    case Node::kAngle:
      endSample(node);
      break;
    case Node::kDocument:
    case Node::kRoot:
    case Node::kData:
    case Node::kTemperatures:
    case Node::kAngleList:
    case Node::kIgnored:
    case Node::kUnknown:
      break;
  }
}

void DsaDocument::endLeaf() {
  while (!text_.empty() && isBlank(text_.back())) text_.pop_back();
  switch (leaf_) {
    case Leaf::kSensorField:
      sensor_.set(field_, text_);
      break;
    case Leaf::kFrameCount:
      frames_.declared = text_;
      break;
    case Leaf::kTemperatureCount:
      temperatures_.declared = text_;
      break;
    case Leaf::kAngleCount:
      angles_.declared = text_;
      break;
    case Leaf::kTime:
      timeMs_ = parseInteger(text_);
      if (!timeMs_) throw Error(here() + "time_stamp isn't a whole number: " + inQuotes(text_));
      if (*timeMs_ < 0 || *timeMs_ >= kEndOfStampsMs)
        throw Error(here() + "time_stamp " + std::to_string(*timeMs_) +
                    " is outside the years 1970 to 2199");
      break;
    case Leaf::kFrameData:
      try {
        decoder_.finish();
      } catch (const Error& error) {
        throw Error(here() + error.what());
      }
      break;
    case Leaf::kTemperatureData:
    case Leaf::kAngleData:
      parseNumbers(text_);
      break;
  }
}

void DsaDocument::parseNumbers(std::string_view text) {
  // A hand at rest sends the same angles again and again: four of five samples of the shared
  // recordings.
  if (!text.empty() && text == numbersText_) return;
  const std::string_view all = text;
  numbersText_.clear();
  numbers_.clear();
  for (bool more = true; more;) {
    if (numbers_.size() == kMaxNumbers)
      throw Error(here() + leafName_ + " has more than " + std::to_string(kMaxNumbers) +
                  " numbers");
    const std::size_t comma = text.find(',');
    more = comma != std::string_view::npos;
    const std::string_view item = text.substr(0, comma);
    const auto value = parseDouble(item);
    if (!value || std::abs(*value) > kLargestNumber)
      throw Error(here() + "value " + std::to_string(numbers_.size()) + " of " + leafName_ +
                  " isn't a valid number: " + inQuotes(item));
    numbers_.push_back(*value);
    if (more) text.remove_prefix(comma + 1);
  }
  numbersText_ = all;
}

// "frame 17: " within a sample, else nothing.
std::string DsaDocument::here() const {
  for (auto node = nodes_.rbegin(); node != nodes_.rend(); ++node) {
    if (*node == Node::kFrame) return "frame " + std::to_string(numFrames()) + ": ";
    if (*node == Node::kTemperature) return "temp " + std::to_string(numTemperatures()) + ": ";
    if (*node == Node::kAngle) return "angle " + std::to_string(numAngles()) + ": ";
    if (*node == Node::kMatrix) return "matrix " + std::to_string(sensor_.numMatrices()) + ": ";
  }
  return {};
}

// Stamps of a profile increase strictly: one that doesn't is moved behind the last.
std::int64_t DsaDocument::stampUs(Series& series, std::optional<std::int64_t> lastUs) {
  const std::int64_t us = *timeMs_ * 1000;
  if (!lastUs || us > *lastUs) return us;
  ++series.movedStamps;
  return *lastUs + 1000;
}

void DsaDocument::charge(std::uint64_t bytes) {
  memoryBytes_ += bytes;
  if (memoryBytes_ > maxMemoryBytes_)
    throw Error("it would take more than " + std::to_string(maxMemoryBytes_ >> 20) +
                " MB of memory, far more than its size explains");
}

void DsaDocument::clearForeignValues() {
  for (const std::uint32_t place : foreignPlaces_) {
    if (values_[place] == 0.0F) continue;
    values_[place] = 0.0F;
    ++foreignValues_;
  }
}

void DsaDocument::endSample(Node node) {
  nodes_.push_back(node);  // so that here() names the sample
  if (!timeMs_) throw Error(here() + "no time_stamp");
  const char* const data = node == Node::kFrame         ? "frame_data"
                           : node == Node::kTemperature ? "temp_data"
                                                        : "angle_data";
  if (!hasData_) throw Error(here() + "no " + std::string(data));
  try {
    if (node == Node::kFrame) {
      clearForeignValues();
      charge(32 + 2 * (values_.size() / 15) + 5 * decoder_.numTokens());
      builder_->addFrame(stampUs(frames_, builder_->lastFrameUs()), values_);
    } else if (node == Node::kTemperature) {
      charge(16 + sizeof(double) * numbers_.size());
      builder_->addTemperatures(stampUs(temperatures_, builder_->lastTemperatureUs()), numbers_);
    } else {
      charge(16 + sizeof(double) * numbers_.size());
      builder_->addAngles(stampUs(angles_, builder_->lastAngleUs()), numbers_);
    }
  } catch (const std::invalid_argument& error) {  // another number of values than the sample before
    throw Error(here() + error.what());
  }
  nodes_.pop_back();
}

std::span<const DsaDocument::Child> DsaDocument::childrenOf(Node node) {
  constexpr auto sensorLeaf = [](std::string_view name, SensorField field) {
    return Child{name, Node::kLeaf, Leaf::kSensorField, field};
  };
  static constexpr std::array kDocument = {Child{"root", Node::kRoot}};
  static constexpr std::array kRoot = {Child{"sensor", Node::kSensor},
                                       Child{"data", Node::kData},
                                       Child{"temperatures", Node::kTemperatures},
                                       Child{"joint_angles", Node::kAngleList}};
  static constexpr std::array kSensor = {Child{"matrix", Node::kMatrix},
                                         sensorLeaf("generated_by", SensorField::kFirmware),
                                         sensorLeaf("serial_nr", SensorField::kSerial),
                                         sensorLeaf("num_matrices", SensorField::kNumMatrices),
                                         Child{"hw_revision", Node::kIgnored},
                                         Child{"converter_resolution", Node::kIgnored}};
  static constexpr std::array kMatrix = {sensorLeaf("cells_x", SensorField::kColumns),
                                         sensorLeaf("cells_y", SensorField::kRows),
                                         sensorLeaf("texel_width", SensorField::kPitchX),
                                         sensorLeaf("texel_height", SensorField::kPitchY),
                                         sensorLeaf("static_mask", SensorField::kStaticMask),
                                         sensorLeaf("dynamic_mask", SensorField::kDynamicMask),
                                         Child{"matrix_center_x", Node::kIgnored},
                                         Child{"matrix_center_y", Node::kIgnored},
                                         Child{"matrix_center_z", Node::kIgnored},
                                         Child{"theta_x", Node::kIgnored},
                                         Child{"theta_y", Node::kIgnored},
                                         Child{"theta_z", Node::kIgnored},
                                         Child{"output_unit", Node::kIgnored},
                                         Child{"hw_revision", Node::kIgnored},
                                         sensorLeaf("one_wire_uid", SensorField::kUniqueId),
                                         Child{"fullscale", Node::kIgnored}};
  static constexpr std::array kData = {Child{"frame", Node::kFrame},
                                       Child{"frame_count", Node::kLeaf, Leaf::kFrameCount}};
  static constexpr std::array kFrame = {Child{"time_stamp", Node::kLeaf, Leaf::kTime},
                                        Child{"frame_data", Node::kLeaf, Leaf::kFrameData}};
  static constexpr std::array kTemperatures = {
      Child{"temp", Node::kTemperature}, Child{"temp_count", Node::kLeaf, Leaf::kTemperatureCount}};
  static constexpr std::array kTemperature = {
      Child{"time_stamp", Node::kLeaf, Leaf::kTime},
      Child{"temp_data", Node::kLeaf, Leaf::kTemperatureData}};
  static constexpr std::array kAngleList = {Child{"angle", Node::kAngle},
                                            Child{"angle_count", Node::kLeaf, Leaf::kAngleCount}};
  static constexpr std::array kAngle = {Child{"time_stamp", Node::kLeaf, Leaf::kTime},
                                        Child{"angle_data", Node::kLeaf, Leaf::kAngleData}};
  switch (node) {
    case Node::kDocument:
      return kDocument;
    case Node::kRoot:
      return kRoot;
    case Node::kSensor:
      return kSensor;
    case Node::kMatrix:
      return kMatrix;
    case Node::kData:
      return kData;
    case Node::kFrame:
      return kFrame;
    case Node::kTemperatures:
      return kTemperatures;
    case Node::kTemperature:
      return kTemperature;
    case Node::kAngleList:
      return kAngleList;
    case Node::kAngle:
      return kAngle;
    case Node::kLeaf:
    case Node::kIgnored:
    case Node::kUnknown:
      break;
  }
  return {};
}

void DsaDocument::compareCount(const Series& series, std::size_t found) {
  if (!series.seen) {
    warnings_.push_back("no element " + std::string(series.element));
    return;
  }
  const std::string name = series.counter;
  if (!series.declared)
    warnings_.push_back("no " + name + "; found " + std::to_string(found));
  else if (parseInteger(*series.declared) != static_cast<std::int64_t>(found))
    warnings_.push_back(name + " says " + inQuotes(*series.declared) + ", found " +
                        std::to_string(found));
}

void DsaDocument::addCountedWarnings() {
  const auto warn = [&](std::uint64_t count, const std::string& text) {
    if (count > 0) warnings_.push_back(text);
  };
  for (const Series* series : {&frames_, &temperatures_, &angles_}) {
    const std::string name = inQuotes(series->sample);
    warn(series->movedStamps,
         counted(series->movedStamps, "time stamp") + " of " + name +
             " not later than the one before: moved 1 ms after it");
    warn(
        series->badIndices,
        name + ": " + counted(series->badIndices, "index attribute") + " out of sequence, ignored");
  }
  warn(foreignValues_,
       counted(foreignValues_, "value") + " at places without a taxel (static_mask): taken as 0");
  warn(unknownElements_,
       counted(unknownElements_, "unknown element") + " skipped, the first " + firstUnknown_);
  warn(unknownAttributes_, counted(unknownAttributes_, "unknown attribute") + " skipped");
  warn(strayTexts_, counted(strayTexts_, "piece") + " of text between elements skipped");
}

Profile DsaDocument::handOver() {
  addCountedWarnings();
  ProfileInfo info;
  info.format = "dsa";
  info.serial = sensor_.serial();
  info.firmware = sensor_.firmware();
  info.sensorRevision = sensor_.firmware();
  info.warnings = sensor_.warnings();
  info.warnings.insert(info.warnings.end(), warnings_.begin(), warnings_.end());
  return builder_->finish(std::move(info));
}

Profile DsaDocument::finish() {
  if (!layout_) throw Error("no element sensor");
  if (!frames_.seen) throw Error("no element data");
  compareCount(frames_, numFrames());
  compareCount(temperatures_, numTemperatures());
  compareCount(angles_, numAngles());
  return handOver();
}

Profile DsaDocument::finishFragments() {
  // Which samples are missing is said elsewhere; indices and counts mean nothing here.
  for (Series* series : {&frames_, &temperatures_, &angles_}) series->badIndices = 0;
  return handOver();
}

}  // namespace palpate
