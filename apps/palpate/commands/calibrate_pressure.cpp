// The command `palpate calibrate pressure TABLE.csv -o P.json` fits the pressure as a function of
// gain and temperature.
#include <array>
#include <cstdint>
#include <optional>

#include "palpate/calibration/calibration.h"
#include "palpate/calibration/calibration_samples.h"
#include "palpate/core/error.h"
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
  CalibrationSampleOptions gather;
  PressureModelOptions model;
  SensorSettings settings;
  std::optional<double> sensitivityOffset;
  constexpr std::array<OptionWord<bool>, 2> kTerms{{{"default", false}, {"study", true}}};
  const CommandLine given(
      {.synopsis = "palpate calibrate pressure TABLE.csv [-o P.json]",
       .purpose =
           "Fits the pressure as a function of gain K and temperature T, P(K, T), and of drift m "
           "and T, P(m, T) [kPa]. TABLE names recordings of loading steps and their pressures: "
           "file,pressure_kpa[,temperature_c]. Terms are kept if leave-one-out cross-validation "
           "improves with them; T is that of the motor nearest to the matrix. --choices study "
           "keeps all terms and takes the study's T. Prints the calibration as JSON, or writes it "
           "to P.json for `calibrate apply` and `contact --calibration`.",
       .options = withOutputOptions(
           {bound("matrix",
                  "M",
                  "the matrix that was loaded",
                  gather.matrix,
                  kMatrixOption,
                  "the one with the largest readings"),
            boundChoice("choices", "NAME", "", model.study, kTerms),
            bound("area",
                  "MM2",
                  "area of the indenter, to compute the forces on it",
                  model.indenterAreaMm2,
                  model.kIndenterAreaMm2,
                  "not known"),
            bound("sensitivity",
                  "S",
                  "sensitivity of the recordings",
                  settings.sensitivity,
                  settings.kSensitivity),
            bound("threshold",
                  "N",
                  "threshold of the recordings",
                  settings.thresholdCounts,
                  settings.kThresholdCounts),
            boundChoice("loss", "NAME", "of the step fits", gather.steps.fit.loss, kStepLossWords),
            {"noise", "N.json", "noise lines (`calibrate noise`) to store in the calibration"},
            bound("sensitivity-offset",
                  "COUNTS",
                  "offset of K over sensitivity (`calibrate sensitivity`)",
                  sensitivityOffset,
                  {-kLargestFullScale, kLargestFullScale})},
           "P.json"),
       .example = "palpate calibrate pressure weights.csv --area 110.25 -o hand.json",
       .minArguments = 1,
       .maxArguments = 1},
      words);
  if (given.helpShown()) return kDone;
  const fs::path table = given.words().front();
  std::optional<NoiseFloor> noise;
  if (const auto path = given.text("noise"))
    noise = noiseFloorFrom(Json::parse(readTextFile(*path, kLargestNoiseFloor)));
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
  calibration.settings = settings;
  calibration.sensitivityOffset = sensitivityOffset;
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
    sayLine(sample.file + " is left out: " + (sample.notes.empty() ? "" : sample.notes.back()));
  }
  if (unused == all.samples.size())
    throw FileError(table,
                    "none of its " + std::to_string(rows.size()) + " rows gives a usable step");
  printJson(given, jsonOf(calibration));
  return unused > 0 || !calibration.pressure.valid() ? kPartlyDone : kDone;
}

}  // namespace palpate::commands
