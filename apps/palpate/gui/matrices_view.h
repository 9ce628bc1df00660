// The heat maps as a widget. Keeps everything that doesn't change as a pixmap, repaints only the
// matrices whose values changed, and tells what lies under the mouse.
#pragma once

#include <QPixmap>
#include <QWidget>
#include <optional>

#include "gui/matrices_painter.h"

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
  void setLook(const MatricesLook& look);
  const MatricesLook& look() const noexcept { return look_; }
  const MatricesGeometry& geometryOfMatrices() const noexcept { return geometry_; }
  // What lies under the mouse: "finger 0 distal · x 3, y 5 · 812 counts"; empty beside the taxels.
  QString hoverText() const;
  QSize sizeHint() const override { return {560, 560}; }
  QSize minimumSizeHint() const override { return {320, 240}; }

 signals:
  void hovered(const QString& text);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  MatricesPictureOptions pictureOptions() const;
  void renew();
  void setHover(std::optional<TaxelPlace> place);

  std::optional<HandDescription> hand_;
  std::optional<TactileFrame> frame_;
  MatricesLook look_;
  MatricesGeometry geometry_;
  QPixmap background_;
  std::optional<TaxelPlace> hover_;
};

}  // namespace palpate::gui
