// The widget for a confusion matrix: rows are true classes, columns are predicted ones. A cell is
// chosen by mouse or arrow keys; the row and column under the pointer are highlighted. Cells are
// large enough for legible names; if they don't fit, the view scrolls while the names stay visible.
// Ctrl with the wheel, + and - zoom; 0 shows everything.
#pragma once

#include <QAbstractScrollArea>
#include <optional>

#include <palpate/recognition/classification_report.h>

#include "gui/appearance/theme.h"
#include "gui/recognise/confusion_painter.h"

namespace palpate::gui {

class ConfusionView : public QAbstractScrollArea {
  Q_OBJECT
 public:
  using Cell = ConfusionCell;

  explicit ConfusionView(QWidget* parent = nullptr);
  void setMatrix(std::optional<ConfusionMatrix> matrix);
  const std::optional<ConfusionMatrix>& matrix() const noexcept { return matrix_; }
  void choose(std::optional<Cell> cell);
  const std::optional<Cell>& chosen() const noexcept { return chosen_; }
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
  void cellChosen(int truth, int called);
  // By mouse; follows cellChosen().
  void cellClicked(int truth, int called);
  // Double click or Return: the user wants to see the grasps of the cell.
  void cellOpened(int truth, int called);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  bool event(QEvent* event) override;
  bool viewportEvent(QEvent* event) override;
  void scrollContentsBy(int dx, int dy) override;

 private:
  ConfusionGrid gridInSight() const;
  // "cup called bottle: 3"
  QString textOf(const Cell& cell) const;
  std::optional<Cell> cellAt(const QPointF& at) const;
  // Updates the scroll bars.
  void layOut();
  void reveal(const Cell& cell);
  void moveChosen(int columns, int rows);

  std::optional<ConfusionMatrix> matrix_;
  std::optional<Cell> chosen_, hovered_;
  std::optional<double> side_;
};

}  // namespace palpate::gui
