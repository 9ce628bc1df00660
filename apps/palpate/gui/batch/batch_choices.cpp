#include "gui/batch/batch_choices.h"

#include <QFileInfo>
#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include <palpate/batch/batch_task.h>
#include <palpate/core/error.h>
#include <palpate/core/escaped_line.h>
#include <palpate/filter/recipe.h>

#include "gui/batch/batch_pictures.h"
#include "gui/source/recording_settings.h"

namespace palpate::gui {
namespace fs = std::filesystem;
namespace {

constexpr int kMostBatchThreads = 256;

Recipe recipeFromText(const QString& text, const char* what) {
  if (text.trimmed().isEmpty()) return {};
  const std::vector<std::string> texts = {text.trimmed().toStdString()};
  try {
    Recipe recipe = parseRecipe(texts);
    recipe.validate();
    return recipe;
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(std::string(what) + ": " + error.what());
  }
}

std::optional<std::int64_t> matrixOf(const BatchChoices& choices) {
  return choices.matrix < 0 ? std::nullopt : std::optional<std::int64_t>(choices.matrix);
}

// A path of the list that isn't there; empty: all are.
QString missingOf(const BatchChoices& choices) {
  for (const QString& path : choices.paths)
    if (!QFileInfo::exists(path)) return path;
  return {};
}

QString relativeName(const fs::path& path, const fs::path& folder) {
  const fs::path below = folder.empty() ? path.filename() : path.lexically_relative(folder);
  return QString::fromStdString(escapedLine(below.string()));
}

}  // namespace

bool usesFilters(const BatchChoices& choices) {
  if (choices.work == BatchWork::kConvert)
    return choices.form != "dsa" && choices.form != "palpate";
  return choices.work == BatchWork::kSignals || choices.work == BatchWork::kRender;
}

bool usesSeries(const BatchChoices& choices) {
  return choices.work == BatchWork::kConvert &&
         (choices.form == "h5" || choices.form == "mat" || choices.form == "mcap");
}

bool usesUnitsRow(const BatchChoices& choices) {
  if (choices.work == BatchWork::kConvert) return choices.form == "csv";
  return choices.work == BatchWork::kSignals || choices.work == BatchWork::kSlip;
}

bool usesMatrix(const BatchChoices& choices) {
  return choices.work == BatchWork::kSignals || choices.work == BatchWork::kSlip;
}

bool usesEachGrasp(const BatchChoices& choices) {
  return choices.work == BatchWork::kConvert && choices.eachGrasp;
}

QString endingOf(const BatchChoices& choices) {
  if (choices.work == BatchWork::kRender) return "." + choices.picture;
  return choices.work == BatchWork::kConvert ? "." + choices.form : QString(".csv");
}

namespace {

fs::path resultFolderOf(const BatchChoices& choices) {
  if (choices.folder.trimmed().isEmpty())
    throw std::invalid_argument("choose a folder for the results");
  const QString folder = folderFromText(choices.folder);
  if (!QFileInfo(folder).isAbsolute())
    throw std::invalid_argument("the folder of the results must begin with / or ~");
  return folder.toStdString();
}

std::string resultNamesOf(const BatchChoices& choices) {
  return (choices.names.trimmed() + endingOf(choices)).toStdString();
}

}  // namespace

BatchTemplate templateOf(const BatchChoices& choices) {
  if (usesEachGrasp(choices)) return graspTemplateOf(choices).planned();
  return BatchTemplate(resultFolderOf(choices), resultNamesOf(choices));
}

GraspTemplate graspTemplateOf(const BatchChoices& choices) {
  const fs::path folder = resultFolderOf(choices);
  if (!choices.names.contains("{n}"))
    throw std::invalid_argument("the names need {n}, the number of the grasp: {name}_{n}");
  return GraspTemplate(folder, resultNamesOf(choices));
}

BatchTask taskOf(const BatchChoices& choices) {
  const Recipe filters =
      usesFilters(choices) ? recipeFromText(choices.filters, "Filters") : Recipe();
  const bool unitsRow = usesUnitsRow(choices) && choices.unitsRow;
  switch (choices.work) {
    case BatchWork::kConvert: {
      const ConvertOptions convert{
          .filters = filters,
          .choices = {.withSignals = choices.withSignals || !usesSeries(choices),
                      .withSlip = choices.withSlip || !usesSeries(choices),
                      .unitsRow = unitsRow}};
      return choices.eachGrasp ? graspsTask(graspTemplateOf(choices), convert)
                               : convertTask(convert);
    }
    case BatchWork::kSignals: {
      const Recipe smooth = recipeFromText(choices.smooth, "Smooth");
      try {
        return signalsTask({.matrix = matrixOf(choices),
                            .filters = filters,
                            .smooth = smooth,
                            .unitsRow = unitsRow});
      } catch (const std::invalid_argument& error) {
        throw std::invalid_argument(std::string("Smooth: ") + error.what());
      }
    }
    case BatchWork::kSlip: {
      SlipRowsOptions table{
          .matrix = matrixOf(choices), .segments = choices.segments, .unitsRow = unitsRow};
      setSlipMethod(table, choices.method.toStdString());
      try {
        setSlipReference(table, choices.reference.trimmed().toStdString());
      } catch (const std::invalid_argument& error) {
        throw std::invalid_argument(std::string("Reference: ") + error.what());
      }
      SlipRuleOptions& rule = table.pass.detector.rule;
      rule.stepTaxels = choices.stepTaxels;
      rule.referenceTaxels = choices.limitTaxels;
      rule.rotationDeg = choices.rotationDeg;
      return slipTask(table);
    }
    case BatchWork::kRender:
      return picturesTask(
          {.filters = filters,
           .map = colorMapFrom(choices.map.toStdString()).value_or(ColorMapName::kInferno),
           .interpolated = choices.interpolated,
           .values = choices.printedValues,
           .speed = choices.speed},
          choices.picture);
    case BatchWork::kFeatures:
      break;
  }
  return featuresTask(featureSetNamed(choices.featureSet.toStdString()));
}

BatchOptions optionsOf(const BatchChoices& choices) {
  return {.threads = static_cast<std::size_t>(std::max(0, choices.threads)),
          .overwrite = choices.replace ? Overwrite::kReplace : Overwrite::kRefuse,
          .resume = choices.resume,
          .inBackground = true};
}

BatchLook lookAtBatch(const BatchChoices& choices, const Progress& progress) {
  BatchLook look;
  try {
    if (choices.paths.isEmpty()) throw Error("add the recordings and folders to be read");
    if (const QString path = missingOf(choices); !path.isEmpty())
      throw FileError(path.toStdString(), "does not exist");
    taskOf(choices);
    const BatchTemplate names = templateOf(choices);
    const fs::path& folder = names.folder();
    std::error_code ignored;
    if (fs::exists(folder, ignored) && !fs::is_directory(folder, ignored))
      throw FileError(folder, "is not a folder");
    std::vector<fs::path> paths;
    for (const QString& path : choices.paths) paths.emplace_back(path.toStdString());
    look.plan = planBatch(paths, names, progress);
    if (look.plan.items.empty() && !look.plan.problems.empty())
      throw Error(look.plan.problems.front());
  } catch (const Cancelled&) {
    throw;
  } catch (const std::exception& error) {
    look.problem = QString::fromStdString(escapedLine(error.what()));
  }
  return look;
}

QStringList firstNames(const BatchPlan& plan, int count) {
  QStringList lines;
  for (const BatchItem& item : plan.items) {
    if (lines.size() == count) break;
    lines << relativeName(item.source, item.root) + " → " +
                 (item.target.empty() ? QString::fromStdString(escapedLine(item.problem))
                                      : relativeName(item.target, plan.folder));
  }
  return lines;
}

QString countsText(const BatchStatus& status) {
  QStringList parts = {QString("%1 done").arg(status.done - status.inPart)};
  const auto add = [&](std::size_t number, const char* what) {
    if (number > 0) parts << QString("%1 %2").arg(number).arg(what);
  };
  add(status.inPart, "done in part");
  add(status.skipped, "skipped");
  add(status.failed, "failed");
  add(status.total - status.done - status.skipped - status.failed, "not done");
  return parts.join(", ");
}

void saveBatchChoices(const BatchChoices& choices, QSettings& settings) {
  settings.beginGroup("batch");
  settings.setValue("paths", choices.paths);
  settings.setValue("work", static_cast<int>(choices.work));
  settings.setValue("filters", choices.filters);
  settings.setValue("form", choices.form);
  settings.setValue("eachGrasp", choices.eachGrasp);
  settings.setValue("picture", choices.picture);
  settings.setValue("map", choices.map);
  settings.setValue("interpolated", choices.interpolated);
  settings.setValue("printedValues", choices.printedValues);
  settings.setValue("speed", choices.speed);
  settings.setValue("signals", choices.withSignals);
  settings.setValue("slip", choices.withSlip);
  settings.setValue("unitsRow", choices.unitsRow);
  settings.setValue("smooth", choices.smooth);
  settings.setValue("matrix", choices.matrix);
  settings.setValue("method", choices.method);
  settings.setValue("reference", choices.reference);
  settings.setValue("segments", choices.segments);
  settings.setValue("step", choices.stepTaxels);
  settings.setValue("limit", choices.limitTaxels);
  settings.setValue("rotation", choices.rotationDeg);
  settings.setValue("set", choices.featureSet);
  settings.setValue("folder", choices.folder);
  settings.setValue("names", choices.names);
  settings.setValue("resume", choices.resume);
  settings.setValue("replace", choices.replace);
  settings.setValue("threads", choices.threads);
  settings.endGroup();
}

BatchChoices loadBatchChoices(const QSettings& settings) {
  BatchChoices choices;
  const auto read = [&](const char* name, auto& value) {
    using Value = std::remove_reference_t<decltype(value)>;
    const QVariant stored = settings.value(QString("batch/") + name);
    if (stored.canConvert<Value>()) value = stored.value<Value>();
  };
  int work = 0;
  read("paths", choices.paths);
  read("work", work);
  if (work >= 0 && work <= static_cast<int>(BatchWork::kRender))
    choices.work = static_cast<BatchWork>(work);
  read("filters", choices.filters);
  read("form", choices.form);
  const auto forms = recordingForms();
  if (std::none_of(forms.begin(), forms.end(), [&](const RecordingForm& form) {
        return choices.form == form.ending + 1;
      }))
    choices.form = BatchChoices().form;
  read("eachGrasp", choices.eachGrasp);
  read("picture", choices.picture);
  if (!batchPictureForms().contains(choices.picture)) choices.picture = BatchChoices().picture;
  read("map", choices.map);
  if (!colorMapFrom(choices.map.toStdString())) choices.map = BatchChoices().map;
  read("interpolated", choices.interpolated);
  read("printedValues", choices.printedValues);
  read("speed", choices.speed);
  if (!(choices.speed >= kLeastBatchSpeed && choices.speed <= kMostBatchSpeed)) choices.speed = 1.0;
  read("signals", choices.withSignals);
  read("slip", choices.withSlip);
  read("unitsRow", choices.unitsRow);
  read("smooth", choices.smooth);
  read("matrix", choices.matrix);
  read("method", choices.method);
  if (!slipMethodNamed(choices.method.toStdString())) choices.method = BatchChoices().method;
  read("reference", choices.reference);
  read("segments", choices.segments);
  read("step", choices.stepTaxels);
  read("limit", choices.limitTaxels);
  read("rotation", choices.rotationDeg);
  read("set", choices.featureSet);
  if (!featureSetNamed(choices.featureSet.toStdString())) choices.featureSet.clear();
  read("folder", choices.folder);
  read("names", choices.names);
  read("resume", choices.resume);
  read("replace", choices.replace);
  read("threads", choices.threads);
  choices.threads = std::clamp(choices.threads, 0, kMostBatchThreads);
  return choices;
}

}  // namespace palpate::gui
