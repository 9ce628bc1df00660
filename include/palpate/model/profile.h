// A profile is the data of one recording: tactile frames and any number of series (joint angles,
// temperatures, a load cell, ..), read-only and with random access. Frames and series are
// independent and have their own time stamps. No sampling rate is assumed, since gaps of minutes
// occur. Data never changes after recording: a crop is a new profile. Readers make profiles;
// filters, signals, playback and the window read them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/model/hand_description.h>
#include <palpate/model/series.h>
#include <palpate/model/tactile_frame.h>
#include <palpate/model/touch.h>

namespace palpate {

// Whether all values of the frames are whole counts, or floats (filtered, for example).
enum class ValueType { kCounts, kFloat };

// What a recording says about its origin and its quality.
struct ProfileInfo {
  std::string format;  // "dsa", "palpate", "synthetic"
  // Serial number of the tactile controller as written in the recording ("1D9B0057"); may be empty.
  std::string serial;
  // Firmware of the tactile controller ("2.9.0.0"); in a .dsa its generated_by; may be empty.
  std::string firmware;
  // Revision of the sensor: generated_by of the sensor's description ("105"); may be empty.
  std::string sensorRevision;
  ValueType valueType = ValueType::kCounts;
  // Oddities of the file that lost no data ("declared 12 frames, found 10").
  std::vector<std::string> warnings;
};

// What a pass over a profile could not read because the file is damaged there.
struct UnreadableSamples {
  // First and last index of samples that follow each other.
  struct Run {
    std::size_t first = 0;
    std::size_t last = 0;
    bool operator==(const Run&) const = default;
  };
  std::size_t count = 0;
  std::vector<Run> runs;   // in order
  std::string firstFault;  // why the first of them can't be read; empty if there is none
  // Adds a sample; indices ascend.
  void add(std::size_t index, const char* fault);
};

// Access to the data of a profile in memory or in a file. Profile checks the indices before it
// calls. Const member functions must be safe to call from several threads at once.
//
// Damage to a part of a file costs the samples in it and nothing else: frames and samples that
// can't be read throw Error, their times don't. Where a time is lost, too, it is estimated, so that
// times always ascend. Only of a long .h5, whose times don't all lie in memory, may a time throw
// Error: when the file can no longer be read.
class ProfileStorage {
 public:
  virtual ~ProfileStorage() = default;
  virtual std::size_t numFrames() const = 0;
  virtual std::int64_t frameTimeUs(std::size_t frame) const = 0;
  // Whether readFrame() gives readings whose touch is still to be decided.
  virtual bool givesReadings() const { return false; }
  // Writes the device time into `out`, and its readings (givesReadings) or `values` and `filtered`.
  virtual void readFrame(std::size_t frame, TactileFrame& out) const = 0;
  // Of a series: the index is one of Profile::series().
  virtual std::size_t numSamples(std::size_t series) const = 0;
  virtual std::int64_t sampleTimeUs(std::size_t series, std::size_t sample) const = 0;
  virtual Sample sample(std::size_t series, std::size_t sample) const = 0;
  // Of a series that is computed: whether its samples are at hand. Otherwise prepare() computes
  // them, which may take as long as a pass over all frames; so does the first sample().
  virtual bool isReady(std::size_t /*series*/) const { return true; }
  virtual void prepare(std::size_t /*series*/, const Progress& /*progress*/) const {}
  // The last sample at or before a time, the first one before all; empty without samples. These
  // search over the times. A storage that knows the times of whole parts of its file searches over
  // those first, and reads only the part in which the sample lies.
  virtual std::optional<std::size_t> frameAt(std::int64_t timeUs) const;
  virtual std::optional<std::size_t> sampleAt(std::size_t series, std::int64_t timeUs) const;
};

// A handle to shared, read-only data; cheap to copy. Const member functions may be called from
// several threads at once. All accessors throw std::out_of_range for an index that does not exist,
// and those that read values throw Error where the file is damaged. Times are always known, see
// ProfileStorage.
class Profile {
 public:
  // `further`: the series that follow those of the hand. Throws std::invalid_argument where one is
  // not valid or two have the same name.
  Profile(ProfileInfo info,
          HandDescription hand,
          std::shared_ptr<const ProfileStorage> storage,
          std::vector<SeriesDescription> further = {});

