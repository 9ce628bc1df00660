#include "palpate/filter/recipe.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"

namespace palpate {
namespace {

using RecipeKind = FilterOption::Kind;

constexpr const char* kFormat = "palpate-recipe";
constexpr std::int64_t kVersion = 1;
constexpr std::string_view kNoOptions[] = {"filter", "enabled", "matrices"};

Json optionJson(const FilterOption& option, double value) {
  if (option.kind == RecipeKind::kFlag) return Json(value != 0.0);
  if (option.kind == RecipeKind::kChoice)
    return Json(option.choices.at(static_cast<std::size_t>(value)));
  if (option.kind != RecipeKind::kReal) return Json(static_cast<std::int64_t>(value));
  return Json(value);
}

Json stepJson(const FilterStep& step) {
  Json json = Json::object();
  json.set("filter", step.name);
  for (const FilterOption& option : step.kind().options) {
    const double value = step.value(option.key);
    if (step.uses(option) && !std::isnan(value)) json.set(option.key, optionJson(option, value));
  }
  if (!step.matrices.empty()) json.set("matrices", jsonList(step.matrices));
  if (step.rest) {
    const auto number = [](float value) { return Json(parseDouble(numberText(value)).value()); };
    json.set("rest", jsonList(step.rest->rest, number));
    if (!step.rest->noise.empty()) json.set("noise", jsonList(step.rest->noise, number));
  }
  json.set("enabled", step.enabled);
  return json;
}

// Returns a JSON value as the text that parseFilterStep() reads.
std::string valueText(const Json& value) {
  if (value.isBool()) return value.asBool() ? "1" : "0";
  if (value.isString()) return value.asString();
  if (value.isNumber()) return numberText(value.asDouble());
  if (value.isNull()) return "auto";
  if (value.isArray()) {  // of a rest
    std::string text;
    for (std::size_t i = 0; i < value.size(); ++i)
      text += (i > 0 ? "/" : "") + numberText(value.at(i).asDouble());
    return text;
  }
  throw std::invalid_argument("a value must be a number, a text, true or false");
}

FilterStep stepFromJson(const Json& json) {
  if (json.isString()) return parseFilterStep(json.asString());
  if (!json.isObject() || !json.contains("filter"))
    throw std::invalid_argument("a step must have \"filter\": one of " + filterNames());
  std::string text = json.at("filter").asString();
  filterKind(text);
  char before = ':';
  for (const std::string& key : json.keys()) {
    if (std::find(std::begin(kNoOptions), std::end(kNoOptions), key) != std::end(kNoOptions))
      continue;
    const std::string value = valueText(json.at(key));
    if (key.find_first_of(",=") != std::string::npos || value.find(',') != std::string::npos)
      throw std::invalid_argument("\"" + shortened(key) + "\": a comma or = isn't allowed there");
    text += before + key + '=' + value;
    before = ',';
  }
  if (json.contains("matrices")) {
    const Json list = json.at("matrices");
    if (!list.isArray()) throw std::invalid_argument("\"matrices\" must be a list of numbers");
    for (std::size_t i = 0; i < list.size(); ++i)
      text += (i == 0 ? before + std::string("matrices=") : "+") +
              std::to_string(list.at(i).asInteger());
  }
  FilterStep step = parseFilterStep(text);
  if (json.contains("enabled")) step.enabled = json.at("enabled").asBool();
  return step;
}

Recipe preset(const char* name, std::initializer_list<const char*> texts) {
  Recipe recipe{.name = name};
  for (const char* text : texts) recipe.steps.push_back(parseFilterStep(text));
  return recipe;
}

std::string stepNumber(std::size_t index) { return "step " + std::to_string(index + 1) + ": "; }

}  // namespace

void Recipe::validate() const {
  if (steps.size() > kMaxSteps)
    throw std::invalid_argument("a recipe of " + std::to_string(steps.size()) + " steps: at most " +
                                std::to_string(kMaxSteps));
  for (std::size_t i = 0; i < steps.size(); ++i) {
    try {
      steps[i].validate();
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(stepNumber(i) + error.what());
    }
  }
}

void Recipe::validateForRate(double rateHz) const {
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (!steps[i].enabled) continue;
    try {
      steps[i].validateForRate(rateHz);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(stepNumber(i) + error.what());
    }
  }
}

