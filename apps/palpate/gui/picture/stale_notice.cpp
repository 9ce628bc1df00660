#include "gui/picture/stale_notice.h"

#include <QFontMetricsF>
#include <QPainter>

namespace palpate::gui {
namespace {

constexpr int kOldVeil = 150, kHeldVeil = 80;  // of 255
constexpr double kAroundText = 12.0;           // [px]
constexpr double kAtSides = 40.0;              // [px] that the text keeps free
constexpr double kFrameWidth = 3.0;            // [px]

}  // namespace

void paintStaleNotice(QPainter& painter, const QRectF& area, const StaleNotice& old, Theme theme) {
  if (old.notice.isEmpty()) return;
  const ThemeColors& colors = colorsOf(theme);
  QColor veil = colors.window;
  veil.setAlpha(old.held ? kHeldVeil : kOldVeil);
  painter.save();
  painter.fillRect(area, veil);
  painter.setRenderHint(QPainter::Antialiasing);
  // What is held is looked at: its line stands above, and a frame tells from afar.
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
