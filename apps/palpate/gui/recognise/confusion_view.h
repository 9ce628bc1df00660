// The widget for a confusion matrix: rows are true classes, columns are predicted ones. A cell is
// chosen by mouse or arrow keys; the row and column under the pointer are highlighted. Cells are
// large enough for legible names; if they don't fit, the view scrolls while the names stay visible.
// Ctrl with the wheel, + and - zoom; 0 shows everything.
#pragma once

#include <QLabel>
#include <QTableWidget>
#include <optional>

#include <palpate/recognition/classification_report.h>

#include "gui/appearance/theme.h"
#include "gui/recognise/confusion_painter.h"

namespace palpate::gui {

class ConfusionView : public QTableWidget {
  Q_OBJECT
 public:
  using Cell = ConfusionCell;

  explicit ConfusionView(QWidget* parent = nullptr);
  void setMatrix(std::optional<ConfusionMatrix> matrix);
  const std::optional<ConfusionMatrix>& matrix() const noexcept { return matrix_; }
  void choose(std::optional<Cell> cell);
  std::optional<Cell> chosen() const;
  Cell cellOf(const QModelIndex& index) const;
  // The cell whose row and column are highlighted: under the pointer, else the chosen one.
  QModelIndex marked() const;
  // Side of a cell [px]: the zoomed one, else one with legible names. setSide() limits the value;
  // nothing returns to legible names.
  double side() const;
  void setSide(std::optional<double> side);
  // However small the cells become.
  void showAll();
  // The rectangle of a cell in the viewport; empty when it is scrolled out of view.
  QRectF rectOf(const Cell& cell) const;
  QSize sizeHint() const override { return {380, 340}; }
  QSize minimumSizeHint() const override { return {200, 180}; }

 signals:
  // cellClicked() follows, if it was by mouse.
  void cellChosen(int truth, int called);
  // Double click or Return: the user wants to see the grasps of the cell.
  void cellOpened(int truth, int called);

 protected:
  void resizeEvent(QResizeEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  bool viewportEvent(QEvent* event) override;

 private:
  QModelIndex indexOf(const Cell& cell) const;
  QModelIndex chosenIndex() const { return selectionModel()->selectedIndexes().value(0); }
  // The sizes of names and cells.
  void layOut();
  void hover(const QModelIndex& index);

  std::optional<ConfusionMatrix> matrix_;
  QLabel* directions_;
  QModelIndex hovered_;
  std::optional<double> side_;
};

}  // namespace palpate::gui
