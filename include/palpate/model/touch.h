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

// Mean and standard deviation of the readings of frames that follow each other at rest, at least
// two of the same layout. Throws std::invalid_argument.
Baseline baselineOf(std::span<const std::shared_ptr<const TactileFrame>> frames);

// The event "baseline" of a recording, its JSON {"rest": [..], "noise": [..]}. Throws Error when it
// would be longer than an event may be.
Event baselineEvent(const Baseline& baseline, std::int64_t timeUs);
// Those of a recording; one that doesn't fit the layout is left out and counted in `wrong`.
Baselines baselinesOf(std::span<const Event> events,
                      const SensorLayout& layout,
                      std::size_t* wrong = nullptr);

// Their events.
std::vector<Event> baselineEvents(const Baselines& baselines);

// The layout of frames whose touch is decided: the same without rules.
SensorLayout withoutTouchRules(const SensorLayout& layout);

// The rules of all matrices as one JSON text, as the meta data of a recording with readings have
// it (kTouchRulesKey): [{"components": 3, "signed": true, "threshold": 5, "sigmas": 0}, ..].
constexpr const char* kTouchRulesKey = "touch_rules";
std::string touchRulesText(const SensorLayout& layout);
// The layout with the rules of such a text. Throws Error when it doesn't fit.
SensorLayout withTouchRules(const SensorLayout& layout, std::string_view text);

}  // namespace palpate
