// What the Batch dialog asks for, what it remembers in the settings, and the plan and work of
// module batch that follow from it.
#pragma once

#include <QSettings>
#include <QString>
#include <QStringList>

#include <palpate/batch/batch_plan.h>
#include <palpate/batch/batch_run.h>
#include <palpate/batch/grasp_files.h>

namespace palpate::gui {

// What a batch makes of each recording; the work is that of the commands of these names.
enum class BatchWork { kConvert, kSignals, kSlip, kFeatures, kRender };

// Ranges of fields below.
inline constexpr int kMaxBatchMatrix = 999, kMaxBatchThreads = 256;
inline constexpr double kMinBatchTaxels = 1e-3, kMaxBatchTaxels = 100.0;  // [taxels]
inline constexpr double kMinBatchDeg = 0.1, kMaxBatchDeg = 360.0;         // [deg]

struct BatchChoices {
  // Recordings and folders.
  QStringList paths = {};
  BatchWork work = BatchWork::kConvert;
  // Filters of kConvert and kSignals as text, "median:size=3 | kalman"; may be empty.
  QString filters = {};
  // Ending of the results of kConvert, without its dot.
  QString form = "npz";
  // Ending of the tables of kSignals, kSlip and kFeatures, without its dot.
  QString table = "csv";
  // Of kConvert: a file for each grasp; `names` then contains {n}.
  bool eachGrasp = false;
  // Of kConvert to .h5 and .mat.
  bool withSignals = true;
  bool withSlip = true;
  // Of CSV: a second row with the units.
  bool unitsRow = false;
  // Filters over time of the signals of kSignals; may be empty.
  QString smooth = {};
  // The only matrix of kSignals and kSlip; below 0: all.
  int matrix = -1;
  // Of kSlip; see slip_rows.h.
  QString method = "contest";
  QString reference = "first";
  bool segments = false;
  double stepTaxels = 0.2;
  double limitTaxels = 1.0;
  double rotationDeg = 5.0;
  // Set of kFeatures; empty: the default of the hand.
  QString featureSet = {};
  // Of kRender: "png", "svg", "pdf", or "mp4" for a movie; the look as in MatricesPictureOptions.
  QString picture = "png";
  QString map = "inferno";
  bool interpolated = false;
  bool printedValues = false;
  double speed = 1.0;  // of a movie
  // Folder of the results, and the template of their names below it, without ending.
  QString folder = {};
  QString names = "{name}";
  bool resume = true;
  bool replace = false;
  // Recordings at the same time; 0: as many as the machine runs at once.
  int threads = 0;
  bool operator==(const BatchChoices&) const = default;
};

// Whether a choice has an effect on the results.
bool usesFilters(const BatchChoices& choices);
bool usesSeries(const BatchChoices& choices);  // withSignals, withSlip
bool usesUnitsRow(const BatchChoices& choices);
bool usesMatrix(const BatchChoices& choices);
bool makesTables(const BatchChoices& choices);
bool usesEachGrasp(const BatchChoices& choices);
// Ending of the results, with its dot.
QString endingOf(const BatchChoices& choices);

// All throw std::invalid_argument with the reason why it can't be done.
BatchTemplate templateOf(const BatchChoices& choices);
// Of a batch with a file for each grasp.
GraspTemplate graspTemplateOf(const BatchChoices& choices);
BatchTask taskOf(const BatchChoices& choices);
BatchOptions optionsOf(const BatchChoices& choices);

// What a batch would make; computed by a worker.
struct BatchLook {
  BatchPlan plan = {};
  // Why the batch can't begin, in one line; empty when it can.
  QString problem = {};
};
// Never throws for bad choices and files; throws Cancelled. Writes nothing.
BatchLook lookAtBatch(const BatchChoices& choices, const Progress& progress = {});

// "a.dsa → a.npz" for the first `count` results of a plan; names relative to their folders.
QStringList firstNames(const BatchPlan& plan, int count);
// "12 done, 3 failed" or "12 done".
QString countsText(const BatchStatus& status);

void saveBatchChoices(const BatchChoices& choices, QSettings& settings);
// Values that are out of range become the defaults.
BatchChoices loadBatchChoices(const QSettings& settings);

}  // namespace palpate::gui
