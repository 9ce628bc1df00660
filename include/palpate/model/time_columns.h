// Times of a result table (core/result_table.h) in other forms than milliseconds since 1970.
#pragma once

#include <memory>

#include <palpate/core/result_table.h>
#include <palpate/model/profile.h>

namespace palpate {

enum class TimeColumn {
  kSeconds,  // "time_s": seconds from the first frame
  kUtc       // "time_utc": "2014-11-27T10:31:05.123456Z"
};

// `table` of a profile with a column behind `time_ms` (of `frame`), `begin_ms` (of `begin`) and
// `end_ms` (of `end`), whose name ends in _s or _utc instead; to the microsecond. Throws
// std::invalid_argument when it has none of them; its rows throw as Profile::frameTimeUs().
std::unique_ptr<ResultTable> withTimeColumns(std::unique_ptr<ResultTable> table,
                                             const Profile& profile,
                                             TimeColumn which);

}  // namespace palpate
