#include "palpate/batch/batch_task.h"

#include <vector>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/recognition/filtered_recording.h"
#include "palpate/recording/recording.h"
#include "palpate/recording/recording_losses.h"
#include "palpate/signals/signal_filter.h"
#include "palpate/signals/signal_rows.h"
#include "palpate/slip/slip_rows.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

std::string matrixText(const std::optional<std::int64_t>& matrix) {
  return matrix ? "; matrix " + std::to_string(*matrix) : "";
}

std::string filtersText(const Recipe& filters) {
  return filters.empty() ? "" : "; " + recipeText(filters);
}

// The recording of an item, filtered; the first half of the progress.
Recording openFiltered(const BatchItem& item,
                       const Recipe& filters,
                       const Progress& progress,
                       std::size_t threads) {
  Recording recording =
      readRecording(item.source, {.threads = threads}, partOf(progress, 0.0, 0.5));
  recording.profile = filteredBy(filters, recording, item.source, partOf(progress, 0.5, 0.5));
  return recording;
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
  return {
      .options = "convert; " + recipeText(options.filters) + choicesText(options.choices),
      .work = [options](const BatchItem& item,
                        Overwrite overwrite,
                        const Progress& progress,
                        std::size_t threads) {
        formatOf(item.target);
        const Recording recording = openFiltered(item, options.filters, progress, threads);
        recording.requireEvents();
        const Profile& profile = recording.profile;
        const SaveExtras extras = exportExtras(
            options.choices, {item.source, recording.meta}, item.target, profile, options.filters);
        const SaveReport saved = saveRecording(
            profile, recording.events, item.target, overwrite, partOf(progress, 0.5, 1.0), extras);
        BatchAnswer answer{.said = counted(profile.numFrames(), "frame")};
        if (const std::string leftOut = leftOutText(profile, item.target); !leftOut.empty())
          answer.said += "; " + leftOut;
        if (saved.movedStamps > 0)
          answer.said += "; " + std::to_string(saved.movedStamps) +
                         " time stamps moved behind the one before: whole milliseconds must "
                         "grow";
        if (!saved.beside.empty())
          answer.said +=
              "; " + std::to_string(saved.beside.size()) + " further series in files beside it";
        answer.problem = partText(item, profile, recording.damage.events);
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
            const Recording whole =
                readRecording(item.source, {.threads = threads}, partOf(progress, 0.0, 0.3));
            whole.requireEvents();
            const std::vector<GraspFrames> grasps = graspFrames(whole.profile, whole.events);
            if (grasps.empty()) throw FileError(item.source, "has no grasp");
            const Profile profile =
                filteredBy(options.filters, whole, item.source, partOf(progress, 0.3, 0.5));
            BatchNameFields fields = nameFieldsOf(item);
            fields.timeUs = whole.profile.frameTimeUs(0);
            BatchAnswer answer{.said = counted(grasps.size(), "grasp")};
            for (std::size_t i = 0; i < grasps.size(); ++i)
              answer.results.push_back(names.pathFor(fields, i + 1, grasps.size()));
            if (const std::string leftOut = leftOutText(profile, answer.results.front());
                !leftOut.empty())
              answer.said += "; " + leftOut;
            GraspFilesOptions files{.overwrite = overwrite, .replaceable = item.earlier};
            const ExportSource source(item.source, whole.meta);
            files.extras = [&](const Profile& part, const fs::path& out) {
              SaveExtras extras = exportExtras(options.choices, source, out, part, options.filters);
              extras.meta.erase("settings");  // those at the start of the whole recording
              return extras;
            };
            saveGrasps(item.source,
                       profile,
                       whole.events,
                       grasps,
                       answer.results,
                       files,
                       partOf(progress, 0.5, 1.0));
            answer.problem = partText(item, profile, whole.damage.events);
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
            const Profile profile = openFiltered(item, table.filters, progress, threads).profile;
            requireMatrix(item.source, profile.layout(), table.matrix);
            requireBelowHalfRate(table.smooth, profile, item.source);
            TableFile out(item.target, overwrite);
            const bool components = profile.givesReadings();
            out.write(signalColumns(components) + "\n");
            if (table.unitsRow) out.write(signalUnits(profile.hand(), components) + "\n");
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
                openFiltered(item, table.filters, partOf(progress, 0.0, 0.4), threads).profile;
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

}  // namespace palpate
