#include "gui/slip/slip_indicator.h"

#include <QPainter>
#include <QPixmap>

namespace palpate::gui {
namespace {

// The symbols are drawn in a square of 16 x 16 units, enlarged by 2.
constexpr int kSlipIndicatorUnits = 16;
constexpr int kScale = 2;
constexpr QPointF kSlipIndicatorMiddle(8.0, 8.0);
constexpr double kSlipIndicatorRadius = 6.0;

QPolygonF slipLampPolygon(const QList<QPointF>& points) { return QPolygonF(points); }

}  // namespace

IndicatorLook indicatorOf(const SlipSample* sample) {
  if (sample == nullptr) return IndicatorLook::kOff;
  if (sample->slipping || sample->indicator == SlipIndicator::kSlipping)
    return IndicatorLook::kSlipping;
  if (sample->indicator == SlipIndicator::kOff) return IndicatorLook::kOff;
  const bool unsure = sample->indicator == SlipIndicator::kNotComputable ||
                      sample->state == SlipState::kAmbiguous ||
                      sample->state == SlipState::kInvalid;
  return unsure ? IndicatorLook::kUnsure : IndicatorLook::kReady;
}

QColor colorOf(IndicatorLook look, Theme theme) {
  const ThemeColors& colors = colorsOf(theme);
  switch (look) {
    case IndicatorLook::kOff:
      break;
    case IndicatorLook::kReady:
      return theme == Theme::kDark ? QColor(0x4c, 0xc3, 0x6b) : QColor(0x1a, 0x7f, 0x37);
    case IndicatorLook::kUnsure:
      return colors.warning;
    case IndicatorLook::kSlipping:
      return colors.danger;
  }
  return colors.muted;
}

QIcon indicatorIcon(IndicatorLook look, Theme theme) {
  QPixmap pixmap(kSlipIndicatorUnits * kScale, kSlipIndicatorUnits * kScale);
  pixmap.setDevicePixelRatio(kScale);
  pixmap.fill(Qt::transparent);
  QPainter painter(&pixmap);
  painter.setRenderHint(QPainter::Antialiasing);
  const QColor color = colorOf(look, theme);
  const QPen inside(colorsOf(theme).panel, 1.8, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin);
  painter.setPen(Qt::NoPen);
  painter.setBrush(color);
  switch (look) {
    case IndicatorLook::kOff:
      painter.setBrush(Qt::NoBrush);
      painter.setPen(QPen(color, 1.6));
      painter.drawEllipse(
          kSlipIndicatorMiddle, kSlipIndicatorRadius - 1.0, kSlipIndicatorRadius - 1.0);
      break;
    case IndicatorLook::kReady:
      painter.drawEllipse(kSlipIndicatorMiddle, kSlipIndicatorRadius, kSlipIndicatorRadius);
      painter.setPen(inside);
      painter.drawPolyline(slipLampPolygon({{5.2, 8.3}, {7.2, 10.3}, {10.9, 5.9}}));
      break;
    case IndicatorLook::kUnsure:
      painter.drawPolygon(slipLampPolygon({{8.0, 1.8}, {14.8, 14.0}, {1.2, 14.0}}));
      painter.setPen(inside);
      painter.drawLine(QPointF(8.0, 6.2), QPointF(8.0, 9.4));
      painter.drawPoint(QPointF(8.0, 12.0));
      break;
    case IndicatorLook::kSlipping:
      painter.drawRoundedRect(QRectF(1.6, 1.6, 12.8, 12.8), 2.0, 2.0);
      painter.setPen(inside);
      painter.drawLine(QPointF(8.0, 4.4), QPointF(8.0, 11.4));
      painter.drawPolyline(slipLampPolygon({{5.0, 8.6}, {8.0, 11.6}, {11.0, 8.6}}));
      break;
  }
  painter.end();
  return QIcon(pixmap);
}

QString stateTextOf(const SlipSample* sample) {
  if (sample == nullptr) return "no contact";
  return QString::fromUtf8(nameOf(sample->state)).replace('_', ' ');
}

QString meaningOf(const SlipSample* sample) {
  if (sample == nullptr) return "No taxel of this matrix is active.";
  switch (sample->state) {
    case SlipState::kStill:
      return "No significant motion of the contact.";
    case SlipState::kLoading:
      return "The contact moves, but no more than is normal while the load changes this fast.";
    case SlipState::kLoadShift:
      return "The load shifted to other taxels; the contact didn't move.";
    case SlipState::kAmbiguous:
      return "The shape of the contact can't distinguish motion from a load shift, or slip isn't "
             "confirmed yet.";
    case SlipState::kSlip:
      return "The contact moves over the matrix.";
    case SlipState::kInvalid:
      break;
  }
  return "The contact is too small or too short, or neither motion nor load explains the change.";
}

}  // namespace palpate::gui
