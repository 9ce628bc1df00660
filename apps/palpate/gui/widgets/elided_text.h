// Shows a text in a label that may be too narrow for it: the middle of the text is left out, and
// the tool tip has all of it.
#pragma once

#include <QString>

class QLabel;

namespace palpate::gui {

void showElided(QLabel* label, const QString& text, int widthPx);

}  // namespace palpate::gui
