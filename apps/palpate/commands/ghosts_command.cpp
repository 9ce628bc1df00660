// The command `palpate ghosts [PATH...]` measures how many false taxels remain after filters, and
// how much the filters remove from true contacts.
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

#include "palpate/core/number_text.h"
#include "palpate/laboratory/ghost_rows.h"
#include "palpate/model/hand_file.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/recording.h"

#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/filter_options.h"
#include "commands/hand_options.h"
#include "commands/recording_list.h"
#include "commands/table_command.h"

namespace palpate::commands {
namespace {

constexpr double kDefaultDegC[] = {30.0, 45.0};
constexpr double kDefaultBelow[] = {0.0, 2.0, 3.0, 5.0};

// Prints rows as they are computed, or one object of JSON at the end.
class GhostOutput {
 public:
  GhostOutput(const CommandLine& given, bool emulated)
      : given_(given), emulated_(emulated), asJson_(formOf(given) == TableForm::kJson) {
    if (!asJson_) out_.emplace(given);
  }
  void add(GhostRow row) {
    if (asJson_)
      list_.push(ghostJson(row, emulated_));
    else
      out_->add(*ghostTable(emulated_, [row = std::move(row)](auto& rows) {
        rows.push_back(row);
        return false;
      }));
  }
  void finish() {
    if (asJson_)
      printJson(given_, Json::object().set("reports", std::move(list_)));
    else
      out_->finish();
  }

 private:
  const CommandLine& given_;
  const bool emulated_, asJson_;
  Json list_ = Json::array();
  std::optional<TableOutput> out_;
};

// Progress of one of several parts of the work.
Progress partOf(const Progress& whole, std::size_t part, std::size_t parts) {
  return [whole, part, parts](double fraction) {
    return !whole || whole((static_cast<double>(part) + fraction) / static_cast<double>(parts));
  };
}

std::vector<double> ghostNumbersOf(const CommandLine& given,
                                   const std::string& option,
                                   OptionRange range,
                                   std::span<const double> defaultValue) {
  std::vector<double> numbers;
  for (const std::string& text : given.texts(option)) {
    const auto number = parseDouble(text);
    if (!number || !range.contains(*number))
      throw UsageError("--" + option + " must be a number from " + numberText(range.minimum) +
                       " to " + numberText(range.maximum) + ", not '" + text + "'");
    numbers.push_back(*number);
  }
  if (numbers.empty()) numbers.assign(defaultValue.begin(), defaultValue.end());
  return numbers;
}

int emulated(const CommandLine& given,
             const std::vector<Recipe>& recipes,
             const GhostingOptions& options,
             NoisyContactsOptions make) {
  const std::vector<double> temperatures = ghostNumbersOf(given, "deg", make.kDegC, kDefaultDegC);
  const std::vector<double> belows =
      ghostNumbersOf(given, "below", make.kBelowCounts, kDefaultBelow);
  GhostOutput rows(given, true);
  ProgressLine line("the emulated hand", given.quiet());
  const std::size_t parts = temperatures.size() * belows.size() * recipes.size();
  std::size_t part = 0;
  for (const double degC : temperatures)
    for (const double below : belows) {
      make.degC = degC;
      make.belowCounts = below;
      const NoisyContacts made = makeNoisyContacts(make);
      const GhostSource source{.degC = degC, .belowCounts = below, .contacts = made.contacts};
      for (const Recipe& recipe : recipes) {
        const auto report = measureGhosting(
            made.profile, recipe, made.truth, options, partOf(line.callback(), part++, parts));
        line.wipe();
        rows.add({recipe, source, report});
      }
    }
  rows.finish();
  return kDone;
}

// Applies thresholds at the noise floor, or `belowCounts` below it, to a recording with threshold
// 0. The temperature of a matrix is that of the motor next to it.
Profile lookedAtOver(double belowCounts,
                     const Profile& profile,
                     const std::filesystem::path& file) {
  const HandDescription& hand = profile.hand();
  const SensorLayout& layout = profile.layout();
  if (!hand.file || !hand.file->characteristics || profile.numTemperatures() == 0 ||
      std::any_of(hand.matrices.begin(), hand.matrices.end(), [&](const MatrixDescription& matrix) {
        return matrix.temperatureSensor.value_or(SIZE_MAX) >= profile.temperatures(0).values.size();
      }))
    throw FileError(file,
                    "--below needs the characteristics of the hand's taxels and the temperatures "
                    "next to its matrices");
  const std::vector<MatrixCharacteristics>& matrices = hand.file->characteristics->matrices;
  ProfileBuilder builder(profile.hand());
  TactileFrame frame;
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    profile.readFrame(i, frame);
    const Sample temperatures = *profile.temperaturesAtFrame(i);
    for (std::size_t m = 0; m < matrices.size(); ++m) {
      const auto threshold = static_cast<float>(
          noiseThresholdCounts(matrices[m],
                               temperatures.values[*hand.matrices[m].temperatureSensor],
                               NoisyContactsOptions{}.noiseMultiple,
                               belowCounts));
      const std::size_t from = layout.offset(m);
      for (std::size_t place = from; place < from + layout.matrix(m).numCells(); ++place)
        frame.values[place] = std::max(0.0F, frame.values[place] - threshold);
    }
    builder.addFrame(frame.hostUs, frame.values, frame.deviceUs);
  }
  return builder.finish(profile.info());
}

int recorded(const CommandLine& given,
             const std::vector<Recipe>& recipes,
             const GhostingOptions& options) {
  for (const char* option : {"deg", "seed", "frames"})
    if (given.has(option))
      throw UsageError(std::string("--") + option +
                       " works with the emulated hand only: leave out PATH");
  std::vector<std::optional<double>> belows;
  for (const double below : ghostNumbersOf(given, "below", NoisyContactsOptions::kBelowCounts, {}))
    belows.emplace_back(below);
  if (belows.empty()) belows.emplace_back();
  GhostOutput rows(given, false);
  const auto work =
      [&](const std::filesystem::path& file, const Recording& recording, const Progress& progress) {
        const Profile& profile = recording.profile;
        requireWithinFullScale("above", options.activeAboveCounts, profile.hand());
        recording.requireEvents();
        GhostingOptions ofFile = options;
        ofFile.restartsUs = settingsTimesUs(recording.events);
        std::size_t part = 0;
        for (const std::optional<double>& below : belows) {
          const Profile seen = below ? lookedAtOver(*below, profile, file) : profile;
          const GhostSource source{.file = file.string(), .belowCounts = below};
          for (const Recipe& recipe : recipes) {
            const Progress ofThis = partOf(progress, part++, belows.size() * recipes.size());
            try {
              rows.add({recipe, source, measureGhosting(seen, recipe, {}, ofFile, ofThis)});
            } catch (const std::invalid_argument& error) {
              throw Error(file.string() + ": " + error.what());
            }
          }
        }
      };
  const int code = forEachOpened(recordingsIn(given.words()), given.quiet(), work);
  if (code != kFailed) rows.finish();
  return code;
}

}  // namespace

