// The list of a recipe's steps in the dock Filter: a tick switches a step on, dragging changes the
// order.
#pragma once

#include <QTreeWidget>
#include <optional>

#include "gui/source/filter_worker.h"

namespace palpate::gui {

class FilterList : public QTreeWidget {
  Q_OBJECT
 public:
  explicit FilterList(QWidget* parent);
  // `live`: steps that need later frames are marked as left out.
  void showRecipe(const Recipe& recipe, bool live);
  // Shows measured cost and delay; nothing when they are not measured yet.
  void showFigures(const std::optional<FilterFigures>& figures);
  // The chosen step; nothing when none is chosen.
  std::optional<std::size_t> chosen() const;
  void choose(std::optional<std::size_t> index);

 signals:
  void stepChosen();
  void enabledChanged(std::size_t index, bool enabled);
  void moved(std::size_t from, std::size_t to);
  void removeRequested(std::size_t index);

 protected:
  void dropEvent(QDropEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void paintEvent(QPaintEvent* event) override;

 private:
  bool filling_ = false;
};

}  // namespace palpate::gui
