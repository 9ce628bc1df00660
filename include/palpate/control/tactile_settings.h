// Sensitivities and thresholds of all matrices as one value: stored under a name, compared, and
// applied with as few commands as possible (each command pauses the stream for about 0.5 s).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <palpate/device/device.h>
#include <palpate/model/hand_description.h>

namespace palpate {

using TactileSettings = std::vector<MatrixSettings>;  // one per matrix

// What a reset gives: sensitivity 0.5, threshold 150 counts proximal, 300 distal.
TactileSettings defaultTactileSettings(const HandDescription& hand);

// What leads from one to the other: nothing where they agree; one command for all matrices where
// the new value is the same for all. Throws std::invalid_argument: different numbers of matrices,
// sensitivity outside 0..1 or no number, threshold outside 0..4095.
std::vector<DeviceCommand> commandsBetween(const TactileSettings& from, const TactileSettings& to);

// {"matrices": [{"sensitivity": 0.5, "threshold_counts": 150}, ..]}
std::string toJson(const TactileSettings& settings);
// Throws Error naming what is missing or out of range.
TactileSettings parseTactileSettings(std::string_view json);

}  // namespace palpate
