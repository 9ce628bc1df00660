#include "gui/widgets/status_strip.h"

#include <QHelpEvent>
#include <QPainter>
#include <QToolTip>

#include "gui/widgets/elided_text.h"

namespace palpate::gui {
namespace {

constexpr int kStatusStripMargin = 12;  // [px]
constexpr int kStatusStripBetween = 18;
constexpr double kLampRadius = 4.0;

}  // namespace

StatusStrip::StatusStrip(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

QSize StatusStrip::sizeHint() const { return {400, fontMetrics().height() + 8}; }

void StatusStrip::setStatus(const Status& status) {
  if (status == status_) return;
  status_ = status;
  QStringList parts =
      QStringList{status.state} + status.figures + QStringList{status.notice, status.right};
  parts.removeAll(QString());
  setAccessibleDescription(parts.join(", "));
  update();
}

// Leaves room for the state and for messages.
QString StatusStrip::shownRight() const {
  return fontMetrics().elidedText(status_.right, Qt::ElideMiddle, width() * 2 / 5);
}

bool StatusStrip::event(QEvent* event) {
  if (event->type() != QEvent::ToolTip) return QWidget::event(event);
  QToolTip::showText(static_cast<QHelpEvent*>(event)->globalPos(),
                     cut_.isEmpty() ? toolTip() : cut_.join("\n"),
                     this);
  return true;
}

void StatusStrip::paintEvent(QPaintEvent*) {
  const ThemeColors& colors = colorsOf();
  QPainter painter(this);
  const auto advance = [this](const QString& text) {
    return fontMetrics().horizontalAdvance(text);
  };
  const QString right = shownRight();
  cut_ = right == status_.right ? QStringList() : QStringList(status_.right);
  const int rightWidth = advance(right);
  painter.setPen(colors.text);
  painter.drawText(QRect(width() - kStatusStripMargin - rightWidth, 0, rightWidth, height()),
                   Qt::AlignRight | Qt::AlignVCenter,
                   right);
  const int end = width() - kStatusStripMargin - rightWidth - kStatusStripBetween;

  const QColor lamp = status_.lamp == Status::Lamp::kGood      ? colors.accent
                      : status_.lamp == Status::Lamp::kWarning ? colors.warning
                                                               : colors.muted;
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(lamp);
  painter.drawEllipse(
      QPointF(kStatusStripMargin + kLampRadius, height() / 2.0), kLampRadius, kLampRadius);
  int x = kStatusStripMargin + static_cast<int>(2 * kLampRadius) + 7;
  const auto item = [&](const QString& text, const QColor& color) {
    const QString shown = x < end ? withShorterPath(text, fontMetrics(), end - x) : QString();
    if (shown != text) cut_.append(text);
    if (shown.isEmpty()) return;
    painter.setPen(color);
    painter.drawText(QRect(x, 0, end - x, height()), Qt::AlignLeft | Qt::AlignVCenter, shown);
    x += advance(text) + kStatusStripBetween;
  };
  item(status_.state, status_.lamp == Status::Lamp::kWarning ? colors.warning : colors.text);
  // Numbers get a fixed width, so that they don't move while playing.
  for (const QString& figure : status_.figures) {
    const int from = x;
    item(figure, colors.muted);
    const auto space = figure.lastIndexOf(' ');
    x = std::max(x, from + advance(figure.left(space) + " 0000") + kStatusStripBetween);
  }
  item(status_.notice, colors.text);
}

}  // namespace palpate::gui
