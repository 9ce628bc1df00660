#include <QFontInfo>
#include <QFontMetricsF>
#include <algorithm>
#include <cmath>

#include "gui/matrices/matrices_painter.h"

namespace palpate::gui {
namespace {

constexpr double kMatricesGeometryMargin = 14.0;     // [px] around everything
constexpr double kMatricesGeometryBarWidth = 14.0;   // [px] of the colour bar
constexpr double kMatricesGeometryBarLabels = 46.0;  // [px] for its numbers
constexpr double kBarGap = 26.0;                     // [px] between matrices and bar
constexpr double kNarrowGap = 18.0;                  // [px] least space between columns of matrices
constexpr double kWideGapTaxels = 2.5;               // [taxels] most space between them
constexpr double kRowGap = 10.0;                     // [px] between rows of matrices
// Where matrices are many: the largest shares of the picture's width and height that gaps and names
// take.
constexpr double kLargestGapShare = 0.25;
constexpr double kLargestNameShare = 0.5;
constexpr double kMatricesGeometryLargestTaxel = 64.0;  // [px]; limits small pads

// Extent of the columns and rows of the picture [mm].
struct Grid {
  std::vector<double> columnMm;
  std::vector<double> rowMm;
};

Grid gridOf(const HandDescription& hand) {
  Grid grid;
  for (std::size_t m = 0; m < hand.matrices.size(); ++m) {
    const MatrixLayout& layout = hand.layout->matrix(m);
    const auto column = static_cast<std::size_t>(hand.matrices[m].pictureColumn);
    const auto row = static_cast<std::size_t>(hand.matrices[m].pictureRow);
    if (grid.columnMm.size() <= column) grid.columnMm.resize(column + 1, 0.0);
    if (grid.rowMm.size() <= row) grid.rowMm.resize(row + 1, 0.0);
    const double widthMm = layout.columns * layout.pitchMm.x;
    const double heightMm = layout.rows * layout.pitchMm.y;
    grid.columnMm[column] = std::max(grid.columnMm[column], widthMm);
    grid.rowMm[row] = std::max(grid.rowMm[row], heightMm);
  }
  return grid;
}

double matricesGeometrySum(const std::vector<double>& values) {
  double total = 0.0;
  for (const double value : values) total += value;
  return total;
}

// Rounds down to whole device pixels, so that squares are equal and edges sharp.
double snapped(double value, double pixelRatio) {
  return pixelRatio > 0.0 ? std::floor(value * pixelRatio) / pixelRatio : value;
}

}  // namespace

QFont pictureFont(const MatricesPictureOptions& options) {
  QFont font = options.font;
  font.setPixelSize(QFontInfo(options.font).pixelSize());
  return font;
}

MatricesGeometry::MatricesGeometry(const QRectF& area,
                                   const HandDescription& hand,
                                   const MatricesPictureOptions& options)
    : area_(area) {
  const QFontMetricsF metrics(pictureFont(options));
  QRectF inside = area.adjusted(kMatricesGeometryMargin,
                                kMatricesGeometryMargin * 0.6,
                                -kMatricesGeometryMargin,
                                -kMatricesGeometryMargin);
  if (!options.title.isEmpty() || !options.caption.isEmpty()) {
    title_ = QRectF(inside.left(), inside.top(), inside.width(), metrics.height());
    inside.setTop(title_.bottom() + 8.0);
  }
  const Grid grid = gridOf(hand);
  if (grid.columnMm.empty() || inside.width() <= 0 || inside.height() <= 0) return;
  const auto columns = static_cast<double>(grid.columnMm.size());
  const auto rows = static_cast<double>(grid.rowMm.size());
  const double barSpace =
      options.colorBar ? kBarGap + kMatricesGeometryBarWidth + kMatricesGeometryBarLabels : 0.0;

  const double narrowGap =
      std::min(kNarrowGap, kLargestGapShare * std::max(0.0, inside.width() - barSpace) / columns);
  const double rowGap = std::min(kRowGap, kLargestGapShare * inside.height() / rows);
  double nameHeight = metrics.height() + 4.0;
  // No names where they would take the place of the matrices.
  if (rows * nameHeight > kLargestNameShare * inside.height()) nameHeight = 0.0;
  const double freeWidth = inside.width() - barSpace - (columns - 1) * narrowGap;
  const double freeHeight = inside.height() - rows * nameHeight - (rows - 1) * rowGap;
  double pxPerMm = std::min(freeWidth / matricesGeometrySum(grid.columnMm),
                            freeHeight / matricesGeometrySum(grid.rowMm));
  // The smaller pitch of the first matrix gets whole pixels; all pitches of an SDH-2 are equal.
  const TaxelPitch& first = hand.layout->matrix(0).pitchMm;
  const double pitchMm = std::min(first.x, first.y);
  double side = std::clamp(pxPerMm * pitchMm, 1e-3, kMatricesGeometryLargestTaxel);
  if (side >= 3.0) side = snapped(side, options.pixelRatio);
  pxPerMm = side / pitchMm;

  // Spare width goes between the fingers up to a limit, the rest to both sides.
  const double spare = inside.width() - barSpace - pxPerMm * matricesGeometrySum(grid.columnMm);
  double gap = narrowGap;
  if (columns > 1)
    gap = std::clamp(spare / (columns - 1), narrowGap, std::max(narrowGap, kWideGapTaxels * side));
  gap = std::max(gap, narrowGap);
  const double width = pxPerMm * matricesGeometrySum(grid.columnMm) + (columns - 1) * gap;
  const double height =
      pxPerMm * matricesGeometrySum(grid.rowMm) + rows * nameHeight + (rows - 1) * rowGap;
  const double left = inside.left() + std::max(0.0, (inside.width() - width - barSpace) / 2);
  const double top = inside.top() + std::max(0.0, (inside.height() - height) / 2);

  for (std::size_t m = 0; m < hand.matrices.size(); ++m) {
    const MatrixLayout& layout = hand.layout->matrix(m);
    const auto column = static_cast<std::size_t>(hand.matrices[m].pictureColumn);
    const auto row = static_cast<std::size_t>(hand.matrices[m].pictureRow);
    double x = left;
    for (std::size_t c = 0; c < column; ++c) x += grid.columnMm[c] * pxPerMm + gap;
    double y = top;
    for (std::size_t r = 0; r < row; ++r) y += nameHeight + grid.rowMm[r] * pxPerMm + rowGap;
    const QSizeF taxel(layout.pitchMm.x * pxPerMm, layout.pitchMm.y * pxPerMm);
    x += (grid.columnMm[column] * pxPerMm - layout.columns * taxel.width()) / 2;
    x = snapped(x, options.pixelRatio);
    y = snapped(y + nameHeight, options.pixelRatio);
    sizes_.push_back(taxel);
    matrices_.emplace_back(x, y, layout.columns * taxel.width(), layout.rows * taxel.height());
    const double nameWidth = grid.columnMm[column] * pxPerMm + gap - 4.0;
    names_.emplace_back(x + layout.columns * taxel.width() / 2 - nameWidth / 2,
                        y - nameHeight,
                        nameWidth,
                        nameHeight);
  }
  const double barTop = top + nameHeight;
  colorBar_ = QRectF(snapped(left + width + kBarGap, options.pixelRatio),
                     snapped(barTop, options.pixelRatio),
                     kMatricesGeometryBarWidth,
                     std::max(1.0, top + height - barTop));
}

QRectF MatricesGeometry::taxelRect(std::size_t matrix, int y, int x) const {
  const QSizeF& taxel = sizes_.at(matrix);
  return {matrices_[matrix].left() + x * taxel.width(),
          matrices_[matrix].top() + y * taxel.height(),
          taxel.width(),
          taxel.height()};
}

std::optional<TaxelPlace> MatricesGeometry::placeAt(const QPointF& point) const {
  for (std::size_t m = 0; m < matrices_.size(); ++m) {
    const QRectF& rect = matrices_[m];
    // Half-open intervals, so that a point on a border belongs to one taxel only.
    if (point.x() < rect.left() || point.x() >= rect.right() || point.y() < rect.top() ||
        point.y() >= rect.bottom())
      continue;
    return TaxelPlace{m,
                      static_cast<int>((point.y() - rect.top()) / sizes_[m].height()),
                      static_cast<int>((point.x() - rect.left()) / sizes_[m].width())};
  }
  return std::nullopt;
}

}  // namespace palpate::gui
