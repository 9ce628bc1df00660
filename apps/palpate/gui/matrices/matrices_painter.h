// The heat maps as a picture: pure painting, used by the window, by exported files and by
// `palpate render`. Matrices lie like the fingers (HandDescription::pictureColumn, pictureRow), all
// at the same scale, row 0 (the fingertip) on top; a colour bar with its unit stands beside them.
#pragma once

#include <QFont>
#include <QRectF>
#include <QSizeF>
#include <QString>
#include <cstddef>
#include <optional>
#include <vector>

#include <palpate/model/hand_description.h>
#include <palpate/model/tactile_frame.h>
#include <palpate/model/taxel_place.h>

#include "gui/appearance/color_map.h"
#include "gui/appearance/theme.h"

class QPainter;

namespace palpate::gui {

struct MatricesPictureOptions {
  QSizeF size{900, 720};  // of a picture of its own [px]
  ColorMapName map = ColorMapName::kInferno;
  bool interpolated = false;  // smooth between taxels instead of one square per taxel
  bool values = false;        // print each active taxel's value
  double rangeMin = 0.0;      // value of the lowest colour [counts]
  double rangeMax = 0.0;      // of the highest; not above rangeMin: 0..maximum of the frame
  Theme theme = Theme::kLight;
  QString title;            // top left; empty together with caption: no line for them
  QString caption;          // top right
  QString unit = "counts";  // of the values
  bool colorBar = true;
  bool difference = false;  // values are signed: the map of differences, 0 in its middle
  double pixelRatio = 0.0;  // device pixels per pixel: taxels get whole ones; 0: exact (vector)
  QFont font;
};

// The font of options in pixels, so that it has the same size on every device.
QFont pictureFont(const MatricesPictureOptions& options);

// Where everything lies in an area.
class MatricesGeometry {
 public:
  MatricesGeometry() = default;
  MatricesGeometry(const QRectF& area,
                   const HandDescription& hand,
                   const MatricesPictureOptions& options);

  std::size_t numMatrices() const noexcept { return matrices_.size(); }
  double taxelSide(std::size_t matrix) const { return sides_.at(matrix); }  // [px]
  QRectF matrixRect(std::size_t matrix) const { return matrices_.at(matrix); }
  QRectF nameRect(std::size_t matrix) const { return names_.at(matrix); }
  QRectF taxelRect(std::size_t matrix, int y, int x) const;
  QRectF titleRect() const noexcept { return title_; }
  QRectF colorBarRect() const noexcept { return colorBar_; }
  const QRectF& area() const noexcept { return area_; }
  // The place under a point; existing or not.
  std::optional<TaxelPlace> placeAt(const QPointF& point) const;

 private:
  QRectF area_;
  QRectF title_;
  QRectF colorBar_;
  std::vector<QRectF> matrices_;
  std::vector<QRectF> names_;
  std::vector<double> sides_;
};

// The range that `options` ask for, given the frame.
struct ValueRange {
  double minimum = 0.0;
  double maximum = 1.0;
  bool operator==(const ValueRange&) const = default;
};
ValueRange rangeOf(const MatricesPictureOptions& options, const TactileFrame& frame);

// Whether there is something to see in a taxel: it was touched as recorded (`contact`), or filters
// left at least half a count in it.
bool isSeen(float contact, float value) noexcept;

// The parts, for a widget that keeps the first as a pixmap. Background: everything that doesn't
// depend on the values (names, colour bar, taxels at rest, masks). Values: one matrix' active
// taxels.
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

// The colours with their values and unit, which stands above the bar; title and caption in one
// line.
void paintColorBar(QPainter& painter,
                   const QRectF& bar,
                   const ValueRange& range,
                   const MatricesPictureOptions& options);
void paintTitle(QPainter& painter, const QRectF& rect, const MatricesPictureOptions& options);

// The whole picture. Throws std::invalid_argument when the frame isn't one of this hand.
void paintMatricesPicture(QPainter& painter,
                          const QRectF& area,
                          const TactileFrame& frame,
                          const HandDescription& hand,
                          const MatricesPictureOptions& options);

}  // namespace palpate::gui
