// The recipe that a person edits, with every change undone and redone.
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
  // The whole of it: a preset, a file. Throws std::invalid_argument; then nothing changes.
  void setRecipe(const Recipe& recipe);
  // As setRecipe(), and nothing can be undone: at the start.
  void restore(const Recipe& recipe);

  // Behind `index` - 1. All throw std::out_of_range for a step that isn't there.
  void insert(std::size_t index, const FilterStep& step);
  void remove(std::size_t index);
  // The step stands at `to` afterwards.
  void move(std::size_t from, std::size_t to);
  void setEnabled(std::size_t index, bool enabled);
  // One value after the other of the same option (a slider on its way) is one change. NaN:
  // automatic. Takes what doesn't fit together (a window below its order) by moving the other
  // options into range.
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
  std::string lastWhat_;  // what the last change was of; empty: nothing that goes on
};

}  // namespace palpate::gui
