// Whether the hand in space can be drawn with OpenGL here.
#pragma once

#include <QString>
#include <filesystem>
#include <functional>

class QObject;

namespace palpate::gui {

// Empty when a context of OpenGL 3.3 (core profile) can be had and draws; else why not, as the end
// of a sentence. Never on platforms whose windows have none (offscreen, minimal, ..): Qt 6.4's
// QOpenGLWidget crashes there. Needs a QGuiApplication, and its thread. Some drivers crash: see
// below.
//
// Without a graphics card Mesa draws on the processor. That takes longer than hand_raster.h, which
// needs no OpenGL: 800 x 600 in 20 ms on two cores against 5 ms on one. So kRefuse says no to it.
enum class SoftwareGl { kTake, kRefuse };
QString openGlProblem(SoftwareGl software = SoftwareGl::kTake);
// Whether a driver of that name (GL_RENDERER) is a program only.
bool isSoftwareRenderer(const QString& renderer);

// The same, with kRefuse, asked of another process (`program --probe-opengl`, one that calls
// answerOpenGlProbe()): a driver that crashes or hangs takes that one along and not the window, and
// the window doesn't wait. `answer` is called once, in this thread, later; never when `context` is
// gone by then. Where no program can be started: why it couldn't.
void askForOpenGl(const std::filesystem::path& program,
                  QObject* context,
                  std::function<void(const QString& why)> answer,
                  int patienceMs = 10'000);

// What that other process does: prints why there is none, if so. Returns its exit code: 0 there is,
// 1 there isn't.
int answerOpenGlProbe(int& argc, char** argv);

}  // namespace palpate::gui
