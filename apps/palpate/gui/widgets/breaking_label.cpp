#include "gui/widgets/breaking_label.h"

#include <QEvent>

namespace palpate::gui {
namespace {

constexpr int kLeastLetters = 12;
constexpr QChar kMayWrapHere(0x200B);  // zero width space

QString withPlacesToWrap(const QString& word) {
  QString made;
  for (const QChar letter : word) {
    made += letter;
    if (QStringLiteral("_-./").contains(letter)) made += kMayWrapHere;
  }
  return made;
}

}  // namespace

BreakingLabel::BreakingLabel(QWidget* parent) : QLabel(parent) { setWordWrap(true); }

void BreakingLabel::setWholeText(const QString& text) {
  text_ = text;
  renew();
}

// Other words keep their letters only, so that a selected name is copied as it is.
void BreakingLabel::renew() {
  const QFontMetrics metrics = fontMetrics();
  QStringList words = text_.split(' ');
  for (QString& word : words)
    if (metrics.horizontalAdvance(word) > width()) word = withPlacesToWrap(word);
  const QString shown = words.join(' ');
  if (shown != text()) setText(shown);
}

QSize BreakingLabel::minimumSizeHint() const {
  const QFontMetrics metrics = fontMetrics();
  return {kLeastLetters * metrics.averageCharWidth(), metrics.lineSpacing()};
}

void BreakingLabel::resizeEvent(QResizeEvent* event) {
  QLabel::resizeEvent(event);
  renew();
}

void BreakingLabel::changeEvent(QEvent* event) {
  QLabel::changeEvent(event);
  if (event->type() == QEvent::FontChange) renew();
}

}  // namespace palpate::gui
