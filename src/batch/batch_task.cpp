#include "palpate/batch/batch_task.h"

#include <stdexcept>
#include <vector>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/core/text_table.h"
#include "palpate/filter/filtered_profile.h"
#include "palpate/model/timing.h"
#include "palpate/recording/recording.h"
#include "palpate/signals/signal_filter.h"
#include "palpate/signals/signal_rows.h"
#include "palpate/slip/slip_rows.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

// The part of the progress between two fractions.
Progress partOf(const Progress& progress, double begin, double end) {
  return [&progress, begin, end](double fraction) {
    return !progress || progress(begin + (end - begin) * fraction);
  };
}

std::string matrixText(const std::optional<std::int64_t>& matrix) {
  return matrix ? "; matrix " + std::to_string(*matrix) : "";
}

std::string filtersText(const Recipe& filters) {
  return filters.empty() ? "" : "; " + recipeText(filters);
}

void requireMatrix(const fs::path& file,
                   const Profile& profile,
                   const std::optional<std::int64_t>& matrix) {
  const auto matrices = static_cast<std::int64_t>(profile.layout().numMatrices());
  if (matrix && *matrix >= matrices)
    throw Error(file.string() + ": has no matrix " + std::to_string(*matrix) + ", only 0.." +
                std::to_string(matrices - 1));
}

// The recording of an item, filtered; the first half of the progress.
Profile openFiltered(const BatchItem& item,
                     const Recipe& filters,
                     const Progress& progress,
                     std::size_t threads) {
  const Profile whole = openRecording(item.source, partOf(progress, 0.0, 0.5), threads);
  return filteredRecording(filters, whole, item.source, partOf(progress, 0.5, 0.5));
}

// Why the result of an item has only a part of its recording; else empty.
std::string partText(const BatchItem& item, const Profile& profile, std::size_t damagedEvents = 0) {
  std::string text = lostText(profile);
  if (damagedEvents > 0) text += (text.empty() ? "" : "; ") + eventsLeftOutText(damagedEvents);
  return text.empty() ? text : item.source.string() + ": " + text;
}

std::string choicesText(const ExportChoices& choices) {
  std::string text;
  const auto add = [&](bool given, const char* name) {
    if (given) text += (text.empty() ? "; " : " ") + std::string(name);
  };
  add(!choices.withSignals, "no-signals");
  add(!choices.withSlip, "no-slip");
  add(choices.unitsRow, "units-row");
  if (choices.compression) add(true, nameOf(*choices.compression));
  if (choices.images) add(true, *choices.images == McapImages::kRos ? "ros" : "foxglove");
  return text;
}

// What `palpate slip` and the window can set.
std::string passText(const SlipRunOptions& pass) {
  const SlipDetectorOptions& detector = pass.detector;
  const SlipRuleOptions& rule = detector.rule;
  return std::string(nameOf(detector.method)) + "; reference " +
         std::to_string(static_cast<int>(detector.reference)) + " " +
         std::to_string(pass.referenceFrame) + "; limits " + numberText(rule.stepTaxels) + " " +
         numberText(rule.referenceTaxels) + " " + numberText(rule.rotationDeg);
}

// A table that is written row by row; its bytes are gathered to pieces.
class TableFile {
 public:
  TableFile(const fs::path& path, Overwrite overwrite) : file_(path, overwrite) {}
  void write(std::string_view text) {
    constexpr std::size_t kPiece = 1u << 16;
    text_ += text;
    if (text_.size() >= kPiece) flush();
  }
  void commit() {
    flush();
    file_.commit();
  }

 private:
  void flush() {
    file_.write(text_);
    text_.clear();
  }
  OutputFile file_;
  std::string text_;
};

// Folders of one class each lie in the given folder; see feature_table.h.
std::string classIn(const BatchItem& item) {
  if (item.root.empty()) return {};
  const fs::path below = item.source.parent_path().lexically_relative(item.root);
  if (!below.empty() && below != ".") return classOfFolder(item.root / *below.begin());
  return classOfFolder(fs::absolute(item.root).lexically_normal());
}

}  // namespace

