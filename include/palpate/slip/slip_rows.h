// Slip as CSV: one row for each frame and matrix with an active taxel, or one for each slip.
// docs/slip.md explains the columns.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include <palpate/core/progress.h>
#include <palpate/filter/recipe.h>
#include <palpate/model/profile.h>
#include <palpate/model/time_base.h>
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
struct SlipRowsOptions {
  SlipRunOptions pass = {};
  std::optional<std::int64_t> matrix = {};
  bool segments = false;  // a row per slip instead of one per frame and matrix
  bool unitsRow = false;  // a second row with the units
  Recipe filters = {};    // of the frames, first
  TimeChoice times = TimeChoice::kArrival;
};
// Set the method by its name (slip_method.h), and the reference: "first", "rest", or the number of
// a frame. Both throw std::invalid_argument.
void setSlipMethod(SlipRowsOptions& table, std::string_view name);
void setSlipReference(SlipRowsOptions& table, const std::string& word);
// Throws Error when the recording hasn't the matrix or the reference frame of the table.
void requireThere(const std::filesystem::path& file,
                  const Profile& profile,
                  const SlipRowsOptions& table);

// Appends ",VALUE", or "," when the value is unknown.
void appendSlipCell(std::string& row, bool known, double value);

}  // namespace palpate
