// The rows of the formats that are written only.
#include "palpate/recording/mat_export.h"
#include "palpate/recording/recording_format.h"
#include "palpate/recording/table_export.h"
#include "palpate/recording/tactile_sensor_json.h"

#include "recording/format_reader.h"

namespace palpate {
namespace {

constexpr const char* kCsvEndings[] = {".csv"};
constexpr const char* kNpzEndings[] = {".npz"};
constexpr const char* kJsonLinesEndings[] = {".jsonl"};
constexpr const char* kMatEndings[] = {".mat"};

SaveReport saveCsv(const SaveJob& job) {
  return {.beside = writeCsv(
              job.content.profile, job.path, job.overwrite, job.progress, job.extras.unitsRow)};
}

SaveReport saveNpz(const SaveJob& job) {
  writeNpz(job.content.profile, job.content.events, job.path, job.overwrite, job.progress);
  return {};
}

SaveReport saveJsonLines(const SaveJob& job) {
  writeTactileSensorLines(job.content.profile, job.path, job.overwrite, job.progress);
  return {};
}

SaveReport saveMat(const SaveJob& job) {
  writeMat(job.content, job.path, job.overwrite, job.progress);
  return {};
}

}  // namespace

constinit const RecordingFormat kCsvFormat{.name = "csv",
                                           .purpose = "CSV, a row per active taxel",
                                           .endings = kCsvEndings,
                                           .isExport = true,
                                           .holdsFurther = true,
                                           .takesUnitsRow = true,
                                           .save = &saveCsv};
constinit const RecordingFormat kNpzFormat{.name = "npz",
                                           .purpose = "NumPy",
                                           .endings = kNpzEndings,
                                           .isExport = true,
                                           .holdsFurther = true,
                                           .holdsReadings = true,
                                           .save = &saveNpz};
constinit const RecordingFormat kJsonLinesFormat{.name = "jsonl",
                                                 .purpose = "JSON lines, schunk_sdh/TactileSensor",
                                                 .endings = kJsonLinesEndings,
                                                 .isExport = true,
                                                 .save = &saveJsonLines};
constinit const RecordingFormat kMatFormat{.name = "mat",
                                           .purpose = "MATLAB, MAT 5",
                                           .endings = kMatEndings,
                                           .isExport = true,
                                           .takesSeries = true,
                                           .holdsFurther = true,
                                           .holdsReadings = true,
                                           .save = &saveMat};

}  // namespace palpate
