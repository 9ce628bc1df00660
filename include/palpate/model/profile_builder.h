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

  // The functions below append one sample. Its time [us since 1970] must be later than that of the
  // previous sample of the series. The number of values must be that of the layout (frames) or of
  // the first sample (angles, temperatures), and values must be finite. They throw
  // std::invalid_argument that names the violated rule.
  void addFrame(std::int64_t hostUs,
                std::span<const float> values,
                std::optional<std::int64_t> deviceUs = {});
  // Appends a frame of another profile with its filtered values, if any.
  void addFrame(const TactileFrame& frame);
  void addAngles(std::int64_t hostUs, std::span<const double> deg);
  void addTemperatures(std::int64_t hostUs, std::span<const double> degC);

  std::size_t numFrames() const noexcept;
  std::size_t numAngles() const noexcept;
  std::size_t numTemperatures() const noexcept;
  // Time stamp of the last sample of each series [us since 1970]; empty before the first sample.
  std::optional<std::int64_t> lastFrameUs() const noexcept;
  std::optional<std::int64_t> lastAngleUs() const noexcept;
  std::optional<std::int64_t> lastTemperatureUs() const noexcept;

  // Returns the profile and leaves the builder empty. Sets info.valueType from the data.
  Profile finish(ProfileInfo info);

 private:
  class Storage;
  void require(std::int64_t hostUs, std::span<const float> values) const;
  std::shared_ptr<const SensorLayout> layout_;
  std::optional<HandDescription> hand_;
  std::shared_ptr<Storage> storage_;
};

}  // namespace palpate
