// Slip as CSV: one row for each frame and matrix with an active taxel, or one for each slip.
// docs/slip.md explains the columns.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include <palpate/core/progress.h>
#include <palpate/model/profile.h>
#include <palpate/slip/slip_segments.h>

namespace palpate {

// The header row without line end.
extern const char* const kSlipColumns;
// The units of these columns, in a row of as many cells without line end.
extern const char* const kSlipUnits;
// Calls `sink` for each row, without line end; of one matrix or of all. Throws as runSlipDetector()
// does, and what the sink throws.
void forEachSlipRow(const Profile& profile,
                    const SlipRunOptions& pass,
                    std::optional<std::int64_t> matrix,
                    const std::function<void(const std::string& row)>& sink,
                    const Progress& progress = {});
// The same for the slips of findSlips().
extern const char* const kSlipSegmentColumns;
extern const char* const kSlipSegmentUnits;
void forEachSlipSegmentRow(const Profile& profile,
                           const SlipRunOptions& pass,
                           std::optional<std::int64_t> matrix,
                           const std::function<void(const std::string& row)>& sink,
                           const Progress& progress = {});
// Appends ",VALUE", or "," when the value is unknown.
void appendSlipCell(std::string& row, bool known, double value);

}  // namespace palpate
