// Each entry of a menu, each key and each button, pressed in each state of the window: it lives, it
// answers, and Esc and Stop work afterwards. Then a monkey that presses, turns and types by a seed,
// while plugs are pulled.
#include <QDockWidget>
#include <QWheelEvent>
#include <cstdlib>
#include <random>

#include "gui/shell/every_action.h"

namespace palpate::gui::every_action_slow_test {
namespace {
using State = PressedWindow::State;

class EveryActionOf : public ::testing::TestWithParam<State> {};

TEST_P(EveryActionOf, AStateLivesAndAnswers) {
  PressedWindow pressed;
  std::vector<Answered> slow;
  ASSERT_TRUE(pressed.bring(GetParam()));
  const auto everything = pressed.pressables();
  EXPECT_GT(everything.size(), 40u);
  pressEverything(pressed, GetParam(), everything, slow);
  pressed.expectThatStopsWork(PressedWindow::nameOf(GetParam()));
  judgeSlow(slow);
}

INSTANTIATE_TEST_SUITE_P(States,
                         EveryActionOf,
                         ::testing::ValuesIn(PressedWindow::kAllStates),
                         [](const auto& of) {
                           std::string name = PressedWindow::nameOf(of.param);
                           std::erase(name, ' ');
                           return name;
                         });

// With each dock open, everything that stands in it; of a recording and live.
TEST(EveryActionLong, OfEachDockLivesAndAnswers) {
  PressedWindow pressed;
  std::vector<Answered> slow;
  for (const State state : {State::kRecording, State::kLive}) {
    ASSERT_TRUE(pressed.bring(state));
    for (const QString& name : pressed.window().docks().names()) {
      SCOPED_TRACE(name.toStdString());
      ASSERT_TRUE(pressed.bring(state));
      pressed.window().docks().show(name);
      QCoreApplication::processEvents();
      const auto* dock = pressed.window().findChild<QDockWidget*>(name);
      ASSERT_NE(dock, nullptr);
      pressEverything(pressed, state, PressedWindow::buttonsIn(*dock), slow);
    }
  }
  pressed.expectThatStopsWork("all docks");
  judgeSlow(slow);
}

// What a child, a cat or a cloth on the keyboard does.
class Monkey {
 public:
  Monkey(PressedWindow& pressed, std::uint64_t seed) : pressed_(pressed), random_(seed) {}
  void step() {
    if (!pressed_.window().isVisible()) pressed_.restart();
    switch (below(20)) {
      case 0:
        return turnAWheel();
      case 1:
      case 2:
        return drag();
      case 3:
        return type();
      case 4:
        return pressed_.state().unplugged() ? pressed_.replug() : pluck();
      case 5:
        if (below(4) == 0) pressed_.bring(PressedWindow::kAllStates.at(below(10)));
        return;
      default:
        return press();
    }
  }

 private:
  std::size_t below(std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_);
  }
  void pluck() {
    if (below(10) == 0) pressed_.unplug();
  }
  void press() {
    const auto all = pressed_.pressables();
    if (!all.empty()) pressed_.press(all[below(all.size())]);
  }
  QWidget* something() {
    QList<QWidget*> seen;
    for (auto* each : pressed_.window().findChildren<QWidget*>())
      if (each->isVisible() && !each->size().isEmpty()) seen.append(each);
    return seen.isEmpty()
               ? nullptr
               : seen[static_cast<qsizetype>(below(static_cast<std::size_t>(seen.size())))];
  }
  QPoint placeIn(const QWidget& widget) {
    return {static_cast<int>(below(static_cast<std::size_t>(widget.width()))),
            static_cast<int>(below(static_cast<std::size_t>(widget.height())))};
  }
  void turnAWheel() {
    QPointer<QWidget> on = something();
    if (!on) return;
    const QPointF at = placeIn(*on);
    QWheelEvent wheel(at,
                      on->mapToGlobal(at),
                      {},
                      {0, below(2) == 0 ? 120 : -120},
                      Qt::NoButton,
                      below(4) == 0 ? Qt::ControlModifier : Qt::NoModifier,
                      Qt::NoScrollPhase,
                      false);
    QCoreApplication::sendEvent(on, &wheel);
  }
  void drag() {
    QPointer<QWidget> on = something();
    if (!on) return;
    const Qt::MouseButton button = below(5) == 0 ? Qt::MiddleButton : Qt::LeftButton;
    QTest::mousePress(on, button, {}, placeIn(*on));
    if (on && below(2) == 0) QTest::mouseMove(on, placeIn(*on));
    if (on) QTest::mouseRelease(on, button, {}, placeIn(*on));
    QCoreApplication::processEvents();
  }
  void type() {
    QWidget* focused = QApplication::focusWidget();
    constexpr std::array kKeys = {Qt::Key_Tab,
                                  Qt::Key_Return,
                                  Qt::Key_Space,
                                  Qt::Key_Up,
                                  Qt::Key_Down,
                                  Qt::Key_Delete,
                                  Qt::Key_9,
                                  Qt::Key_A};
    QTest::keyClick(focused ? focused : &pressed_.window(), kKeys.at(below(kKeys.size())));
    QCoreApplication::processEvents();
  }

  PressedWindow& pressed_;
  std::mt19937_64 random_;
};

// PALPATE_MONKEY_SECONDS (600) and PALPATE_MONKEY_SEED (another one each day, printed).
TEST(MonkeyLong, DoesNothingThatTheWindowOrTheHandDoesNotSurvive) {
  const auto number = [](const char* variable, std::uint64_t otherwise) {
    const char* text = std::getenv(variable);
    return text && *text ? std::strtoull(text, nullptr, 10) : otherwise;
  };
  constexpr std::int64_t kDayUs = 86'400'000'000;
  const std::uint64_t seconds = number("PALPATE_MONKEY_SECONDS", 600);
  const std::uint64_t seed =
      number("PALPATE_MONKEY_SEED", static_cast<std::uint64_t>(systemClock().wallUs() / kDayUs));
  std::printf("monkey: seed %llu, %llu s\n",
              static_cast<unsigned long long>(seed),
              static_cast<unsigned long long>(seconds));
  PressedWindow pressed;
  Monkey monkey(pressed, seed);
  const std::int64_t endUs =
      systemClock().monotonicUs() + static_cast<std::int64_t>(seconds) * 1'000'000;
  constexpr int kStepsBetweenStops = 200;
  int steps = 0;
  while (systemClock().monotonicUs() < endUs) {
    monkey.step();
    if (++steps % kStepsBetweenStops == 0)
      pressed.expectThatStopsWork("step " + std::to_string(steps) + " of seed " +
                                  std::to_string(seed));
    if (::testing::Test::HasFatalFailure()) return;
  }
  std::printf("monkey: %d steps\n", steps);
}

}  // namespace
}  // namespace palpate::gui::every_action_slow_test
