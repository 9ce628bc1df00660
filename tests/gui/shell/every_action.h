// The window in everything that it can be, for tests that press whatever there is: each menu entry,
// key and button. Connected is the emulated hand on ports of its own, so that it can be seen from
// outside what the hand does.
#pragma once

#include <QAbstractButton>
#include <QAction>
#include <QApplication>
#include <QDesktopServices>
#include <QDialog>
#include <QMenu>
#include <QMenuBar>
#include <QPointer>
#include <QTest>
#include <QTimer>
#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "control/emulated_bench.h"
#include "gui/recognise/presentation_window.h"
#include "gui/shell/main_window.h"
#include "gui/testing/make_active.h"
#include "testing/heartbeat.h"
#include "testing/testing.h"

namespace palpate::gui {

// What this thread has computed [us]: others on the same processor don't count.
inline std::int64_t threadCpuUs() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return now.tv_sec * 1'000'000 + now.tv_nsec / 1000;
}

// Closes what waits for an answer, as soon as it is there: dialogues, boxes, open menus.
class ModalCloser : public QObject {
 public:
  ModalCloser() {
    timer_.setInterval(2);
    connect(&timer_, &QTimer::timeout, this, [this] { close(); });
    timer_.start();
  }
  // When something first waited for an answer since begin() [monotonic us], and how long this
  // thread had computed by then [us]; 0: nothing did.
  std::int64_t seenUs() const noexcept { return seenUs_; }
  std::int64_t seenCpuUs() const noexcept { return seenCpuUs_; }
  void begin() { seenUs_ = 0; }

 private:
  void close() {
    QWidget* popup = QApplication::activePopupWidget();
    QWidget* modal = QApplication::activeModalWidget();
    if (!popup && !modal) return;
    if (seenUs_ == 0) {
      seenUs_ = systemClock().monotonicUs();
      seenCpuUs_ = threadCpuUs();
    }
    if (popup) popup->close();
    if (auto* dialog = qobject_cast<QDialog*>(modal))
      dialog->reject();
    else if (modal)
      modal->close();
  }

  QTimer timer_;
  std::int64_t seenUs_ = 0, seenCpuUs_ = 0;
};

// Dialogues ask, but unsaved labels are discarded.
class DiscardingAsk : public DialogAsk {
 public:
  int choice(const QString& text, const QStringList& buttons, int enter) override {
    return buttons == QStringList{"Save", "Discard"} ? 1 : DialogAsk::choice(text, buttons, enter);
  }
};

// Something that can be pressed. It may be gone by the time it is its turn.
struct Pressable {
  std::string name;
  QPointer<QAction> action;          // triggered, when there is no key
  QKeySequence key;                  // pressed in the window
  QPointer<QAbstractButton> button;  // clicked
};

// How long something took to answer: until it was done, or its dialogue stood there.
struct Answered {
  std::string name;
  std::int64_t tookUs = 0;
  std::int64_t cpuUs = 0;         // of it, computed by the window's thread
  std::int64_t standstillUs = 0;  // of the machine, meanwhile
};

class PressedWindow {
 public:
  enum class State {
    kNothing,
    kRecording,
    kSeveral,
    kCompare,
    kLive,
    kMoving,
    kHolding,
    kRecordingLive,
    kUnplugged,
    kShow
  };
  static constexpr std::array kAllStates = {State::kNothing,
                                            State::kRecording,
                                            State::kSeveral,
                                            State::kCompare,
                                            State::kLive,
                                            State::kMoving,
                                            State::kHolding,
                                            State::kRecordingLive,
                                            State::kUnplugged,
                                            State::kShow};
  static const char* nameOf(State state) {
    constexpr std::array kNames = {"nothing",
                                   "recording",
                                   "several",
                                   "compare",
                                   "live",
                                   "moving",
                                   "holding",
                                   "recording live",
                                   "unplugged",
                                   "show"};
    return kNames.at(static_cast<std::size_t>(state));
  }

