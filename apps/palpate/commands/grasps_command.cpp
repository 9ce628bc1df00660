// The command `palpate grasps PATH...` finds the grasps in recordings and prints them as CSV.
#include <algorithm>
#include <cstdint>
#include <filesystem>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/core/text_table.h"
#include "palpate/core/time.h"
#include "palpate/model/hand_file.h"
#include "palpate/recognition/grasp_segments.h"

#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/export_options.h"
#include "commands/filter_options.h"
#include "commands/recording_list.h"

namespace palpate::commands {
namespace {

// Throws when the rule of the study has no matrices: the result "no grasp" would be wrong.
void requirePads(const std::filesystem::path& file,
                 const Profile& profile,
                 const GraspSegmentOptions& options) {
  const HandDescription& hand = profile.hand();
  if (options.rule == GraspRule::kStudy && !(hand.file && hand.file->pinch))
    throw FileError(file,
                    "rule study needs two pads that pinch, which the description of '" + hand.name +
                        "' doesn't name: use --rule general");
}

std::vector<std::string> graspsCellsOf(const Profile& profile, const GraspSegment& grasp) {
  std::string fingers;
  for (const int finger : grasp.fingers)
    fingers += (fingers.empty() ? "" : " ") + std::to_string(finger);
  return {std::to_string(grasp.begin),
          std::to_string(grasp.end),
          std::to_string(profile.frameTimeUs(grasp.begin) / kUsPerMs),
          std::to_string(profile.frameTimeUs(grasp.end) / kUsPerMs),
          fingers,
          numberText(grasp.quality)};
}

}  // namespace

int graspsCommand(const Arguments& words) {
  const CommandLine given(
      {.synopsis = "palpate grasps PATH... [--rule general|study]",
       .purpose =
           "Finds the grasps in recordings and prints one per row as CSV: first and last frame "
           "(both inclusive), their host times [ms since 1970], the fingers, and a quality. PATH "
           "is a recording, or a folder: every recording below it. With several recordings a last "
           "column names the file.\n\nRule general: at least two different fingers (or the only "
           "one) have an active taxel (value > 0) for more than 20 frames and more than 0.6 s; "
           "interruptions of up to 3 frames are ignored. Rule study: the two pads that pinch "
           "(matrices 1 and 5 of an SDH-2) are both active for more than 20 frames without "
           "interruption. A gap of the recording (longer than max(1 s, 5 median intervals)) ends a "
           "grasp. fingers: those that touch in at least half of its frames, with blanks "
           "between.\n\nquality, 0 to 1, is the product of four numbers:\n  the fraction of its "
           "frames in contact by the rule (the others are ignored interruptions)\n  the fraction "
           "of its frames without a saturated taxel\n  1 - min(1, sd / mean) of the sum of all "
           "taxels over the middle half of its frames (1: held steadily)\n  1, 1/2 or 1/4 if both, "
           "one or none of its ends are inside the recording (not at its first or last frame, nor "
           "beside a gap)",
       .options =
           withFilterOptions({{"rule", "RULE", "general (default) or study"}, unitsRowOption()}),
       .example = "palpate grasps recordings --rule general > grasps.csv",
       .minArguments = 1},
      words);
  if (given.helpShown()) return kDone;
  GraspSegmentOptions options;
  if (given.choice("rule", {"general", "study"}) == "study") options.rule = GraspRule::kStudy;
  const Recipe recipe = recipeOf(given);
  const RecordingList list = recordingsIn(given.words());
  std::vector<std::string> header = {"begin", "end", "begin_ms", "end_ms", "fingers", "quality"};
  if (list.several) header.emplace_back("file");
  std::vector<std::string> units = {"", "", "ms", "ms", "", ""};
  units.resize(header.size());
  return writeOpenedTexts(
      list,
      given.quiet(),
      {.begin = csvLine(header) + (given.has("units-row") ? csvLine(units) : "")},
      [&](const std::filesystem::path& file,
          const Recording& whole,
          const TextSink& write,
          const Progress& progress) {
        const Profile profile = filteredBy(recipe, whole, file, progress);
        requirePads(file, profile, options);
        for (const GraspSegment& grasp : findGrasps(profile, options, progress)) {
          std::vector<std::string> cells = graspsCellsOf(profile, grasp);
          if (list.several) cells.push_back(file.string());
          write(csvLine(cells));
        }
      });
}

}  // namespace palpate::commands
