// Texts that may have too little room.
#pragma once

#include <QString>

class QFontMetrics;
class QLabel;

namespace palpate::gui {

// The middle of the text is left out, and the tool tip of the label has all of it.
void showElided(QLabel* label, const QString& text, int widthPx);
// The text within a width: of a path in it the folders are left out first, so that the name of the
// file is seen; another text loses its end.
QString withShorterPath(const QString& text, const QFontMetrics& metrics, int widthPx);

}  // namespace palpate::gui
