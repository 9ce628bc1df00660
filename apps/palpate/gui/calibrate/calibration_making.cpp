#include "gui/calibrate/calibration_making.h"

#include <palpate/core/error.h>
#include <palpate/core/hash.h>
#include <palpate/recording/recording.h>

#include "gui/widgets/notes_label.h"

namespace palpate::gui {
namespace {

CalibrationSource gatheredSource(const std::filesystem::path& file, const Progress& progress) {
  return {openRecording(file, progress), sha256OfFile(file)};
}

}  // namespace

ShownCalibrationPtr calibrationFromTable(const std::filesystem::path& table,
                                         const CalibrationChoices& choices,
                                         const ShownCalibrationPtr& before,
                                         const Progress& progress) {
  const PressureModelOptions& options = choices.model;
  std::shared_ptr<const CalibrationSteps> known;
  if (before && before->source == table && before->by.matrix == choices.matrix &&
      before->by.robust == choices.robust)
    known = before->gathered;
  if (!known) {
    CalibrationSampleOptions gather;
    gather.matrix = choices.matrix;
    if (choices.robust) gather.steps.fit.loss = StepLoss::kHuber;
    known = std::make_shared<const CalibrationSteps>(collectCalibrationSteps(
        readPressureTable(table), table.parent_path(), gatheredSource, gather, progress));
  }
  if (known->numUnused() == known->samples.size()) {
    const auto& notes = known->samples.front().notes;
    throw FileError(table,
                    "none of its rows gives a usable step" +
                        (notes.empty() ? "" : "; the first: " + notes.back()));
  }
  auto made = std::make_shared<ShownCalibration>();
  made->source = table;
  made->gathered = known;
  made->by = choices;
  Calibration& calibration = made->calibration = calibrationOf(*known, options);
  calibration.settings = choices.settings;
  calibration.programVersion = programVersion();
  calibration.madeAt = madeNow();
  calibration.options = Json::object()
                            .set("table", table.string())
                            .set("table_sha256", sha256OfFile(table))
                            .set("choices", options.study ? "study" : "default")
                            .set("loss", choices.robust ? "huber" : "squares")
                            .set("area_mm2", options.indenterAreaMm2);
  return made;
}

ShownCalibrationPtr calibrationFromFile(const std::filesystem::path& path) {
  auto read = std::make_shared<ShownCalibration>();
  read->source = path;
  read->calibration = loadCalibration(path);
  return read;
}

}  // namespace palpate::gui
