// The hand in space as a widget: with OpenGL where it can be had, painted without else. Turned by
// dragging; taxels are chosen with Ctrl. Draws only when something has changed.
#pragma once

#include <QPoint>
#include <QWidget>
#include <memory>
#include <optional>
#include <vector>

#include "gui/hand3d/hand_picture.h"
#include "gui/hand3d/hand_raster.h"
#include "gui/hand3d/hand_scene_builder.h"
#include "gui/picture/stale_notice.h"

namespace palpate {
struct PressureFrame;
}

namespace palpate::gui {

class HandGlCanvas;

class HandView : public QWidget {
  Q_OBJECT
 public:
  explicit HandView(QWidget* parent = nullptr);

  // From now on with OpenGL; for those who know that it can be had (gl_probe.h). Back to painting
  // if it fails.
  void useOpenGl();

  // Another hand; the camera goes back to where it shows all of it.
  void setHand(const HandDescription& hand);
  void clear();
  // Of one frame: no angles, the rest pose, greyed.
  void setMoment(const TactileFrame& frame, const std::vector<double>& anglesDeg);
  // For a hand without recorded angles; empty: none are assumed.
  void setAssumedAngles(const std::vector<double>& anglesDeg);
  const std::vector<double>& assumedAngles() const noexcept { return assumedDeg_; }
  void setLook(const HandLook& look);
  const HandLook& look() const noexcept { return look_; }
  // Where no heat maps stand beside it.
  void setColorBar(bool shown);
  void select(const TaxelSelection& selection);
  const TaxelSelection& selection() const noexcept { return selection_; }

  // Over an old picture, as in the heat maps.
  void setStale(const StaleNotice& old);
  const QString& notice() const noexcept { return stale_.notice; }

  const HandSceneBuilder& drawing() const noexcept { return drawing_; }
  const HandCamera& camera() const noexcept { return camera_; }
  void setCamera(const HandCamera& camera);
  // What the first view shows all of [mm]; forgotten with the next hand. Empty: the first frame.
  void setExtent(std::vector<Eigen::Vector3d> pointsMm);
  // Everything that is drawn, from where the eye is; from where it stood at first.
  void fit();
  void resetCamera();
  // By keys: part of a turn or of the height of the view; a factor > 1 comes nearer.
  void orbitBy(double rightDeg, double upDeg);
  void panBy(double rightShare, double upShare);
  void zoomBy(double factor);
  // "finger 0 distal · x 3, y 5 · 812 counts"; empty beside the taxels.
  QString hoverText() const;
  // How the contacts move; empty: not known.
  void setSlip(std::vector<HandSlip> slip);
  void setPressure(std::shared_ptr<const PressureFrame> pressure);  // as MatricesView has it
  // What is seen, for a picture of its own: `page` gives size and colours.
  HandPictureOptions pictureOptions(const MatricesPictureOptions& page) const;
  bool usesOpenGl() const noexcept { return canvas_ != nullptr; }
  // How many times it has been drawn.
  int numPaints() const noexcept { return numPaints_; }
  QSize sizeHint() const override { return {520, 560}; }
  QSize minimumSizeHint() const override { return {240, 200}; }

 signals:
  void selectionChanged();
  void hovered(const QString& text);
  void openGlFailed(const QString& why);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  enum class Drag { kNone, kClick, kOrbit, kPan, kZoom, kChoose };
  void renew();
  void drawAnew();
  void fitTo(const std::vector<Eigen::Vector3d>& pointsMm);
  void fitFirstView();
  void paintOver(QPainter& painter);
  void fallBack(const QString& why);
  std::optional<TaxelPlace> placeAt(const QPointF& at) const;
  void choose(const TaxelPlace& place, bool clicked);
  void setHover(std::optional<TaxelPlace> place);
  HandPictureOptions options() const;

  HandGlCanvas* canvas_ = nullptr;
  HandSceneBuilder drawing_;
  HandScene scene_;
  HandRaster raster_;
  bool sceneIsOld_ = true;
  HandLook look_;
  HandCamera camera_;
  std::vector<Eigen::Vector3d> extent_;
  bool moved_ = false;  // by the user: a resize leaves the camera alone
  bool colorBar_ = false;
  std::vector<double> assumedDeg_;
  bool assumed_ = false;
  StaleNotice stale_;
  TaxelSelection selection_;
  std::optional<TaxelPlace> hover_;
  std::shared_ptr<const PressureFrame> pressure_;
  Drag drag_ = Drag::kNone;
  QPointF pressed_, last_;
  int numPaints_ = 0;
};

}  // namespace palpate::gui
