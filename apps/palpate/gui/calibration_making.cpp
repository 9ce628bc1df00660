#include "gui/calibration_making.h"

#include <palpate/core/error.h>
#include <palpate/core/hash.h>
#include <palpate/recording/recording.h>

#include "gui/calibrate_texts.h"

namespace palpate::gui {
namespace {

GatheredSource openSource(const std::filesystem::path& file, const Progress& progress) {
  return {openRecording(file, progress), sha256OfFile(file)};
}

}  // namespace

ShownCalibrationPtr calibrationFromTable(const std::filesystem::path& table,
                                         const PressureModelOptions& options,
                                         const SensorSettings& settings,
                                         std::shared_ptr<const GatheredSteps> known,
                                         const Progress& progress) {
  if (!known)
    known = std::make_shared<const GatheredSteps>(
        gatherSteps(readPressureTable(table), table.parent_path(), openSource, {}, progress));
  if (known->numUnused() == known->samples.size()) {
    const auto& notes = known->samples.front().notes;
    throw FileError(table,
                    "none of its rows gives a usable step" +
                        (notes.empty() ? "" : "; the first: " + notes.back()));
  }
  auto made = std::make_shared<ShownCalibration>();
  made->source = table;
  made->gathered = known;
  Calibration& calibration = made->calibration = calibrationOf(*known, options);
  calibration.settings = settings;
  calibration.programVersion = programVersion();
  calibration.madeAt = madeNow();
  calibration.options = Json::object()
                            .set("table", table.string())
                            .set("table_sha256", sha256OfFile(table))
                            .set("choices", options.study ? "study" : "default")
                            .set("loss", "squares")
                            .set("area_mm2", options.stampAreaMm2);
  return made;
}

ShownCalibrationPtr calibrationFromFile(const std::filesystem::path& path) {
  auto read = std::make_shared<ShownCalibration>();
  read->source = path;
  read->calibration = loadCalibration(path);
  return read;
}

}  // namespace palpate::gui
