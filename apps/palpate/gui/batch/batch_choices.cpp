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
#include <palpate/recording/result_file.h>

#include "gui/appearance/settings_table.h"
#include "gui/batch/batch_pictures.h"
#include "gui/source/recording_settings.h"

namespace palpate::gui {
namespace fs = std::filesystem;
namespace {

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
  return usesMatrix(choices) && choices.table == "csv";
}

bool usesMatrix(const BatchChoices& choices) {
  return choices.work == BatchWork::kSignals || choices.work == BatchWork::kSlip;
}

bool makesTables(const BatchChoices& choices) {
  return usesMatrix(choices) || choices.work == BatchWork::kFeatures;
}

bool usesEachGrasp(const BatchChoices& choices) {
  return choices.work == BatchWork::kConvert && choices.eachGrasp;
}

QString endingOf(const BatchChoices& choices) {
  if (choices.work == BatchWork::kRender) return "." + choices.picture;
  return "." + (makesTables(choices) ? choices.table : choices.form);
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
      if (choices.table == "mcap")
        throw std::invalid_argument(
            "a table of grasps has no time: choose a format other than .mcap");
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

namespace {

void batchFields(SettingsTable& table, BatchChoices& choices) {
  table.texts("paths", choices.paths);
  table.number("work", choices.work, 0, static_cast<int>(BatchWork::kRender));
  table.text("filters", choices.filters);
  table.text("form", choices.form, [](const QString& text) {
    const auto endings = recordingEndings();
    return std::find(endings.begin(), endings.end(), "." + text.toStdString()) != endings.end();
  });
  table.text("table", choices.table, [](const QString& text) {
    const auto endings = resultEndings();
    return std::ranges::find(endings, "." + text.toStdString()) != endings.end();
  });
  table.flag("eachGrasp", choices.eachGrasp);
  table.text("picture", choices.picture, [](const QString& text) {
    return batchPictureForms().contains(text);
  });
  table.text("map", choices.map, [](const QString& text) {
    return colorMapFrom(text.toStdString()).has_value();
  });
  table.flag("interpolated", choices.interpolated);
  table.flag("printedValues", choices.printedValues);
  table.number("speed", choices.speed, kMinBatchSpeed, kMaxBatchSpeed);
  table.flag("signals", choices.withSignals);
  table.flag("slip", choices.withSlip);
  table.flag("unitsRow", choices.unitsRow);
  table.text("smooth", choices.smooth);
  table.number("matrix", choices.matrix, -1, kMaxBatchMatrix);
  table.text("method", choices.method, [](const QString& text) {
    return slipMethodNamed(text.toStdString()).has_value();
  });
  table.text("reference", choices.reference);
  table.flag("segments", choices.segments);
  table.number("step", choices.stepTaxels, kMinBatchTaxels, kMaxBatchTaxels);
  table.number("limit", choices.limitTaxels, kMinBatchTaxels, kMaxBatchTaxels);
  table.number("rotation", choices.rotationDeg, kMinBatchDeg, kMaxBatchDeg);
  table.text("set", choices.featureSet, [](const QString& text) {
    return text.isEmpty() || featureSetNamed(text.toStdString());
  });
  table.text("folder", choices.folder);
  table.text("names", choices.names);
  table.flag("resume", choices.resume);
  table.flag("replace", choices.replace);
  table.number("threads", choices.threads, 0, kMaxBatchThreads);
}

}  // namespace

void saveBatchChoices(const BatchChoices& choices, QSettings& settings) {
  saveFields(settings, choices, batchFields, "batch/");
}

BatchChoices loadBatchChoices(const QSettings& settings) {
  return loadFields<BatchChoices>(settings, batchFields, "batch/");
}

}  // namespace palpate::gui