BatchTask convertTask(const ConvertOptions& options) {
  options.filters.validate();
  return {.options = "convert; " + recipeText(options.filters) + choicesText(options.choices),
          .work = [options](const BatchItem& item,
                            Overwrite overwrite,
                            const Progress& progress,
                            std::size_t threads) {
            formatOf(item.target);
            const Profile profile = openFiltered(item, options.filters, progress, threads);
            const EventsReport events = readEvents(item.source);
            const SaveExtras extras =
                exportExtras(options.choices, item.source, item.target, profile, options.filters);
            const SaveReport saved = saveRecording(
                profile, events.events, item.target, overwrite, partOf(progress, 0.5, 1.0), extras);
            BatchAnswer answer{.said = counted(profile.numFrames(), "frame")};
            if (saved.movedStamps > 0)
              answer.said += "; " + std::to_string(saved.movedStamps) +
                             " time stamps moved behind the one before: whole milliseconds must "
                             "grow";
            answer.problem = partText(item, profile, events.damaged);
            return answer;
          }};
}

BatchTask graspsTask(const GraspTemplate& names, const ConvertOptions& options) {
  options.filters.validate();
  return {
      .options = "convert grasps; " + recipeText(options.filters) + choicesText(options.choices),
      .work =
          [names, options](const BatchItem& item,
                           Overwrite overwrite,
                           const Progress& progress,
                           std::size_t threads) {
            formatOf(item.target);
            const Profile whole = openRecording(item.source, partOf(progress, 0.0, 0.3), threads);
            const EventsReport events = readEvents(item.source);
            const std::vector<GraspFrames> grasps = graspFrames(whole, events.events);
            if (grasps.empty()) throw FileError(item.source, "has no grasp");
            const Profile profile =
                filteredRecording(options.filters, whole, item.source, partOf(progress, 0.3, 0.5));
            BatchNameFields fields = nameFieldsOf(item);
            fields.timeUs = whole.frameTimeUs(0);
            BatchAnswer answer{.said = counted(grasps.size(), "grasp")};
            for (std::size_t i = 0; i < grasps.size(); ++i)
              answer.results.push_back(names.pathFor(fields, i + 1, grasps.size()));
            GraspFilesOptions files{.overwrite = overwrite, .replaceable = item.earlier};
            const ExportSource source(item.source);
            files.extras = [&](const Profile& part, const fs::path& out) {
              SaveExtras extras = exportExtras(options.choices, source, out, part, options.filters);
              extras.meta.erase("settings");  // those at the start of the whole recording
              return extras;
            };
            saveGrasps(item.source,
                       profile,
                       events.events,
                       grasps,
                       answer.results,
                       files,
                       partOf(progress, 0.5, 1.0));
            answer.problem = partText(item, profile, events.damaged);
            return answer;
          },
      .namesResults = true};
}

BatchTask signalsTask(const SignalRowsOptions& table) {
  table.filters.validate();
  SignalFilter(table.smooth, 1, [](std::int64_t, std::span<const SignalValues>) {});
  return {.options = "signals; " + recipeText(table.filters) + "; smooth " +
                     recipeText(table.smooth) + matrixText(table.matrix) +
                     (table.unitsRow ? "; units-row" : ""),
          .work = [table](const BatchItem& item,
                          Overwrite overwrite,
                          const Progress& progress,
                          std::size_t threads) {
            const Profile profile = openFiltered(item, table.filters, progress, threads);
            requireMatrix(item.source, profile, table.matrix);
            requireBelowHalfRate(table.smooth, profile, item.source);
            TableFile out(item.target, overwrite);
            out.write(std::string(kSignalColumns) + "\n");
            if (table.unitsRow) out.write(signalUnits(profile.hand()) + "\n");
            writeSignalRows(
                profile,
                table.matrix,
                table.smooth,
                "\n",
                [&](const std::string& lines) { out.write(lines); },
                partOf(progress, 0.5, 1.0));
            out.commit();
            return BatchAnswer{.said = counted(profile.numFrames(), "frame"),
                               .problem = partText(item, profile)};
          }};
}

void setSlipMethod(SlipRowsOptions& table, std::string_view name) {
  const auto method = slipMethodNamed(name);
  if (!method) throw std::invalid_argument("there is no method '" + shortened(name) + "' of slip");
  table.pass.detector.method = *method;
  table.pass.detector.hypothesisAlarm = *method == SlipMethod::kContest;
}

void setSlipReference(SlipRowsOptions& table, const std::string& word) {
  SlipDetectorOptions& detector = table.pass.detector;
  if (word == "first") {
    detector.reference = SlipReference::kFirst;
  } else if (word == "rest") {
    detector.reference = SlipReference::kWhenAtRest;
  } else if (const auto frame = parseInteger(word); frame && *frame >= 0) {
    detector.reference = SlipReference::kGiven;
    table.pass.referenceFrame = static_cast<std::size_t>(*frame);
  } else {
    throw std::invalid_argument("'" + shortened(word) +
                                "'; it is first, rest, or the number of a frame");
  }
}

