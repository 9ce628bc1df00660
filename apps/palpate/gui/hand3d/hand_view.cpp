#include "gui/hand3d/hand_view.h"

#include <QEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QTimer>
#include <QToolTip>
#include <cmath>

#include "gui/hand3d/hand_gl_canvas.h"
#include "gui/hand3d/hand_raster.h"
#include "gui/matrices/taxel_text.h"

namespace palpate::gui {
namespace {

// Least time between two drawings of which only the colours differ [us]: every second frame of an
// SDH-2.
constexpr std::int64_t kLiveColorsUs = 50'000;
// A shorter movement is a click, not a drag.
constexpr double kClickPx = 4.0;
// Zoom factor per eighth of a degree of the wheel.
constexpr double kHandViewWheelStep = 1.0015;
// Margin around the fitted points, since fingers move and spheres appear.
constexpr double kRoom = 1.06;
// Zoom factor per px.
constexpr double kDragZoom = 1.006;

}  // namespace

HandView::HandView(QWidget* parent) : QWidget(parent) {
  setMouseTracking(true);
  setFocusPolicy(Qt::ClickFocus);
  setAccessibleName("Hand in 3-D");
  setAttribute(Qt::WA_OpaquePaintEvent);
}

void HandView::useOpenGl() {
  if (canvas_) return;
  setAttribute(Qt::WA_OpaquePaintEvent, false);
  canvas_ = new HandGlCanvas(this);
  canvas_->setAttribute(Qt::WA_TransparentForMouseEvents);
  canvas_->scene = [this]() -> const HandScene& {
    renew();
    return scene_;
  };
  canvas_->camera = [this]() -> const HandCamera& { return camera_; };
  canvas_->paintOver = [this](QPainter& painter) { paintOver(painter); };
  connect(canvas_, &HandGlCanvas::failed, this, &HandView::fallBack);
  canvas_->setGeometry(rect());
  canvas_->show();
}

// Must not be called during a paint event of the canvas.
void HandView::fallBack(const QString& why) {
  if (!canvas_) return;
  canvas_->hide();
  canvas_->deleteLater();
  canvas_ = nullptr;
  setAttribute(Qt::WA_OpaquePaintEvent);
  update();
  emit openGlFailed(why);
}

void HandView::setHand(const HandDescription& hand) {
  // When only the scanned taxels change, the hand is the same and the camera stays.
  const TaxelSelection fresh(*hand.layout);
  const bool same = drawing_.hasHand() && TaxelSelection(*drawing_.hand().layout).sameSensor(fresh);
  drawing_.setHand(hand, false);
  meshes_.abandon();
  if (const auto geometry = drawing_.meshesMissing())
    meshes_.start(
        [this, geometry]() -> FileReading::Take {
          return [this, bodies = handBodies(*geometry)] {
            drawing_.setBodies(bodies);
            if (!moved_) fitFirstView();
            drawAnew();
          };
        },
        [](const QString&) {});
  extent_.clear();
  if (!selection_.sameSensor(fresh)) selection_ = fresh;
  drawing_.setSelection(selection_);
  setHover(std::nullopt);
  if (!same) resetCamera();
  drawAnew();
}

void HandView::clear() {
  meshes_.abandon();
  drawing_.clear();
  stale_ = {};
  selection_ = {};
  setHover(std::nullopt);
  drawAnew();
}

void HandView::setObjects(const std::vector<SceneObject>& objects) {
  if (drawing_.setObjects(objects)) sceneIsOld_ = true;
}

void HandView::setMoment(const TactileFrame& frame, const std::vector<double>& anglesDeg) {
  takeMoment(frame, anglesDeg, false);
}

void HandView::setLiveMoment(const TactileFrame& frame, const std::vector<double>& anglesDeg) {
  takeMoment(frame, anglesDeg, true);
}

void HandView::takeMoment(const TactileFrame& frame,
                          const std::vector<double>& anglesDeg,
                          bool live) {
  if (!drawing_.hasHand()) return;
  const HandState& shown = drawing_.handState();
  assumed_ = anglesDeg.empty() && !assumedDeg_.empty() && !drawing_.hand().axes.empty();
  const std::vector<double>& angles = assumed_ ? assumedDeg_ : anglesDeg;
  const std::int64_t sinceUs = frame.hostUs - drawnUs_;
  const bool tooSoon = live && sinceUs >= 0 && sinceUs < kLiveColorsUs;
  if (shown.frame && shown.frame->values == frame.values && shown.anglesDeg == angles) {
    if (sceneIsOld_ && !tooSoon) drawAnew();
    return;
  }
  const bool first = !shown.frame;
  const bool moves = shown.anglesDeg != angles;
  drawing_.setMoment(frame, angles);
  if (!moved_ && (first || (live && moves && leavesView()))) fitFirstView();
  if (tooSoon && !first && !moves)
    sceneIsOld_ = true;
  else
    drawAnew();
  if (hover_) emit hovered(hoverText());
}

void HandView::setAssumedAngles(const std::vector<double>& anglesDeg) {
  assumedDeg_ = anglesDeg;
  if (const auto frame = drawing_.handState().frame; frame && (assumed_ || !drawing_.posed()))
    setMoment(*frame, {});
}

void HandView::setLook(const HandLook& look) {
  if (look == look_) return;
  const HandLook before = drawing_.effective(look_), after = drawing_.effective(look);
  look_ = look;
  // Another object is shown: the camera returns to its default.
  if (isFlat(before.taxels) != isFlat(after.taxels) || before.only != after.only ||
      (isFlat(after.taxels) && before.taxels != after.taxels))
    resetCamera();
  drawAnew();
}

void HandView::setColorBar(bool shown) {
  if (shown == colorBar_) return;
  colorBar_ = shown;
  drawAnew();
}

void HandView::select(const TaxelSelection& selection) {
  if (selection == selection_) return;
  selection_ = selection;
  drawing_.setSelection(selection_);
  drawAnew();
  emit selectionChanged();
}

void HandView::setCamera(const HandCamera& camera) {
  camera_ = camera;
  drawAnew();
}

// Whether a part of the hand lies outside the picture: a hand that opens moves out of the view that
// was fitted to a closed one.
bool HandView::leavesView() const {
  const QRectF picture(rect());
  for (const Eigen::Vector3d& pointMm : drawing_.extent(drawing_.effective(look_))) {
    const auto seen = camera_.project(pointMm, size());
    if (!seen || !picture.contains(seen->at)) return true;
  }
  return false;
}

void HandView::drawAnew() {
  sceneIsOld_ = true;
  if (const auto& frame = drawing_.handState().frame) drawnUs_ = frame->hostUs;
  update();
  if (canvas_) canvas_->update();
}

void HandView::resetCamera() {
  camera_ = drawing_.usualCamera(look_);
  moved_ = false;
  fitFirstView();
}

void HandView::setExtent(std::vector<Eigen::Vector3d> pointsMm) {
  extent_ = std::move(pointsMm);
  if (!moved_) fitFirstView();
}

void HandView::fitTo(const std::vector<Eigen::Vector3d>& pointsMm) {
  HandCamera camera = camera_;
  // The notice of a sensor without geometry stays: its taxels are below it.
  const double above =
      drawing_.hasGeometry() ? 0.0 : noticeHeight(font(), width(), poseNotice(drawing_, assumed_));
  const double whole = std::max(1, height());
  const double room = std::max(0.5 * whole, whole - above);
  camera.fit(pointsMm, std::max(1, width()) / room);
  camera.distanceMm *= kRoom * whole / room;
  camera.pan({0.0, 0.5 * (whole - room)}, whole);
  setCamera(camera);
}

void HandView::fitFirstView() {
  const HandLook look = drawing_.effective(look_);
  const bool ofAll = !extent_.empty() && !isFlat(look.taxels) && !look.only;
  if (!ofAll) return fitTo(drawing_.extent(look));
  auto pointsMm = extent_;
  // The extent is without the bodies that files describe.
  if (drawing_.drawsMeshes()) {
    const auto now = drawing_.extent(look);
    pointsMm.insert(pointsMm.end(), now.begin(), now.end());
  }
  fitTo(pointsMm);
}

void HandView::fit() { fitTo(drawing_.extent(look_)); }

void HandView::orbitBy(double rightDeg, double upDeg) {
  HandCamera camera = camera_;
  camera.azimuthDeg -= rightDeg;
  camera.elevationDeg = std::clamp(camera.elevationDeg + upDeg, -89.0, 89.0);
  moved_ = true;
  setCamera(camera);
}

void HandView::panBy(double rightShare, double upShare) {
  HandCamera camera = camera_;
  camera.pan(QPointF(rightShare, -upShare) * height(), height());
  moved_ = true;
  setCamera(camera);
}

void HandView::zoomBy(double factor) {
  HandCamera camera = camera_;
  camera.zoom(factor, QRectF(rect()).center(), size());
  moved_ = true;
  setCamera(camera);
}

HandPictureOptions HandView::options() const {
  HandPictureOptions options;
  options.page.size = size();
  options.page.map = look_.map;
  options.page.rangeMin = look_.range.minimum;
  options.page.rangeMax = look_.range.maximum;
  options.page.taxels = look_.view;
  options.page.isSigned = look_.isSigned;
  options.page.arrows = look_.arrows;
  options.page.theme = look_.theme;
  options.page.font = font();
  options.page.colorBar = colorBar_;
  options.look = look_;
  options.camera = camera_;
  options.notice = poseNotice(drawing_, assumed_);
  return options;
}

HandPictureOptions HandView::pictureOptions(const MatricesPictureOptions& page) const {
  HandPictureOptions of = options();
  of.page = page;
  return of;
}

void HandView::renew() {
  if (!sceneIsOld_) return;
  sceneIsOld_ = false;
  drawing_.fill(scene_, look_, camera_);
  if (!hover_ || hover_->matrix >= drawing_.hand().layout->numMatrices()) return;
  const MatrixLayout& layout = drawing_.hand().layout->matrix(hover_->matrix);
  const TaxelPatch& patch = drawing_.patches(
      drawing_.effective(look_))[drawing_.hand().layout->offset(hover_->matrix) +
                                 static_cast<std::size_t>(hover_->y * layout.columns + hover_->x)];
  for (std::size_t i = 0; i < 4; ++i)
    scene_.lines.push_back({patch.cornersMm[i] + patch.normal * 0.5F,
                            patch.cornersMm[(i + 1) % 4] + patch.normal * 0.5F,
                            2.0F,
                            colorsOf(look_.theme).accent.rgb()});
}

void HandView::paintEvent(QPaintEvent*) {
  if (canvas_) return;
  QPainter painter(this);
  renew();
  painter.drawImage(QRectF(rect()), raster_.draw(scene_, camera_, size(), devicePixelRatioF()));
  paintOver(painter);
}

void HandView::paintOver(QPainter& painter) {
  ++numPaints_;
  if (drawing_.hasHand()) paintHandOverlay(painter, rect(), drawing_, scene_, options());
  painter.setFont(font());
  paintStaleNotice(painter, rect(), stale_, look_.theme);
}

void HandView::setStale(const StaleNotice& old) {
  if (old == stale_) return;
  stale_ = old;
  update();
  if (canvas_) canvas_->update();
}

void HandView::resizeEvent(QResizeEvent*) {
  if (canvas_) canvas_->setGeometry(rect());
  if (!moved_) fitFirstView();
}

void HandView::changeEvent(QEvent* event) {
  if (event->type() == QEvent::FontChange) update();
  QWidget::changeEvent(event);
}

std::optional<TaxelPlace> HandView::placeAt(const QPointF& at) const {
  return drawing_.taxelUnder(camera_.eyeMm(), camera_.rayAt(at, size()), look_);
}

void HandView::choose(const TaxelPlace& place, bool clicked) {
  TaxelSelection wanted = selection_;
  if (clicked && wanted.contains(place.matrix, place.y, place.x))
    wanted.toggle(place.matrix, place.y, place.x);
  else
    wanted.add(place.matrix, place.y, place.x, place.y, place.x);
  select(wanted);
}

void HandView::mousePressEvent(QMouseEvent* event) {
  pressed_ = last_ = event->position();
  if (!drawing_.hasHand()) return;
  const bool more = event->modifiers() & Qt::ControlModifier;
  const bool shift = event->modifiers() & Qt::ShiftModifier;
  if (event->button() == Qt::LeftButton && more) {
    drag_ = Drag::kChoose;
    if (const auto place = placeAt(event->position())) choose(*place, true);
  } else if (event->button() == Qt::MiddleButton || (event->button() == Qt::LeftButton && shift)) {
    drag_ = Drag::kPan;
  } else if (event->button() == Qt::LeftButton) {
    drag_ = Drag::kClick;
  } else if (event->button() == Qt::RightButton) {
    drag_ = Drag::kZoom;
  }
}

void HandView::mouseMoveEvent(QMouseEvent* event) {
  const QPointF by = event->position() - last_;
  if (drag_ == Drag::kClick && QLineF(pressed_, event->position()).length() >= kClickPx)
    drag_ = Drag::kOrbit;
  HandCamera camera = camera_;
  switch (drag_) {
    case Drag::kNone:
      setHover(placeAt(event->position()));
      if (hover_)
        QToolTip::showText(event->globalPosition().toPoint() + QPoint(12, 8), hoverText(), this);
      else
        QToolTip::hideText();
      return;
    case Drag::kClick:
      return;
    case Drag::kChoose:
      if (const auto place = placeAt(event->position())) choose(*place, false);
      return;
    case Drag::kOrbit:
      camera.orbit(by, height());
      break;
    case Drag::kPan:
      camera.pan(by, height());
      break;
    case Drag::kZoom:
      camera.zoom(std::pow(kDragZoom, -by.y()), pressed_, size());
      break;
  }
  last_ = event->position();
  moved_ = true;
  setHover(std::nullopt);
  setCamera(camera);
}

void HandView::mouseReleaseEvent(QMouseEvent* event) {
  // A click without a drag selects, as in the heat maps; beside the taxels it clears the selection.
  if (drag_ == Drag::kClick && drawing_.hasHand()) {
    TaxelSelection none = selection_;
    none.clear();
    if (const auto place = placeAt(event->position()))
      none.add(place->matrix, place->y, place->x, place->y, place->x);
    select(none);
  }
  drag_ = Drag::kNone;
}

void HandView::mouseDoubleClickEvent(QMouseEvent*) { fit(); }

void HandView::wheelEvent(QWheelEvent* event) {
  HandCamera camera = camera_;
  camera.zoom(std::pow(kHandViewWheelStep, event->angleDelta().y()), event->position(), size());
  moved_ = true;
  setCamera(camera);
  event->accept();
}

void HandView::leaveEvent(QEvent*) { setHover(std::nullopt); }

void HandView::setHover(std::optional<TaxelPlace> place) {
  if (place == hover_) return;
  hover_ = place;
  drawAnew();
  emit hovered(hoverText());
}

void HandView::setSlip(std::vector<HandSlip> slip) {
  if (slip == drawing_.slip()) return;
  drawing_.setSlip(std::move(slip));
  drawAnew();
}

void HandView::setPressure(std::shared_ptr<const PressureFrame> pressure) {
  pressure_ = std::move(pressure);
  if (hover_) emit hovered(hoverText());
}

void HandView::setUnits(const DisplayUnits& units) {
  units_ = units;
  if (hover_) emit hovered(hoverText());
}

QString HandView::hoverText() const {
  if (!hover_ || !drawing_.hasHand()) return {};
  return taxelText(drawing_.hand(), *hover_, drawing_.handState().frame, pressure_.get(), units_);
}

}  // namespace palpate::gui
