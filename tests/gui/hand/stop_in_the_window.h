// Escape pressed in the window at random moments of a grasp, while it paints and rolls: the stop is
// on the wire within 20 ms (R18). Each stop is measured once.
#pragma once

#include <QApplication>
#include <QTest>
#include <algorithm>
#include <random>

#include "control/emulated_bench.h"
#include "gui/shell/main_window.h"
#include "gui/testing/fake_ask.h"
#include "testing/punctuality.h"

namespace palpate::gui {

class StopInTheWindow {
 public:
  StopInTheWindow() {
    WindowEnvironment environment;
    environment.dataFolder = testing::dataFolder();
    environment.settingsPath = QString::fromStdString((folder_ / "palpate.ini").string());
    environment.ask = &ask_;
    window_ = std::make_unique<MainWindow>(environment);
    window_->show();
    Connection connection;
    connection.kind = Connection::Kind::kPorts;
    connection.dsaPort = QString::fromStdString(bench_.hand->dsaPort());
    connection.sdhPort = QString::fromStdString(bench_.hand->sdhPort());
    window_->state().connectTo(connection);
    EXPECT_TRUE(await([&] { return window_->state().displayed.isLive() && canReact(); }));
  }
  ~StopInTheWindow() {
    window_->close();
    await([&] { return !window_->isVisible(); });
  }
  MainWindow& window() { return *window_; }
  const std::filesystem::path& folder() const { return folder_.path(); }
  FakeAsk& ask() { return ask_; }
  // Escape, so long after the call of the grasp; `before` is called just before.
  void pressAfter(std::int64_t pressUs,
                  const GraspRequest& request,
                  const std::function<void()>& before = {}) {
    bench_.log.clear();
    const std::int64_t askedUs = systemClock().monotonicUs();
    ASSERT_TRUE(await([&] { return canReact(); }));
    try {
      control().grasp(request);
    } catch (const DeviceError& refused) {
      stops_.lost(askedUs, systemClock().monotonicUs(), 50'000, refused.what());
      return;
    }
    const std::int64_t pressAtUs = systemClock().monotonicUs() + pressUs;
    for (std::int64_t nowUs = 0; (nowUs = systemClock().monotonicUs()) < pressAtUs;) {
      QCoreApplication::processEvents();
      testing::sleepUntilUs(std::min(nowUs + 100, pressAtUs));
    }
    if (before) before();
    const std::int64_t pressedUs = systemClock().monotonicUs();
    QTest::keyClick(window_.get(), Qt::Key_Escape);
    ASSERT_TRUE(await([&] { return bench_.log.firstSince("stop", pressedUs).has_value(); }))
        << "no stop came";
    const std::int64_t arrivedUs = bench_.log.firstSince("stop", pressedUs)->monoUs;
    stops_.took(pressedUs, arrivedUs);
    EXPECT_TRUE(await([&] { return control().status().phase == GraspPhase::kIdle; }));
    EXPECT_FALSE(bench_.handMoves());
    for (const testing::ArrivedCommand& deed : bench_.log.deeds())
      EXPECT_LE(deed.monoUs, arrivedUs) << deed.name << " behind the stop";
    inMotion_ += !bench_.log.named("m").empty();
  }
  void judge() { stops_.judge("\"in_motion\": " + std::to_string(inMotion_)); }
  int inMotion() const noexcept { return inMotion_; }

 private:
  static bool await(const std::function<bool()>& condition) {
    return QTest::qWaitFor(condition, 20'000);
  }
  GraspControl& control() { return *window_->state().live.source()->control; }
  bool canReact() { return control().status().cannotReact.empty(); }

  testing::TemporaryFolder folder_;
  FakeAsk ask_;
  testing::EmulatedBench bench_{testing::stillHand()};
  std::unique_ptr<MainWindow> window_;
  testing::Punctuality stops_{"escape_to_the_wire"};
  int inMotion_ = 0;
};

inline void escapeAtRandomMoments(int moments, std::int64_t latestUs) {
  StopInTheWindow bench;
  std::mt19937 random(5);
  for (int i = 0; i < moments; ++i) {
    SCOPED_TRACE("moment " + std::to_string(i));
    GraspRequest request;
    request.mode = i % 3 == 0 ? GraspMode::kReactive : GraspMode::kPlain;
    request.velocityDegPerS = 20.0;
    request.closeRatio = i % 2 == 0 ? 1.0 : 0.0;
    bench.pressAfter(std::uniform_int_distribution<std::int64_t>(0, latestUs)(random), request);
    if (::testing::Test::HasFatalFailure()) return;
  }
  bench.judge();
  EXPECT_GT(bench.inMotion(), moments / 2);
}

}  // namespace palpate::gui
