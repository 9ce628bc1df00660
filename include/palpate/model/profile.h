// A profile: the pressure, angles and temperatures of one recording as data, read-only, with random
// access. Three independent time series with their own stamps; rates are never assumed (gaps of
// minutes occur). Data is never changed after recording: a crop is a new profile.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <palpate/model/hand_description.h>
#include <palpate/model/hand_state.h>
#include <palpate/model/tactile_frame.h>

namespace palpate {

enum class ValueType { kCounts, kFloat };

// What a recording says about itself.
struct ProfileInfo {
  std::string format;  // "dsa", "palpate", "synthetic"
  std::string serial;  // tactile controller, as written ("1D9B0057"); may be empty
  // of the tactile controller ("2.9.0.0"); of a .dsa its generated_by; may be empty
  std::string firmware;
  std::string sensorRevision;  // generated_by of the sensor's description ("105"); may be empty
  ValueType valueType = ValueType::kCounts;
  std::vector<std::string> warnings;  // oddities that cost nothing ("declared 12 frames, found 10")
};

// Where the data lies: memory, or a file. Indices are checked by Profile. Const calls may come from
// several threads at once.
class ProfileStorage {
 public:
  virtual ~ProfileStorage() = default;
  virtual std::size_t numFrames() const = 0;
  virtual std::int64_t frameTimeUs(std::size_t frame) const = 0;
  // Writes layout.numCells() values and the device time.
  virtual void readFrame(std::size_t frame, TactileFrame& out) const = 0;
  virtual std::size_t numAngles() const = 0;
  virtual std::int64_t angleTimeUs(std::size_t sample) const = 0;
  virtual JointAngles angles(std::size_t sample) const = 0;
  virtual std::size_t numTemperatures() const = 0;
  virtual std::int64_t temperatureTimeUs(std::size_t sample) const = 0;
  virtual Temperatures temperatures(std::size_t sample) const = 0;
};

// Cheap to copy (shared storage). Const member functions may be called from several threads at
// once. All accessors throw std::out_of_range for an index that isn't there.
class Profile {
 public:
  Profile(ProfileInfo info, HandDescription hand, std::shared_ptr<const ProfileStorage> storage);

  const ProfileInfo& info() const noexcept { return data_->info; }
  const HandDescription& hand() const noexcept { return data_->hand; }
  const SensorLayout& layout() const noexcept { return *data_->hand.layout; }

  std::size_t numFrames() const { return data_->storage->numFrames(); }
  std::int64_t frameTimeUs(std::size_t frame) const;  // [us since 1970], strictly increasing
  TactileFrame frame(std::size_t frame) const;
  // As frame(), reusing the memory of `out`.
  void readFrame(std::size_t frame, TactileFrame& out) const;

  std::size_t numAngles() const { return data_->storage->numAngles(); }
  std::int64_t angleTimeUs(std::size_t sample) const;
  JointAngles angles(std::size_t sample) const;

  std::size_t numTemperatures() const { return data_->storage->numTemperatures(); }
  std::int64_t temperatureTimeUs(std::size_t sample) const;
  Temperatures temperatures(std::size_t sample) const;

  // The last frame at or before a time, clamped at both ends; nothing in an empty profile.
  std::optional<std::size_t> frameAt(std::int64_t timeUs) const;
  // Angles and temperatures that belong to a time or a frame: the last sample at or before it,
  // before the first one the first, after the last one the last; nothing where there are none.
  std::optional<std::size_t> angleSampleAt(std::int64_t timeUs) const;
  std::optional<std::size_t> temperatureSampleAt(std::int64_t timeUs) const;
  std::optional<JointAngles> anglesAtFrame(std::size_t frame) const;
  std::optional<Temperatures> temperaturesAtFrame(std::size_t frame) const;

  // Time from the first to the last frame [us]; 0 with fewer than two.
  std::int64_t durationUs() const;

 private:
  struct Data {
    ProfileInfo info;
    HandDescription hand;
    std::shared_ptr<const ProfileStorage> storage;
  };
  std::shared_ptr<const Data> data_;
};

}  // namespace palpate
