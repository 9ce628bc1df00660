// A recipe: a chain of filters that runs the same live, on recordings and on the command line. As
// text its steps are joined by " | "; as a file it is JSON:
//   {"format": "palpate-recipe", "version": 1, "name": "..", "made_by": "palpate 0.1",
//    "steps": [{"filter": "median", "size": 3, "masked": true, "matrices": [1, 3],
//               "enabled": true}, ..]}
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/core/json.h>
#include <palpate/filter/filter_step.h>

namespace palpate {

struct Recipe {
  static constexpr std::size_t kMaxSteps = 64;
  std::string name{};  // for people; may be empty
  std::vector<FilterStep> steps{};

  // Throws std::invalid_argument naming the step (from 1) that is wrong, or too many steps.
  void validate() const;
  // No step that does something.
  bool empty() const noexcept;
  // Runs live.
  bool causal() const;
  // The steps, whatever it is called.
  bool sameSteps(const Recipe& other) const { return steps == other.steps; }
  bool operator==(const Recipe&) const = default;
};

// "median:size=3 | kalman"; steps that are off in round brackets: "median | (kalman)".
std::string recipeText(const Recipe& recipe);
// Of "median:size=3|kalman" or of several such texts one after the other. Throws
// std::invalid_argument.
Recipe parseRecipe(std::span<const std::string> texts);

Json recipeJson(const Recipe& recipe);
// Throws Error saying which step and key is wrong: unknown keys and names list the known ones.
Recipe recipeFromJson(const Json& json);

// Throws FileError (gone, unreadable), FormatError (larger than a megabyte, no recipe) or Error,
// with the path.
Recipe readRecipe(const std::filesystem::path& path);
// The file appears whole or not at all. Throws FileError.
void writeRecipe(const std::filesystem::path& path, const Recipe& recipe, bool overwrite);

// What is offered ready-made; first what is for high sensitivity.
std::span<const Recipe> recipePresets();
// What cleans the frames of a hand at high sensitivity: chosen from the table in docs/ghosting.md.
const Recipe& highSensitivityRecipe();

}  // namespace palpate
