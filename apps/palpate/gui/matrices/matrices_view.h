// The widget that shows the heat maps. It caches everything that doesn't change as a pixmap,
// repaints only matrices whose values changed, and describes the taxel under the mouse pointer.
#pragma once

#include <QPixmap>
#include <QWidget>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include <palpate/model/taxel_selection.h>

#include "gui/appearance/display_units.h"
#include "gui/matrices/matrices_painter.h"
#include "gui/picture/stale_notice.h"

namespace palpate {
struct PressureFrame;
}

namespace palpate::gui {

// How the view shows values; its owner computes the range.
struct MatricesLook {
  ColorMapName map = ColorMapName::kInferno;
  bool interpolated = false;
  bool values = false;
  ValueRange range;
  TaxelView taxels = TaxelView::kNormal;
  bool isSigned = false;  // isDrawnSigned()
  double arrows = kUsualArrows;
  Theme theme = Theme::kDark;
  bool operator==(const MatricesLook&) const = default;
};

class MatricesView : public QWidget {
  Q_OBJECT
 public:
  explicit MatricesView(QWidget* parent = nullptr);

  // Sets another hand; nothing is shown until its first frame.
  void setHand(const HandDescription& hand);
  void clear();
  void setFrame(const TactileFrame& frame);
  // Pressures, shown with the counts of the taxel under the mouse pointer; null: no calibration is
  // applied.
  void setPressure(std::shared_ptr<const PressureFrame> pressure);
  // The unit of these pressures.
  void setUnits(const DisplayUnits& units);
  void setLook(const MatricesLook& look);
  const MatricesLook& look() const noexcept { return look_; }
  const MatricesGeometry& geometryOfMatrices() const noexcept { return geometry_; }
  // Describes the taxel under the mouse pointer: "finger 0 distal · x 3, y 5 · 812 counts"; empty
  // beside the taxels.
  QString hoverText() const;

  // Click and drag select taxels, Ctrl adds to the selection, a click beside the taxels (or Escape)
  // clears it. With the focus, Return lets the arrow keys move to the next taxel in their
  // direction, Space select or deselect it, and Shift with an arrow key select on the way; Return
  // once more ends it.
  const TaxelSelection& selection() const noexcept { return selection_; }
  void select(const TaxelSelection& selection);
  void clearSelection();
  // Marks matrices that can't measure the limit set for a grasp; the reason is also shown with
  // their counts. One text per matrix, empty: it can. An empty vector: all can, or nothing is
  // connected.
  void setUnmeasurable(const std::vector<QString>& why);
  const std::vector<QString>& unmeasurable() const noexcept { return unmeasurable_; }
  // Marks matrices whose contact slips.
  void setSlipping(const std::set<std::size_t>& matrices);
  const std::set<std::size_t>& slipping() const noexcept { return slipping_; }
  // Shows the notice over a stale or held picture.
  void setStale(const StaleNotice& old);
  const QString& notice() const noexcept { return stale_.notice; }
  // Time of the newest frame that is completely painted [us since 1970]; 0: none yet.
  std::int64_t paintedUs() const noexcept { return paintedUs_; }
  QSize sizeHint() const override { return {560, 560}; }
  QSize minimumSizeHint() const override { return {220, 130}; }

 signals:
  void hovered(const QString& text);
  void selectionChanged();
  // The right mouse button was pressed.
  void menuRequested(const QPoint& globalPosition);
  // The first paint event that shows a frame has ended.
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
  void keyPressEvent(QKeyEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;
  // Takes its keys before they are shortcuts of the window.
  bool event(QEvent* event) override;

 private:
  // The nearest taxel in a direction; the same one where there is none. The first one of all for no
  // `from`.
  std::optional<TaxelPlace> neighbour(const std::optional<TaxelPlace>& from,
                                      const QPoint& direction) const;
  MatricesPictureOptions pictureOptions() const;
  void renew();
  void setHover(std::optional<TaxelPlace> place);
  void choose(const TaxelPlace& from, const TaxelPlace& to);
  void paintSelection(QPainter& painter) const;
  void paintUnmeasurable(QPainter& painter) const;
  // A frame around a matrix, with a word at its lower end.
  void paintFrame(QPainter& painter, std::size_t matrix, const QString& word) const;

  std::optional<HandDescription> hand_;
  std::optional<TactileFrame> frame_;
  std::shared_ptr<const PressureFrame> pressure_;
  DisplayUnits units_;
  MatricesLook look_;
  MatricesGeometry geometry_;
  QPixmap background_;
  std::optional<TaxelPlace> hover_;
  // Whether the user asked for it by Return: arrow keys and Space play and step otherwise. The
  // focus is not enough, which Qt passes on when another control is hidden.
  bool hasKeys_ = false;
  TaxelSelection selection_;
  // The selection to which a drag adds.
  TaxelSelection selectedBefore_;
  // Where the drag began.
  std::optional<TaxelPlace> pressed_;
  StaleNotice stale_;
  std::vector<QString> unmeasurable_;
  std::set<std::size_t> slipping_;
  std::int64_t paintedUs_ = 0;
};

}  // namespace palpate::gui
