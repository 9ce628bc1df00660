#include "gui/bench/recipe_editor.h"

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

// The options that depend on each other, brought into range of the one that was chosen.
void reconcile(FilterStep& step, const std::string& chosen) {
  const FilterKind& kind = step.kind();
  if (kind.option("window") != nullptr && step.valueOr0("centred") != 0.0 &&
      step.integer("window") % 2 == 0)
    step.given["window"] = step.integer("window") + 1;
  // What was chosen stays; the other one gives way until the step is sound.
  if (step.name == "median3d") {
    const char* other = chosen == "size" ? "window" : "size";
    while (step.integer(other) > 1 && !sound(step)) step.given[other] = step.integer(other) - 2;
  }
  if (kind.option("order") == nullptr) return;
  if (step.integer("order") >= step.integer("window")) {
    if (chosen == "order")
      step.given["window"] = step.integer("order") / 2 * 2 + 3;
    else
      step.given["order"] = step.integer("window") - 1;
  }
  if (step.integer("derivative") > step.integer("order")) {
    if (chosen == "derivative") {
      step.given["order"] = step.integer("derivative");
      reconcile(step, "order");
    } else {
      step.given["derivative"] = step.integer("order");
    }
  }
}

void dropDefaults(FilterStep& step) {
  for (const FilterOption& option : step.kind().options) {
    const auto at = step.given.find(option.key);
    if (at == step.given.end()) continue;
    if (at->second == option.fallback || (std::isnan(at->second) && option.automatic()))
      step.given.erase(at);
  }
}

}  // namespace

void RecipeEditor::put(Recipe recipe, const std::string& what) {
  recipe.validate();
  if (recipe == recipe_) return;
  if (what.empty() || what != lastWhat_ || past_.empty()) past_.push_back(recipe_);
  if (past_.size() > kMostPast) past_.erase(past_.begin());
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
  changed.steps.at(index);
  changed.steps.erase(changed.steps.begin() + static_cast<std::ptrdiff_t>(index));
  put(std::move(changed));
}

void RecipeEditor::move(std::size_t from, std::size_t to) {
  Recipe changed = recipe_;
  const FilterStep step = changed.steps.at(from);
  changed.steps.at(to);
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
  step.given[key] = value;
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
