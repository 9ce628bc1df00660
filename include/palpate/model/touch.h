// Whether a taxel is touched, for sensors whose readings have a sign, three components, or noise at
// rest (TouchRule). What is stored are the readings; this is what is seen and computed of them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <palpate/model/event.h>
#include <palpate/model/tactile_frame.h>

namespace palpate {

// The readings at rest, per reading of the layout (SensorLayout::numReadings).
struct Baseline {
  std::vector<float> rest;   // mean
  std::vector<float> noise;  // standard deviation; empty: not known
  bool operator==(const Baseline&) const = default;
};
// The baselines of a recording, each from its time on [us since 1970], ascending. The first one
// also holds before.
using Baselines = std::vector<std::pair<std::int64_t, std::shared_ptr<const Baseline>>>;
std::shared_ptr<const Baseline> baselineAt(const Baselines& baselines, std::int64_t timeUs);

// Sets `values` (what presses, 0 where nothing touches) and `filtered` (the same of all taxels) of
// a frame from its readings. Null: a baseline of 0. A taxel is touched when
//   |reading - rest| > max(threshold, sigmas * noise)
// with the length of the vector for three components; readings without a sign must be above their
// rest. `values` are then |reading - rest|, for three components that of z; the signs are in
// forceAt(). Frames without readings
// stay as they are. Throws std::invalid_argument when a size is not that of the layout.
void decideTouch(TactileFrame& frame, std::shared_ptr<const Baseline> baseline);

// The components of a taxel over its baseline; with one component it is z.
std::array<float, 3> forceAt(const TactileFrame& frame, const TaxelPlace& place);

// Takes mean and standard deviation of readings at rest, frame by frame.
class RestMeter {
 public:
  // `fullScale`: of the hand, for baseline().
  explicit RestMeter(double fullScale = 0.0) : fullScale_(fullScale) {}
  // Throws std::invalid_argument: another number of readings than before.
  void add(std::span<const float> readings);
  std::size_t numFrames() const noexcept { return numFrames_; }
  // Throws std::invalid_argument: fewer than two frames. With a full scale, throws Error where
  // the readings aren't at rest: from 16 frames on, where the mean of one differs between the
  // earlier and the later half by more than 3 standard deviations (of the calmer half) and 0.2 %
  // of the full scale.
  // Something that presses without moving can't be told from the rest.
  Baseline baseline() const;

 private:
  double fullScale_;
  std::size_t numFrames_ = 0;
  std::vector<float> readings_;  // of all frames
};
// What was taken, in one line: "33 frames: 486 readings at rest from 0 to 12, noise up to 0.8".
std::string baselineText(const Baseline& baseline, std::size_t numFrames);

// The event of a baseline, its JSON {"rest": [..], "noise": [..]}: taken while recording, or later
// by a person, who can remove it. Throws Error when it would be longer than an event may be.
inline constexpr const char* kBaselineKind = "baseline";
inline constexpr const char* kNewBaselineKind = "new_baseline";
// Text of the event of a baseline that came back.
inline constexpr const char* kPreviousBaselineText = "the previous baseline";
Event baselineEvent(const Baseline& baseline,
                    std::int64_t timeUs,
                    const char* kind = kBaselineKind);
// Over which a recording is seen: those taken later or, without any, those taken while recording.
// One that doesn't fit the layout is left out and counted in `wrong`.
Baselines baselinesOf(std::span<const Event> events,
                      const SensorLayout& layout,
                      std::size_t* wrong = nullptr);
// Over which it was recorded, and what its file says of each second is counted.
Baselines recordedBaselinesOf(std::span<const Event> events, const SensorLayout& layout);

// Their events.
std::vector<Event> baselineEvents(const Baselines& baselines);

// The layout of frames whose touch is decided: the same without rules.
SensorLayout withoutTouchRules(const SensorLayout& layout);

// What the readings are, for people: "3 components, signed"; of hands with several kinds of
// matrices each kind once, "3 components, signed; signed". Empty where all are one component
// without a sign.
std::string readingsText(const SensorLayout& layout);

// The rules of all matrices as one JSON text, as the meta data of a recording with readings have
// it (kTouchRulesKey): [{"components": 3, "signed": true, "threshold": 5, "sigmas": 0}, ..].
constexpr const char* kTouchRulesKey = "touch_rules";
std::string touchRulesText(const SensorLayout& layout);
// The layout with the rules of such a text. Throws Error when it doesn't fit.
SensorLayout withTouchRules(const SensorLayout& layout, std::string_view text);

}  // namespace palpate
