// Applies a calibration to the frames of a recording; used by `palpate calibrate apply` and
// by `contact`, `derive`, `spectrum` and `compare` with --calibration.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "palpate/calibration/pressure_map.h"
#include "palpate/calibration/tare.h"
#include "palpate/computed/computed_series.h"
#include "palpate/model/profile.h"
#include "palpate/recording/recording_data.h"

#include "commands/command_line.h"

namespace palpate::commands {

// The options --calibration C.json, --sensor-sensitivity S, --sensor-threshold N, --no-tare,
// --no-drift.
std::vector<OptionSpec> calibrationOptions();
// The options of a command followed by calibrationOptions().
std::vector<OptionSpec> withCalibration(std::vector<OptionSpec> options);

// The calibration and the options that the command line chose.
struct CalibrationChoice {
  Calibration calibration;
  PressureMapOptions options;
  bool tare = true;
};
// Nothing when --calibration is missing. Throws UsageError, FileError, FormatError.
std::optional<CalibrationChoice> calibrationGiven(const CommandLine& given);

// Options of the curves that are computed of a recording (computed/computed_series.h), with the
// tare and the settings that it contains. Throws as CalibratedFrames.
ComputedOptions computedOptions(const std::optional<CalibrationChoice>& choice,
                                const std::filesystem::path& file,
                                const Recording& recording);

// The signals that a command may name: those of a recording and those computed from its frames.
struct NamedSignals {
  Profile profile;
  ComputedOptions computed;
};
// `frames`: those of the recording, as they are or filtered. Throws as computedOptions().
NamedSignals namedSignals(const std::optional<CalibrationChoice>& choice,
                          const std::filesystem::path& file,
                          const Recording& recording,
                          const Profile& frames);
// Prints what the forces assume, each sentence once, where there is a calibration; where `names`
// has a force that isn't known, by reportLoss().
void reportAssumptions(const NamedSignals& named,
                       const std::vector<std::string>& names,
                       bool quiet);

// Computes the pressures of one frame after the other.
class CalibratedFrames {
 public:
  // `profile`: that of the recording, as it is or filtered. Subtracts the tare that the recording's
  // events contain. Throws Error for a sensor that the calibration cannot be applied to; FileError
  // or FormatError where the tare or the settings are wanted and the events can't be read.
  CalibratedFrames(const CalibrationChoice& choice,
                   const std::filesystem::path& file,
                   const Recording& recording,
                   const Profile& profile);
  // Call it with the frames in order.
  const PressureFrame& of(const TactileFrame& frame);
  // The assumptions that were made, one sentence each.
  std::vector<std::string> assumptions() const;
  // Whether forces are known, not only their upper limits (PressureFrame::areaKnown).
  bool areaKnown() const { return map_.calibration().pressure.knowsArea(); }

 private:
  const Profile profile_;
  PressureMap map_;
  std::optional<Tare> tare_;
  TactileFrame tared_;
  PressureFrame out_;
};

}  // namespace palpate::commands