bool Recipe::dependsOnRate() const {
  return std::any_of(steps.begin(), steps.end(), [](const FilterStep& step) {
    return step.enabled && butterworthOf(step);
  });
}

bool Recipe::empty() const noexcept {
  return std::none_of(
      steps.begin(), steps.end(), [](const FilterStep& step) { return step.enabled; });
}

bool Recipe::causal() const {
  return std::all_of(steps.begin(), steps.end(), [](const FilterStep& step) {
    return !step.enabled || step.causal();
  });
}

namespace {
std::string joinedSteps(const Recipe& recipe, std::string (*textOf)(const FilterStep&)) {
  std::string text;
  for (const FilterStep& step : recipe.steps) {
    if (!text.empty()) text += " | ";
    text += step.enabled ? textOf(step) : "(" + textOf(step) + ")";
  }
  return text;
}
}  // namespace

std::string recipeText(const Recipe& recipe) { return joinedSteps(recipe, filterText); }

std::string fullRecipeText(const Recipe& recipe) { return joinedSteps(recipe, fullFilterText); }

std::string shownRecipeText(const Recipe& recipe) { return joinedSteps(recipe, shownFilterText); }

Recipe parseRecipe(std::span<const std::string> texts) {
  Recipe recipe;
  for (std::string_view text : texts) {
    for (;;) {
      const auto end = text.find('|');
      std::string_view part = trimmed(text.substr(0, end));
      const bool off = part.size() >= 2 && part.front() == '(' && part.back() == ')';
      if (off) part = part.substr(1, part.size() - 2);
      recipe.steps.push_back(parseFilterStep(part));
      recipe.steps.back().enabled = !off;
      if (end == std::string_view::npos) break;
      text.remove_prefix(end + 1);
    }
  }
  recipe.validate();
  return recipe;
}

Json recipeJson(const Recipe& recipe) {
  Json steps = jsonList(recipe.steps, [](const FilterStep& step) { return stepJson(step); });
  return Json::object()
      .set("format", kFormat)
      .set("version", kVersion)
      .set("made_by", "palpate " PALPATE_VERSION)
      .set("name", recipe.name)
      .set("steps", std::move(steps));
}

Recipe recipeFromJson(const Json& json) {
  if (!json.isObject() || json.at("format").isNull() || !json.at("format").isString() ||
      json.at("format").asString() != kFormat)
    throw Error(std::string("isn't a recipe of filters: \"format\" is not \"") + kFormat + "\"");
  if (!json.at("version").isNumber() || json.at("version").asInteger() != kVersion)
    throw Error("is a recipe with another version than " + std::to_string(kVersion) +
                ": it needs another palpate");
  const Json steps = json.at("steps");
  if (!steps.isArray()) throw Error("has no list \"steps\"");
  if (steps.size() > Recipe::kMaxSteps)
    throw Error("has " + std::to_string(steps.size()) + " steps: at most " +
                std::to_string(Recipe::kMaxSteps));
  Recipe recipe;
  if (json.at("name").isString()) recipe.name = json.at("name").asString();
  for (std::size_t i = 0; i < steps.size(); ++i) {
    try {
      recipe.steps.push_back(stepFromJson(steps.at(i)));
    } catch (const std::exception& error) {
      throw Error(stepNumber(i) + error.what());
    }
  }
  return recipe;
}

std::span<const Recipe> recipePresets() {
  static const std::array kPresets = {
      preset("High sensitivity", {"min-median:window=2,size=1,masked=1"}),
      preset("Thresholds too low",
             {"min-median:window=2,size=1,masked=1", "opening:shape=cross,masked=1"}),
      preset("Ghosts, the study's choice", {"median3d:size=3,window=3,masked=1"}),
      preset("Lone taxels", {"median:size=3,masked=1"}),
      preset("Smooth in space", {"gaussian:size=3"}),
      preset("Smooth in space, edges kept", {"bilateral:diameter=3,sigma_value=50,sigma_space=3"}),
      preset("Smooth in time", {"kalman:q=0.05,r=0.5"}),
      preset("Smooth in space and time", {"gaussian:size=3", "running-mean:window=5"}),
      preset("Slope (counts per frame)",
             {"savitzky-golay:window=5,order=2,derivative=1,centred=1"}),
  };
  return kPresets;
}

const Recipe& highSensitivityRecipe() { return recipePresets().front(); }

}  // namespace palpate
