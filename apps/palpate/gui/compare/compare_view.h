// The widget with the heat maps of a comparison. It keeps what rarely changes as a pixmap, and
// shows the values of A, B and A - B of the taxel under the mouse.
#pragma once

#include <QPixmap>
#include <QWidget>
#include <optional>

#include "gui/compare/compare_painter.h"

namespace palpate::gui {

class CompareView : public QWidget {
  Q_OBJECT
 public:
  explicit CompareView(QWidget* parent = nullptr);

  void setHands(const ComparedHands& hands);
  void clear();
  void setFrames(ComparedFrames frames);
  // Font and pixel size are taken from the widget.
  void setOptions(const ComparePictureOptions& options);
  const ComparePictureOptions& options() const noexcept { return options_; }
  const ComparedFrames& frames() const noexcept { return frames_; }
  const std::optional<ComparedHands>& hands() const noexcept { return hands_; }
  const CompareGeometry& geometryOfGroups() const noexcept { return geometry_; }
  // "finger 0 distal · x 3, y 5 · A 812 · B 640 · A − B +172 counts"; empty outside the taxels.
  QString hoverText() const;

  // The height is the least one: beside text that wraps, the area that scrolls both would take a
  // larger wanted height for the least one. Stretch shares what there is.
  QSize sizeHint() const override { return {900, 180}; }
  QSize minimumSizeHint() const override { return {420, 180}; }

 signals:
  void hovered(const QString& text);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  void renew();
  void setHover(std::optional<TaxelPlace> place);
  QString valueText(CompareGroup group) const;

  std::optional<ComparedHands> hands_;
  ComparedFrames frames_;
  ComparePictureOptions options_;
  CompareGeometry geometry_;
  QPixmap background_;
  std::optional<TaxelPlace> hover_;
};

}  // namespace palpate::gui