  PressedWindow() {
    for (const char* scheme : {"file", "http", "https"})
      QDesktopServices::setUrlHandler(scheme, &nobody_, "opensNothing");
    for (const char* name : {"a.dsa", "b.dsa"})
      std::filesystem::copy_file(testing::dataFolder() / "demo_grasps.dsa", folder_ / name);
    // Labels of the demo recording are saved beside it.
    std::filesystem::copy(
        testing::dataFolder(), folder_ / "data", std::filesystem::copy_options::recursive);
    restart();
  }
  ~PressedWindow() {
    for (const char* scheme : {"file", "http", "https"}) QDesktopServices::unsetUrlHandler(scheme);
    end();
  }

  MainWindow& window() { return *window_; }
  auto& state() { return bench_; }
  testing::Heartbeat& heartbeat() { return heartbeat_; }
  GraspControl* control() {
    LiveSource* source = window_->state().live.source();
    return source ? source->control.get() : nullptr;
  }

  // False: it couldn't be brought about.
  bool bring(State state) {
    if (!window_->isVisible()) restart();
    if (bench_.unplugged_ && state != State::kUnplugged) replug();
    auto* show = window_->findChild<PresentationWindow*>();
    if (show && state != State::kShow) {
      show->close();
      if (!await([&] { return !window_->findChild<PresentationWindow*>(); })) return false;
    }
    const ActionRegistry& actions = window_->state().actions;
    if (window_->state().comparison.on() && state != State::kCompare)
      actions.at("compare")->trigger();
    switch (state) {
      case State::kNothing:
        return disconnect() && closeRecordings(0);
      case State::kRecording:
        return disconnect() && closeRecordings(1) && openRecordings(1);
      case State::kSeveral:
        return disconnect() && openRecordings(2);
      case State::kCompare:
        if (!disconnect() || !openRecordings(2)) return false;
        if (!window_->state().comparison.on()) actions.at("compare")->trigger();
        return await([&] { return window_->state().comparison.on(); });
      case State::kLive:
        return idle() && endRecording();
      case State::kMoving:
        return endRecording() && move();
      case State::kHolding:
        return endRecording() && hold();
      case State::kRecordingLive:
        if (!idle()) return false;
        if (!window_->state().live.recording()) actions.at("record")->trigger();
        return await([&] { return window_->state().live.health().recorder.framesOnDisk > 0; });
      case State::kUnplugged:
        if (bench_.unplugged_) {
          if (isOurs() && window_->state().displayed.isLive()) return true;
          replug();
        }
        if (!idle() || !endRecording()) return false;
        bench_.hand->unplug();
        bench_.unplugged_ = true;
        return await([&] { return window_->state().live.stale(); });
      case State::kShow:
        if (!idle()) return false;
        if (!show) actions.at("showMode")->trigger();
        return window_->findChild<PresentationWindow*>() != nullptr;
    }
    return false;
  }

  // What can be pressed now: entries of menus, keys, buttons that are seen.
  std::vector<Pressable> pressables() const {
    std::vector<Pressable> all;
    std::set<QAction*> actions;
    for (QAction* action : window_->actions()) actions.insert(action);
    collect(*window_->menuBar(), actions);
    for (QAction* action : actions) {
      if (!action->isEnabled() || !action->isVisible() || action->isSeparator()) continue;
      const std::string name = plainText(*action).toStdString();
      if (!action->menu()) all.push_back({"entry " + name, action, {}, {}});
      for (const QKeySequence& key : action->shortcuts())
        all.push_back({"key " + key.toString().toStdString() + " (" + name + ")", action, key, {}});
    }
    for (Pressable& button : buttonsIn(*window_)) all.push_back(std::move(button));
    // Whatever the order in memory is, a run is like the next one.
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
    return all;
  }
  static std::vector<Pressable> buttonsIn(const QWidget& part) {
    std::vector<Pressable> all;
    for (auto* button : part.findChildren<QAbstractButton*>())
      if (button->isVisible() && button->isEnabled())
        all.push_back({"button " + (button->objectName() + " " + button->text()).toStdString(),
                       {},
                       {},
                       button});
    return all;
  }

