#include "gui/hand3d/gl_probe.h"

#include <QGuiApplication>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QOpenGLFramebufferObject>
#include <QOpenGLFunctions>
#include <QPointer>
#include <QProcess>
#include <QTimer>
#include <array>
#include <cstdio>
#include <memory>

#include "gui/desktop/application.h"
#include "gui/hand3d/hand_gl.h"

namespace palpate::gui {

namespace {

// Side of the picture that is drawn as a trial [px].
constexpr int kSide = 8;

// Draws a red square that fills the picture, and reads it back.
QString tryToDraw() {
  HandGl gl;
  if (const QString why = gl.initialize(); !why.isEmpty()) return why;
  QOpenGLFramebufferObject target(kSide, kSide, QOpenGLFramebufferObject::Depth);
  if (!target.isValid() || !target.bind())
    return QStringLiteral("the driver provides no framebuffer");
  const HandCamera camera;
  const Eigen::Vector3f middle = camera.targetMm.cast<float>();
  HandScene scene;
  const Eigen::Matrix3f axes = camera.eyeFromBase().cast<float>();
  for (const auto& [right, up] : std::array<std::pair<float, float>, 3>{
           {{-2000.0F, -1000.0F}, {2000.0F, -1000.0F}, {0.0F, 2000.0F}}}) {
    const Eigen::Vector3f at = middle + (axes.row(0) * right + axes.row(1) * up).transpose();
    scene.solid.push_back({.positionMm = {at.x(), at.y(), at.z()}, .color = qRgb(255, 0, 0)});
  }
  gl.draw(scene, camera, QSizeF(kSide, kSide));
  const QRgb seen = target.toImage().pixel(kSide / 2, kSide / 2);
  target.release();
  gl.release();
  return (seen & RGB_MASK) == (qRgb(255, 0, 0) & RGB_MASK)
             ? QString()
             : QStringLiteral("the driver draws nothing");
}

}  // namespace

bool isSoftwareRenderer(const QString& renderer) {
  for (const char* name : {"llvmpipe", "softpipe", "swrast", "Software Rasterizer", "SwiftShader"})
    if (renderer.contains(QLatin1String(name), Qt::CaseInsensitive)) return true;
  return false;
}

QString openGlProblem(SoftwareGl software) {
  if (!qobject_cast<QGuiApplication*>(QCoreApplication::instance()))
    return QStringLiteral("there is no window system");
  const QString platform = QGuiApplication::platformName();
  for (const char* without : {"offscreen", "minimal", "vnc", "linuxfb"})
    if (platform == QLatin1String(without))
      return QStringLiteral("the platform \"%1\" has no OpenGL").arg(platform);
  QSurfaceFormat format;
  format.setVersion(3, 3);
  format.setProfile(QSurfaceFormat::CoreProfile);
  format.setDepthBufferSize(24);
  QOffscreenSurface surface;
  surface.setFormat(format);
  surface.create();
  QOpenGLContext context;
  context.setFormat(format);
  if (!context.create()) return QStringLiteral("the window system provides no OpenGL context");
  if (!surface.isValid() || !context.makeCurrent(&surface))
    return QStringLiteral("the OpenGL context can't be used");
  const QString renderer = QString::fromUtf8(
      reinterpret_cast<const char*>(context.functions()->glGetString(GL_RENDERER)));
  const bool refused = software == SoftwareGl::kRefuse && isSoftwareRenderer(renderer);
  const QString why =
      refused ? QStringLiteral("the processor would draw it (%1), which is slower than without")
                    .arg(renderer.section(' ', 0, 0))
              : tryToDraw();
  context.doneCurrent();
  return why;
}

void askForOpenGl(const std::filesystem::path& program,
                  QObject* context,
                  std::function<void(const QString& why)> answer,
                  int patienceMs) {
  auto* process = new QProcess(QCoreApplication::instance());
  // The process ends, doesn't start, or takes too long: the first of these gives the answer.
  const auto finish = [answer = std::move(answer),
                       done = std::make_shared<bool>(false)](const QString& why) {
    if (!std::exchange(*done, true)) answer(why);
  };
  QObject::connect(process, &QProcess::finished, context, [process, finish] {
    const QString said = QString::fromUtf8(process->readAllStandardOutput()).simplified();
    if (process->exitStatus() == QProcess::CrashExit)
      finish(QStringLiteral("the OpenGL driver crashes"));
    else if (process->exitCode() == 0)
      finish({});
    else
      finish(said.isEmpty() ? QStringLiteral("OpenGL can't be tried") : said.left(300));
  });
  QObject::connect(
      process,
      &QProcess::errorOccurred,
      process,
      [process, context = QPointer(context), finish](QProcess::ProcessError error) {
        if (error != QProcess::FailedToStart) return;
        process->deleteLater();
        if (context) finish(QStringLiteral("OpenGL can't be tried"));
      },
      Qt::QueuedConnection);
  QTimer::singleShot(patienceMs, process, [process, context = QPointer(context), finish] {
    if (context) finish(QStringLiteral("the OpenGL driver hangs"));
    process->kill();
  });
  QObject::connect(process, &QProcess::finished, process, &QObject::deleteLater);
  QObject::connect(context, &QObject::destroyed, process, &QProcess::kill);
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  environment.insert(QStringLiteral("QT_QPA_PLATFORM"), QGuiApplication::platformName());
  process->setProcessEnvironment(environment);
  process->setStandardErrorFile(QProcess::nullDevice());
  process->start(QString::fromStdString(program.string()), {QStringLiteral("--probe-opengl")});
}

int answerOpenGlProbe(int& argc, char** argv) {
  const auto application = makeApplication(argc, argv);
  const QString why = openGlProblem(SoftwareGl::kRefuse);
  if (why.isEmpty()) return 0;
  std::puts(qUtf8Printable(why));
  return 1;
}

}  // namespace palpate::gui
