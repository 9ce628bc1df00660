// Paints the heat maps, for the window, for exported files and for `palpate render`. The matrices
// are arranged like the fingers (HandDescription::pictureColumn, pictureRow), all at the same
// scale, row 0 (the fingertip) on top, beside a colour bar with its unit.
#pragma once

#include <QFont>
#include <QRectF>
#include <QSizeF>
#include <QString>
#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include <palpate/model/hand_description.h>
#include <palpate/model/matrix_layout.h>
#include <palpate/model/tactile_frame.h>

#include "gui/appearance/color_map.h"
#include "gui/appearance/taxel_view.h"
#include "gui/appearance/theme.h"

class QPainter;

namespace palpate::gui {

struct MatricesPictureOptions {
  // Size of an exported picture [px].
  QSizeF size{900, 720};
  ColorMapName map = ColorMapName::kInferno;
  // Smooth between taxels instead of one square per taxel.
  bool interpolated = false;
  // Print the value of each active taxel.
  bool values = false;
  // Value of the lowest colour [counts].
  double rangeMin = 0.0;
  // Value of the highest colour [counts]; if not above rangeMin, the range is 0..maximum of the
  // frame.
  double rangeMax = 0.0;
  Theme theme = Theme::kLight;
  // At the top left; if title and caption are both empty, there is no line for them.
  QString title;
  // At the top right.
  QString caption;
  // Unit of the values; empty: that of the hand.
  QString unit;
  bool colorBar = true;
  // The values are signed: the difference map is used, with 0 in its middle.
  bool difference = false;
  // What is drawn of readings, see gui/matrices/drawn_taxels.h.
  TaxelView taxels = TaxelView::kNormal;
  // isDrawnSigned(): the difference map shows the normal component, with 0 in its middle.
  // paintMatricesPicture() sets it.
  bool isSigned = false;
  double arrows = kUsualArrows;  // factor of the arrows of shear; 0: none
  // Device pixels per pixel, so that taxels get whole device pixels; 0: exact sizes (vector
  // graphics).
  double pixelRatio = 0.0;
  QFont font;
};

// The font of `options` with its size in pixels, so that it has the same size on every device.
QFont pictureFont(const MatricesPictureOptions& options);

// The layout of the picture in an area: rectangles of matrices, taxels, names, title and colour
// bar.
class MatricesGeometry {
 public:
  MatricesGeometry() = default;
  MatricesGeometry(const QRectF& area,
                   const HandDescription& hand,
                   const MatricesPictureOptions& options);

  std::size_t numMatrices() const noexcept { return matrices_.size(); }
  QSizeF taxelSize(std::size_t matrix) const { return sizes_.at(matrix); }  // [px]
  // The shorter side of a taxel [px].
  double taxelSide(std::size_t matrix) const {
    return std::min(sizes_.at(matrix).width(), sizes_.at(matrix).height());
  }
  QRectF matrixRect(std::size_t matrix) const { return matrices_.at(matrix); }
  QRectF nameRect(std::size_t matrix) const { return names_.at(matrix); }
  QRectF taxelRect(std::size_t matrix, int y, int x) const;
  QRectF titleRect() const noexcept { return title_; }
  QRectF colorBarRect() const noexcept { return colorBar_; }
  const QRectF& area() const noexcept { return area_; }
  // The place under a point, whether or not a taxel exists there.
  std::optional<TaxelPlace> placeAt(const QPointF& point) const;

 private:
  QRectF area_;
  QRectF title_;
  QRectF colorBar_;
  std::vector<QRectF> matrices_;
  std::vector<QRectF> names_;
  std::vector<QSizeF> sizes_;
};

// The value range of a frame according to `options`; of signed values as far below 0 as above.
struct ValueRange {
  double minimum = 0.0;
  double maximum = 1.0;
  bool operator==(const ValueRange&) const = default;
};
ValueRange rangeOf(const MatricesPictureOptions& options, const TactileFrame& frame);

// The options with the unit of the hand, unless they have one.
MatricesPictureOptions withUnit(MatricesPictureOptions options, const HandDescription& hand);

// Whether a taxel is drawn: it was active as recorded (`contact`), or the filters leave at least
// `least` in it, which is leastSeen().
inline bool isSeen(float contact, float value, float least) noexcept {
  return isTouched(contact) || value >= least;
}
// Half a unit of the last digit that is shown: half a count.
float leastSeen(const HandDescription& hand);

// The parts of the picture, for a widget that caches the background as a pixmap. The background is
// everything that doesn't depend on the values (names, colour bar, taxels at rest, masks); the
// values are the active taxels of one matrix.
void paintMatricesBackground(QPainter& painter,
                             const MatricesGeometry& geometry,
                             const HandDescription& hand,
                             const ValueRange& range,
                             const MatricesPictureOptions& options);
void paintMatrixValues(QPainter& painter,
                       const MatricesGeometry& geometry,
                       std::size_t matrix,
                       const TactileFrame& frame,
                       const HandDescription& hand,
                       const ValueRange& range,
                       const MatricesPictureOptions& options);

// The longest name of a matrix that fits; the names of the matrices differ as long as there is room
// for a letter of each word: "finger 0 proximal", "0 proximal", "0 prox.", "0 P", "0P".
QString matrixNameWithin(const HandDescription& hand,
                         std::size_t matrix,
                         const std::function<bool(const QString&)>& fits);

// Length of an arrow per unit of shear, in sides of a taxel; 0: there are no arrows.
double arrowScale(const ValueRange& range, double arrows);
// Paints the shear of the touched taxels of a matrix as arrows from their centres.
void paintShear(QPainter& painter,
                const MatricesGeometry& geometry,
                std::size_t matrix,
                const TactileFrame& frame,
                const ValueRange& range,
                const MatricesPictureOptions& options);

// Paints the colour bar with its values, above it the unit, and below it a field in the colour of
// taxels that aren't touched, which isn't that of the smallest value; and title and caption in one
// line.
void paintColorBar(QPainter& painter,
                   const QRectF& bar,
                   const ValueRange& range,
                   const MatricesPictureOptions& options);
void paintTitle(QPainter& painter, const QRectF& rect, const MatricesPictureOptions& options);

// Paints the whole picture. Throws std::invalid_argument when the frame doesn't fit this hand.
void paintMatricesPicture(QPainter& painter,
                          const QRectF& area,
                          const TactileFrame& frame,
                          const HandDescription& hand,
                          const MatricesPictureOptions& options);

}  // namespace palpate::gui