void requireThere(const fs::path& file, const Profile& profile, const SlipRowsOptions& table) {
  requireMatrix(file, profile, table.matrix);
  if (table.pass.detector.reference == SlipReference::kGiven &&
      table.pass.referenceFrame >= profile.numFrames())
    throw Error(file.string() + ": has no frame " + std::to_string(table.pass.referenceFrame) +
                " to be the reference; it has " + std::to_string(profile.numFrames()));
}

BatchTask slipTask(const SlipRowsOptions& table) {
  table.filters.validate();
  return {.options = std::string("slip") + (table.segments ? "; segments" : "") + "; " +
                     passText(table.pass) + matrixText(table.matrix) +
                     (table.unitsRow ? "; units-row" : "") + filtersText(table.filters),
          .work = [table](const BatchItem& item,
                          Overwrite overwrite,
                          const Progress& progress,
                          std::size_t threads) {
            const Profile profile =
                openFiltered(item, table.filters, partOf(progress, 0.0, 0.4), threads);
            requireThere(item.source, profile, table);
            TableFile out(item.target, overwrite);
            out.write(std::string(table.segments ? kSlipSegmentColumns : kSlipColumns) + "\n");
            if (table.unitsRow)
              out.write(std::string(table.segments ? kSlipSegmentUnits : kSlipUnits) + "\n");
            std::size_t rows = 0;
            (table.segments ? forEachSlipSegmentRow : forEachSlipRow)(
                profile,
                table.pass,
                table.matrix,
                [&](const std::string& row) {
                  out.write(row + "\n");
                  ++rows;
                },
                partOf(progress, 0.2, 1.0));
            out.commit();
            return BatchAnswer{.said = counted(rows, table.segments ? "slip" : "row"),
                               .problem = partText(item, profile)};
          }};
}

BatchTask featuresTask(std::optional<FeatureSet> set, const Recipe& filters) {
  filters.validate();
  return {.options = "features; " + std::string(set ? featureSetName(*set) : "default") +
                     filtersText(filters),
          .work = [set, filters](const BatchItem& item,
                                 Overwrite overwrite,
                                 const Progress& progress,
                                 std::size_t) {
            FeatureTable table = extractFeatures(
                {item.source}, {.set = set, .threads = 1, .filters = filters}, progress);
            if (table.rows.empty())
              throw Error(table.problems.empty()
                              ? FileError(item.source, "has no grasp with features").what()
                              : table.problems.front());
            TableFile out(item.target, overwrite);
            out.write(featureHeaderLine(table));
            for (FeatureRow& row : table.rows) {
              row.className = classIn(item);
              out.write(featureLine(row));
            }
            out.commit();
            BatchAnswer answer{.said = counted(table.rows.size(), "grasp")};
            if (!table.problems.empty()) answer.problem = table.problems.front();
            return answer;
          }};
}

std::string featureHeaderLine(const FeatureTable& table) {
  std::vector<std::string> header = {"class", "file", "begin", "end", "initial_frame", "end_frame"};
  header.insert(header.end(), table.names.begin(), table.names.end());
  return csvLine(header);
}

std::string featureLine(const FeatureRow& row) {
  std::vector<std::string> cells = {row.className,
                                    row.file.string(),
                                    std::to_string(row.begin),
                                    std::to_string(row.end),
                                    std::to_string(row.initialFrame),
                                    std::to_string(row.endFrame)};
  for (const double value : row.values) cells.push_back(numberText(value));
  return csvLine(cells);
}

void requireBelowHalfRate(const Recipe& recipe, const Profile& profile, const fs::path& file) {
  if (!recipe.dependsOnRate()) return;
  try {
    recipe.validateForRate(timingOf(profile).rateHz);
  } catch (const std::invalid_argument& error) {
    throw Error(file.string() + ": " + error.what());
  }
}

Profile filteredRecording(const Recipe& recipe,
                          const Profile& profile,
                          const fs::path& file,
                          const Progress& progress) {
  if (recipe.empty()) return profile;
  try {
    return filteredProfile(profile, recipe, {settingsTimesUs(readEvents(file).events)}, progress);
  } catch (const std::invalid_argument& error) {
    throw Error(file.string() + ": " + error.what());
  }
}

}  // namespace palpate
