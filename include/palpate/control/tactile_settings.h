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

// Settings after a reset: sensitivity 0.5, threshold 150 counts proximal, 300 distal.
TactileSettings defaultTactileSettings(const HandDescription& hand);

// The commands that change the settings `from` into `to`: none where they agree, and one command
// for all matrices where the new value is the same for all. Throws std::invalid_argument: different
// numbers of matrices, sensitivity outside 0..1 or not a number, threshold outside 0..4095.
std::vector<DeviceCommand> commandsBetween(const TactileSettings& from, const TactileSettings& to);

// {"matrices": [{"sensitivity": 0.5, "threshold_counts": 150}, ..]}
std::string toJson(const TactileSettings& settings);
// Throws Error naming the missing or invalid field.
TactileSettings parseTactileSettings(std::string_view json);

}  // namespace palpate
