#include "palpate/batch/batch_task.h"

#include <vector>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/model/hand_file.h"
#include "palpate/recognition/filtered_recording.h"
#include "palpate/recording/recording.h"
#include "palpate/recording/recording_losses.h"
#include "palpate/recording/result_file.h"
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

std::string timesText(TimeChoice times) {
  return times == TimeChoice::kFitted ? "; times fitted" : "";
}

std::string unitsRowText(bool unitsRow) { return unitsRow ? "; units-row" : ""; }

// Takes the chosen times; returns what a batch says of them, "; frames: drift ..".
std::string takeTimes(TimeChoice times,
                      Recording& recording,
                      const fs::path& file,
                      const Progress& progress) {
  return times == TimeChoice::kFitted ? "; " + takeFittedTimes(recording, file, progress) : "";
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
      .options = "convert; " + recipeText(options.filters) + choicesText(options.choices) +
                 timesText(options.times),
      .work = [options](const BatchItem& item,
                        Overwrite overwrite,
                        const Progress& progress,
                        std::size_t threads) {
        formatOf(item.target);
        Recording recording =
            readRecording(item.source, {.threads = threads}, partOf(progress, 0.0, 0.5));
        const Progress prepared = partOf(progress, 0.5, 0.5);
        const std::string times = takeTimes(options.times, recording, item.source, prepared);
        recording.profile = filteredBy(options.filters, recording, item.source, prepared);
        recording.requireEvents();
        const Profile& profile = recording.profile;
        const SaveExtras extras = exportExtras(
            options.choices, {item.source, recording.meta}, item.target, profile, options.filters);
        const SaveReport saved = saveRecording(
            profile, recording.events, item.target, overwrite, partOf(progress, 0.5, 1.0), extras);
        BatchAnswer answer{.said = counted(profile.numFrames(), "frame") + times};
        if (const std::string leftOut = leftOutText(profile, item.target); !leftOut.empty())
          answer.said += "; " + leftOut;
        if (saved.movedStamps > 0)
          answer.said += "; " + std::to_string(saved.movedStamps) +
                         " time stamps moved after the previous one: whole milliseconds must "
                         "increase";
        if (!saved.beside.empty())
          answer.said +=
              "; " + std::to_string(saved.beside.size()) + " further series in separate files";
        answer.problem = partText(item, profile, recording.damage.events);
        return answer;
      }};
}

