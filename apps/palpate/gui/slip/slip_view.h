// How the contact of one matrix lies and moves: its taxels faintly, an ellipse of two standard
// deviations with principal axis and marks of its skewness, the way since the reference, and the
// motion of the last frame enlarged, with a ring that is its threshold.
#pragma once

#include <QPointF>
#include <QWidget>
#include <optional>
#include <vector>

#include <palpate/model/hand_description.h>
#include <palpate/model/tactile_frame.h>
#include <palpate/slip/slip_series.h>

#include "gui/appearance/color_map.h"
#include "gui/appearance/theme.h"
#include "gui/picture/exported_view.h"

namespace palpate::gui {

// What is drawn, in taxels: x right, y down, (0, 0) the middle of the first taxel.
struct SlipViewData {
  MatrixLayout layout;
  MatrixValues values;  // counts; empty: none
  double largestCounts = 0.0;
  QString name;
  std::optional<SlipSample> sample;  // nothing: no contact
  std::vector<QPointF> path;         // from the reference to where it is now; empty: no reference
  double stepTaxels = 0.2;           // thresholds
  double referenceTaxels = 1.0;
};

class SlipView : public QWidget {
  Q_OBJECT
 public:
  static constexpr double kEnlarged = 10.0;  // the motion of a frame

  explicit SlipView(QWidget* parent = nullptr);
  void setScene(const SlipViewData& scene);
  void clear();
  const std::optional<SlipViewData>& scene() const noexcept { return scene_; }
  void setTheme(Theme theme);
  void setMap(ColorMapName map);
  void paint(QPainter& painter, const QRectF& area, Theme theme) const;
  // Where a place of the matrix is drawn [px].
  QPointF pixelOf(double x, double y) const;

  QSize sizeHint() const override { return {240, 380}; }
  QSize minimumSizeHint() const override { return {140, 200}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  struct Place;  // where the matrix lies in an area
  Place placeIn(const QRectF& area) const;

  std::optional<SlipViewData> scene_;
  Theme theme_ = Theme::kDark;
  ColorMapName map_ = ColorMapName::kInferno;
};

}  // namespace palpate::gui
