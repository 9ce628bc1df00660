// A text in a label that has less room than it needs: its middle gives way, and the tooltip has all
// of it.
#pragma once

#include <QString>

class QLabel;

namespace palpate::gui {

void showElided(QLabel* label, const QString& text, int widthPx);

}  // namespace palpate::gui
