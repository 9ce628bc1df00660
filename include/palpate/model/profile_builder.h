// Builds a profile in memory, sample by sample: readers, generators and filters use it. Frames are
// kept run-length coded, so an hour of an SDH-2 takes a few MB.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include <palpate/model/profile.h>

namespace palpate {

class ProfileBuilder {
 public:
  // The layout says how many values a frame has.
  explicit ProfileBuilder(std::shared_ptr<const SensorLayout> layout);
  ~ProfileBuilder();
  ProfileBuilder(ProfileBuilder&&) noexcept;

  // Appends. Time [us since 1970] must be later than the previous sample's; the number of values
  // must be the layout's (frames), or that of the first sample (angles, temperatures). Values must
  // be finite. Throws std::invalid_argument saying which.
  void addFrame(std::int64_t hostUs,
                std::span<const float> values,
                std::optional<std::int64_t> deviceMs = {});
  // A frame of another profile, with what filters gave beside its values.
  void addFrame(const TactileFrame& frame);
  void addAngles(std::int64_t hostUs, std::span<const double> deg);
  void addTemperatures(std::int64_t hostUs, std::span<const double> degC);

  std::size_t numFrames() const noexcept;
  std::size_t numAngles() const noexcept;
  std::size_t numTemperatures() const noexcept;
  // Stamp of the last sample added [us]; nothing before the first.
  std::optional<std::int64_t> lastFrameUs() const noexcept;
  std::optional<std::int64_t> lastAngleUs() const noexcept;
  std::optional<std::int64_t> lastTemperatureUs() const noexcept;

  // Hands the data over; the builder is empty afterwards. Sets info.valueType from the data.
  Profile finish(ProfileInfo info);

 private:
  class Storage;
  void require(std::int64_t hostUs, std::span<const float> values) const;
  std::shared_ptr<const SensorLayout> layout_;
  std::shared_ptr<Storage> storage_;
};

}  // namespace palpate
