#include "palpate/model/profile_builder.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <deque>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "palpate/model/frame_coding.h"

namespace palpate {
namespace {

// Samples are kept in chunks, so that appending never copies older samples and memory use has no
// peak.
constexpr std::size_t kFramesPerChunk = 1024;

struct FrameChunk {
  std::vector<std::int64_t> hostUs;
  std::vector<std::uint32_t> begin;  // of each frame in `bytes`
  std::vector<FrameCoding> coding;
  std::vector<std::optional<std::int64_t>> deviceUs;  // empty when no frame of the chunk has one
  std::vector<std::byte> bytes;
};

// Without an early exit, so that the compiler can vectorise the loop.
bool areFinite(std::span<const float> values) noexcept {
  constexpr std::uint32_t kExponent = 0x7F800000;  // all of its bits are set: infinite or no number
  std::uint32_t wrong = 0;
  for (const float value : values)
    wrong |=
        static_cast<std::uint32_t>((std::bit_cast<std::uint32_t>(value) & kExponent) == kExponent);
  return wrong == 0;
}

const char* const kHandSeriesNames[kHandSeries] = {"angles", "temperatures"};

// The samples of one series, with a fixed number of values each.
class Series {
 public:
  explicit Series(SeriesDescription of)
      : description(std::move(of)), width_(description.columns.size()) {}

  void add(std::int64_t hostUs,
           std::span<const double> values,
           std::optional<std::int64_t> deviceUs,
           bool maySkip) {
    const std::string& what = description.name;
    if (!hostUs_.empty() && hostUs <= hostUs_.back())
      throw std::invalid_argument(what + ": time must be later than the last sample's");
    if (values.empty() || (width_ != 0 && values.size() != width_))
      throw std::invalid_argument(what + ": expected " + std::to_string(width_) + " values, got " +
                                  std::to_string(values.size()));
    if (!std::all_of(values.begin(), values.end(), [&](double v) {
          return maySkip ? !std::isinf(v) : std::isfinite(v);
        }))
      throw std::invalid_argument(what + ": a value is not a number");
    width_ = values.size();
    if (deviceUs && deviceUs_.empty()) deviceUs_.resize(hostUs_.size());
    if (deviceUs || !deviceUs_.empty()) deviceUs_.push_back(deviceUs);
    hostUs_.push_back(hostUs);
    values_.insert(values_.end(), values.begin(), values.end());
  }
  std::size_t size() const noexcept { return hostUs_.size(); }
  std::size_t width() const noexcept { return width_; }
  std::int64_t timeUs(std::size_t sample) const { return hostUs_[sample]; }
  std::optional<std::int64_t> deviceUs(std::size_t sample) const {
    return sample < deviceUs_.size() ? deviceUs_[sample] : std::nullopt;
  }
  std::vector<double> values(std::size_t sample) const {
    const auto first = values_.begin() + static_cast<std::ptrdiff_t>(sample * width_);
    return {first, first + static_cast<std::ptrdiff_t>(width_)};
  }
  std::optional<std::int64_t> lastUs() const {
    return hostUs_.empty() ? std::nullopt : std::optional(hostUs_.back());
  }

  const SeriesDescription description;

 private:
  std::size_t width_ = 0;
  std::deque<std::int64_t> hostUs_;
  std::deque<std::optional<std::int64_t>> deviceUs_;  // empty when no sample has one
  std::deque<double> values_;
};

}  // namespace

class ProfileBuilder::Storage final : public ProfileStorage {
 public:
  std::size_t numFrames() const override { return numFrames_; }
  bool givesReadings() const override { return hasReadings; }
  std::int64_t frameTimeUs(std::size_t frame) const override {
    return chunks_[frame / kFramesPerChunk].hostUs[frame % kFramesPerChunk];
  }
  void readFrame(std::size_t frame, TactileFrame& out) const override {
    const FrameChunk& chunk = chunks_[frame / kFramesPerChunk];
    const std::size_t i = frame % kFramesPerChunk;
    out.deviceUs = i < chunk.deviceUs.size() ? chunk.deviceUs[i] : std::nullopt;
    const auto bytes = std::span(chunk.bytes).subspan(chunk.begin[i]);
    if (hasReadings)
      decodeFrame(bytes, chunk.coding[i], std::span(out.readings));
    else
      decodeFrame(bytes, chunk.coding[i], out);
  }
  std::size_t numSamples(std::size_t index) const override { return series[index].size(); }
  std::int64_t sampleTimeUs(std::size_t index, std::size_t sample) const override {
    return series[index].timeUs(sample);
  }
  Sample sample(std::size_t index, std::size_t sample) const override {
    const Series& of = series[index];
    return {of.timeUs(sample), of.values(sample), index, of.deviceUs(sample)};
  }

  // `Values` is a span of values, or a frame that may also have filtered values.
  template <typename Values>
  void addFrame(std::int64_t hostUs, const Values& values, std::optional<std::int64_t> deviceUs) {
    if (numFrames_ % kFramesPerChunk == 0) chunks_.emplace_back();
    FrameChunk& chunk = chunks_.back();
    const FrameCoding coding = codingFor(values);
    allCounts = allCounts && coding == FrameCoding::kCounts;
    chunk.begin.push_back(static_cast<std::uint32_t>(chunk.bytes.size()));
    encodeFrame(values, coding, chunk.bytes);
    chunk.hostUs.push_back(hostUs);
    // Many recordings have no device times; then no memory is used for them.
    if (deviceUs && chunk.deviceUs.empty()) chunk.deviceUs.resize(chunk.hostUs.size() - 1);
    if (deviceUs || !chunk.deviceUs.empty()) chunk.deviceUs.push_back(deviceUs);
    chunk.coding.push_back(coding);
    ++numFrames_;
    if (numFrames_ % kFramesPerChunk == 0) chunk.bytes.shrink_to_fit();
  }
  std::optional<std::int64_t> lastFrameUs() const {
    return numFrames_ == 0 ? std::nullopt : std::optional(frameTimeUs(numFrames_ - 1));
  }

