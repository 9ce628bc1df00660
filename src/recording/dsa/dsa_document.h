// The content of a .dsa recording: takes its XML element by element and builds a profile.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/core/xml.h"
#include "palpate/model/profile.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/dsa_reader.h"
#include "palpate/recording/frame_text.h"

#include "recording/dsa_sensor.h"

namespace palpate {

// A bound in bytes against files that expand to far more than a recording: `freeBytes`, or `ratio`
// times the file where that is more.
std::uint64_t boundFor(std::uint64_t freeBytes, double ratio, std::uint64_t fileBytes) noexcept;

// The same for the profile in memory.
std::uint64_t memoryBound(const DsaReadOptions& options,
                          bool compressed,
                          std::uint64_t fileBytes) noexcept;

// Handler of one document, or of single samples cut out of a damaged one. Throws Error with what is
// wrong and in which frame; the XML parser knows at which byte.
class DsaDocument final : public XmlHandler {
 public:
  // A whole document follows. `maxMemoryBytes` bounds the profile in memory.
  DsaDocument(const DsaReadOptions& options, std::uint64_t maxMemoryBytes);

  // Samples of a damaged document: which element comes next as the root of a small document. The
  // sensor must be known (given by useLayout() or read) before frames and other samples.
  enum class Fragment { kSensor, kFrame, kTemperatures, kAngles };
  void beginFragment(Fragment fragment);
  void useLayout(std::shared_ptr<const SensorLayout> layout);
  bool hasLayout() const noexcept { return layout_ != nullptr; }

  void startElement(std::string_view name, const char* const* attributes) override;
  void endElement(std::string_view name) override;
  void text(std::string_view piece) override;

  std::size_t numFrames() const noexcept { return builder_ ? builder_->numFrames() : 0; }
  std::size_t numAngles() const noexcept { return builder_ ? builder_->numAngles() : 0; }
  std::size_t numTemperatures() const noexcept {
    return builder_ ? builder_->numTemperatures() : 0;
  }

  // After the last element of a whole document: checks that the parts are there, compares the
  // declared counts, and hands the profile over.
  Profile finish();
  // After the last fragment: what was gathered. The layout must be known.
  Profile finishFragments();

 private:
  enum class Node : std::uint8_t {
    kDocument,
    kRoot,
    kSensor,
    kMatrix,
    kData,
    kFrame,
    kTemperatures,
    kTemperature,
    kAngleList,
    kAngle,
    kLeaf,     // an element whose text counts; leaf_ says which
    kIgnored,  // a known element that is not needed
    kUnknown,
  };
  enum class Leaf : std::uint8_t {
    kSensorField,
    kFrameCount,
    kTemperatureCount,
    kAngleCount,
    kTime,
    kFrameData,
    kTemperatureData,
    kAngleData,
  };
  struct Child {
    std::string_view name;
    Node node;
    Leaf leaf = Leaf::kTime;
    SensorField field = SensorField::kFirmware;
  };
  // A time series of samples with declared count and repaired stamps.
  struct Series {
    const char* sample;   // "frame"
    const char* element;  // "data"
    const char* counter;  // "frame_count"
    bool seen = false;
    std::optional<std::string> declared{};
    std::uint64_t movedStamps = 0;
    std::uint64_t badIndices = 0;
  };

  static std::span<const Child> childrenOf(Node node);
  void enter(const Child& child, const char* const* attributes);
  void enterUnknown();
  void beginPart(Series& series);
  void beginLeaf(const Child& child);
  void endLeaf();
  void endSample(Node node);
  void countAttributes(const char* const* attributes, Series* series, std::size_t number);
  void charge(std::uint64_t bytes);
  std::int64_t stampUs(Series& series, std::optional<std::int64_t> lastUs);
  void parseNumbers(std::string_view text);
  void clearForeignValues();
  std::string here() const;
  void startBuilder(std::shared_ptr<const SensorLayout> layout);
  void compareCount(const Series& series, std::size_t found);
  void addCountedWarnings();
  Profile handOver();

  DsaReadOptions options_;
  std::uint64_t maxMemoryBytes_;
  std::uint64_t memoryBytes_ = 0;  // of the samples so far, roughly

  std::vector<Node> nodes_;
  Leaf leaf_ = Leaf::kTime;
  SensorField field_ = SensorField::kFirmware;
  std::string leafName_;
  std::string text_;  // of the leaf, where it is short

  DsaSensor sensor_;
  bool sensorSeen_ = false;
  std::shared_ptr<const SensorLayout> layout_;
  std::vector<std::uint32_t> foreignPlaces_;  // places without a taxel
  std::optional<ProfileBuilder> builder_;

  Series frames_{"frame", "data", "frame_count"};
  Series temperatures_{"temp", "temperatures", "temp_count"};
  Series angles_{"angle", "joint_angles", "angle_count"};

  // The sample that is open.
  std::optional<std::int64_t> timeMs_;
  bool hasData_ = false;
  FrameTextDecoder decoder_;
  std::vector<float> values_;
  std::vector<double> numbers_;
  std::string numbersText_;  // that numbers_ were parsed from; empty when they weren't all right

  std::uint64_t unknownElements_ = 0;
  std::uint64_t unknownAttributes_ = 0;
  std::uint64_t strayTexts_ = 0;
  std::uint64_t foreignValues_ = 0;
  std::string firstUnknown_;
  std::vector<std::string> warnings_;
};

}  // namespace palpate