int ghostsCommand(const Arguments& words) {
  GhostingOptions options;
  NoisyContactsOptions make;
  const CommandLine given(
      {.synopsis = "palpate ghosts [PATH...] [--filter SPEC]... [--recipe R.json] [--json]",
       .purpose =
           "Measures how well filters remove ghosts: taxels that are active (value > 0) while "
           "nothing touches them. Prints a CSV row for each filter that might help and for each "
           "preset; with --filter or --recipe for these filters alone.\n\nOf recordings: nothing "
           "may touch the hand in them; make sure of that (it is so in recordings of the noise "
           "floor). With --below, PATH must be recordings at threshold 0: it counts what would "
           "remain with thresholds that many counts below the noise floor. Without PATH it uses an "
           "emulated hand with the noise of the real one at sensitivity 1, and thresholds at the "
           "noise floor (docs/notes/ghosting.md) and below it. Contacts of five sizes begin, hold "
           "and "
           "end there, and it is known which taxels the same sensor would report without "
           "noise.\n\nThe columns: false: active taxels that nothing touches; scattered: the false "
           "ones, without matrices of which more than a quarter of the taxels are active at once; "
           "frames_false: fraction of frames with at least one; whole_matrix: fraction of "
           "matrices, over all frames, with more than a quarter active; touched_removed: fraction "
           "of the truly touched active taxels that the filters remove, also by size of the "
           "contact; delay: frames from the first active taxel of a contact without filter to the "
           "first one with it; latency_frames: of the filters themselves; cost_us: mean time of "
           "the filters per frame.",
       .options = withOneTableOptions(
           withFilterOptions(
               {{"deg",
                 "DEGC",
                 "temperature of the emulated hand, default 30 and 45; may be repeated"},
                {"below",
                 "COUNTS",
                 "set thresholds this far below the noise floor, emulated 0, 2, 3 and 5; may be "
                 "repeated"},
                bound("frames", "N", "emulated: frames", make.frames, make.kFrames),
                bound("seed",
                      "N",
                      "emulated: seed of noise and contacts",
                      make.seed,
                      {0, kFrameOption.maximum}),
                bound("above",
                      "COUNTS",
                      "count filtered values above it as active",
                      options.activeAboveCounts,
                      options.kActiveAboveCounts)}),
           "full reports, per matrix and per contact, as one object"),
       .example = "palpate ghosts --below 5 --filter min-median:window=3,masked=1"},
      words);
  if (given.helpShown()) return kDone;
  const Recipe own = recipeOf(given);
  const std::vector<Recipe> recipes =
      given.has("filter") || given.has("recipe") ? std::vector{own} : ghostCandidates();
  return given.words().empty() ? emulated(given, recipes, options, make)
                               : recorded(given, recipes, options);
}

}  // namespace palpate::commands
