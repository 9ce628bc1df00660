// The dock Recognise in the real window, of recordings and live on the emulated hand.
#include <QApplication>
#include <QCheckBox>
#include <QDockWidget>
#include <QImage>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QTableView>
#include <chrono>
#include <thread>

#include <palpate/control/grasp_control.h>

#include "gui/appearance/text_size.h"
#include "gui/hand3d/hand_view.h"
#include "gui/matrices/matrices_feature.h"
#include "gui/matrices/matrices_panel.h"
#include "gui/matrices/matrices_view.h"
#include "gui/recognise/answer_view.h"
#include "gui/recognise/ask_page.h"
#include "gui/recognise/check_page.h"
#include "gui/recognise/grasps_page.h"
#include "gui/recognise/guessing_game.h"
#include "gui/recognise/presentation_window.h"
#include "gui/recognise/recognise_fixture.h"
#include "gui/shell/show_scene.h"
#include "gui/testing/layout_faults.h"
#include "gui/testing/make_active.h"
#include "gui/timeline/event_rows.h"
#include "gui/timeline/timeline_chart.h"
#include "gui/timeline/timeline_feature.h"
#include "gui/timeline/timeline_panel.h"

namespace palpate::gui::recognise_window_test {
namespace {

TEST_F(RecogniseWindowTest, ComesAndGoesByItsKey) {
  openIt(record("pen"));
  EXPECT_FALSE(dock()->isVisible());
  press(Qt::Key_I, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_TRUE(dock()->isVisible());
  press(Qt::Key_I, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_FALSE(dock()->isVisible());
}

TEST_F(RecogniseWindowTest, NamesTheSelectedGrasp) {
  openIt(record("pen"));
  press(Qt::Key_Q);
  EXPECT_TRUE(dock()->isVisible());
  settle();
  panel().controller().useEmulatedModel();
  settle();
  press(Qt::Key_Q);
  settle();
  EXPECT_TRUE(answer().text.startsWith("No grasp is chosen")) << answer().text.toStdString();
  press(Qt::Key_N);  // the first grasp
  ASSERT_TRUE(window().feature<TimelineFeature>().panel().chart().selection());
  press(Qt::Key_Q);
  settle();
  EXPECT_EQ(answer().name(), "pen") << answer().accessibleText().toStdString();
  EXPECT_TRUE(answer().of.startsWith("pen.palpate, ")) << answer().of.toStdString();
}

TEST_F(RecogniseWindowTest, AnAnswerGoesWithItsSource) {
  openIt(record("pen"));
  window().docks().show("Recognise");
  panel().controller().useEmulatedModel();
  settle();
  press(Qt::Key_N);
  press(Qt::Key_Q);
  settle();
  ASSERT_EQ(answer().name(), "pen") << answer().accessibleText().toStdString();
  openIt(record("ball"));
  EXPECT_EQ(answer().kind, RecognitionAnswer::Kind::kNothing) << answer().name().toStdString();
}

// The same grasp has the same answer live and in its recording.
TEST_F(RecogniseWindowTest, ARecordingOfTheEmulatedHandHasItsModel) {
  const std::filesystem::path path = folder_ / "pen.palpate";
  SaveExtras extras;
  extras.meta["emulated"] = "pen";
  saveRecording(graspsOf("pen", 2), {}, path, Overwrite::kRefuse, {}, extras);
  openIt(path.string());
  window().docks().show("Recognise");
  settle();
  press(Qt::Key_N);
  press(Qt::Key_Q);
  settle();
  EXPECT_EQ(answer().name(), "pen") << answer().accessibleText().toStdString();
  EXPECT_TRUE(answer().sure) << answer().unsure.toStdString();
}

TEST_F(RecogniseWindowTest, AnswersOnTheWholeScreen) {
  openIt(record("pen"));
  window().docks().show("Recognise");
  panel().controller().useEmulatedModel();
  settle();
  trigger("showMode");
  auto* full = window().findChild<PresentationWindow*>("showWindow");
  ASSERT_NE(full, nullptr);
  EXPECT_TRUE(full->isFullScreen());
  press(Qt::Key_N);
  QTest::keyClick(full, Qt::Key_Q);
  settle();
  EXPECT_EQ(full->view().answer().name(), "pen");
  EXPECT_TRUE(full->view().answer().offset.isEmpty()) << "no words for experts";
  // The hand and its heat maps stand beside it.
  auto* scene = full->findChild<ShowScene*>();
  ASSERT_NE(scene, nullptr);
  EXPECT_TRUE(scene->hand().isVisible() && scene->matrices().isVisible());
  ASSERT_TRUE(scene->hand().drawing().handState().frame);
  EXPECT_EQ(scene->hand().drawing().handState().frame->values,
            window().state().currentFrame.frame().values);
  EXPECT_EQ(scene->matrices().look(), window().feature<MatricesFeature>().panel().view().look());
  // In the guessing game the answer is hidden until the visitor has guessed.
  auto* game = full->findChild<GuessingGame*>();
  EXPECT_FALSE(game->isVisible());
  QTest::keyClick(full, Qt::Key_G);
  EXPECT_TRUE(game->isVisible());
  QTest::keyClick(full, Qt::Key_Q);
  settle();
  EXPECT_EQ(full->view().answer().name(), "");
  const auto buttons = game->findChildren<QPushButton*>("gameObject");
  ASSERT_EQ(buttons.size(), 3);
  for (const QPushButton* button : buttons) EXPECT_FALSE(button->accessibleName().isEmpty());
  QTest::keyClick(full, Qt::Key_2);
  settle();
  EXPECT_EQ(full->view().answer().name(), "pen") << "the guess asks the hand";
  QTest::keyClick(full, Qt::Key_1);
  EXPECT_EQ(game->score(), "hand 0 · you 0 · of 1") << "the pen is none of the three";
  QTest::keyClick(full, Qt::Key_G);
  EXPECT_FALSE(game->isVisible());
  EXPECT_EQ(full->view().answer().name(), "pen");
  QTest::keyClick(full, Qt::Key_Escape);
  EXPECT_TRUE(QTest::qWaitFor(
      [&] { return window().findChild<PresentationWindow*>("showWindow") == nullptr; }, 5'000));
}

TEST_F(RecogniseWindowTest, WithoutAModelTheDockOpensInsteadOfTheWholeScreen) {
  openIt(record("pen"));
  EXPECT_FALSE(dock()->isVisible());
  trigger("showMode");
  EXPECT_EQ(window().findChild<PresentationWindow*>("showWindow"), nullptr);
  EXPECT_TRUE(dock()->isVisible());
  EXPECT_TRUE(window().state().messages.flashed().startsWith("No model is chosen"));
}

TEST_F(RecogniseWindowTest, AGraspOfTheCheckIsOpenedAndSelected) {
  const std::string pen = record("pen"), ball = record("ball");
  openIt(pen);
  emit panel().check().graspAsked(ball, 60, 200);
  ASSERT_TRUE(QTest::qWaitFor(
      [&] {
        return window().state().displayed.unfilteredRecording() &&
               window().state().displayed.unfilteredRecording()->path == ball;
      },
      20'000));
  const auto& selection = window().feature<TimelineFeature>().panel().chart().selection();
  ASSERT_TRUE(selection);
  EXPECT_NEAR(selection->fromS, window().state().displayed.unfilteredRecording()->timeAt(60), 1e-6);
  EXPECT_NEAR(selection->toS, window().state().displayed.unfilteredRecording()->timeAt(200), 1e-6);
}

// All pages with grasps of two objects, in the usual layout.
TEST_F(RecogniseWindowTest, AGraspOfTheTableIsOpenedAndThePagesFit) {
  const auto folder = folder_ / "objects";
  for (const char* name : {"ball", "pen"}) {
    std::filesystem::create_directories(folder / name);
    std::filesystem::copy_file(record(name), folder / name / (std::string(name) + ".palpate"));
  }
  openIt((folder / "ball" / "ball.palpate").string());
  window().docks().show("Recognise");
  panel().teaching().setFolder(folder);
  settle();
  for (const QString& page : panel().pageNames()) {
    panel().showPage(page);
    QCoreApplication::processEvents();
    const QStringList faults = layoutFaults(window());
    EXPECT_TRUE(faults.isEmpty()) << page.toStdString() << ":\n" << faults.join("\n").toStdString();
  }
  panel().showPage("Grasps");
  QTableView& table = panel().grasps().table();
  ASSERT_EQ(table.model()->rowCount(), 4);
  // The second grasp of the pen, wherever it stands. Keys with Shift that a test before this one
  // pressed still count as held; the choice doesn't depend on them.
  panel().grasps().choose(3);
  // Copied: the table may be computed anew meanwhile.
  const FeatureRow grasp = panel().teaching().table()->rows.at(3);
  table.setFocus();
  QTest::keyClick(&table, Qt::Key_Return);
  ASSERT_TRUE(QTest::qWaitFor(
      [&] {
        return window().state().displayed.unfilteredRecording() &&
               window().state().displayed.unfilteredRecording()->path == grasp.file;
      },
      20'000));
  const auto& selection = window().feature<TimelineFeature>().panel().chart().selection();
  ASSERT_TRUE(selection);
  EXPECT_NEAR(selection->fromS,
              window().state().displayed.unfilteredRecording()->timeAt(grasp.begin),
              1e-6);
}

TEST_F(RecogniseWindowTest, NamesWhatTheEmulatedHandHolds) { EXPECT_EQ(heldName("pen"), "pen"); }

class RecogniseLiveTest : public RecogniseWindowTest {
 protected:
  // The emulated hand with a pen before its open fingers; it moves when it is told.
  RecogniseLiveTest() {
    Connection connection;
    connection.kind = Connection::Kind::kEmulated;
    connection.scene = "pen";
    window().state().connectTo(connection);
    EXPECT_TRUE(QTest::qWaitFor(
        [&] {
          return window().state().displayed.isLive() && control().status().cannotReact.empty();
        },
        20'000));
  }
  GraspControl& control() { return *window().state().live.source()->control; }
  void moveTo(double closeRatio) {
    GraspRequest request;
    request.preshape = "pinch-parallel";
    request.closeRatio = closeRatio;
    request.velocityDegPerS = 60.0;
    control().grasp(request);
    EXPECT_TRUE(
        QTest::qWaitFor([&] { return control().status().phase == GraspPhase::kIdle; }, 20'000));
  }
  static bool await(const std::function<bool()>& condition) {
    return QTest::qWaitFor(condition, 20'000);
  }
};

// L-B1: it asked itself without an end.
TEST_F(RecogniseLiveTest, AskedByItselfWhileSomethingIsHeldItAnswers) {
  window().docks().show("Recognise");
  find<QCheckBox>("recogniseByItself")->setChecked(true);
  moveTo(1.0);
  EXPECT_TRUE(await([&] { return answer().name() == "pen" && answer().of == "held now"; }))
      << answer().accessibleText().toStdString();
}

TEST_F(RecogniseLiveTest, ThatNothingIsHeldIsNotSaidAnyMoreWhenSomethingIs) {
  window().docks().show("Recognise");
  press(Qt::Key_Q);
  ASSERT_TRUE(await([&] { return answer().text.startsWith("Nothing is held"); }))
      << answer().text.toStdString();
  moveTo(1.0);
  EXPECT_TRUE(await([&] { return !answer().text.startsWith("Nothing is held"); }))
      << answer().text.toStdString();
}

// A window that is busy hears of a release and of the next contact at once.
TEST_F(RecogniseLiveTest, WhatWasLetGoWhileTheWindowWasBusyIsNotHeldNow) {
  window().docks().show("Recognise");
  auto* byItself = find<QCheckBox>("recogniseByItself");
  byItself->setChecked(true);
  moveTo(1.0);
  ASSERT_TRUE(await([&] { return answer().of == kHeldNow && answer().name() == "pen"; }))
      << answer().accessibleText().toStdString();
  byItself->setChecked(false);
  panel().controller().settle();
  const auto moveBeside = [&](double closeRatio) {
    GraspRequest request;
    request.preshape = "pinch-parallel";
    request.closeRatio = closeRatio;
    request.velocityDegPerS = 60.0;
    control().grasp(request);
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (control().status().phase != GraspPhase::kIdle && std::chrono::steady_clock::now() < end)
      std::this_thread::yield();
    ASSERT_EQ(control().status().phase, GraspPhase::kIdle);
  };
  moveBeside(0.0);
  moveBeside(1.0);
  EXPECT_EQ(answer().of, kHeldNow) << "not heard yet";
  EXPECT_TRUE(await([&] { return answer().of == kLastGrasp; })) << answer().of.toStdString();
}

// L-B1, L-M16.
TEST_F(RecogniseLiveTest, TheShowNamesWhatIsHeldNowAndNothingThatWasLetGo) {
  moveTo(1.0);
  trigger("showMode");
  auto* full = window().findChild<PresentationWindow*>("showWindow");
  ASSERT_NE(full, nullptr);
  ASSERT_TRUE(await([&] { return full->view().answer().name() == "pen"; }));
  moveTo(0.0);
  EXPECT_TRUE(await([&] {
    return full->view().answer().kind == RecognitionAnswer::Kind::kNothing &&
           full->view().answer().text == "Let the hand grasp its object.";
  })) << full->view().answer().accessibleText().toStdString();
  // Asked for, the last grasp is named in the dock, which says so; an audience sees an empty hand.
  QTest::keyClick(full, Qt::Key_Q);
  ASSERT_TRUE(await([&] { return answer().name() == "pen" && answer().of == "the last grasp"; }));
  EXPECT_EQ(full->view().answer().name(), "");
  // A show that begins with an empty hand names nothing either.
  QTest::keyClick(full, Qt::Key_Escape);
  ASSERT_TRUE(
      await([&] { return window().findChild<PresentationWindow*>("showWindow") == nullptr; }));
  trigger("showMode");
  full = window().findChild<PresentationWindow*>("showWindow");
  ASSERT_NE(full, nullptr);
  EXPECT_EQ(full->view().answer().name(), "");
}

// A name must not look like one of now when nothing arrives from the hand.
TEST_F(RecogniseLiveTest, WithoutFramesNothingIsNamedAsHeldNow) {
  window().docks().show("Recognise");
  moveTo(1.0);
  trigger("showMode");
  auto* full = window().findChild<PresentationWindow*>("showWindow");
  ASSERT_NE(full, nullptr);
  const auto& dockView = panel().ask().view();
  const auto* ask = find<QPushButton>("whatIsIt");
  ASSERT_TRUE(await([&] { return full->view().answer().name() == "pen"; }));
  EXPECT_EQ(full->view().stale(), "");
  EXPECT_TRUE(ask->isEnabled());
  EmulatedHand& hand = *window().state().live.source()->emulated;
  hand.mute(true);
  ASSERT_TRUE(await([&] { return !full->view().stale().isEmpty(); }));
  EXPECT_TRUE(full->view().stale().startsWith("no frame for "))
      << full->view().stale().toStdString();
  EXPECT_EQ(full->view().accessibleName(), full->view().stale());
  EXPECT_EQ(full->view().answer().name(), "pen") << "greyed, it stays";
  EXPECT_EQ(dockView.stale(), full->view().stale());
  EXPECT_EQ(answer().of, kLastGrasp);
  EXPECT_FALSE(ask->isEnabled());
  QTest::keyClick(full, Qt::Key_Q);
  EXPECT_EQ(answer().text, "No frames arrive: what is held isn't known.");
  // Asked again or felt again, it is named again.
  QStringList named;
  QObject::connect(&panel().controller(),
                   &RecognitionController::answered,
                   full,
                   [&](const RecognitionAnswer& each) { named.append(each.of + each.name()); });
  hand.mute(false);
  ASSERT_TRUE(await([&] { return full->view().stale().isEmpty(); }));
  EXPECT_EQ(full->view().answer().name(), "");
  EXPECT_TRUE(ask->isEnabled());
  EXPECT_TRUE(await([&] { return full->view().answer().name() == "pen"; }))
      << named.join("; ").toStdString();
}

TEST_F(RecogniseWindowTest, TheButtonIsCalledAsInTheTextsAboutIt) {
  window().docks().show("Recognise");
  settle();
  EXPECT_EQ(find<QPushButton>("whatIsIt")->text(), "What is it?  (Q)");
  EXPECT_EQ(answer().text.toStdString(),
            "No model is chosen. Open one (Model), or train one on the page Teach.");
  panel().controller().useEmulatedModel();
  settle();
  EXPECT_TRUE(answer().text.endsWith("then press What is it? (Q).")) << answer().text.toStdString();
}

TEST_F(RecogniseLiveTest, TheShowHasAStopThatStopsTheHandAndSaysWhatItDoes) {
  trigger("showMode");
  auto* full = window().findChild<PresentationWindow*>("showWindow");
  ASSERT_NE(full, nullptr);
  makeActive(*full);
  auto* stop = full->findChild<QPushButton*>("showStop");
  const auto* said = full->findChild<QLabel*>("showHandState");
  ASSERT_TRUE(stop && said);
  EXPECT_TRUE(stop->isVisible());
  EXPECT_TRUE(full->rect().contains(QRect(stop->mapTo(full, QPoint()), stop->size())));
  // The keys of motions work here, and what they do is said, also when they are refused.
  const auto grasp = [&] {
    QTest::keyClick(full, Qt::Key_G, Qt::ControlModifier | Qt::AltModifier);
  };
  grasp();
  ASSERT_TRUE(await([&] { return control().status().phase != GraspPhase::kIdle; }));
  EXPECT_TRUE(await([&] { return said->text().contains("deg/s"); })) << said->text().toStdString();
  ASSERT_TRUE(await([&] { return !window().state().actions.at("graspHand")->isEnabled(); }));
  grasp();
  EXPECT_EQ(said->text().toStdString(), "Can't grasp: A plain grasp runs; Stop (Esc) ends it");
  QTest::mouseClick(stop, Qt::LeftButton);
  EXPECT_TRUE(await([&] { return control().status().phase == GraspPhase::kIdle; }));
  EXPECT_TRUE(await([&] { return said->text() == "stopped by the user"; }))
      << said->text().toStdString();
  EXPECT_TRUE(full->isVisible()) << "the show goes on";
}

TEST_F(RecogniseWindowTest, WithoutAHandTheShowHasNoStop) {
  openIt(record("pen"));
  window().docks().show("Recognise");
  panel().controller().useEmulatedModel();
  settle();
  trigger("showMode");
  const auto* full = window().findChild<PresentationWindow*>("showWindow");
  ASSERT_NE(full, nullptr);
  EXPECT_FALSE(full->findChild<QPushButton*>("showStop")->isVisible());
}

// Pixels of a colour, with the mixed ones at its edges.
int pixelsLike(const QImage& picture, const QColor& color) {
  int count = 0;
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      const QColor here = picture.pixelColor(x, y);
      count += std::abs(here.red() - color.red()) < 12 &&
               std::abs(here.green() - color.green()) < 12 &&
               std::abs(here.blue() - color.blue()) < 12;
    }
  return count;
}

TEST_F(RecogniseLiveTest, NoTextOfTheShowIsCut) {
  trigger("showMode");
  auto* full = window().findChild<PresentationWindow*>("showWindow");
  ASSERT_NE(full, nullptr);
  full->showNormal();
  RecognitionAnswer answer;
  answer.kind = RecognitionAnswer::Kind::kNamed;
  answer.best = {{"slipping handle of the drawer", 0.52}, {"foam ball", 0.31}, {"pen", 0.1}};
  answer.offset = "session offset 1.2 ± 0.4 mm, from 14 unnamed grasps, 3 objects";
  answer.unsure =
      "the session offset is not known well enough: it is 1.2 ± 0.9 mm; touch the empty hand, or "
      "name some grasps; the object fits foam ball, too, as long as this isn't known";
  for (const int pt : {0, 15})
    for (const QSize size : {QSize(1280, 800), QSize(1366, 768), QSize(1024, 700)}) {
      SCOPED_TRACE(std::to_string(pt) + " pt, " + std::to_string(size.width()));
      applyTextPt(pt);
      full->resize(size);
      full->view().setAnswer(answer);
      // Sizes that follow from the text are computed when all widgets have their font.
      for (int round = 0; round < 3; ++round) QCoreApplication::processEvents();
      const QStringList faults = layoutFaults(*full);
      EXPECT_TRUE(faults.isEmpty()) << faults.join("\n").toStdString();
      // The same with any height below it: if a line is cut, there is more of its colour.
      const AnswerView& view = full->view();
      const double unit = view.textHeight(), air = 0.9 * unit;
      const auto painted = [&](int height) {
        QImage picture(view.width(), height, QImage::Format_RGB32);
        picture.fill(Qt::black);
        QPainter painter(&picture);
        painter.setFont(view.font());
        paintAnswer(painter,
                    QRectF(air, air, view.width() - 2 * air, height - 2 * air),
                    answer,
                    QPixmap(),
                    Theme::kDark,
                    unit);
        painter.end();
        return pixelsLike(picture, colorsOf(Theme::kDark).warning);
      };
      EXPECT_GT(painted(view.height()), 0);
      EXPECT_EQ(painted(view.height()), painted(3 * view.height()));
    }
  applyTextPt(0);
}

}  // namespace
}  // namespace palpate::gui::recognise_window_test
