// The characteristic signals of a recording as CSV: one row for each frame and matrix.
// docs/signals.md explains the columns.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include <palpate/core/progress.h>
#include <palpate/filter/recipe.h>
#include <palpate/model/hand_description.h>
#include <palpate/model/profile.h>
#include <palpate/signals/characteristic_signals.h>

namespace palpate {

// The signals of these columns in order; with components: of a profile with readings
// (Profile::givesReadings()).
std::span<const SignalKind> signalColumnKinds(bool withComponents);
// The header row without line end.
std::string signalColumns(bool withComponents);
// "taxels", "mm^2", or the unit of the hand.
const std::string& unitOf(SignalKind kind, const HandDescription& hand);
// The units of the columns, in a row of as many cells without line end.
std::string signalUnits(const HandDescription& hand, bool withComponents);
// Passes the rows of one frame at a time to `sink`, each with `lineEnd`; of one matrix or of all.
// `smooth`: filters over time that are applied to the signals themselves; may be empty. Throws
// Cancelled, std::invalid_argument (a filter over space, or a frequency that is
// not below half of the rate, 1 / median interval), and what the sink throws.
void writeSignalRows(const Profile& profile,
                     std::optional<std::size_t> onlyMatrix,
                     const Recipe& smooth,
                     const std::string& lineEnd,
                     const std::function<void(const std::string& lines)>& sink,
                     const Progress& progress = {});

}  // namespace palpate
