#include "gui/widgets/elided_text.h"

#include <QFontMetrics>
#include <QLabel>

namespace palpate::gui {

void showElided(QLabel* label, const QString& text, int widthPx) {
  label->setText(label->fontMetrics().elidedText(text, Qt::ElideMiddle, widthPx));
  label->setToolTip(label->text() == text ? QString() : text);
  label->setAccessibleName(text);
}

QString withShorterPath(const QString& text, const QFontMetrics& metrics, int widthPx) {
  // A path begins a word ("10 deg/s" has none); of several paths the first one is shortened.
  const qsizetype begin = text.startsWith('/') ? 0 : text.indexOf(" /") + 1;
  const qsizetype next = text.indexOf(" /", begin + 1);
  const qsizetype name = text.lastIndexOf('/', next < 0 ? -1 : next);
  if (begin >= name || text[begin] != '/' || metrics.horizontalAdvance(text) <= widthPx)
    return metrics.elidedText(text, Qt::ElideRight, widthPx);
  const QString before = text.left(begin), after = text.mid(name);
  const int room = widthPx - metrics.horizontalAdvance(before + after);
  if (room >= metrics.horizontalAdvance("…"))
    return before + metrics.elidedText(text.mid(begin, name - begin), Qt::ElideRight, room) + after;
  return metrics.elidedText("…" + after, Qt::ElideRight, widthPx);
}

}  // namespace palpate::gui
