// Slip as CSV: what `palpate slip` prints, and `palpate demo` writes, a row per frame and matrix
// with an active taxel.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "palpate/core/progress.h"
#include "palpate/model/profile.h"
#include "palpate/slip/slip_segments.h"

namespace palpate::commands {

// Without line end.
extern const char* const kSlipColumns;
// Gives `sink` row after row, without line end; of one matrix, or of all. Throws as
// runSlipDetector, and what the sink throws.
void forEachSlipRow(const Profile& profile,
                    const SlipRunOptions& pass,
                    std::optional<std::int64_t> matrix,
                    const std::function<void(const std::string& row)>& sink,
                    const Progress& progress = {});
// ",VALUE"; "," where it isn't known.
void appendSlipCell(std::string& row, bool known, double value);

}  // namespace palpate::commands
