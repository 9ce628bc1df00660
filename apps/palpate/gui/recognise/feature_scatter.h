// The scatter plot of two features: a point for each grasp, a colour and a form for each object,
// with the names of the objects beside it. A click chooses a grasp, a name lets its object stand
// out; the wheel zooms, dragging moves, a double click shows all.
#pragma once

#include <QWidget>
#include <memory>
#include <optional>
#include <vector>

#include <palpate/recognition/feature_table.h>

#include "gui/appearance/theme.h"
#include "gui/picture/exported_view.h"

class QCustomPlot;
class QListWidget;
class QMouseEvent;
class QPainter;

namespace palpate::gui {

// The colour of one of `count` objects.
QColor objectColor(int object, int count, Theme theme = shownTheme());

class FeatureScatter : public QWidget {
  Q_OBJECT
 public:
  explicit FeatureScatter(QWidget* parent = nullptr);
  // `leftOut`: as many as there are rows. Null: no table.
  void setTable(const std::shared_ptr<const FeatureTable>& table, std::vector<bool> leftOut);
  void setLeftOut(std::vector<bool> leftOut);
  // Columns of the table along both axes.
  void setAxes(std::size_t x, std::size_t y);
  // The chosen row of the table; -1: none.
  void choose(int row);
  int chosen() const noexcept { return chosen_; }
  // Where a row is drawn, in coordinates of the plot; for tests.
  QPointF pointOf(int row) const;
  QCustomPlot& plot() noexcept { return *plot_; }
  QListWidget& names() noexcept { return *names_; }
  // The row near a point of the plot; nothing: none is near.
  std::optional<int> rowAt(const QPointF& at) const;
  QString tipOf(int row) const;
  void paintPicture(QPainter& painter, const PictureLook& look);

 signals:
  void rowChosen(int row);

 private:
  void rebuild(Theme theme = shownTheme());
  void fit();
  void showChosen();
  void hover(QMouseEvent* event);

  std::shared_ptr<const FeatureTable> table_;
  std::vector<bool> leftOut_;
  std::size_t x_ = 0, y_ = 1;
  int chosen_ = -1;
  QPointF pressed_;
  QCustomPlot* plot_;
  QListWidget* names_;
};

}  // namespace palpate::gui