  // Nothing: it is gone, or can't be pressed now.
  std::optional<Answered> press(const Pressable& what) {
    const bool isKey = !what.key.isEmpty();
    if (isKey ? !what.action
              : !(what.action && what.action->isEnabled()) &&
                    !(what.button && what.button->isEnabled() && what.button->isVisible()))
      return std::nullopt;
    auto* show = window_->findChild<PresentationWindow*>();
    QWidget* front = show ? static_cast<QWidget*>(show) : window_.get();
    makeActive(*front);
    closer_.begin();
    const std::int64_t beginUs = systemClock().monotonicUs();
    const std::int64_t beginCpuUs = threadCpuUs();
    if (isKey)
      QTest::keyClick(front, what.key[0].key(), what.key[0].keyboardModifiers());
    else if (what.action)
      what.action->trigger();
    else
      what.button->click();
    QCoreApplication::processEvents();
    std::int64_t endUs = systemClock().monotonicUs();
    std::int64_t endCpuUs = threadCpuUs();
    if (closer_.seenUs() != 0) {
      endUs = std::min(endUs, closer_.seenUs());
      endCpuUs = closer_.seenCpuUs();
    }
    Answered answered{
        what.name, endUs - beginUs, endCpuUs - beginCpuUs, heartbeat_.standstillUs(beginUs, endUs)};
    clean();
    return answered;
  }

  // Esc and the button Stop end a motion, now.
  void expectThatStopsWork(const std::string& after) {
    if (!bring(State::kMoving)) {
      ADD_FAILURE() << "no motion after " << after;
      return;
    }
    QTest::keyClick(window_.get(), Qt::Key_Escape);
    EXPECT_TRUE(await([&] { return !bench_.handMoves(); })) << "Esc after " << after;
    ASSERT_TRUE(bring(State::kMoving)) << after;
    auto* stop = window_->findChild<QAbstractButton*>("stopHand");
    ASSERT_TRUE(stop && stop->isEnabled()) << after;
    stop->click();
    EXPECT_TRUE(await([&] { return !bench_.handMoves(); })) << "Stop after " << after;
  }

