#include "gui/window_state/recipe_editor.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace palpate::gui {
namespace {

bool sound(const FilterStep& step) {
  try {
    step.validate();
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

// Brings options that depend on each other into range of the option that was chosen.
void reconcile(FilterStep& step, const std::string& chosen) {
  const FilterKind& kind = step.kind();
  if (kind.option("window") != nullptr && step.valueOrZero("centred") != 0.0 &&
      step.integer("window") % 2 == 0)
    step.explicitOptions["window"] = step.integer("window") + 1;
  if (step.name == "baseline" && (chosen == "from" || chosen == "to")) {
    step.rest.reset();  // it is taken of that span
    if (step.value("from") >= step.value("to")) {
      const double to = std::max(chosen == "to" ? step.value("to") : step.value("from") + 1.0, 1.0);
      step.explicitOptions["to"] = std::min(to, kind.option("to")->maximum);
      step.explicitOptions["from"] = std::min(step.value("from"), step.value("to") - 1.0);
    }
  }
  // The chosen option stays; the other one changes until the step is valid.
  if (step.name == "median3d") {
    const char* other = chosen == "size" ? "window" : "size";
    while (step.integer(other) > 1 && !sound(step))
      step.explicitOptions[other] = step.integer(other) - 2;
  }
  if (kind.option("low") != nullptr && step.value("low") >= step.value("high")) {
    // An octave between the edges; at the end of the range, the chosen edge gives way.
    const double lowest = kind.option("low")->minimum, highest = kind.option("high")->maximum;
    const double low = std::clamp(
        chosen == "low" ? step.value("low") : step.value("high") / 2.0, lowest, highest / 2.0);
    step.explicitOptions["low"] = low;
    step.explicitOptions["high"] =
        std::max(chosen == "low" ? 2.0 * low : step.value("high"), 2.0 * low);
  }
  if (kind.option("order") == nullptr || kind.option("window") == nullptr) return;
  if (step.integer("order") >= step.integer("window")) {
    if (chosen == "order")
      step.explicitOptions["window"] = step.integer("order") / 2 * 2 + 3;
    else
      step.explicitOptions["order"] = step.integer("window") - 1;
  }
  if (step.integer("derivative") > step.integer("order")) {
    if (chosen == "derivative") {
      step.explicitOptions["order"] = step.integer("derivative");
      reconcile(step, "order");
    } else {
      step.explicitOptions["derivative"] = step.integer("order");
    }
  }
}

void dropDefaults(FilterStep& step) {
  for (const FilterOption& option : step.kind().options) {
    const auto at = step.explicitOptions.find(option.key);
    if (at == step.explicitOptions.end()) continue;
    if (at->second == option.defaultValue || (std::isnan(at->second) && option.automatic()))
      step.explicitOptions.erase(at);
  }
}

}  // namespace

void RecipeEditor::put(Recipe recipe, const std::string& what) {
  recipe.validate();
  if (recipe == recipe_) return;
  if (what.empty() || what != lastWhat_ || past_.empty()) past_.push_back(recipe_);
  if (past_.size() > kMaxUndoSteps) past_.erase(past_.begin());
  future_.clear();
  lastWhat_ = what;
  recipe_ = std::move(recipe);
  emit changed();
}

void RecipeEditor::setRecipe(const Recipe& recipe) { put(recipe); }

void RecipeEditor::restore(const Recipe& recipe) {
  recipe.validate();
  past_.clear();
  future_.clear();
  lastWhat_.clear();
  recipe_ = recipe;
  emit changed();
}

void RecipeEditor::insert(std::size_t index, const FilterStep& step) {
  if (index > recipe_.steps.size()) throw std::out_of_range("RecipeEditor: no such place");
  Recipe changed = recipe_;
  changed.steps.insert(changed.steps.begin() + static_cast<std::ptrdiff_t>(index), step);
  put(std::move(changed));
}

void RecipeEditor::remove(std::size_t index) {
  Recipe changed = recipe_;
  static_cast<void>(changed.steps.at(index));
  changed.steps.erase(changed.steps.begin() + static_cast<std::ptrdiff_t>(index));
  put(std::move(changed));
}

void RecipeEditor::move(std::size_t from, std::size_t to) {
  Recipe changed = recipe_;
  const FilterStep step = changed.steps.at(from);
  static_cast<void>(changed.steps.at(to));
  changed.steps.erase(changed.steps.begin() + static_cast<std::ptrdiff_t>(from));
  changed.steps.insert(changed.steps.begin() + static_cast<std::ptrdiff_t>(to), step);
  put(std::move(changed));
}

void RecipeEditor::setEnabled(std::size_t index, bool enabled) {
  Recipe changed = recipe_;
  changed.steps.at(index).enabled = enabled;
  put(std::move(changed));
}

void RecipeEditor::setOption(std::size_t index, const std::string& key, double value) {
  Recipe changed = recipe_;
  FilterStep& step = changed.steps.at(index);
  step.explicitOptions[key] = value;
  reconcile(step, key);
  dropDefaults(step);
  put(std::move(changed), key + "@" + std::to_string(index));
}

void RecipeEditor::setMatrices(std::size_t index, const std::vector<std::size_t>& matrices) {
  Recipe changed = recipe_;
  changed.steps.at(index).matrices = matrices;
  put(std::move(changed));
}

void RecipeEditor::undo() {
  if (past_.empty()) return;
  future_.push_back(std::move(recipe_));
  recipe_ = std::move(past_.back());
  past_.pop_back();
  lastWhat_.clear();
  emit changed();
}

void RecipeEditor::redo() {
  if (future_.empty()) return;
  past_.push_back(std::move(recipe_));
  recipe_ = std::move(future_.back());
  future_.pop_back();
  lastWhat_.clear();
  emit changed();
}

}  // namespace palpate::gui
