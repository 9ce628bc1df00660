#include "gui/hand3d/gl_probe.h"

#include <QGuiApplication>
#include <QOpenGLContext>
#include <QProcess>
#include <QTest>
#include <filesystem>
#include <optional>

#include "testing/testing.h"

namespace palpate::gui::gl_probe_test {
namespace {

namespace fs = std::filesystem;

class GlProbeTest : public ::testing::Test {
 protected:
  // A program that does what `script` says.
  fs::path program(const std::string& script) {
    const fs::path path = folder_ / "program";
    palpate::testing::writeFile(path, "#!/bin/sh\n" + script + "\n");
    fs::permissions(path, fs::perms::owner_all);
    return path;
  }
  QString answerOf(const fs::path& asked, int patienceMs = 10'000) {
    std::optional<QString> said;
    askForOpenGl(
        asked,
        &context_,
        [&](const QString& why) {
          EXPECT_FALSE(said) << "answered twice";
          said = why;
        },
        patienceMs);
    EXPECT_FALSE(said) << "answered at once";
    EXPECT_TRUE(QTest::qWaitFor([&] { return said.has_value(); }, 20'000));
    EXPECT_TRUE(QTest::qWaitFor(
        [] { return QCoreApplication::instance()->findChildren<QProcess*>().isEmpty(); }, 20'000))
        << "a process was left behind";
    return said.value_or("no answer");
  }

  palpate::testing::TemporaryFolder folder_;
  QObject context_;
};

TEST_F(GlProbeTest, PlatformsWithoutWindowsHaveNone) {
  const QString platform = QGuiApplication::platformName();
  if (platform == "offscreen" || platform == "minimal") {
    EXPECT_EQ(openGlProblem(), "the platform \"" + platform + "\" has no OpenGL");
  } else {
    // Whatever the answer: it leaves no context behind.
    openGlProblem();
    EXPECT_EQ(QOpenGLContext::currentContext(), nullptr);
  }
}

TEST_F(GlProbeTest, KnowsDriversThatAreProgramsOnly) {
  for (const char* name : {"llvmpipe (LLVM 15.0.6, 256 bits)",
                           "softpipe",
                           "Software Rasterizer",
                           "Google SwiftShader"})
    EXPECT_TRUE(isSoftwareRenderer(name)) << name;
  for (const char* name : {"Mesa Intel(R) UHD Graphics 620 (KBL GT2)",
                           "AMD Radeon RX 6600 (navi23, LLVM 15.0.6, DRM 3.49)",
                           "NVIDIA GeForce RTX 3060/PCIe/SSE2",
                           "virgl",
                           ""})
    EXPECT_FALSE(isSoftwareRenderer(name)) << name;
  if (openGlProblem().isEmpty() && !openGlProblem(SoftwareGl::kRefuse).isEmpty()) {
    EXPECT_TRUE(openGlProblem(SoftwareGl::kRefuse).startsWith("the processor would draw it ("));
  }
}

TEST_F(GlProbeTest, TheOtherProcessIsAskedOnThisPlatform) {
  const fs::path told = folder_ / "told";
  EXPECT_EQ(answerOf(program("echo $1 $QT_QPA_PLATFORM > '" + told.string() + "'")), "");
  EXPECT_EQ(palpate::testing::readFile(told),
            "--probe-opengl " + QGuiApplication::platformName().toStdString() + "\n");
}

TEST_F(GlProbeTest, ItsReasonIsHandedOn) {
  EXPECT_EQ(answerOf(program("echo 'the driver offers OpenGL 1.4, 3.3 is needed'; exit 1")),
            "the driver offers OpenGL 1.4, 3.3 is needed");
  EXPECT_EQ(answerOf(program("exit 1")), "OpenGL can't be tried");
}

TEST_F(GlProbeTest, ADriverThatCrashesCrashesElsewhere) {
  EXPECT_EQ(answerOf(program("kill -SEGV $$")), "the OpenGL driver crashes");
}

TEST_F(GlProbeTest, ADriverThatHangsIsGivenUp) {
  const fs::path pid = folder_ / "pid";
  EXPECT_EQ(answerOf(program("echo $$ > '" + pid.string() + "'; exec sleep 1000"), 300),
            "the OpenGL driver hangs");
}

TEST_F(GlProbeTest, AProgramThatIsntThereAnswersToo) {
  EXPECT_EQ(answerOf(folder_ / "none"), "OpenGL can't be tried");
}

TEST_F(GlProbeTest, WhoHasGoneIsntAnswered) {
  auto asking = std::make_unique<QObject>();
  askForOpenGl(program("exit 0"), asking.get(), [](const QString&) { ADD_FAILURE(); });
  asking.reset();
  // When no process is left, nobody is going to say anything any more.
  EXPECT_EQ(answerOf(program("exit 0")), "");
}

}  // namespace
}  // namespace palpate::gui::gl_probe_test
