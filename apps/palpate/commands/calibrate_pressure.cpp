// The command `palpate calibrate pressure TABLE.csv -o P.json` fits the pressure as a function of
// gain and temperature.
#include <cstdint>
#include <cstdio>
#include <optional>

#include "palpate/calibration/calibration.h"
#include "palpate/calibration/calibration_samples.h"
#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/hash.h"
#include "palpate/core/text_file.h"
#include "palpate/core/time.h"
#include "palpate/recording/recording.h"

#include "commands/calibrate_commands.h"
#include "commands/hand_options.h"
#include "commands/recording_list.h"

namespace palpate::commands {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kLargestNoiseFloor = 64u << 20;  // [bytes]

}  // namespace

int calibratePressure(const Arguments& words) {
  const CommandLine given(
      {.synopsis = "palpate calibrate pressure TABLE.csv [-o P.json]",
       .purpose =
           "Fits the pressure as a function of gain K and temperature T, P(K, T), and of drift m "
           "and T, P(m, T) [kPa]. TABLE names recordings of loading steps and their pressures: "
           "file,pressure_kpa[,temperature_c]. Terms are kept if leave-one-out cross-validation "
           "improves with them; T is that of the motor nearest to the matrix. --choices study "
           "keeps all terms and takes the study's T. Prints the calibration as JSON, or writes it "
           "to P.json for `calibrate apply` and `contact --calibration`.",
       .options =
           {{"matrix",
             "M",
             "the matrix that was loaded; default the one with the largest readings"},
            {"choices", "NAME", "default or study"},
            {"area", "MM2", "area of the indenter [mm^2]: forces are then those on this area"},
            {"sensitivity", "S", "sensitivity of the recordings, default 1"},
            {"threshold", "N", "threshold of the recordings [counts], default 100"},
            {"loss", "NAME", "loss of the step fits: squares (default), huber, cauchy"},
            {"noise", "N.json", "noise lines (`calibrate noise`) to store in the calibration"},
            {"sensitivity-offset",
             "COUNTS",
             "offset of K over sensitivity (`calibrate sensitivity`)"},
            {"output,o", "P.json", "write the result to this file"},
            {"force", "", "replace P.json"}},
       .example = "palpate calibrate pressure weights.csv --area 110.25 -o hand.json",
       .minArguments = 1,
       .maxArguments = 1},
      words);
  if (given.helpShown()) return kDone;
  const fs::path table = given.words().front();
  StepReportOptions options;
  options.fit.loss = lossGiven(given);
  PressureModelOptions model;
  model.study = given.choice("choices", {"default", "study"}) == "study";
  model.indenterAreaMm2 = given.number("area", 0.0, 1e6).value_or(0.0);
  std::optional<NoiseFloor> noise;
  if (const auto path = given.text("noise"))
    noise = noiseFloorFrom(Json::parse(readTextFile(*path, kLargestNoiseFloor)));
  CalibrationSampleOptions gather;
  gather.steps = options;
  if (given.has("matrix")) gather.matrix = matrixGiven(given);
  const std::vector<PressureTableRow> rows = readPressureTable(table);
  CalibrationSteps all;
  {
    ProgressLine line("reading", given.quiet());
    const auto open = [&](const fs::path& file, const Progress& progress) {
      return CalibrationSource{openReported(file, line, given.quiet(), progress).profile,
                               sha256OfFile(file)};
    };
    all = collectCalibrationSteps(rows, table.parent_path(), open, gather, line.callback());
  }
  Calibration calibration = calibrationOf(all, model);
  calibration.settings = {given.number("sensitivity", 0.01, 1.0).value_or(1.0),
                          given.number("threshold", 0.0, kLargestFullScale).value_or(100.0),
                          true};
  calibration.sensitivityOffset =
      given.number("sensitivity-offset", -kLargestFullScale, kLargestFullScale);
  calibration.noise = noise;
  calibration.programVersion = PALPATE_VERSION;
  calibration.madeAt = utcStamp();
  calibration.options = Json::object()
                            .set("table", table.string())
                            .set("table_sha256", sha256OfFile(table))
                            .set("choices", model.study ? "study" : "default")
                            .set("loss", given.text("loss").value_or("squares"))
                            .set("area_mm2", model.indenterAreaMm2);
  std::size_t unused = 0;
  for (const PressureSample& sample : all.samples) {
    if (sample.used) continue;
    ++unused;
    std::fprintf(stderr,
                 "palpate: %s\n",
                 escapedLine(sample.file +
                             " is left out: " + (sample.notes.empty() ? "" : sample.notes.back()))
                     .c_str());
  }
  if (unused == all.samples.size())
    throw FileError(table,
                    "none of its " + std::to_string(rows.size()) + " rows gives a usable step");
  printJson(given, jsonOf(calibration));
  return unused > 0 || !calibration.pressure.valid() ? kPartlyDone : kDone;
}

}  // namespace palpate::commands
