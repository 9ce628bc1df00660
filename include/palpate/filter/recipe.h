// A recipe is a chain of filters that gives the same results live, on recordings and on the command
// line. As text its steps are joined by " | "; as a file it is JSON:
//   {"format": "palpate-recipe", "version": 1, "name": "..", "made_by": "palpate 0.1",
//    "steps": [{"filter": "median", "size": 3, "masked": true, "matrices": [1, 3],
//               "enabled": true}, ..]}
// A step "baseline" may have lists "rest" and "noise".
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/core/json.h>
#include <palpate/filter/filter_step.h>

namespace palpate {

// A named chain of filters.
struct Recipe {
  static constexpr std::size_t kMaxSteps = 64;
  // Title in the window; may be empty.
  std::string name{};
  std::vector<FilterStep> steps{};

  // Throws std::invalid_argument that names the wrong step (counted from 1), or too many steps.
  void validate() const;
  // Throws std::invalid_argument that names the wrong step when an enabled step has a frequency at
  // or above half of the rate of the frames [Hz]; 0 is an unknown rate.
  void validateForRate(double rateHz) const;
  // Returns whether an enabled step has a frequency, so that it depends on the rate.
  bool dependsOnRate() const;
  // Returns whether no step is enabled.
  bool empty() const noexcept;
  // Returns whether all enabled steps are causal, so that the recipe can run live.
  bool causal() const;
  // Compares the steps but not the names.
  bool sameSteps(const Recipe& other) const { return steps == other.steps; }
  bool operator==(const Recipe&) const = default;
};

// Returns the text of a recipe, "median:size=3 | kalman"; disabled steps are in round brackets:
// "median | (kalman)".
std::string recipeText(const Recipe& recipe);
// Returns the text with the value of every option, as fullFilterText(): for what was done to a
// recording.
std::string fullRecipeText(const Recipe& recipe);
// Returns the text of a recipe as shownFilterText(): for people.
std::string shownRecipeText(const Recipe& recipe);
// Parses one text, such as "median:size=3|kalman", or several, whose steps follow one another.
// Throws std::invalid_argument.
Recipe parseRecipe(std::span<const std::string> texts);

Json recipeJson(const Recipe& recipe);
// Throws Error that names the wrong step and key, and lists the known keys and names.
Recipe recipeFromJson(const Json& json);

// Throws FileError (missing or unreadable), FormatError (larger than a megabyte, or no recipe) or
// Error, each with the path.
Recipe readRecipe(const std::filesystem::path& path);
// Writes a recipe; a failure leaves no partial file. Throws FileError.
void writeRecipe(const std::filesystem::path& path, const Recipe& recipe, bool overwrite);

// Ready-made recipes that the window offers; those for high sensitivity come first.
std::span<const Recipe> recipePresets();
// The recipe that cleans the frames of a hand at high sensitivity; chosen from the table in
// docs/notes/ghosting.md.
const Recipe& highSensitivityRecipe();

}  // namespace palpate
