// Builds a profile in memory, sample by sample; readers, generators and filters use it. Frames are
// kept run-length coded, so that an hour of an SDH-2 takes a few MB.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include <palpate/model/profile.h>

namespace palpate {

// Collects samples and makes a Profile of them.
class ProfileBuilder {
 public:
  // The layout determines how many values a frame has. The profile's hand is describeHand().
  explicit ProfileBuilder(std::shared_ptr<const SensorLayout> layout);
  // The profile's hand is this one.
  explicit ProfileBuilder(HandDescription hand);
  ~ProfileBuilder();
  ProfileBuilder(ProfileBuilder&&) noexcept;

  // Adds a series beside those of the hand and returns its index. Throws std::invalid_argument as
  // validate() does, or when another one has its name.
  std::size_t addSeries(SeriesDescription description);

  // The functions below append one sample. Its time [us since 1970] must be later than that of the
  // previous one. The number of values must be that of the layout (frames: places or readings), of
  // the series' description, or of its first sample (angles, temperatures). Values must be finite;
  // those of a series beside the hand's may be NaN. They throw std::invalid_argument that names the
  // violated rule.
  void addFrame(std::int64_t hostUs,
                std::span<const float> values,
                std::optional<std::int64_t> deviceUs = {});
  // Readings whose touch is decided when they are read (model/touch.h); a profile has readings, or
  // values.
  void addReadings(std::int64_t hostUs,
                   std::span<const float> readings,
                   std::optional<std::int64_t> deviceUs = {});
  // Appends a frame of another profile with its readings, or its filtered values, if any.
  void addFrame(const TactileFrame& frame);
  void addSample(std::size_t series,
                 std::int64_t hostUs,
                 std::span<const double> values,
                 std::optional<std::int64_t> deviceUs = {});
  void addSample(const Sample& sample) {
    addSample(sample.series, sample.hostUs, sample.values, sample.deviceUs);
  }
  void addAngles(std::int64_t hostUs, std::span<const double> deg) {
    addSample(kAngleSeries, hostUs, deg);
  }
  void addTemperatures(std::int64_t hostUs, std::span<const double> degC) {
    addSample(kTemperatureSeries, hostUs, degC);
  }

  std::size_t numFrames() const noexcept;
  std::size_t numSamples(std::size_t series) const;
  std::size_t numAngles() const { return numSamples(kAngleSeries); }
  std::size_t numTemperatures() const { return numSamples(kTemperatureSeries); }
  // Time stamp of the last frame, and of the last sample of a series [us since 1970]; empty before
  // the first one.
  std::optional<std::int64_t> lastFrameUs() const noexcept;
  std::optional<std::int64_t> lastSampleUs(std::size_t series) const;
  std::optional<std::int64_t> lastAngleUs() const { return lastSampleUs(kAngleSeries); }
  std::optional<std::int64_t> lastTemperatureUs() const { return lastSampleUs(kTemperatureSeries); }

  // Those of the finished profile.
  void setBaselines(Baselines baselines) { baselines_ = std::move(baselines); }

  // Returns the profile and leaves the builder empty. Sets info.valueType from the data.
  Profile finish(ProfileInfo info);

 private:
  class Storage;
  void require(std::int64_t hostUs, std::span<const float> values, std::size_t count) const;
  std::shared_ptr<const SensorLayout> layout_;
  std::optional<HandDescription> hand_;
  std::shared_ptr<Storage> storage_;
  Baselines baselines_;
};

}  // namespace palpate
