// Fills a box with the signals that can be plotted of a matrix.
#pragma once

#include <QComboBox>
#include <QString>

#include "gui/appearance/plotted_signal.h"

namespace palpate::gui {

// Components are offered where the source has them. What is chosen stays, if it is still offered.
// Emits nothing that a user would.
inline void offerSignals(QComboBox& box, bool withComponents) {
  const QString chosen = box.currentText();
  box.clear();
  for (const PlottedSignal signal : signalKinds(withComponents)) {
    box.addItem(nameOf(signal));
    box.setItemData(box.count() - 1, meaningOf(signal), Qt::ToolTipRole);
  }
  box.setCurrentText(chosen);
}

}  // namespace palpate::gui
