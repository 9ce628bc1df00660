// The drawing of the dock Slip for the contact of one matrix: its taxels in faint colours, an
// ellipse of two standard deviations with principal axis and marks of its skewness, the path since
// the reference, and the enlarged motion of the last frame with a ring for its threshold.
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

// What is drawn. Coordinates in taxels: x right, y down, (0, 0) is the centre of the first taxel.
struct SlipViewData {
  MatrixLayout layout;
  // [counts]; empty when there are none.
  MatrixValues values;
  double largestCounts = 0.0;
  QString name;
  // Nothing when there is no contact.
  std::optional<SlipSample> sample;
  // Path from the reference to the present position; empty without a reference.
  std::vector<QPointF> path;
  // Thresholds of the motion from frame to frame and since the reference.
  double stepTaxels = 0.2;
  double referenceTaxels = 1.0;
};

class SlipView : public QWidget {
  Q_OBJECT
 public:
  // Enlargement of the motion of one frame.
  static constexpr double kEnlarged = 10.0;

  explicit SlipView(QWidget* parent = nullptr);
  void setScene(const SlipViewData& scene);
  void clear();
  const std::optional<SlipViewData>& scene() const noexcept { return scene_; }
  void setMap(ColorMapName map);
  void paint(QPainter& painter, const QRectF& area, Theme theme) const;
  // The pixel position of a point of the matrix.
  QPointF pixelOf(double x, double y) const;

  QSize sizeHint() const override { return {240, 380}; }
  QSize minimumSizeHint() const override { return {140, 200}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  // The place and scale of the matrix in an area.
  struct Place;
  Place placeIn(const QRectF& area) const;

  std::optional<SlipViewData> scene_;
  ColorMapName map_ = ColorMapName::kInferno;
};

}  // namespace palpate::gui