  const ProfileInfo& info() const noexcept { return data_->info; }
  const HandDescription& hand() const noexcept { return data_->hand; }
  const SensorLayout& layout() const noexcept { return *data_->hand.layout; }
  // Whether frames have readings (TactileFrame::readings).
  bool givesReadings() const { return data_->storage->givesReadings(); }
  // Whether all `values` are whole counts: not of readings, whose values are differences.
  bool hasCounts() const { return data_->info.valueType == ValueType::kCounts && !givesReadings(); }
  const Baselines& baselines() const noexcept { return data_->baselines; }
  // The same recording seen over other baselines.
  Profile withBaselines(Baselines baselines) const;

  std::size_t numFrames() const { return data_->storage->numFrames(); }
  std::int64_t frameTimeUs(std::size_t frame) const;  // [us since 1970], strictly increasing
  TactileFrame frame(std::size_t frame) const;
  // Does the same as frame(). An exception leaves `out` as it was.
  void readFrame(std::size_t frame, TactileFrame& out) const;
  // The same for passes that go on where the file is damaged. With `unreadable`, a frame that can't
  // be read is added to it, and false returned; only the time in `out` is valid then.
  bool readFrame(std::size_t frame, TactileFrame& out, UnreadableSamples* unreadable) const;

  // All series: first those of the hand (kAngleSeries, kTemperatureSeries), whose columns are its
  // axes and sensors.
  const std::vector<SeriesDescription>& series() const noexcept { return data_->series; }
  // Those that follow the hand's, as the constructor takes them.
  std::vector<SeriesDescription> furtherSeries() const {
    return {series().begin() + kHandSeries, series().end()};
  }
  // Samples per second from the first to the last one; 0 with fewer than two.
  double meanSampleRateHz(std::size_t series) const;
  // The series with samples of a name; empty if there is none.
  std::optional<std::size_t> seriesNamed(std::string_view name) const;
  std::size_t numSamples(std::size_t series) const;
  std::int64_t sampleTimeUs(std::size_t series, std::size_t sample) const;
  Sample sample(std::size_t series, std::size_t sample) const;
  // See ProfileStorage. prepare() throws Cancelled, and what computing the series throws.
  bool isReady(std::size_t series) const;
  void prepare(std::size_t series, const Progress& progress = {}) const;
  // The same for the series of the hand.
  std::size_t numAngles() const { return numSamples(kAngleSeries); }
  std::int64_t angleTimeUs(std::size_t i) const { return sampleTimeUs(kAngleSeries, i); }
  Sample angles(std::size_t i) const { return sample(kAngleSeries, i); }
  std::size_t numTemperatures() const { return numSamples(kTemperatureSeries); }
  std::int64_t temperatureTimeUs(std::size_t i) const {
    return sampleTimeUs(kTemperatureSeries, i);
  }
  Sample temperatures(std::size_t i) const { return sample(kTemperatureSeries, i); }

  // Index of the last frame at or before a time, clamped to the first and the last frame; empty
  // when the profile has no frames.
  std::optional<std::size_t> frameAt(std::int64_t timeUs) const;
  // The sample of a series that belongs to a time or a frame: the last one at or before it; the
  // first one when the time is earlier than all samples; empty when there are no samples.
  std::optional<std::size_t> sampleAt(std::size_t series, std::int64_t timeUs) const;
  std::optional<Sample> sampleAtFrame(std::size_t series, std::size_t frame) const;
  std::optional<std::size_t> angleSampleAt(std::int64_t timeUs) const {
    return sampleAt(kAngleSeries, timeUs);
  }
  std::optional<std::size_t> temperatureSampleAt(std::int64_t timeUs) const {
    return sampleAt(kTemperatureSeries, timeUs);
  }
  std::optional<Sample> anglesAtFrame(std::size_t frame) const {
    return sampleAtFrame(kAngleSeries, frame);
  }
  std::optional<Sample> temperaturesAtFrame(std::size_t frame) const {
    return sampleAtFrame(kTemperatureSeries, frame);
  }

  // Time from the first to the last frame [us]; 0 with fewer than two.
  std::int64_t durationUs() const;

 private:
  struct Data {
    ProfileInfo info;
    HandDescription hand;
    std::shared_ptr<const ProfileStorage> storage;
    std::vector<SeriesDescription> series;
    Baselines baselines;
  };
  std::shared_ptr<const Data> data_;
};

}  // namespace palpate
