#include "gui/hand3d/hand_picture.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

#include <palpate/core/number_text.h>
#include <palpate/kinematics/joint_range.h>

#include "gui/hand3d/hand_raster.h"
#include "gui/matrices/drawn_taxels.h"

namespace palpate::gui {
namespace {

constexpr double kHandPictureMargin = 12.0;    // [px]
constexpr double kNoticePadding = 10.0;        // [px], half of it above and below
constexpr double kHandPictureBarWidth = 12.0;  // [px] of the colour bar
constexpr double kHandPictureBarLabels = 44.0;
constexpr double kHighestBar = 220.0;
// Below this height [px] there is no room for a colour bar.
constexpr double kLowestPicture = 220.0;
// Longest scale bar, as a share of the width.
constexpr double kScaleShare = 0.16;
// Device pixels per unit from which fewer samples suffice.
constexpr double kFine = 2.0;
// Dots per unit on paper.
constexpr double kVectorRatio = 2.5;

// The longest of 1, 2, 5, 10, 20, .. mm that fits.
double roundLength(double longestMm) {
  const double power = std::pow(10.0, std::floor(std::log10(longestMm)));
  for (const double step : {5.0, 2.0})
    if (step * power <= longestMm) return step * power;
  return power;
}

void paintScale(QPainter& painter, const QRectF& area, const HandPictureOptions& options) {
  const double pxPerMm = options.camera.pxPerMm(area.height());
  if (!(pxPerMm > 0.0) || !std::isfinite(pxPerMm)) return;
  const double lengthMm = roundLength(area.width() * kScaleShare / pxPerMm);
  const double length = lengthMm * pxPerMm;
  const QPointF left(area.left() + kHandPictureMargin, area.bottom() - kHandPictureMargin);
  painter.setPen(QPen(colorsOf(options.page.theme).muted, 1.5));
  painter.drawLine(left, left + QPointF(length, 0.0));
  for (const double at : {0.0, length})
    painter.drawLine(left + QPointF(at, -4.0), left + QPointF(at, 0.0));
  const QString text = QString::fromStdString(numberText(lengthMm)) + " mm";
  painter.drawText(left + QPointF(length + 8.0, 2.0), text);
}

// Paints the diameter of the sphere, if the sphere is visible.
double paintSphereText(QPainter& painter,
                       const QRectF& area,
                       double top,
                       const HandSceneBuilder& drawing,
                       const HandPictureOptions& options) {
  const HandLook& look = options.look;
  if (look.sphere == SphereLook::kNone || look.only || isFlat(drawing.effective(look).taxels))
    return top;
  const QString text = sphereText(drawing, look.sphereOf);
  if (text.isEmpty()) return top;
  const QFontMetricsF metrics(painter.font());
  painter.setPen(colorsOf(options.page.theme).muted);
  const QRectF line(area.left() + kHandPictureMargin,
                    top,
                    area.width() - 2.0 * kHandPictureMargin,
                    metrics.height());
  const QString shown =
      metrics.horizontalAdvance(text) <= line.width() ? text : text.section(", ", 1);
  // The hand may lie behind it.
  constexpr double kAround = 4.0;  // [px]
  QColor behind = colorsOf(options.page.theme).window;
  behind.setAlphaF(0.8F);
  painter.fillRect(QRectF(line.topLeft(), QSizeF(metrics.horizontalAdvance(shown), line.height()))
                       .adjusted(-kAround, 0.0, kAround, 0.0),
                   behind);
  painter.drawText(line, Qt::AlignLeft | Qt::AlignVCenter, shown);
  return line.bottom() + 6.0;
}

// The text of a notice at the top of a picture of this width.
QRectF noticeBox(const QFont& font, double widthPx, const QString& notice) {
  const double left = kHandPictureMargin + kNoticePadding;
  return QFontMetricsF(font).boundingRect(
      QRectF(left, 0.0, widthPx - 2.0 * left, 200.0), Qt::AlignLeft | Qt::TextWordWrap, notice);
}

void handPicturePaintNotice(QPainter& painter,
                            const QRectF& area,
                            double top,
                            const HandPictureOptions& options) {
  if (options.notice.isEmpty()) return;
  const ThemeColors& colors = colorsOf(options.page.theme);
  const QRectF box =
      noticeBox(painter.font(), area.width(), options.notice).translated(area.left(), top);
  const QRectF around = box.adjusted(-kNoticePadding, 0.0, kNoticePadding, kNoticePadding);
  painter.setPen(QPen(colors.warning, 1.0));
  painter.setBrush(colors.panel);
  painter.drawRoundedRect(around, 5.0, 5.0);
  painter.setPen(colors.warning);
  painter.drawText(box.translated(0.0, 5.0), Qt::AlignLeft | Qt::TextWordWrap, options.notice);
}

}  // namespace

double noticeHeight(const QFont& font, double widthPx, const QString& notice) {
  return notice.isEmpty() ? 0.0
                          : kHandPictureMargin + noticeBox(font, widthPx, notice).height() +
                                2.0 * kNoticePadding;
}

HandLook lookOf(const HandPictureOptions& options, const HandSceneBuilder& drawing) {
  HandLook look = options.look;
  MatricesPictureOptions page = options.page;
  look.map = page.map;
  look.range = {page.rangeMin, page.rangeMax};
  if (const auto& frame = drawing.handState().frame) {
    page.isSigned = isDrawnSigned(*frame, page.taxels);
    look.range = rangeOf(page, *frame);
  }
  look.view = page.taxels;
  look.isSigned = page.isSigned;
  look.arrows = page.arrows;
  look.theme = page.theme;
  return look;
}

void paintHandOverlay(QPainter& painter,
                      const QRectF& area,
                      const HandSceneBuilder& drawing,
                      const HandScene& scene,
                      const HandPictureOptions& options) {
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setFont(pictureFont(options.page));
  painter.translate(area.topLeft());
  paintLabels(painter, scene, options.camera, area.size());
  painter.translate(-area.topLeft());
  const QFontMetricsF metrics(painter.font());
  double top = area.top() + kHandPictureMargin;
  if (!options.page.title.isEmpty() || !options.page.caption.isEmpty()) {
    const QRectF title(area.left() + kHandPictureMargin,
                       top,
                       area.width() - 2.0 * kHandPictureMargin,
                       metrics.height());
    paintTitle(painter, title, options.page);
    top = title.bottom() + 8.0;
  }
  painter.setFont(pictureFont(options.page));
  top = paintSphereText(painter, area, top, drawing, options);
  handPicturePaintNotice(painter, area, top, options);
  if (drawing.hasHand()) {
    painter.setFont(pictureFont(options.page));
    paintScale(painter, area, options);
    if (options.page.colorBar && area.height() >= kLowestPicture) {
      const double above = top + 2.5 * metrics.height();
      const double height = std::min(kHighestBar, area.bottom() - above - 3.0 * kHandPictureMargin);
      const QRectF bar(
          area.right() - kHandPictureMargin - kHandPictureBarLabels - kHandPictureBarWidth,
          above,
          kHandPictureBarWidth,
          height);
      painter.setRenderHint(QPainter::Antialiasing, false);
      const HandLook look = lookOf(options, drawing);
      MatricesPictureOptions page = withUnit(options.page, drawing.hand());
      page.isSigned = look.isSigned;
      paintColorBar(painter, bar, look.range, page);
    }
  }
  painter.restore();
}

void paintHandPicture(QPainter& painter,
                      const QRectF& area,
                      const HandSceneBuilder& drawing,
                      const HandPictureOptions& options) {
  HandScene scene;
  drawing.fill(scene, lookOf(options, drawing), options.camera);
  const double ratio = options.page.pixelRatio > 0.0 ? options.page.pixelRatio : kVectorRatio;
  // Small pixels need fewer samples.
  const RasterQuality quality = ratio >= kFine ? RasterQuality::kScreen : RasterQuality::kPicture;
  painter.drawImage(area, rasterize(scene, options.camera, area.size(), ratio, quality));
  paintHandOverlay(painter, area, drawing, scene, options);
}

QString sphereText(const HandSceneBuilder& drawing, SphereOf of) {
  const HandContact& contact = drawing.handState().contact;
  const auto& sphere = of == SphereOf::kTaxels ? contact.taxelSphere : contact.centroidSphere;
  if (!sphere || !(sphere->radiusMm > 0.0)) return {};
  return QString(of == SphereOf::kTaxels ? "enclosing sphere, diameter "
                                         : "sphere of centroids, diameter ") +
         QString::number(2.0 * sphere->radiusMm, 'f', 1) + " mm";
}

QString poseNotice(const HandSceneBuilder& drawing, bool assumed) {
  if (!drawing.hasHand()) return {};
  if (!drawing.hasGeometry())
    return "The geometry of this sensor isn't known: its matrices are laid flat.";
  if (!drawing.handState().frame) return {};
  if (!drawing.posed()) return "No usable joint angles: the hand is shown at rest, without sizes.";
  if (assumed) return "Joint angles are assumed, not recorded.";
  const AnglesCheck check = checkAngles(drawing.handState().anglesDeg, drawing.hand().axes);
  return QString::fromStdString(check.problem);
}

}  // namespace palpate::gui
