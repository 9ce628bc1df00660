// The header of the timeline: which signal is plotted, and a legend in the colours of the matrices.
#pragma once

#include <QWidget>
#include <vector>

#include <palpate/model/hand_description.h>

#include "gui/plotted_signal.h"
#include "gui/theme.h"

class QComboBox;

namespace palpate::gui {

// Squares of colour with names, as many as there is room for.
class Legend : public QWidget {
  Q_OBJECT
 public:
  struct Entry {
    QColor color;
    QString name;
  };
  explicit Legend(QWidget* parent = nullptr);
  void setEntries(std::vector<Entry> entries, Theme theme);
  const std::vector<Entry>& entries() const noexcept { return entries_; }
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override { return {40, sizeHint().height()}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  std::vector<Entry> entries_;
  Theme theme_ = Theme::kDark;
};

class TimelineHeader : public QWidget {
  Q_OBJECT
 public:
  explicit TimelineHeader(QWidget* parent = nullptr);
  void setSignal(PlottedSignal signal);
  // plotted: one per matrix of the hand, the whole last; empty: nothing is open.
  void setPlotted(const HandDescription& hand, const std::vector<bool>& plotted, Theme theme);

 signals:
  void signalChosen(palpate::gui::PlottedSignal signal);

 private:
  QComboBox* signal_;
  Legend* legend_;
};

}  // namespace palpate::gui
