// The header of the timeline: chooses the plotted signal of the matrices and further curves, shows
// a legend with the colours and strokes of the curves, and offers actions for the selection.
#pragma once

#include <QPen>
#include <QWidget>
#include <vector>

#include "gui/appearance/plotted_signal.h"
#include "gui/appearance/theme.h"
#include "gui/chart/plotted_curve.h"

class QComboBox;
class QHBoxLayout;
class QLabel;
class QToolButton;

namespace palpate::gui {

// Shows strokes with names, in two lines if they don't fit in one, as many as there is room for.
class Legend : public QWidget {
  Q_OBJECT
 public:
  struct Entry {
    QPen pen;
    QString name;
  };
  explicit Legend(QWidget* parent = nullptr);
  void setEntries(std::vector<Entry> entries);
  const std::vector<Entry>& entries() const noexcept { return entries_; }
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override { return {40, sizeHint().height()}; }
  // Whether some names have no room.
  bool isCut() const;
  // Where "…" stands for the entries that have no room [px]; empty: all have some.
  QRect dotsRect() const;

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  // Where the entries stand that have room in a width [px]: x [px], and the index of the line.
  std::vector<QPoint> places(int roomPx) const;
  // Where "…" stands: x [px], and the index of the line.
  QPoint dotsPlace() const;
  // Takes the height that the entries need.
  void fit();

  int lines_ = 1;
  std::vector<Entry> entries_;
};

class TimelineHeader : public QWidget {
  Q_OBJECT
 public:
  struct Actions {
    // These become buttons beside the text of setSelection(), those of them that are also in
    // `ofCursors` for a live source.
    QList<QAction*> ofSelection = {};
    QList<QAction*> ofCursors = {};
    // Buttons for a live source only.
    QList<QAction*> ofLive = {};
  };
  explicit TimelineHeader(const Actions& actions, QWidget* parent = nullptr);
  void setSignal(PlottedSignal signal);
  // Whether x, y, z and their norm can be chosen.
  void setComponents(bool offered);
  void setCurves(const std::vector<PlottedCurve>& curves);
  // "3.20 – 5.10 s · 61 frames"; empty: nothing is selected, no cursor is set.
  void setSelection(const QString& words);
  // "reading 34 %"; empty: everything is read.
  void setReading(const QString& words);
  // Shows what there is for a live source, or for a recording.
  void setLive(bool live);
  QToolButton* curvesButton() const noexcept { return curves_; }

 signals:
  void signalChosen(palpate::gui::PlottedSignal signal);
  void curvesRequested();

 private:
  QComboBox* signal_;
  QToolButton* curves_;
  Legend* legend_;
  QLabel* reading_;
  QWidget* selection_;
  QLabel* selectionWords_;
  // Buttons for a recording only, and for a live source only.
  QList<QToolButton*> ofRecording_;
  QList<QToolButton*> ofLive_;
};

}  // namespace palpate::gui
