// The command `palpate derive FILE NAME=FORMULA..` prints curves that formulas make of the signals
// of a recording as CSV.
#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "palpate/core/error.h"
#include "palpate/recording/recording.h"
#include "palpate/signals/curve_rows.h"
#include "palpate/signals/formula.h"

#include "commands/calibrated_frames.h"
#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/filter_options.h"
#include "commands/recording_list.h"
#include "commands/table_command.h"

namespace palpate::commands {
namespace {

struct NamedFormula {
  std::string name;
  Formula formula;
};

// "rate=der(hand_sum)"; without NAME= the formula is its own name.
NamedFormula namedFormula(const std::string& word) {
  // The first = that is not part of a comparison ends the name.
  const auto equals = word.find('=');
  const bool named = equals != std::string::npos && equals > 0 &&
                     std::string("!<>").find(word[equals - 1]) == std::string::npos &&
                     (equals + 1 == word.size() || word[equals + 1] != '=');
  try {
    return {named ? word.substr(0, equals) : word, Formula(named ? word.substr(equals + 1) : word)};
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

}  // namespace

int deriveCommand(const Arguments& words) {
  const CommandLine given(
      {.synopsis = "palpate derive FILE NAME=FORMULA.. [--from N] [--to N] [--filter SPEC..] "
                   "[--calibration C.json]",
       .purpose =
           "Computes curves from signals by formulas and prints them as CSV: frame,time_s and a "
           "column for each formula. Signals: m1_mean, m1_filtered_mean, m1_min, m1_max, m1_sum, "
           "m1_active, m1_area_mm2 of matrix 1, with readings also m1_x, m1_y, m1_z, m1_norm; "
           "hand_sum and so on of the whole hand; m5_x2_y9 a "
           "taxel (column 2, row 9); angle3 [deg] and temperature4 [deg C], interpolated at the "
           "frames; t [s]. Operators + - * / ^ ( ), comparisons and a ? b : c; functions abs sqrt "
           "min max exp ln sin .., and of signals: der(x), the slope of x over time [1/s]; "
           "smooth(x,n) and median(x,n) over n samples; lowpass(x,hz), highpass(x,hz), "
           "bandpass(x,low,high), bandstop(x,low,high). Signals that are "
           "computed of the frames: m1_centroid_x_mm, hand_sphere_diameter_mm, m1_slip_speed_mm_s, "
           "m1_slip_mm, and with --calibration hand_force_n, m1_force_n [N], m1_pressure_kpa, "
           "m1_pressure_max_kpa. A value that isn't known is an empty cell.",
       .options = withOneTableOptions(
           withCalibration(withFilterOptions(withFrameOptions({timeOption()})))),
       .example = "palpate derive foam_ball.dsa grip=m1_sum-m3_sum > grip.csv",
       .minArguments = 2},
      words);
  if (given.helpShown()) return kDone;
  const Recipe recipe = recipeOf(given);
  const FrameChoice frameChoice = frameChoiceOf(given);
  const auto calibration = calibrationGiven(given);
  const std::string& file = given.words().front();
  std::vector<NamedFormula> formulas;
  for (std::size_t i = 1; i < given.words().size(); ++i)
    formulas.push_back(namedFormula(given.words()[i]));
  std::set<std::string> names = {"frame", "time_s"};
  for (const NamedFormula& one : formulas)
    if (!names.insert(one.name).second)
      throw UsageError("two columns would have the name '" + one.name + "': give another one");
  ProgressLine line("reading " + file, given.quiet());
  Recording recorded = openReported(file, line, given.quiet());
  takeTimes(given, recorded, file, line.callback());
  const Profile frames = filteredBy(recipe, recorded, file, line.callback());
  if (frames.numFrames() == 0) throw Error(file + ": has no frames");
  const NamedSignals named = namedSignals(calibration, file, recorded, frames);
  const Profile& profile = named.profile;
  const auto [from, to] = framesOf(frameChoice, file, profile);
  std::vector<std::string> used;
  for (const NamedFormula& one : formulas)
    used.insert(used.end(), one.formula.names().begin(), one.formula.names().end());
  reportAssumptions(named, used, given.quiet());
  // The whole recording is computed, so that a slope at the ends of the part is that of its
  // neighbours.
  std::vector<NamedCurve> curves;
  for (const NamedFormula& one : formulas) {
    line.setLabel("computing " + one.name);
    try {
      curves.push_back({one.name,
                        formulaSeries(profile,
                                      one.formula,
                                      0.0,
                                      static_cast<double>(profile.durationUs()) / 1e6 + 1.0,
                                      line.callback())});
    } catch (const std::invalid_argument& error) {
      throw Error(file + ": " + error.what());
    }
  }
  line.wipe();
  return writeTable(given, *curveTable(std::move(curves), from, to));
}

}  // namespace palpate::commands
