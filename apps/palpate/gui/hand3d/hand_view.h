// The widget that shows the hand in 3-D: with OpenGL where available, else drawn by HandRaster.
// Dragging turns it; Ctrl selects taxels. It draws only when something has changed.
#pragma once

#include <QPoint>
#include <QWidget>
#include <memory>
#include <optional>
#include <vector>

#include "gui/appearance/display_units.h"
#include "gui/hand3d/hand_picture.h"
#include "gui/hand3d/hand_raster.h"
#include "gui/hand3d/hand_scene_builder.h"
#include "gui/picture/stale_notice.h"
#include "gui/source/file_reading.h"

namespace palpate {
struct PressureFrame;
}

namespace palpate::gui {

class HandGlCanvas;

class HandView : public QWidget {
  Q_OBJECT
 public:
  explicit HandView(QWidget* parent = nullptr);

  // Draws with OpenGL from now on; call it only if OpenGL is available (gl_probe.h). Returns to
  // drawing without it if it fails.
  void useOpenGl();

  // Sets another hand; the camera returns to the view of the whole hand.
  void setHand(const HandDescription& hand);
  void clear();
  // Sets frame and joint angles [deg]; without angles the rest pose is drawn, greyed.
  void setMoment(const TactileFrame& frame, const std::vector<double>& anglesDeg);
  // As setMoment(), for frames of a running hand: while the hand stands still, the colours of its
  // taxels are drawn anew 16 times a second at most, and when the stream stops (setStale()).
  // Drawing the hand takes more time than anything else in a window that is live.
  void setLiveMoment(const TactileFrame& frame, const std::vector<double>& anglesDeg);
  // Sets the objects around an emulated hand, before its moment.
  void setObjects(const std::vector<SceneObject>& objects);
  // Angles for a recording that has none [deg]; empty: none are assumed.
  void setAssumedAngles(const std::vector<double>& anglesDeg);
  const std::vector<double>& assumedAngles() const noexcept { return assumedDeg_; }
  void setLook(const HandLook& look);
  const HandLook& look() const noexcept { return look_; }
  // Shows a colour bar; needed when the heat maps aren't visible beside this view.
  void setColorBar(bool shown);
  void select(const TaxelSelection& selection);
  const TaxelSelection& selection() const noexcept { return selection_; }

  // Shows the notice over a stale picture, as in the heat maps.
  void setStale(const StaleNotice& old);
  const QString& notice() const noexcept { return stale_.notice; }

  const HandSceneBuilder& drawing() const noexcept { return drawing_; }
  const HandCamera& camera() const noexcept { return camera_; }
  void setCamera(const HandCamera& camera);
  // Points that the first view must show [mm], valid until the next hand. Empty: those of the first
  // frame.
  void setExtent(std::vector<Eigen::Vector3d> pointsMm);
  // fit() shows everything from the present direction, resetCamera() from the default one.
  void fit();
  void resetCamera();
  // For keys: angles, shares of the height of the view, and a factor > 1 that comes nearer.
  void orbitBy(double rightDeg, double upDeg);
  void panBy(double rightShare, double upShare);
  void zoomBy(double factor);
  // Describes the taxel under the mouse pointer: "finger 0 distal · x 3, y 5 · 812 counts"; empty
  // beside the taxels.
  QString hoverText() const;
  // Slip of the contacts; empty: not known.
  void setSlip(std::vector<HandSlip> slip);
  // As in MatricesView.
  void setPressure(std::shared_ptr<const PressureFrame> pressure);
  // The unit of these pressures.
  void setUnits(const DisplayUnits& units);
  // Options for an exported picture of the view; `page` gives size and colours.
  HandPictureOptions pictureOptions(const MatricesPictureOptions& page) const;
  bool usesOpenGl() const noexcept { return canvas_ != nullptr; }
  // Number of times the view has been drawn.
  int numPaints() const noexcept { return numPaints_; }
  QSize sizeHint() const override { return {520, 560}; }
  QSize minimumSizeHint() const override { return {180, 120}; }

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
  void takeMoment(const TactileFrame& frame, const std::vector<double>& anglesDeg, bool live);
  void drawAnew();
  bool leavesView() const;
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
  FileReading meshes_{this};
  HandScene scene_;
  HandRaster raster_;
  bool sceneIsOld_ = true;
  // Time stamp of the frame when the view was last drawn anew [us since 1970].
  std::int64_t drawnUs_ = 0;
  HandLook look_;
  HandCamera camera_;
  std::vector<Eigen::Vector3d> extent_;
  // The user has moved the camera: a resize doesn't change it then.
  bool moved_ = false;
  bool colorBar_ = false;
  std::vector<double> assumedDeg_;
  bool assumed_ = false;
  StaleNotice stale_;
  TaxelSelection selection_;
  std::optional<TaxelPlace> hover_;
  std::shared_ptr<const PressureFrame> pressure_;
  DisplayUnits units_;
  Drag drag_ = Drag::kNone;
  QPointF pressed_, last_;
  int numPaints_ = 0;
};

}  // namespace palpate::gui
