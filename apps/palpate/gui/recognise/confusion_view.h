// A confusion matrix: what it was (rows) against what it was called (columns). A cell can be chosen
// by mouse or arrow keys; the row and the column under the pointer stand out. As large as its names
// need to be read: then it scrolls, names stay; Ctrl and the wheel, + and - zoom, 0 shows all of
// it.
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
  void setTheme(Theme theme);
  void choose(std::optional<Cell> cell);
  const std::optional<Cell>& chosen() const noexcept { return chosen_; }
  // Side of a cell [px]: as set by zooming, else what is readable. Nothing: as large as that.
  // Clamped.
  double side() const;
  void setSide(std::optional<double> side);
  void showAll();  // however small that is
  // Of a cell, in the viewport; empty: scrolled away.
  QRectF rectOf(const Cell& cell) const;
  QSize sizeHint() const override { return {380, 340}; }
  QSize minimumSizeHint() const override { return {200, 180}; }

 signals:
  void cellChosen(int truth, int called);
  void cellClicked(int truth, int called);  // by mouse, after cellChosen()
  void cellOpened(int truth, int called);   // double click, Return: what is behind it shall be seen

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
  std::optional<Cell> cellAt(const QPointF& at) const;
  void layOut();  // scroll bars
  void reveal(const Cell& cell);
  void moveChosen(int columns, int rows);

  std::optional<ConfusionMatrix> matrix_;
  std::optional<Cell> chosen_, hovered_;
  std::optional<double> side_;
  Theme theme_ = Theme::kDark;
};

}  // namespace palpate::gui
