// Many seconds of the per-second summary packed in one row, for charts: the rows of a day's
// `second` table take half a second to read, these 20 ms. Derived data, made when a recording is
// finished; without it `second` is read. Private to this module.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "palpate/recording/second_summary.h"

#include "recording/native/sqlite_database.h"

namespace palpate {

// Makes the table from the rows of `second`. Returns the number of seconds in it.
std::int64_t writeOverview(SqliteDatabase& database, std::size_t numMatrices);

// Nothing where there is none, it hasn't `numSeconds` seconds, or it is damaged anywhere.
std::optional<std::vector<SecondSummary>> readOverview(SqliteDatabase& database,
                                                       std::size_t numMatrices,
                                                       std::int64_t numSeconds);

}  // namespace palpate
