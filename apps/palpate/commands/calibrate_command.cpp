// The command `palpate calibrate KIND ..` selects the kind of calibration; here are also the
// functions that the kinds share.
#include <array>
#include <cstdio>

#include "palpate/calibration/calibration.h"
#include "palpate/core/time.h"

#include "commands/calibrate_commands.h"
#include "commands/filter_options.h"

namespace palpate::commands {
namespace {

struct Kind {
  const char* name;
  const char* summary;
  int (*run)(const Arguments& words);
};

constexpr std::array kKinds = {
    Kind{"noise",
         "measures the noise floor of an unloaded hand over its temperature",
         &calibrateNoise},
    Kind{"step", "fits gain, drift and time constants to each loading step", &calibrateStep},
    Kind{"pressure",
         "fits pressure to gain and temperature, from a table of recordings",
         &calibratePressure},
    Kind{"sensitivity", "measures gain against the sensor's sensitivity", &calibrateSensitivity},
    Kind{"tare", "measures the unloaded readings and notes them in the recording", &calibrateTare},
    Kind{"apply", "computes pressure and force of a recording by a calibration", &calibrateApply},
};

void showKinds() {
  std::puts(
      "Usage: palpate calibrate KIND ...\n\n"
      "Converts counts to kilopascals and newtons, with standard deviations. KIND:");
  for (const Kind& kind : kKinds) std::printf("  %-12s %s\n", kind.name, kind.summary);
  std::puts(
      "\nEvery KIND takes --help and --quiet.\n\n"
      "Example:\n  palpate calibrate step A1.dsa --matrix 1");
}

}  // namespace

std::vector<std::string> calibrationKinds() {
  std::vector<std::string> names;
  for (const Kind& kind : kKinds) names.emplace_back(kind.name);
  return names;
}

int calibrateCommand(const Arguments& words) {
  if (!words.empty() && (words[0] == "--help" || words[0] == "-h")) {
    showKinds();
    return kDone;
  }
  std::string known;
  for (const Kind& kind : kKinds) {
    if (!words.empty() && words[0] == kind.name) return kind.run({words.begin() + 1, words.end()});
    known += (known.empty() ? "" : ", ") + std::string(kind.name);
  }
  throw UsageError(words.empty()
                       ? "calibrate needs a KIND: one of " + known
                       : "calibrate has no KIND '" + words[0] + "'; give one of " + known);
}

OptionSpec matrixSpec() {
  return rangedWhole("matrix", "M", "the matrix that was loaded", kMatrixOption);
}

std::size_t matrixGiven(const CommandLine& given) {
  const auto matrix = given.integer("matrix", kMatrixOption);
  if (!matrix) throw UsageError("--matrix M is missing: give the matrix that was loaded");
  return static_cast<std::size_t>(*matrix);
}

Json provenance(const std::string& kind) {
  return Json::object()
      .set("kind", "palpate " + kind + " calibration")
      .set("format_version", Calibration::kFormatVersion)
      .set("program_version", PALPATE_VERSION)
      .set("made_at", utcStamp());
}

}  // namespace palpate::commands
