// The command `palpate convert IN OUT` converts a recording, or a whole folder of them, to another
// form.
#include <cstdio>
#include <stdexcept>

#include "palpate/batch/batch_task.h"
#include "palpate/batch/grasp_files.h"
#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/recording/crop.h"
#include "palpate/recording/recording.h"

#include "commands/batch_options.h"
#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/export_options.h"
#include "commands/filter_options.h"
#include "commands/recording_list.h"

namespace palpate::commands {
namespace fs = std::filesystem;
namespace {

std::string doneText(const fs::path& out, const Profile& profile) {
  return out.string() + ": " + counted(profile.numFrames(), "frame");
}

// Reports the time stamps that a .dsa file could not store unchanged.
std::string movedText(std::size_t stamps) {
  if (stamps == 0) return "";
  return "; " + std::to_string(stamps) +
         " time stamps moved behind the one before: whole milliseconds must grow";
}

// Names the files of further series next to a .csv.
std::string besideText(const std::vector<fs::path>& files) {
  std::string text;
  for (const fs::path& file : files) text += (text.empty() ? "; series in " : ", ") + file.string();
  return text;
}

int convertOne(const CommandLine& given, const std::string& in, const std::string& out) {
  const Overwrite overwrite = given.has("force") ? Overwrite::kReplace : Overwrite::kRefuse;
  formatOf(out);
  requireOther(in, out);
  requireWritable(out, overwrite);
  const FrameChoice frames = frameChoiceOf(given);
  const Recipe recipe = recipeOf(given);
  const ExportChoices choices = exportChoicesOf(given, recipe, out);
  Recording recording = [&] {
    ProgressLine progress("reading " + in, given.quiet());
    return readRecording(in, {.topics = given.texts("topic")}, progress.callback());
  }();
  recording.requireEvents();
  takeTimes(given, recording, in);
  Profile& profile = recording.profile;
  if (frames.from || frames.to) {
    const auto [first, last] = framesOf(frames, in, profile);
    profile = cropped(profile, first, last);
    recording.events = eventsWithin(recording.events, profile);
  }
  profile = filteredBy(recipe, recording, in);
  SaveExtras extras = exportExtras(choices, {in, recording.meta}, out, profile, recipe);
  if (frames.from || frames.to)
    extras.meta.erase("settings");  // those at the start of the whole recording
  reportLeftOut(profile, out);
  const SaveReport saved = [&] {
    ProgressLine progress("writing " + out, given.quiet());
    return saveRecording(profile, recording.events, out, overwrite, progress.callback(), extras);
  }();
  if (!given.quiet())
    std::printf("%s\n",
                escapedLine(doneText(out, profile) + movedText(saved.movedStamps) +
                            besideText(saved.beside))
                    .c_str());
  const int code = reportOpened(in, profile, given.quiet());
  if (recording.damage.events == 0) return code;
  sayLine(in + ": " + eventsLeftOutText(recording.damage.events));
  return kPartlyDone;
}

// The endings without their dots.
auto formWords() {
  return wordsOf(recordingEndings(), [](const std::string& ending) { return ending.substr(1); });
}

BatchTask convertTaskOf(const CommandLine& given, const std::string& ending) {
  const Recipe recipe = recipeOf(given);
  return convertTask({.filters = recipe,
                      .choices = exportChoicesOf(given, recipe, "result" + ending),
                      .times = timeChoiceOf(given)});
}

// --each-grasp PATH.. -o TEMPLATE
int convertGrasps(const CommandLine& given) {
  for (const char* name : {"from", "to", "to-form", "topic"})
    if (given.has(name))
      throw UsageError("--" + std::string(name) + " doesn't go with --each-grasp");
  if (!given.has("output"))
    throw UsageError("--each-grasp needs -o TEMPLATE, as -o out/{name}_{n}.palpate");
  const Recipe recipe = recipeOf(given);
  const GraspTemplate names = [&] {
    try {
      return GraspTemplate(*given.text("output"));
    } catch (const std::invalid_argument& error) {
      throw UsageError(std::string("-o: ") + error.what());
    }
  }();
  const ExportChoices choices = exportChoicesOf(given, recipe, "result" + names.ending());
  formatOf("result" + names.ending());
  return runBatchCommand(
      given,
      names.planned(),
      graspsTask(names, {.filters = recipe, .choices = choices, .times = timeChoiceOf(given)}));
}

int convertBatch(const CommandLine& given) {
  if (given.has("topic")) throw UsageError("--topic works with one recording: give IN OUT");
  for (const char* name : {"from", "to", "to-form"})
    if (given.has(name))
      throw UsageError("--" + std::string(name) +
                       " doesn't go with -o; the ending of the template chooses the form");
  const BatchTemplate names = batchTemplateOf(given, recordingEndings());
  return runBatchCommand(given, names, convertTaskOf(given, names.ending()));
}

// FOLDER OUTFOLDER --to-form FORM (`ending`: ".FORM"): a batch that keeps the names; of two that
// would get the same one, the second fails.
int convertFolder(const CommandLine& given, const std::string& ending) {
  const fs::path outFolder = given.words()[1];
  std::error_code ignored;
  if (fs::exists(outFolder, ignored) && !fs::is_directory(outFolder, ignored))
    throw FileError(outFolder, "is not a folder");
  return runBatchCommand(given,
                         BatchTemplate(outFolder, "{name}" + ending),
                         convertTaskOf(given, ending),
                         {.paths = {given.words()[0]},
                          .sameResults = SameResults::kSecondFails,
                          .summary = hasBatchOptions(given)});
}

}  // namespace

int convertCommand(const Arguments& words) {
  const CommandLine given(
      {.synopsis = "palpate convert IN OUT [--from N --to M] | FOLDER OUTFOLDER --to-form FORM\n"
                   "       palpate convert PATH... [--each-grasp] -o TEMPLATE",
       .purpose = "Converts a recording. The ending of OUT chooses the format: .dsa, .palpate, "
                  ".csv (with OUT.angles.csv and such files of other series next to it), .npz (for "
                  "NumPy), .h5, .mat, .mcap (docs/manual/files.md) or .jsonl (frames as "
                  "schunk_sdh/TactileSensor). Of a FOLDER it converts every recording below it, "
                  "into OUTFOLDER under the same names with the ending of FORM, and prints a line "
                  "per file. If one fails, the others are still converted: exit code 3.",
       .options = withBatchOptions(withExportOptions(withFilterOptions(withFrameOptions(
           {{"each-grasp", "", "write a file for each grasp, as -o out/{name}_{n}.palpate"},
            worded("to-form", "FORM", "of a folder", formWords()),
            timeOption(),
            topicOption()})))),
       .example = "palpate convert foam_ball.dsa grasp3.palpate --from 700 --to 1400",
       .minArguments = 1},
      words);
  if (given.helpShown()) return kDone;
  if (given.has("each-grasp")) return convertGrasps(given);
  if (given.has("output")) return convertBatch(given);
  if (given.words().size() != 2)
    throw UsageError("convert takes IN OUT, FOLDER OUTFOLDER or PATH.. -o TEMPLATE, not " +
                     counted(given.words().size(), "word"));
  const std::string& in = given.words()[0];
  const std::string& out = given.words()[1];
  const auto ending = given.chosen("to-form", formWords());
  std::error_code ignored;
  const bool isFolder = fs::is_directory(in, ignored);
  if (isFolder && !ending)
    throw UsageError(in + " is a folder: choose the format of the results with --to-form");
  if (!isFolder && ending) throw UsageError("--to-form needs a folder; " + in + " isn't one");
  if (isFolder && (given.has("from") || given.has("to") || given.has("topic")))
    throw UsageError("--from, --to and --topic work with one recording, not with a folder");
  if (isFolder) return convertFolder(given, *ending);
  refuseBatchOptions(given);
  return convertOne(given, in, out);
}

}  // namespace palpate::commands
