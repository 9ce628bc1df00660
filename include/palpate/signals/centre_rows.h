// The centre of force of a matrix over time as a result table. docs/manual/columns.md explains the
// columns.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include <palpate/core/progress.h>
#include <palpate/core/result_table.h>
#include <palpate/model/profile.h>

namespace palpate {

// The mean place of the touched taxels, weighed by their values.
struct ForceCentre {
  double sum = 0.0;             // of the values, in the hand's unit
  double x = 0.0, y = 0.0;      // column and row [taxels]
  double xMm = 0.0, yMm = 0.0;  // on the unrolled surface, from the centre of taxel (0, 0)
};
// Empty where the matrix is not touched.
std::optional<ForceCentre> forceCentre(const TactileFrame& frame, std::size_t matrix);

// The table "centres": a row for each frame and matrix that is touched. Its rows throw Cancelled
// and FileError.
std::unique_ptr<ResultTable> centreTable(const Profile& profile,
                                         std::optional<std::int64_t> matrix = {},
                                         const Progress& progress = {});

}  // namespace palpate
