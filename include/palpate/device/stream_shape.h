// What a stream of a hand carries, whatever its form: frames, joint angles, temperatures and a
// description, and the rules that every value must fulfil. docs/manual/stream_protocol.md specifies
// the forms: lines of text (StreamLineParser) and packets (StreamPacketParser).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <palpate/model/hand_description.h>

namespace palpate {

enum class StreamItemKind {
  kFrame,
  kAngles,
  kTemperatures,
  kDescription,
};

// One item as it was received. The views are valid only inside the call of the sink.
struct StreamItem {
  StreamItemKind kind = StreamItemKind::kFrame;
  // Of a frame: one value per place of the layout [unit of the hand]; 0 where no taxel exists.
  std::span<const float> values;
  // Of angles: one per axis [deg; mm for a sliding axis]. Of temperatures: one per sensor [deg C].
  std::span<const double> numbers;
  // Of a description: a JSON object.
  std::string_view text;
  // Time of the device's clock [us since any start]; empty when none was sent.
  std::optional<std::int64_t> deviceUs;
  // Number of the frame, modulo 2^32; empty when none was sent.
  std::optional<std::uint32_t> sequence;
};

// The number of values of each item, and the range of a taxel's value.
class StreamShape {
 public:
  // Throws std::invalid_argument when the hand has no layout or no full scale above 0.
  explicit StreamShape(const HandDescription& hand);

  // Values of a frame: readings, where the hand decides touch by its readings (model/touch.h).
  std::size_t numPlaces() const noexcept { return numPlaces_; }
  // Taxels that exist by the static masks: numPlaces() when no place is masked.
  std::size_t numTaxels() const noexcept { return numTaxels_; }
  std::size_t numAxes() const noexcept { return numAxes_; }
  std::size_t numTemperatures() const noexcept { return numTemperatures_; }
  const SensorLayout& layout() const noexcept { return *layout_; }

  // Numbers that an item of this kind has. A frame has a number per place, or a number per taxel
  // that exists, both in the order of the layout.
  bool fits(StreamItemKind kind, std::size_t count) const noexcept;
  // "256 numbers", "64 or 52 numbers"; for a hand without axes "no angles: the hand has no axes".
  std::string expected(StreamItemKind kind) const;

  // Makes a frame of `count` received values, which are the first ones of `values` (numPlaces()
  // floats): moves them to their places if only those of taxels were sent, and sets places without
  // a taxel to 0. Returns what is outside of the description, for example "value 17 is -3, not in
  // 0..4095 counts", with values counted from 1 as they were sent; empty when nothing is. Such a
  // value is kept; one that is not finite becomes 0, and the text says so.
  std::string arrange(std::span<float> values, std::size_t count) const;
  // The matrix of this name or short name, in letters of either case.
  std::optional<std::size_t> matrixNamed(std::string_view name) const noexcept;
  // Whether a line with this name is a frame by it: "frame", or the name of the hand or a matrix,
  // whatever stands in place of its blanks.
  bool isOwnName(std::string_view name) const noexcept;
  // Returns what is wrong with angles or temperatures: a value that is not finite.
  std::string check(std::span<const double> numbers) const;

 private:
  std::shared_ptr<const SensorLayout> layout_;
  std::size_t numPlaces_ = 0;
  std::size_t numTaxels_ = 0;
  std::size_t numAxes_ = 0;
  std::size_t numTemperatures_ = 0;
  std::vector<float> fullScales_;  // per matrix
  std::string unit_;
  std::string handName_;
  std::vector<std::pair<std::string, std::string>> names_;  // per matrix: name, short name
  std::vector<std::uint8_t> exists_;  // per place; empty when no place is masked
};

// The description that a sender may give of itself, a JSON object: "name", "serial" and "firmware"
// (texts) and "matrices" (a list of {"rows", "columns"}), all of them optional.
struct StreamDescription {
  std::string name;
  std::string serial;
  std::string firmware;
  // What does not agree with the hand; empty when all agrees.
  std::string mismatch;
};
// Throws Error when `text` is not such an object.
StreamDescription readStreamDescription(std::string_view text, const StreamShape& shape);

}  // namespace palpate
