// The frames of a recording through a calibration: what `calibrate apply` and `contact
// --calibration` share.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "palpate/calibration/pressure_map.h"
#include "palpate/calibration/tare.h"
#include "palpate/model/profile.h"

#include "commands/command_line.h"

namespace palpate::commands {

// --calibration C.json, --sensor-sensitivity S, --sensor-threshold N, --no-tare, --no-drift.
std::vector<OptionSpec> calibrationOptions();
// Those of a command, and these.
std::vector<OptionSpec> withCalibration(std::vector<OptionSpec> options);

struct CalibrationChoice {
  Calibration calibration;
  PressureMapOptions options;
  bool tare = true;
};
// Nothing without --calibration. Throws UsageError, FileError, FormatError.
std::optional<CalibrationChoice> calibrationGiven(const CommandLine& given);

class CalibratedFrames {
 public:
  // Takes off the tare that the recording's events hold. Throws Error for a sensor that the
  // calibration can't serve.
  CalibratedFrames(const CalibrationChoice& choice,
                   const std::filesystem::path& file,
                   const Profile& profile);
  // Frames in order.
  const PressureFrame& of(const TactileFrame& frame);
  // What was assumed, a sentence each.
  std::vector<std::string> assumptions() const;

 private:
  const Profile& profile_;
  PressureMap map_;
  std::optional<Tare> tare_;
  TactileFrame tared_;
  PressureFrame out_;
};

}  // namespace palpate::commands
