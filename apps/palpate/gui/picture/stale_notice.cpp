#include "gui/picture/stale_notice.h"

#include <QFontMetricsF>
#include <QPainter>

namespace palpate::gui {
namespace {

// Opacity of the veil over a stale and over a held picture, of 255.
constexpr int kOldVeil = 150, kHeldVeil = 80;
constexpr double kAroundText = 12.0;  // [px]
constexpr double kAtSides = 40.0;     // [px] free beside the text
constexpr double kFrameWidth = 3.0;   // [px]

}  // namespace

void paintStaleNotice(QPainter& painter, const QRectF& area, const StaleNotice& old, Theme theme) {
  if (old.notice.isEmpty()) return;
  const ThemeColors& colors = colorsOf(theme);
  QColor veil = colors.window;
  veil.setAlpha(old.held ? kHeldVeil : kOldVeil);
  painter.save();
  painter.fillRect(area, veil);
  painter.setRenderHint(QPainter::Antialiasing);
  // The user looks at a held picture: its text is at the top, and a frame makes it recognisable
  // from a distance.
  const int where =
      Qt::TextWordWrap | Qt::AlignHCenter | (old.held ? Qt::AlignTop : Qt::AlignVCenter);
  const QRectF room = area.adjusted(kAtSides, kAroundText, -kAtSides, -kAroundText);
  const QRectF text = QFontMetricsF(painter.font()).boundingRect(room, where, old.notice);
  const QRectF box =
      text.adjusted(-kAroundText, -kAroundText / 2.0, kAroundText, kAroundText / 2.0);
  if (old.held) {
    constexpr double kInset = kFrameWidth / 2.0;
    painter.setPen(QPen(colors.warning, kFrameWidth));
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(area.adjusted(kInset, kInset, -kInset, -kInset));
  }
  painter.setPen(QPen(colors.warning, 1.0));
  painter.setBrush(colors.panel);
  painter.drawRoundedRect(box, 6.0, 6.0);
  painter.setPen(colors.warning);
  painter.drawText(text.adjusted(-1.0, 0.0, 1.0, 0.0), where, old.notice);
  painter.restore();
}

}  // namespace palpate::gui
