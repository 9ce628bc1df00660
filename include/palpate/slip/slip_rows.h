// Slip as result tables: one row for each frame and matrix with an active taxel, or one for each
// slip. docs/manual/columns.md explains the columns.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/core/result_table.h>
#include <palpate/filter/recipe.h>
#include <palpate/model/profile.h>
#include <palpate/model/time_base.h>
#include <palpate/slip/slip_segments.h>

namespace palpate {

// What is known of a matrix with an active taxel in one frame; `withCentroid`: x and y, too.
std::vector<ColumnOf<SlipDetection>> slipColumns(bool withCentroid = false);

struct SlipRowsOptions {
  SlipRunOptions pass = {};
  std::optional<std::int64_t> matrix = {};  // only this one
  bool withCentroid = false;                // x and y behind `active`
  bool segments = false;                    // a row per slip instead of one per frame and matrix
  bool unitsRow = false;                    // of CSV: a second row with the units
  Recipe filters = {};                      // of the frames, first
  TimeChoice times = TimeChoice::kArrival;
};
// The table "slip" of a profile that is filtered already, or "slip_segments". Throws as SlipRun.
std::unique_ptr<ResultTable> slipTable(const Profile& profile,
                                       const SlipRowsOptions& options,
                                       const Progress& progress = {});

// Set the method by its name (slip_method.h), and the reference: "first", "rest", or the number of
// a frame. Both throw std::invalid_argument.
void setSlipMethod(SlipRowsOptions& table, std::string_view name);
void setSlipReference(SlipRowsOptions& table, const std::string& word);
// Throws Error when the recording hasn't the matrix or the reference frame of the table.
void requireThere(const std::filesystem::path& file,
                  const Profile& profile,
                  const SlipRowsOptions& table);

}  // namespace palpate