  void restart() {
    end();
    WindowEnvironment environment;
    environment.dataFolder = folder_ / "data";
    environment.settingsPath = QString::fromStdString((folder_ / "palpate.ini").string());
    environment.ask = &ask_;
    window_ = std::make_unique<MainWindow>(environment);
    window_->resize(1440, 900);
    window_->show();
    makeActive(*window_);
    // Serial ports of this machine are nobody's here.
    window_->state().prompts.connection = [](const Connection&) {
      return std::optional<Connection>();
    };
    window_->state().prompts.endRecording = [](UserPrompts::Ending) { return true; };
    window_->state().prompts.recording = [this](RecordingSettings settings, const QString&) {
      settings.folder = QString::fromStdString((folder_ / "runs").string());
      return std::optional(settings);
    };
    QCoreApplication::processEvents();
  }
  // In the middle of anything: as on a desk.
  void unplug() {
    bench_.hand->unplug();
    bench_.unplugged_ = true;
  }
  void replug() {
    bench_.hand->replug();
    bench_.unplugged_ = false;
  }
  static bool await(const std::function<bool()>& condition) {
    return QTest::qWaitFor(condition, 20'000);
  }

 private:
  struct Bench : testing::EmulatedBench {
    using EmulatedBench::EmulatedBench;
    bool unplugged_ = false;
    bool unplugged() const noexcept { return unplugged_; }
  };

  static void collect(const QWidget& menu, std::set<QAction*>& actions) {
    for (QAction* action : menu.actions()) {
      actions.insert(action);
      if (action->menu()) collect(*action->menu(), actions);
    }
  }
  void end() {
    if (!window_) return;
    window_->close();
    EXPECT_TRUE(await([&] { return !window_->isVisible(); }));
    window_.reset();
  }
  // Dialogues that stay open beside the window.
  void clean() {
    for (QWidget* each : QApplication::topLevelWidgets())
      if (auto* dialog = qobject_cast<QDialog*>(each); dialog && dialog->isVisible())
        dialog->reject();
    // A window that is about to close closes.
    if (window_->state().live.state() == LiveController::State::kEnding)
      await([&] { return window_->state().live.state() != LiveController::State::kEnding; });
    QCoreApplication::processEvents();
  }
  bool disconnect() {
    if (window_->state().live.state() == LiveController::State::kNone) return true;
    window_->state().live.end();
    return await([&] { return window_->state().live.state() == LiveController::State::kNone; });
  }
  bool closeRecordings(std::size_t left) {
    for (int i = 0; window_->state().recordings.all().size() > left && i < 20; ++i)
      window_->state().actions.at("closeRecording")->trigger();
    return window_->state().recordings.all().size() <= left;
  }
  bool openRecordings(std::size_t wanted) {
    std::vector<std::filesystem::path> files{folder_ / "a.dsa", folder_ / "b.dsa"};
    files.resize(wanted);
    const auto open = [&](const std::filesystem::path& file) {
      return std::any_of(window_->state().recordings.all().begin(),
                         window_->state().recordings.all().end(),
                         [&](const auto& each) { return each->path == file; });
    };
    std::erase_if(files, open);
    if (!files.empty()) window_->state().open(files);
    return await([&] {
      return !window_->state().opener.busy() && window_->state().displayed.unfilteredRecording() &&
             window_->state().recordings.all().size() >= wanted;
    });
  }
  bool isOurs() const {
    return window_->state().live.source() &&
           window_->state().live.connection().dsaPort.toStdString() == bench_.hand->dsaPort();
  }
  // Connected to our hand, shown, and nothing moves.
  bool idle() {
    if (bench_.unplugged_) replug();
    if (!isOurs()) {
      Connection connection;
      connection.kind = Connection::Kind::kPorts;
      connection.dsaPort = QString::fromStdString(bench_.hand->dsaPort());
      connection.sdhPort = QString::fromStdString(bench_.hand->sdhPort());
      window_->state().connectTo(connection);
      if (!await([&] { return isOurs(); })) return false;
    }
    if (!window_->state().displayed.isLive()) window_->state().actions.at("live")->trigger();
    if (control()->status().phase != GraspPhase::kIdle) control()->stop();
    return await([&] {
      return control() && control()->status().phase == GraspPhase::kIdle &&
             control()->status().cannotReact.empty();
    });
  }
  bool endRecording() {
    if (!window_->state().live.recording()) return true;
    window_->state().live.stopRecording();
    return await([&] { return !window_->state().live.recording(); });
  }
  bool begin(GraspRequest request) {
    try {
      control()->grasp(request);
      return true;
    } catch (const std::exception&) {
      return false;
    }
  }
  bool move() {
    if (isOurs() && !bench_.unplugged_ && window_->state().displayed.isLive() && bench_.handMoves())
      return true;
    for (const double ratio : {1.0, 0.0}) {
      if (!idle()) return false;
      GraspRequest request;
      request.closeRatio = ratio;
      request.velocityDegPerS = 3.0;
      if (!begin(request)) return false;
      if (await([&] {
            return bench_.handMoves() || control()->status().phase == GraspPhase::kIdle;
          }) &&
          bench_.handMoves())
        return true;
    }
    return false;
  }
  bool holds() { return control() && control()->status().phase == GraspPhase::kHolding; }
  bool hold() {
    if (isOurs() && window_->state().displayed.isLive() && holds()) return true;
    if (!idle()) return false;
    // Whatever was pressed before: the hand feels with all of its taxels, as it is delivered.
    window_->state().actions.at("scanAll")->trigger();
    if (auto* reset = window_->findChild<QAbstractButton*>("resetSettings")) reset->click();
    if (!await([&] { return control()->status().cannotReact.empty(); })) return false;
    GraspRequest request;
    request.closeRatio = 0.0;
    request.velocityDegPerS = 60.0;
    if (!begin(request) || !await([&] { return control()->status().phase == GraspPhase::kIdle; }))
      return false;
    request.mode = GraspMode::kSlip;
    request.closeRatio = 1.0;
    request.velocityDegPerS = 30.0;
    request.limitCounts = 300;
    return begin(request) && await([&] { return holds(); });
  }

  testing::TemporaryFolder folder_;
  QObject nobody_;
  Bench bench_{testing::handWith("ball")};
  testing::Heartbeat heartbeat_;
  ModalCloser closer_;
  DiscardingAsk ask_;
  std::unique_ptr<MainWindow> window_;
};

// Presses everything that can be pressed in a state, each once. Returns how many there were that
// answered: what is gone by its turn, or can't be pressed then, isn't counted.
inline std::size_t pressEverything(PressedWindow& pressed,
                                   PressedWindow::State state,
                                   const std::vector<Pressable>& everything,
                                   std::vector<Answered>& slow) {
  constexpr std::int64_t kLimitUs = 100'000;
  std::size_t numAnswered = 0;
  for (const Pressable& each : everything) {
    if (!pressed.bring(state)) {
      ADD_FAILURE() << PressedWindow::nameOf(state) << " can't be brought about before "
                    << each.name;
      return numAnswered;
    }
    SCOPED_TRACE(std::string(PressedWindow::nameOf(state)) + ": " + each.name);
    const auto answered = pressed.press(each);
    if (!answered) continue;
    ++numAnswered;
    if (answered->tookUs > kLimitUs) {
      slow.push_back(*answered);
      slow.back().name = std::string(PressedWindow::nameOf(state)) + ": " + answered->name;
    }
    if (state != PressedWindow::State::kMoving || !pressed.window().isVisible() ||
        !pressed.state().handMoves())
      continue;
    QTest::keyClick(&pressed.window(), Qt::Key_Escape);
    if (!PressedWindow::await([&] { return !pressed.state().handMoves(); })) {
      ADD_FAILURE() << "Esc";
      return numAnswered;
    }
  }
  return numAnswered;
}

// What took longer than 100 ms is printed. It is a failure when the window's thread computed so
// long, or when it stood still for a second, as it would in a wait; a processor that others use
// meanwhile is not the window's. Under sanitizers everything computes several times as long:
// nothing is judged then.
inline void judgeSlow(const std::vector<Answered>& slow) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  constexpr bool kIsSanitized = true;
#else
  constexpr bool kIsSanitized = false;
#endif
  constexpr std::int64_t kCpuUs = 100'000, kWaitUs = 1'000'000;
  // Known, and not asynchronous: a theme gives every widget its style anew.
  struct Known {
    const char* name;
    std::int64_t cpuUs;
  };
  constexpr std::array kKnown = {Known{"Switch between dark and light theme", 1'500'000},
                                 Known{"entry dark", 1'500'000},
                                 Known{"entry light", 1'500'000},
                                 Known{"entry as the desktop", 1'500'000}};
  for (const Answered& each : slow) {
    std::printf("slow: %s: %.0f ms, %.0f of them computed, the machine stood still for %.0f\n",
                each.name.c_str(),
                static_cast<double>(each.tookUs) / 1e3,
                static_cast<double>(each.cpuUs) / 1e3,
                static_cast<double>(each.standstillUs) / 1e3);
    if (kIsSanitized) continue;
    const auto* known = std::find_if(kKnown.begin(), kKnown.end(), [&](const Known& one) {
      return each.name.find(one.name) != std::string::npos;
    });
    const bool isKnown = known != kKnown.end();
    EXPECT_LE(each.cpuUs, isKnown ? known->cpuUs : kCpuUs) << each.name;
    EXPECT_LE(each.tookUs - each.standstillUs, isKnown ? 2 * kWaitUs + known->cpuUs : kWaitUs)
        << each.name;
  }
}

}  // namespace palpate::gui
