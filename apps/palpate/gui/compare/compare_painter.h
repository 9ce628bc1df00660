// Two frames and their difference as a picture: three groups of heat maps side by side at the same
// scale, A and B in one colour range, A - B about 0. Pure painting, for the window and for exported
// files.
#pragma once

#include <QRectF>
#include <QString>
#include <array>
#include <optional>

#include <palpate/model/hand_description.h>
#include <palpate/model/tactile_frame.h>

#include "gui/matrices/matrices_painter.h"

class QPainter;

namespace palpate::gui {

enum class CompareGroup { kA, kB, kDifference };
inline constexpr std::array kAllCompareGroups = {
    CompareGroup::kA, CompareGroup::kB, CompareGroup::kDifference};

// What stands in the groups.
struct ComparedHands {
  HandDescription a;
  HandDescription b;
  HandDescription difference;  // A's, with what is compared as its mask (FrameComparison::layout)
  const HandDescription& of(CompareGroup group) const;
};

struct CompareGroupContent {
  TactileFrame frame;  // no values: there is none
  QString name;        // "foam_ball.dsa"
  QString caption;     // "frame 241 · 7.60 s"
  QString notice;      // over the taxels, where there is no frame: "ended at 12.31 s"
};
using ComparedFrames = std::array<CompareGroupContent, 3>;

struct ComparePictureOptions {
  MatricesPictureOptions look;     // map, theme, font, .., and the range that A and B share
  double largestDifference = 1.0;  // value of the outermost colours of A - B [counts]
};

// Where everything lies in an area.
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

// For a widget that keeps the first as a pixmap: taxels at rest, names of matrices, colour bars.
void paintCompareBackground(QPainter& painter,
                            const CompareGeometry& geometry,
                            const ComparedHands& hands,
                            const ComparePictureOptions& options);
// Titles, values, notices.
void paintCompareValues(QPainter& painter,
                        const CompareGeometry& geometry,
                        const ComparedHands& hands,
                        const ComparedFrames& frames,
                        const ComparePictureOptions& options);
void paintComparison(QPainter& painter,
                     const QRectF& area,
                     const ComparedHands& hands,
                     const ComparedFrames& frames,
                     const ComparePictureOptions& options);

}  // namespace palpate::gui
