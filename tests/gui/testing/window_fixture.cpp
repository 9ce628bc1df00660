#include "gui/testing/window_fixture.h"

#include <QSettings>

#include <palpate/core/error.h>
#include <palpate/emulator/synthetic_profile.h>

#include "gui/slip/slip_fixture.h"
#include "gui/source/file_reading.h"
#include "gui/testing/make_active.h"
#include "gui/widgets/message_banner.h"

namespace palpate::gui {
WindowTest::WindowTest() {
  const auto read = [this](const std::filesystem::path& path, const Progress& progress) {
    ++reads_;
    const std::string name = path.filename().string();
    if (name.starts_with("good")) return twentyFrames();
    if (name.starts_with("gap")) {
      std::vector<std::int64_t> stamps;
      for (std::int64_t i = 0; i < 10; ++i) stamps.push_back(50 * i + (i > 4 ? 10'020 : 0));
      return profileWithStamps(stamps);
    }
    if (name.starts_with("empty")) return profileWithStamps({});
    if (name.starts_with("undated")) return undatedFrames();
    if (name.starts_with("rich")) return synthesize({.durationS = 4.0, .grasps = 1});
    if (name.starts_with("slip")) return movingContact();
    while (name.starts_with("slow"))
      if (!progress(0.5)) throw Cancelled();
    throw FormatError(path, "is not a recording: <b>no frames</b>", 17);
  };
  environment_ = {.dataFolder = folder_.path(),
                  .settingsPath = settingsFile(),
                  .clock = &clock_,
                  .read = asRecording(read),
                  .ask = &ask_};
}

WindowTest::~WindowTest() {
  window_.reset();
  // What it left may still read the files of the test.
  EXPECT_TRUE(Abandonable::awaitThreads(std::chrono::seconds(20)));
}

MainWindow& WindowTest::start() {
  window_.reset();
  qApp->setStyleSheet(
      {});  // as the program starts; with one, building a window takes twice as long
  window_ = std::make_unique<MainWindow>(environment_);
  // The screen that draws to memory is smaller than a usual one.
  if (!QSettings(settingsFile(), QSettings::IniFormat).contains("window/geometry"))
    window_->resize(1440, 900);
  window_->show();
  makeActive(*window_);
  QCoreApplication::processEvents();
  return *window_;
}

QString WindowTest::settingsFile() const {
  return QString::fromStdString((folder_ / "palpate.ini").string());
}

std::string WindowTest::file(const std::string& name) {
  const auto path = folder_ / name;
  if (!std::filesystem::exists(path)) testing::writeFile(path, "");
  return path.string();
}

void WindowTest::open(const std::vector<std::string>& names) {
  std::vector<std::filesystem::path> paths;
  for (const std::string& name : names) paths.emplace_back(file(name));
  window().state().open(paths);
  waitUntilOpened();
}

void WindowTest::waitUntilOpened() {
  QSignalSpy finished(&window_->state().opener, &RecordingOpener::finished);
  while (window_->state().opener.busy())
    if (!finished.wait(10'000)) FAIL() << "opening doesn't end";
  FileReading::settleAll(*window_);
  QCoreApplication::processEvents();
}

void WindowTest::press(Qt::Key key, Qt::KeyboardModifiers modifiers) {
  makeActive(window());
  QTest::keyClick(&window(), key, modifiers);
}

QString WindowTest::bannerText() {
  const auto* banner = window().findChild<MessageBanner*>("MessageBanner");
  return banner->isVisible() ? banner->message() : QString();
}

}  // namespace palpate::gui
