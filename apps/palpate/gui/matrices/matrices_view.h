// The heat maps as a widget. Keeps everything that doesn't change as a pixmap, repaints only the
// matrices whose values changed, and tells what lies under the mouse.
#pragma once

#include <QPixmap>
#include <QWidget>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <palpate/model/taxel_selection.h>

#include "gui/matrices/matrices_painter.h"
#include "gui/picture/stale_notice.h"

namespace palpate {
struct PressureFrame;
}

namespace palpate::gui {

// How the view shows values; where the range ends is its owner's affair.
struct MatricesLook {
  ColorMapName map = ColorMapName::kInferno;
  bool interpolated = false;
  bool values = false;
  ValueRange range;
  Theme theme = Theme::kDark;
  bool operator==(const MatricesLook&) const = default;
};

class MatricesView : public QWidget {
  Q_OBJECT
 public:
  explicit MatricesView(QWidget* parent = nullptr);

  // Another hand; nothing is shown until the first frame.
  void setHand(const HandDescription& hand);
  void clear();
  void setFrame(const TactileFrame& frame);
  // Told beside the counts of the taxel under the mouse; null: no calibration is applied.
  void setPressure(std::shared_ptr<const PressureFrame> pressure);
  void setLook(const MatricesLook& look);
  const MatricesLook& look() const noexcept { return look_; }
  const MatricesGeometry& geometryOfMatrices() const noexcept { return geometry_; }
  // What lies under the mouse: "finger 0 distal · x 3, y 5 · 812 counts"; empty beside the taxels.
  QString hoverText() const;

  // Click and drag choose taxels, Ctrl adds to what is chosen, a click beside them (or Escape) lets
  // go.
  const TaxelSelection& selection() const noexcept { return selection_; }
  void select(const TaxelSelection& selection);
  void clearSelection();
  // Why a matrix can't tell the limit of a grasp, as it is set: marked, and told beside its counts.
  // One text per matrix, empty: it can; none at all: all can, or nothing is connected.
  void setUnmeasurable(const std::vector<QString>& why);
  const std::vector<QString>& unmeasurable() const noexcept { return unmeasurable_; }
  // Over an old picture, one that is held, too.
  void setStale(const StaleNotice& old);
  const QString& notice() const noexcept { return stale_.notice; }
  // Of the newest frame that is wholly on screen [us since 1970]; 0: none yet.
  std::int64_t paintedUs() const noexcept { return paintedUs_; }
  QSize sizeHint() const override { return {560, 560}; }
  QSize minimumSizeHint() const override { return {320, 240}; }

 signals:
  void hovered(const QString& text);
  void selectionChanged();
  void menuRequested(const QPoint& globalPosition);  // the right button
  // The paint event that first shows a frame has ended.
  void painted(qint64 frameHostUs);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  MatricesPictureOptions pictureOptions() const;
  void renew();
  void setHover(std::optional<TaxelPlace> place);
  void choose(const TaxelPlace& from, const TaxelPlace& to);
  void paintSelection(QPainter& painter) const;
  void paintUnmeasurable(QPainter& painter) const;

  std::optional<HandDescription> hand_;
  std::optional<TactileFrame> frame_;
  std::shared_ptr<const PressureFrame> pressure_;
  MatricesLook look_;
  MatricesGeometry geometry_;
  QPixmap background_;
  std::optional<TaxelPlace> hover_;
  TaxelSelection selection_;
  TaxelSelection selectedBefore_;      // what a drag adds to
  std::optional<TaxelPlace> pressed_;  // where the drag began
  StaleNotice stale_;
  std::vector<QString> unmeasurable_;
  std::int64_t paintedUs_ = 0;
};

}  // namespace palpate::gui