  std::deque<Series> series{Series({kHandSeriesNames[kAngleSeries], {}, {}, {}}),
                            Series({kHandSeriesNames[kTemperatureSeries], {}, {}, {}})};
  bool allCounts = true;
  bool hasReadings = false;

 private:
  std::deque<FrameChunk> chunks_;
  std::size_t numFrames_ = 0;
};

ProfileBuilder::ProfileBuilder(std::shared_ptr<const SensorLayout> layout)
    : layout_(std::move(layout)) {
  if (!layout_) throw std::invalid_argument("ProfileBuilder: no sensor layout");
  storage_ = std::make_shared<Storage>();
}
ProfileBuilder::ProfileBuilder(HandDescription hand) : ProfileBuilder(hand.layout) {
  hand_ = std::move(hand);
}
ProfileBuilder::~ProfileBuilder() = default;
ProfileBuilder::ProfileBuilder(ProfileBuilder&&) noexcept = default;

void ProfileBuilder::require(std::int64_t hostUs,
                             std::span<const float> values,
                             std::size_t count) const {
  if (values.size() != count)
    throw std::invalid_argument("frame: expected " + std::to_string(count) + " values, got " +
                                std::to_string(values.size()));
  const auto last = storage_->lastFrameUs();
  if (last && hostUs <= *last)
    throw std::invalid_argument("frame: time must be later than the last frame's");
  if (!areFinite(values)) throw std::invalid_argument("frame: a value is not a number");
}

void ProfileBuilder::addFrame(std::int64_t hostUs,
                              std::span<const float> values,
                              std::optional<std::int64_t> deviceUs) {
  require(hostUs, values, layout_->numCells());
  if (storage_->hasReadings) throw std::invalid_argument("frame: values among readings");
  storage_->addFrame(hostUs, values, deviceUs);
}

void ProfileBuilder::addReadings(std::int64_t hostUs,
                                 std::span<const float> readings,
                                 std::optional<std::int64_t> deviceUs) {
  require(hostUs, readings, layout_->numReadings());
  if (!layout_->decidesTouch() || (numFrames() > 0 && !storage_->hasReadings))
    throw std::invalid_argument("frame: readings among values, or of a hand without such");
  storage_->hasReadings = true;
  storage_->addFrame(hostUs, readings, deviceUs);
}

void ProfileBuilder::addFrame(const TactileFrame& frame) {
  if (!frame.readings.empty()) return addReadings(frame.hostUs, frame.readings, frame.deviceUs);
  require(frame.hostUs, frame.values, layout_->numCells());
  if (!frame.filtered.empty()) require(frame.hostUs, frame.filtered, layout_->numCells());
  if (storage_->hasReadings) throw std::invalid_argument("frame: values among readings");
  storage_->addFrame(frame.hostUs, frame, frame.deviceUs);
}

std::size_t ProfileBuilder::addSeries(SeriesDescription description) {
  validate(description);
  for (const Series& other : storage_->series)
    if (other.description.name == description.name)
      throw std::invalid_argument("two series have the name " + description.name);
  storage_->series.emplace_back(std::move(description));
  return storage_->series.size() - 1;
}

void ProfileBuilder::addSample(std::size_t series,
                               std::int64_t hostUs,
                               std::span<const double> values,
                               std::optional<std::int64_t> deviceUs) {
  storage_->series.at(series).add(hostUs, values, deviceUs, series >= kHandSeries);
}

std::size_t ProfileBuilder::numFrames() const noexcept { return storage_->numFrames(); }
std::size_t ProfileBuilder::numSamples(std::size_t series) const {
  return storage_->series.at(series).size();
}
std::optional<std::int64_t> ProfileBuilder::lastFrameUs() const noexcept {
  return storage_->lastFrameUs();
}
std::optional<std::int64_t> ProfileBuilder::lastSampleUs(std::size_t series) const {
  return storage_->series.at(series).lastUs();
}

Profile ProfileBuilder::finish(ProfileInfo info) {
  const std::shared_ptr<Storage> storage = std::exchange(storage_, std::make_shared<Storage>());
  info.valueType = storage->allCounts ? ValueType::kCounts : ValueType::kFloat;
  const std::size_t axes = storage->series[kAngleSeries].width();
  const std::size_t sensors = storage->series[kTemperatureSeries].width();
  std::vector<SeriesDescription> further;
  for (std::size_t i = kHandSeries; i < storage->series.size(); ++i)
    further.push_back(storage->series[i].description);
  HandDescription hand =
      hand_ ? withSeriesOf(*hand_, axes, sensors) : describeHand(*layout_, axes, sensors);
  return Profile(std::move(info), std::move(hand), storage, std::move(further))
      .withBaselines(std::exchange(baselines_, {}));
}

}  // namespace palpate
