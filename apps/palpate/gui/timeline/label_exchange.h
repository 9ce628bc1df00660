// Writes the labels of the displayed recording into a CSV table, and adds those of such a table to
// it; what was added can be undone.
#pragma once

#include <QObject>

#include "gui/window_state/window_state.h"

namespace palpate::gui {

class LabelExchange : public QObject {
  Q_OBJECT
 public:
  // All arguments must outlive this object.
  LabelExchange(WindowState& windowState, QObject* parent);

  void exportLabels();
  void importLabels();

 private:
  WindowState& windowState_;
};

}  // namespace palpate::gui
