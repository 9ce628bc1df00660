// Tables that other programs read: a profile as CSV and NPZ, one frame for pasting.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <palpate/core/output_file.h>
#include <palpate/core/progress.h>
#include <palpate/core/text_table.h>
#include <palpate/model/event.h>
#include <palpate/model/profile.h>
#include <palpate/model/tactile_frame.h>

namespace palpate {

// PATH.csv: `frame,time_ms,matrix,y,x,value,time_us` for active taxels, of a recording with
// readings also `dx,dy,dz`: what they are over the baseline, with their signs (forceAt(); dx and dy
// are empty with one component); beside it PATH.angles.csv
// and PATH.temperatures.csv with a column per axis (deg; mm where it slides) or sensor, and
// PATH.NAME.csv of each further series, its columns named with their units ("fz_N"; empty cells:
// not known; `device_time_us`: the sender's clock where it is known), where there are any. time_ms:
// whole milliseconds since 1970, rounded down; time_us: exact. Every file is whole or not there; an
// existing one is only replaced when asked. `unitsRow`: below the names a row with the unit of each
// column, empty where it has none. Returns the files of further series. Throws FileError,
// Cancelled.
std::vector<std::filesystem::path> writeCsv(const Profile& profile,
                                            const std::filesystem::path& path,
                                            Overwrite overwrite = Overwrite::kRefuse,
                                            const Progress& progress = {},
                                            bool unitsRow = false);

// PATH.npz (stored zip of .npy arrays; numpy.load opens it with allow_pickle=False): `time_ms` and
// `time_us` (T, int64), `m0`.. (T, rows, columns; uint16 for counts, float32 otherwise), of a
// filtered recording also `m0_active`.. (bool, of the same shape: which taxels are active, see
// TactileFrame::filtered), of one with readings `m0_readings`.. (T, rows, columns, components;
// float32) and in `meta` the rules of touch; its baselines are among the events; `angles` (n, axes;
// float64, deg; mm where the axis slides), `angle_time_ms`, `angle_time_us`, `temperatures` (n,
// sensors; float64, deg C), `temperature_time_ms`, `temperature_time_us`, of each further series
// `NAME` (n, columns; float64, NaN: not known), `NAME_time_us`, and where the sender's clock is
// known `NAME_device_time_us`
// (-2^63: not known), `static_mask` (places, uint8), `meta` (JSON text in ASCII, with the events
// and what further series are). Throws FileError (also where an array would have the name of
// another one), Cancelled.
void writeNpz(const Profile& profile,
              std::span<const Event> events,
              const std::filesystem::path& path,
              Overwrite overwrite = Overwrite::kRefuse,
              const Progress& progress = {});

// The taxels of one frame as a table, for pasting and for CSV. Its columns are
// `frame,time_ms,matrix,y,x,value`, with a row per taxel that is scanned, at rest or not, matrix
// after matrix, row by row. Filtered values are those that are drawn (TactileFrame::allValues()).
// `index` stands in the column frame; it is empty for a live frame.
TextTable taxelTable(const TactileFrame& frame, const std::string& index);

}  // namespace palpate
