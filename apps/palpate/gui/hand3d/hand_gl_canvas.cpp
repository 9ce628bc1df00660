#include "gui/hand3d/hand_gl_canvas.h"

#include <QOpenGLContext>
#include <QOpenGLPaintDevice>
#include <QPainter>
#include <QSurfaceFormat>

namespace palpate::gui {
namespace {

constexpr int kSamples = 4;
constexpr int kDepthBits = 24;

}  // namespace

HandGlCanvas::HandGlCanvas(QWidget* parent) : QOpenGLWidget(parent) {
  QSurfaceFormat format;
  format.setVersion(3, 3);
  format.setProfile(QSurfaceFormat::CoreProfile);
  format.setDepthBufferSize(kDepthBits);
  format.setSamples(kSamples);
  setFormat(format);
}

HandGlCanvas::~HandGlCanvas() {
  if (!context()) return;
  makeCurrent();
  gl_.release();
  doneCurrent();
}

void HandGlCanvas::initializeGL() {
  // A widget that moves into another window gets another context.
  connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, [this] {
    makeCurrent();
    gl_.release();
    doneCurrent();
  });
  const QString why = gl_.initialize();
  if (!why.isEmpty()) fail(why);
}

void HandGlCanvas::fail(const QString& why) {
  if (failed_) return;
  failed_ = true;
  QMetaObject::invokeMethod(
      this, [this, why] { emit failed(why); }, Qt::QueuedConnection);
}

void HandGlCanvas::paintGL() {
  if (failed_) return;
  gl_.draw(scene(), camera(), size(), devicePixelRatioF());
  // Not a painter on this widget: while a picture of the window is taken, painters of its widgets
  // are redirected.
  QOpenGLPaintDevice device(size() * devicePixelRatioF());
  device.setDevicePixelRatio(devicePixelRatioF());
  QPainter painter(&device);
  paintOver(painter);
}

}  // namespace palpate::gui