BatchTask graspsTask(const GraspTemplate& names, const ConvertOptions& options) {
  options.filters.validate();
  return {.options = "convert grasps; " + recipeText(options.filters) +
                     choicesText(options.choices) + timesText(options.times),
          .work =
              [names, options](const BatchItem& item,
                               Overwrite overwrite,
                               const Progress& progress,
                               std::size_t threads) {
                formatOf(item.target);
                Recording whole =
                    readRecording(item.source, {.threads = threads}, partOf(progress, 0.0, 0.3));
                whole.requireEvents();
                const std::vector<GraspFrames> grasps = graspFrames(whole.profile, whole.events);
                if (grasps.empty()) throw FileError(item.source, "has no grasp");
                BatchNameFields fields = nameFieldsOf(item);
                fields.timeUs = whole.profile.frameTimeUs(0);
                const std::string times =
                    takeTimes(options.times, whole, item.source, partOf(progress, 0.3, 0.3));
                const Profile profile =
                    filteredBy(options.filters, whole, item.source, partOf(progress, 0.3, 0.5));
                BatchAnswer answer{.said = counted(grasps.size(), "grasp") + times};
                for (std::size_t i = 0; i < grasps.size(); ++i)
                  answer.results.push_back(names.pathFor(fields, i + 1, grasps.size()));
                if (const std::string leftOut = leftOutText(profile, answer.results.front());
                    !leftOut.empty())
                  answer.said += "; " + leftOut;
                GraspFilesOptions files{.overwrite = overwrite, .replaceable = item.earlier};
                const ExportSource source(item.source, whole.meta);
                files.extras = [&](const Profile& part, const fs::path& out) {
                  SaveExtras extras =
                      exportExtras(options.choices, source, out, part, options.filters);
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

RecordingTable signalsOf(const SignalRowsOptions& options) {
  options.filters.validate();
  SignalFilter(options.smooth, 1, [](std::int64_t, std::span<const SignalValues>) {});
  return {.options = (options.centres ? "centres; " : "signals; ") + recipeText(options.filters) +
                     "; smooth " + recipeText(options.smooth) + matrixText(options.matrix) +
                     timesText(options.times),
          .of =
              [options](const fs::path& file, const Recording& whole, const Progress& progress) {
                const Profile profile = filteredBy(
                    options.filters, whole, file, partOf(progress, 0.0, 0.5), options.times);
                requireMatrix(file, profile.layout(), options.matrix);
                requireBelowHalfRate(options.smooth, profile, file);
                return signalTable(profile, options, partOf(progress, 0.5, 1.0));
              },
          .unitsRow = options.unitsRow};
}

RecordingTable slipOf(const SlipRowsOptions& options) {
  options.filters.validate();
  return {.options = std::string("slip") + (options.segments ? "; segments" : "") + "; " +
                     passText(options.pass) + matrixText(options.matrix) +
                     filtersText(options.filters) + timesText(options.times),
          .of =
              [options](const fs::path& file, const Recording& whole, const Progress& progress) {
                const Profile profile = filteredBy(
                    options.filters, whole, file, partOf(progress, 0.0, 0.3), options.times);
                requireThere(file, profile, options);
                return slipTable(profile, options, partOf(progress, 0.3, 1.0));
              },
          .rowNoun = options.segments ? "slip" : "row",
          .unitsRow = options.unitsRow};
}

RecordingTable graspsOf(const GraspRowsOptions& options) {
  options.filters.validate();
  const bool isStudy = options.segments.rule == GraspRule::kStudy;
  return {
      .options =
          std::string("grasps; ") + (isStudy ? "study" : "general") + filtersText(options.filters),
      .of =
          [options, isStudy](
              const fs::path& file, const Recording& whole, const Progress& progress) {
            const Profile profile =
                filteredBy(options.filters, whole, file, partOf(progress, 0.0, 0.5));
            const HandDescription& hand = profile.hand();
            if (isStudy && !(hand.file && hand.file->pinch))
              throw FileError(file,
                              "rule study needs two pads that pinch, which the description of '" +
                                  hand.name + "' doesn't name: use --rule general");
            return graspTable(profile, options.segments, partOf(progress, 0.5, 1.0));
          },
      .rowNoun = "grasp"};
}

BatchTask tableTask(const RecordingTable& table) {
  return {.options = table.options + unitsRowText(table.unitsRow),
          .work = [table](const BatchItem& item,
                          Overwrite overwrite,
                          const Progress& progress,
                          std::size_t threads) {
            const Recording recording = (table.readable ? readableRecording : readRecording)(
                item.source, {.threads = threads}, partOf(progress, 0.0, 0.4));
            const std::unique_ptr<ResultTable> rows =
                table.of(item.source, recording, partOf(progress, 0.4, 1.0));
            const std::size_t count =
                writeResult(*rows, item.target, overwrite, {.unitsRow = table.unitsRow});
            BatchAnswer answer{
                .said = table.rowNoun.empty() ? counted(recording.profile.numFrames(), "frame")
                                              : counted(count, table.rowNoun),
                .problem = partText(
                    item, recording.profile, table.readable ? recording.damage.events : 0)};
            for (const std::string& note : rows->notes()) answer.said += "; " + note;
            if (table.readable && !recording.damage.text.empty())
              answer.problem = item.source.string() + ": " + recording.damage.text;
            for (const std::string& problem : rows->problems())
              answer.problem += (answer.problem.empty() ? "" : "; ") + problem;
            return answer;
          }};
}

BatchTask featuresTask(std::optional<FeatureSet> set, const Recipe& filters, bool unitsRow) {
  filters.validate();
  return {.options = "features; " + std::string(set ? featureSetName(*set) : "default") +
                     filtersText(filters) + unitsRowText(unitsRow),
          .work = [set, filters, unitsRow](const BatchItem& item,
                                           Overwrite overwrite,
                                           const Progress& progress,
                                           std::size_t) {
            FeatureTable table = extractFeatures(
                {item.source}, {.set = set, .threads = 1, .filters = filters}, progress);
            if (table.rows.empty())
              throw Error(table.problems.empty()
                              ? FileError(item.source, "has no grasp with features").what()
                              : table.problems.front());
            for (FeatureRow& row : table.rows) row.className = classIn(item);
            const std::size_t count =
                writeResult(*featureTable(table), item.target, overwrite, {.unitsRow = unitsRow});
            BatchAnswer answer{.said = counted(count, "grasp")};
            if (!table.problems.empty()) answer.problem = table.problems.front();
            return answer;
          }};
}

}  // namespace palpate
