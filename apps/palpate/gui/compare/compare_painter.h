// Paints two frames and their difference: three groups of heat maps side by side at the same scale,
// A and B in one colour range, A - B in a range around 0. It needs no widget; the window and the
// export use it.
#pragma once

#include <QRectF>
#include <QString>
#include <array>
#include <optional>
#include <vector>

#include <palpate/model/hand_description.h>
#include <palpate/model/tactile_frame.h>

#include "gui/matrices/matrices_painter.h"

class QFontMetricsF;
class QPainter;

namespace palpate::gui {

// The three groups of heat maps.
enum class CompareGroup { kA, kB, kDifference };
inline constexpr std::array kAllCompareGroups = {
    CompareGroup::kA, CompareGroup::kB, CompareGroup::kDifference};

// The hands that the three groups show.
struct ComparedHands {
  HandDescription a;
  HandDescription b;
  // A's hand; its mask is the taxels that are compared (FrameComparison::layout).
  HandDescription difference;
  const HandDescription& of(CompareGroup group) const;
};

// What one group shows.
struct CompareGroupContent {
  // Has no values when there is no frame.
  TactileFrame frame;
  // Name of the recording: "foam_ball.dsa".
  QString name;
  // "frame 241 · 7.60 s"
  QString caption;
  // Shorter captions, ever shorter: the first one with room stands in place of a caption without.
  std::vector<QString> shorterCaptions = {};
  // Text over the taxels when there is no frame: "ended at 12.31 s".
  QString notice;
};
// The caption, or the shorter one, that fits into `width` [px]; the last one if none does.
const QString& fittingCaption(const CompareGroupContent& content,
                              double width,
                              const QFontMetricsF& metrics);
using ComparedFrames = std::array<CompareGroupContent, 3>;

// How a comparison is painted.
struct ComparePictureOptions {
  // Colour map, theme, font and so on, and the range that A and B share.
  MatricesPictureOptions look;
  // The value of the outermost colours of A - B [counts].
  double largestDifference = 1.0;
};

// The layout of a comparison's picture: where its groups and taxels are in a rectangle.
class CompareGeometry {
 public:
  CompareGeometry() = default;
  CompareGeometry(const QRectF& area,
                  const ComparedHands& hands,
                  const ComparePictureOptions& options);

  const QRectF& area() const noexcept { return area_; }
  const MatricesGeometry& group(CompareGroup which) const;
  QRectF titleRect(CompareGroup which) const;
  struct Place {
    CompareGroup group = CompareGroup::kA;
    TaxelPlace taxel;
    bool operator==(const Place&) const = default;
  };
  std::optional<Place> placeAt(const QPointF& point) const;

 private:
  QRectF area_;
  std::array<QRectF, 3> titles_;
  std::array<MatricesGeometry, 3> groups_;
};

// Paints what changes rarely, so that a widget can keep it as a pixmap: taxels without values,
// names of matrices, colour bars.
void paintCompareBackground(QPainter& painter,
                            const CompareGeometry& geometry,
                            const ComparedHands& hands,
                            const ComparePictureOptions& options);
// Paints what changes with every frame: titles, values and notices.
void paintCompareValues(QPainter& painter,
                        const CompareGeometry& geometry,
                        const ComparedHands& hands,
                        const ComparedFrames& frames,
                        const ComparePictureOptions& options);
// Paints both, for example into a file.
void paintComparison(QPainter& painter,
                     const QRectF& area,
                     const ComparedHands& hands,
                     const ComparedFrames& frames,
                     const ComparePictureOptions& options);

}  // namespace palpate::gui
