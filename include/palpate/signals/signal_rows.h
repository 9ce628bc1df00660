// The characteristic signals of a recording as a result table: one row for each frame and matrix.
// docs/manual/columns.md explains the columns.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/core/result_table.h>
#include <palpate/filter/recipe.h>
#include <palpate/model/profile.h>
#include <palpate/model/time_base.h>
#include <palpate/signals/signal_filter.h>

namespace palpate {

// The signals of a matrix, values in `unit`. With components: of a profile with readings
// (Profile::givesReadings()). Smoothed: filtered over time, where `active` may be a fraction.
std::vector<ColumnOf<SignalValues>> signalColumns(const std::string& unit,
                                                  bool withComponents = false,
                                                  bool isSmoothed = false);

struct SignalRowsOptions {
  std::optional<std::int64_t> matrix = {};  // only this one
  bool ofHand = false;    // of the whole hand instead, without components; matrix: their number
  bool centres = false;   // instead: centres of force (signals/centre_rows.h)
  Recipe filters = {};    // of the frames, first
  Recipe smooth = {};     // of the signals, over time
  bool unitsRow = false;  // of CSV: a second row with the units
  TimeChoice times = TimeChoice::kArrival;  // of the frames, before the filters
};
// The table "signals" of a profile that is filtered already. Throws std::invalid_argument (no such
// matrix, a filter over space, or a frequency that is not below half of the rate, 1 / median
// interval); its rows throw Cancelled and FileError.
std::unique_ptr<ResultTable> signalTable(const Profile& profile,
                                         const SignalRowsOptions& options = {},
                                         const Progress& progress = {});

}  // namespace palpate
