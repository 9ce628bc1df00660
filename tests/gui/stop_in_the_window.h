// Escape pressed in the window at random moments of a grasp, while it paints and rolls: the stop is on the wire
// within 20 ms (R18).
#pragma once

#include <QApplication>
#include <QTest>
#include <algorithm>
#include <cstdio>
#include <optional>
#include <random>
#include <thread>
#include <vector>

#include "control/emulated_bench.h"
#include "gui/main_window.h"
#include "testing/timely.h"

namespace palpate::gui {

class StopInTheWindow {
 public:
  StopInTheWindow() {
    WindowSurroundings surroundings;
    surroundings.dataFolder = testing::dataFolder();
    surroundings.settingsPath = QString::fromStdString((folder_ / "palpate.ini").string());
    window_ = std::make_unique<MainWindow>(surroundings);
    window_->show();
    Connection connection;
    connection.kind = Connection::Kind::kPorts;
    connection.dsaPort = QString::fromStdString(bench_.hand->dsaPort());
    connection.sdhPort = QString::fromStdString(bench_.hand->sdhPort());
    window_->connectTo(connection);
    EXPECT_TRUE(await([&] { return window_->liveShown() && canReact(); }));
  }
  ~StopInTheWindow() {
    window_->close();
    await([&] { return !window_->isVisible(); });
  }
  // From the press to the arrival of the stop at the hand [us]; nothing when the grasp had ended by itself.
  std::optional<std::int64_t> pressAfter(std::int64_t pressUs, const GraspRequest& request) {
    bench_.log.clear();
    if (!await([&] { return canReact(); })) return {};
    try {
      control().grasp(request);
    } catch (const DeviceError&) {
      return {};  // the machine stood still: no living stream
    }
    const std::int64_t beganUs = systemClock().monotonicUs();
    while (systemClock().monotonicUs() - beganUs < pressUs) {
      QCoreApplication::processEvents();
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
    const std::int64_t pressedUs = systemClock().monotonicUs();
    QTest::keyClick(window_.get(), Qt::Key_Escape);
    if (!await([&] { return bench_.log.firstSince("stop", pressedUs).has_value(); })) return {};
    const std::int64_t arrivedUs = bench_.log.firstSince("stop", pressedUs)->monoUs;
    EXPECT_TRUE(await([&] { return control().status().phase == GraspPhase::kIdle; }));
    EXPECT_FALSE(bench_.handMoves());
    for (const testing::ArrivedCommand& deed : bench_.log.deeds())
      EXPECT_LE(deed.monoUs, arrivedUs) << deed.name << " behind the stop";
    inMotion_ += !bench_.log.named("m").empty();
    return arrivedUs - pressedUs;
  }
  int inMotion() const noexcept { return inMotion_; }

 private:
  static bool await(const std::function<bool()>& condition) {
    return QTest::qWaitFor(condition, 20'000);
  }
  GraspControl& control() { return *window_->live().source()->control; }
  bool canReact() { return control().status().cannotReact.empty(); }

  testing::TemporaryFolder folder_;
  testing::EmulatedBench bench_{testing::stillHand()};
  std::unique_ptr<MainWindow> window_;
  int inMotion_ = 0;
};

inline void escapeAtRandomMoments(int moments, std::int64_t latestUs) {
  constexpr std::int64_t kLimitUs = 20'000;
  constexpr int kTries = 6;
  StopInTheWindow bench;
  std::mt19937 random(5);
  std::vector<std::int64_t> latencies;
  for (int i = 0; i < moments; ++i) {
    const auto pressUs = std::uniform_int_distribution<std::int64_t>(0, latestUs)(random);
    int turn = i;
    const testing::Timely timely = testing::inTime(kLimitUs, kTries, [&] {
      GraspRequest request;
      request.mode = i % 3 == 0 ? GraspMode::kReactive : GraspMode::kPlain;
      request.velocityDegPerS = 20.0;
      request.closeRatio = turn++ % 2 == 0 ? 1.0 : 0.0;
      return bench.pressAfter(pressUs, request);
    });
    ASSERT_TRUE(timely.bestUs.has_value()) << "moment " << i;
    EXPECT_LE(*timely.bestUs, kLimitUs) << "moment " << i << ", pressed after " << pressUs << " us";
    latencies.push_back(*timely.bestUs);
  }
  std::sort(latencies.begin(), latencies.end());
  std::printf(
      "Escape to the stop on the wire, %d moments (%d in a motion): median %.2f ms, worst %.2f "
      "ms\n",
      moments,
      bench.inMotion(),
      static_cast<double>(latencies[latencies.size() / 2]) / 1e3,
      static_cast<double>(latencies.back()) / 1e3);
  EXPECT_GT(bench.inMotion(), moments / 2);
}

}  // namespace palpate::gui
