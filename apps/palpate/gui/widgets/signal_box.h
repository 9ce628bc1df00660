// Fills a box with the signals that can be plotted of a matrix.
#pragma once

#include <QComboBox>
#include <QString>

#include "gui/appearance/plotted_signal.h"

namespace palpate::gui {

// Components are offered where the source has them. What is chosen stays, if it is still offered.
// A box that offers the same already stays as it is. Emits no activated().
inline void offerSignals(QComboBox& box, bool withComponents) {
  const auto kinds = signalKinds(withComponents);
  if (box.count() == static_cast<int>(kinds.size())) return;
  const QString chosen = box.currentText();
  box.clear();
  for (const PlottedSignal signal : kinds) {
    box.addItem(nameOf(signal));
    box.setItemData(box.count() - 1, meaningOf(signal), Qt::ToolTipRole);
  }
  box.setCurrentText(chosen);
}

}  // namespace palpate::gui
