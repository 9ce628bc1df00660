// Slip as CSV, for `palpate slip` and `palpate demo`: one row for each frame and matrix with an
// active taxel.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "palpate/core/progress.h"
#include "palpate/model/profile.h"
#include "palpate/slip/slip_segments.h"

namespace palpate::commands {

// The header row without line end.
extern const char* const kSlipColumns;
// Calls `sink` for each row, without line end; of one matrix or of all. Throws as runSlipDetector()
// does, and what the sink throws.
void forEachSlipRow(const Profile& profile,
                    const SlipRunOptions& pass,
                    std::optional<std::int64_t> matrix,
                    const std::function<void(const std::string& row)>& sink,
                    const Progress& progress = {});
// Appends ",VALUE", or "," when the value is unknown.
void appendSlipCell(std::string& row, bool known, double value);

}  // namespace palpate::commands
