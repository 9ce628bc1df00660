#include "commands/filter_options.h"

#include <stdexcept>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"

#include "commands/commands.h"

namespace palpate::commands {
namespace {

std::string filterOptionsRangeOf(const FilterOption& option) {
  if (option.kind == FilterOption::Kind::kFlag) return "0|1";
  if (option.kind == FilterOption::Kind::kChoice) {
    std::string text;
    for (const std::string& choice : option.choices) text += (text.empty() ? "" : "|") + choice;
    return text;
  }
  return (option.kind == FilterOption::Kind::kOdd ? "odd " : "") + numberText(option.minimum) +
         ".." + numberText(option.maximum) + (option.unit.empty() ? "" : " " + option.unit);
}

std::string fallbackOf(const FilterOption& option) {
  if (option.automatic()) return "auto";
  if (option.kind == FilterOption::Kind::kChoice)
    return option.choices.at(static_cast<std::size_t>(option.defaultValue));
  return numberText(option.defaultValue);
}

std::string padded(std::string text, std::size_t width) {
  if (text.size() < width) text.resize(width, ' ');
  return text;
}

const char* domainText(FilterDomain domain) {
  switch (domain) {
    case FilterDomain::kSpatial:
      return "space";
    case FilterDomain::kTemporal:
      return "time";
    case FilterDomain::kSpatioTemporal:
      break;
  }
  return "space and time";
}

}  // namespace

std::vector<OptionSpec> filterOptions() {
  return {{"filter", "SPEC", "filter first, as median:size=3; may be repeated"},
          {"recipe", "R.json", "filter first by a recipe, before every --filter"}};
}

std::vector<OptionSpec> withFilterOptions(std::vector<OptionSpec> options) {
  for (OptionSpec& option : filterOptions()) options.push_back(std::move(option));
  return options;
}

OptionSpec timeOption() {
  return worded("time",
                "WHICH",
                "times of frames and series; fitted: the sender's clock, fitted to arrival "
                "(docs/manual/spectra.md)",
                kTimeChoiceWords,
                "arrival");
}

TimeChoice timeChoiceOf(const CommandLine& given) {
  return given.chosen("time", kTimeChoiceWords).value_or(TimeChoice::kArrival);
}

void takeTimes(const CommandLine& given,
               Recording& recording,
               const std::filesystem::path& file,
               const Progress& progress) {
  if (timeChoiceOf(given) == TimeChoice::kArrival) return;
  const std::string text = takeFittedTimes(recording, file, progress);
  if (!given.quiet()) sayLine(file.string() + ": " + text);
}

std::vector<OptionSpec> withFrameOptions(std::vector<OptionSpec> options) {
  options.push_back(rangedWhole("from", "N", "first frame", kFrameOption, "0"));
  options.push_back(rangedWhole("to", "M", "last frame (inclusive)", kFrameOption, "the last one"));
  return options;
}

FrameChoice frameChoiceOf(const CommandLine& given) {
  const FrameChoice choice{given.integer("from", kFrameOption), given.integer("to", kFrameOption)};
  if (choice.from && choice.to && *choice.from > *choice.to)
    throw UsageError("--from is after --to");
  return choice;
}

std::pair<std::size_t, std::size_t> framesOf(const FrameChoice& choice,
                                             const std::filesystem::path& file,
                                             const Profile& profile) {
  const auto last = static_cast<std::int64_t>(profile.numFrames()) - 1;
  const std::int64_t from = choice.from.value_or(0), to = choice.to.value_or(last);
  if (last < 0 && !choice.from && !choice.to) return {1, 0};
  if (from > last || to > last)
    throw Error(file.string() + ": has no frame " + std::to_string(from > last ? from : to) +
                (last < 0 ? ", it is empty" : ", only 0.." + std::to_string(last)));
  return {static_cast<std::size_t>(from), static_cast<std::size_t>(to)};
}

Recipe recipeOf(const CommandLine& given) {
  Recipe recipe;
  if (const auto file = given.text("recipe")) recipe = readRecipe(*file);
  try {
    const Recipe more = parseRecipe(given.texts("filter"));
    recipe.steps.insert(recipe.steps.end(), more.steps.begin(), more.steps.end());
    recipe.validate();
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--filter ") + error.what());
  }
  return recipe;
}

std::vector<std::pair<std::string, SignalKind>> signalWords() {
  return wordsOf(kAllSignalKinds, signalName);
}

std::optional<SignalKind> signalChosen(const CommandLine& given) {
  return given.chosen("signal", signalWords());
}

std::string filterList() {
  std::string text;
  for (const FilterKind& kind : filterKinds()) {
    text += padded(kind.name, 18) + kind.purpose + "\n";
    text += padded("", 18) + "Over " + domainText(kind.domain) + ". Border: " + kind.border +
            ". Source: " + kind.source + ".\n";
    for (const FilterOption& option : kind.options)
      text += "    " + padded(option.key, 14) + padded(filterOptionsRangeOf(option), 27) +
              " default " + padded(fallbackOf(option), 8) + option.purpose + "\n";
  }
  text += "Every filter takes matrices=A+B.. (only these). A filter in round brackets is off.\n";
  return text;
}

}  // namespace palpate::commands
