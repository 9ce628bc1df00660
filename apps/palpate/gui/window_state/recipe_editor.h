// Holds the recipe of filters that the user edits, with undo and redo of every change.
#pragma once

#include <QObject>
#include <vector>

#include <palpate/filter/recipe.h>

namespace palpate::gui {

class RecipeEditor : public QObject {
  Q_OBJECT
 public:
  explicit RecipeEditor(QObject* parent = nullptr) : QObject(parent) {}

  const Recipe& recipe() const noexcept { return recipe_; }
  // Replaces the whole recipe, by a preset or a file. Throws std::invalid_argument and then changes
  // nothing.
  void setRecipe(const Recipe& recipe);
  // As setRecipe(), but can't be undone; used at the start of the program.
  void restore(const Recipe& recipe);

  // Inserts the step before the one at `index`. This and the functions below throw
  // std::out_of_range for a step that doesn't exist.
  void insert(std::size_t index, const FilterStep& step);
  void remove(std::size_t index);
  // Moves a step; its index is `to` afterwards.
  void move(std::size_t from, std::size_t to);
  void setEnabled(std::size_t index, bool enabled);
  // Successive values of the same option (a slider being dragged) count as one change. NaN:
  // automatic. Where the value doesn't fit the other options (a window shorter than its order
  // needs), the others are moved into range.
  void setOption(std::size_t index, const std::string& key, double value);
  void setMatrices(std::size_t index, const std::vector<std::size_t>& matrices);

  bool canUndo() const noexcept { return !past_.empty(); }
  bool canRedo() const noexcept { return !future_.empty(); }
  void undo();
  void redo();

 signals:
  void changed();

 private:
  void put(Recipe recipe, const std::string& what = {});

  static constexpr std::size_t kMaxUndoSteps = 200;
  Recipe recipe_;
  std::vector<Recipe> past_;
  std::vector<Recipe> future_;
  // The option of the last change, so that further values of it join that change; empty: a change
  // of its own.
  std::string lastWhat_;
};

}  // namespace palpate::gui
