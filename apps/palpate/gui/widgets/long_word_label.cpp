#include "gui/widgets/long_word_label.h"

#include <QPainter>
#include <QRegularExpression>
#include <algorithm>

namespace palpate::gui {
namespace {

constexpr int kMinLetters = 10;   // of a line
constexpr int kHighest = 10'000;  // [px]
constexpr int kFlags = Qt::AlignLeft | Qt::AlignVCenter | Qt::TextWrapAnywhere;

}  // namespace

LongWordLabel::LongWordLabel(QWidget* parent) : QLabel(parent) {
  // File names aren't to be read as HTML.
  setTextFormat(Qt::PlainText);
  setWordWrap(true);
  setTextInteractionFlags(Qt::TextSelectableByMouse);
}

// Whether a word is longer than a line.
bool LongWordLabel::isBroken(int width) const {
  const QStringList words = text().split(QRegularExpression("\\s+"), Qt::SkipEmptyParts);
  const int room = width - 2 * margin();
  return std::any_of(words.begin(), words.end(), [&](const QString& word) {
    return fontMetrics().horizontalAdvance(word) > room;
  });
}

QRect LongWordLabel::textRect(int width) const {
  return fontMetrics().boundingRect(QRect(0, 0, width - 2 * margin(), kHighest), kFlags, text());
}

QSize LongWordLabel::minimumSizeHint() const {
  const QSize least = QLabel::minimumSizeHint();
  const int broken = kMinLetters * fontMetrics().averageCharWidth() + 2 * margin();
  return {std::min(least.width(), broken), fontMetrics().height() + 2 * margin()};
}

int LongWordLabel::heightForWidth(int width) const {
  return isBroken(width) ? textRect(width).height() + 2 * margin() : QLabel::heightForWidth(width);
}

void LongWordLabel::paintEvent(QPaintEvent* event) {
  if (!isBroken(width())) return QLabel::paintEvent(event);
  QPainter painter(this);
  painter.setPen(palette().color(foregroundRole()));
  painter.drawText(
      contentsRect().adjusted(margin(), margin(), -margin(), -margin()), kFlags, text());
}

}  // namespace palpate::gui
