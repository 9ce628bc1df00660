// Finds out whether the hand in 3-D can be drawn with OpenGL on this machine.
#pragma once

#include <QString>
#include <filesystem>
#include <functional>

class QObject;

namespace palpate::gui {

// Returns an empty text when a context of OpenGL 3.3 (core profile) can be created and draws; else
// the reason, as the end of a sentence. Always a reason on platforms whose windows have no OpenGL
// (offscreen, minimal, ..): Qt 6.4's QOpenGLWidget crashes there. Needs a QGuiApplication, and its
// thread. Some drivers crash: see askForOpenGl().
//
// Without a graphics card, Mesa draws on the processor. That takes longer than hand_raster.h, which
// needs no OpenGL: 800 x 600 in 20 ms on two cores against 5 ms on one. Therefore kRefuse rejects
// it.
enum class SoftwareGl { kTake, kRefuse };
QString openGlProblem(SoftwareGl software = SoftwareGl::kTake);
// Whether the driver of this name (GL_RENDERER) draws on the processor.
bool isSoftwareRenderer(const QString& renderer);

// Calls openGlProblem(kRefuse) in another process (`program --probe-opengl`, which calls
// answerOpenGlProbe()): a driver that crashes or hangs ends that process and not the window, and
// the window doesn't wait. `answer` is called once, later, in this thread; never if `context` is
// destroyed before. If the program can't be started, the answer is the reason.
void askForOpenGl(const std::filesystem::path& program,
                  QObject* context,
                  std::function<void(const QString& why)> answer,
                  int patienceMs = 10'000);

// What the other process does: prints why OpenGL can't be used, if so. Returns its exit code: 0
// when OpenGL can be used, else 1.
int answerOpenGlProbe(int& argc, char** argv);

}  // namespace palpate::gui
