// A small list of the vertical axes of a chart, one line per unit: whether the range is automatic,
// its ends, and whether it is logarithmic. A change acts at once; Escape or a click elsewhere
// closes the list. A begin that isn't below its end is said and not used.
#pragma once

#include <QFrame>
#include <QPointer>

#include "gui/chart/unit_axes.h"

class QLabel;

namespace palpate::gui {

class AxisEditor : public QFrame {
  Q_OBJECT
 public:
  explicit AxisEditor(QWidget* parent = nullptr);

  // Opens below (or above) a widget, for the axes of a chart; they must outlive this object.
  void openBeside(const QWidget& widget, UnitAxes& axes);

 private:
  void rebuild();
  // Tells below the lines what is wrong; empty: nothing.
  void say(const QString& problem);

  QPointer<UnitAxes> axes_;
  QWidget* rows_ = nullptr;
  QLabel* problem_ = nullptr;
};

}  // namespace palpate::gui
