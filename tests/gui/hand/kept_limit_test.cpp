// Grasps that keep their limit, chosen in the dock Hand: the object, what is remembered of it, and
// what is expected of the next grasp.
#include <QCheckBox>
#include <QComboBox>
#include <QLineEdit>
#include <QListWidget>
#include <QMenu>
#include <QSignalSpy>
#include <QTabBar>
#include <QToolButton>
#include <fstream>

#include "palpate/core/text_file.h"
#include "palpate/device/sdh2.h"
#include "palpate/kinematics/preshape_opening.h"

#include "calibration/sample_calibrations.h"
#include "gui/hand/grasp_panel.h"
#include "gui/hand/hand_dock_bench.h"
#include "gui/hand/touch_store.h"
#include "gui/testing/layout_faults.h"
#include "testing/sdh2.h"

namespace palpate::gui::kept_limit_test {
namespace {
namespace fs = std::filesystem;
using testing::stillHand;

TouchMemory memoryOf(const std::string& object, double ratio, int grasps) {
  return TouchMemory::parse(
      R"({"format": "palpate-touches", "version": 1, "touches": [{"preshape": "centrical", )"
      R"("object": ")" +
          object + R"(", "ratio": )" + std::to_string(ratio) + R"(, "grasps": )" +
          std::to_string(grasps) + "}]}",
      "touches.json");
}

class KeptLimitTest : public HandDockBench {
 protected:
  KeptLimitTest() {
    dock_->resize(455, 1000);
    dock_->touches().file = [this] { return file_; };
    find<QToolButton>("moreGraspOptions")->click();
  }
  GraspRequest request(GraspMode mode) { return dock_->findChild<GraspPanel*>()->request(mode); }
  void name(const QString& text) {
    auto* line = find<QComboBox>("objectName")->lineEdit();
    line->setFocus();
    line->selectAll();
    QTest::keyClicks(line, text);
  }
  void size(const QString& text) {
    auto* field = find<QDoubleSpinBox>("objectSize");
    field->setFocus();
    field->selectAll();
    QTest::keyClicks(field, text);
    QTest::keyClick(field, Qt::Key_Return);
  }
  QString forecast() { return find<QLabel>("graspForecast")->text(); }
  QString remembered() { return find<QLabel>("rememberedTouch")->text(); }
  QColor shownColor() {
    return QColor(find<QLabel>("graspForecast")->styleSheet().section(' ', 1).chopped(1));
  }

  const fs::path file_ = folder_ / "data/touches.json";
};

TEST_F(KeptLimitTest, IsTheUsualWayAndIsRemembered) {
  auto* keep = find<QCheckBox>("keepLimit");
  EXPECT_TRUE(keep->isChecked());
  for (const GraspMode mode : {GraspMode::kReactive, GraspMode::kSlip})
    EXPECT_TRUE(request(mode).keepsLimit);
  EXPECT_FALSE(request(GraspMode::kPlain).keepsLimit);
  EXPECT_EQ(find<ValueSlider>("limit")->field()->accessibleName(), "Limit");
  const auto isLabelled = [&](const QString& text) {
    const auto labels = dock_->findChild<GraspPanel*>()->findChildren<QLabel*>();
    return std::any_of(labels.begin(), labels.end(), [&](const QLabel* each) {
      return each->isVisible() && each->text() == text;
    });
  };
  EXPECT_TRUE(isLabelled("Limit"));
  EXPECT_FALSE(isLabelled("Stop at"));
  name("ball");
  QTest::mouseClick(keep, Qt::LeftButton, {}, {8, keep->height() / 2});
  ASSERT_FALSE(keep->isChecked());
  EXPECT_FALSE(isLabelled("Limit"));
  EXPECT_TRUE(isLabelled("Stop at"));
  EXPECT_EQ(find<ValueSlider>("limit")->field()->accessibleName(), "Stop at");
  for (const GraspMode mode : {GraspMode::kReactive, GraspMode::kSlip}) {
    EXPECT_FALSE(request(mode).keepsLimit);
    EXPECT_EQ(request(mode).object, "");
  }
  dock_ = newDock();
  EXPECT_FALSE(find<QCheckBox>("keepLimit")->isChecked());
}

TEST_F(KeptLimitTest, TheObjectGoesWithTheGraspAndNotIntoTheNextSession) {
  connectTo(stillHand());
  EXPECT_EQ(request(GraspMode::kReactive).touchRatio, std::nullopt);
  name("  tin \"A\" ");
  size("70");
  const HandGeometry geometry(sdh2Geometry());
  const auto ratioOf = [&](const char* preshape, double sizeMm) {
    return touchRatioOf(geometry, sdh2Preshape(preshape), sizeMm);
  };
  for (const GraspMode mode : {GraspMode::kReactive, GraspMode::kSlip}) {
    EXPECT_EQ(request(mode).object, "tin \"A\"");
    ASSERT_TRUE(request(mode).touchRatio);
    EXPECT_EQ(request(mode).touchRatio, ratioOf("centrical", 70.0));
  }
  EXPECT_EQ(request(GraspMode::kPlain).object, "");
  EXPECT_EQ(request(GraspMode::kPlain).touchRatio, std::nullopt);
  auto* preshape = find<QComboBox>("preshape");
  preshape->setCurrentIndex(preshape->findData("pinch-parallel"));
  EXPECT_EQ(request(GraspMode::kReactive).touchRatio, ratioOf("pinch-parallel", 70.0));
  EXPECT_NE(ratioOf("pinch-parallel", 70.0), ratioOf("centrical", 70.0));
  size("1");  // thinner than the closed hand is
  EXPECT_EQ(request(GraspMode::kReactive).touchRatio, std::nullopt);
  EXPECT_TRUE(remembered().contains("doesn't close to its size")) << remembered().toStdString();
  // A motion of joints that stops at a contact has nothing of it.
  const GraspRequest joints = [&] {
    find<QTabBar>("handPages")->setCurrentIndex(1);
    find<QCheckBox>("stopAtContact")->setChecked(true);
    type("targetAngle2", "20");
    click("moveJoints");
    EXPECT_TRUE(bench_->awaitMotion());
    return bench_->control->status().request.value_or(GraspRequest{});
  }();
  EXPECT_TRUE(isJointMotion(joints));
  EXPECT_FALSE(joints.keepsLimit);
  EXPECT_EQ(joints.object, "");
  EXPECT_EQ(joints.touchRatio, std::nullopt);
  click("stopHand");
  ASSERT_TRUE(await([&] { return !bench_->handMoves(); }));
  dock_->setHand(nullptr, nullptr);
  dock_ = newDock();
  EXPECT_EQ(find<QComboBox>("objectName")->currentText(), "");
  EXPECT_EQ(find<QDoubleSpinBox>("objectSize")->value(), 0.0);
}

// GraspRequest: one line of at most 100 bytes.
TEST_F(KeptLimitTest, ANameIsOneLineOfAHundredBytes) {
  for (int i = 0; i < 60; ++i) find<QComboBox>("objectName")->lineEdit()->insert("ü");
  EXPECT_EQ(request(GraspMode::kReactive).object.size(), 100u);
  EXPECT_NO_THROW(request(GraspMode::kReactive).validate());
  auto* line = find<QComboBox>("objectName")->lineEdit();
  line->clear();
  line->insert("a tin\nof fish");
  EXPECT_EQ(request(GraspMode::kReactive).object, "a tin of fish");
  EXPECT_NO_THROW(request(GraspMode::kReactive).validate());
}

TEST_F(KeptLimitTest, WhatIsRememberedIsOfferedShownAndForgotten) {
  saveTouches(memoryOf("ball", 0.82, 15), file_);
  connectTo(stillHand());
  auto* names = find<QComboBox>("objectName");
  ASSERT_EQ(names->count(), 1);
  EXPECT_EQ(names->itemText(0), "ball");
  EXPECT_EQ(names->currentText(), "") << "offered, not chosen";
  EXPECT_FALSE(isEnabled("forgetTouch"));
  name("ba");
  EXPECT_EQ(names->currentText(), "ba") << "not completed";
  EXPECT_FALSE(remembered().contains("touched at")) << remembered().toStdString();
  EXPECT_FALSE(isEnabled("forgetTouch"));
  name("ball");
  EXPECT_EQ(remembered(), "touched at 0.82, 15 grasps");
  EXPECT_TRUE(await([&] { return forecast().contains("touches in about"); }))
      << forecast().toStdString();
  // Of this preshape only.
  auto* preshape = find<QComboBox>("preshape");
  preshape->setCurrentIndex(preshape->findData("parallel"));
  EXPECT_EQ(names->count(), 0);
  EXPECT_EQ(names->currentText(), "ball");
  EXPECT_FALSE(isEnabled("forgetTouch"));
  preshape->setCurrentIndex(preshape->findData("centrical"));
  EXPECT_EQ(remembered(), "touched at 0.82, 15 grasps");
  ASSERT_TRUE(isEnabled("forgetTouch"));
  click("forgetTouch");
  EXPECT_EQ(names->count(), 0);
  EXPECT_EQ(names->currentText(), "ball") << "what was typed stays";
  EXPECT_FALSE(isEnabled("forgetTouch"));
  EXPECT_FALSE(bench_->control->touches().find("centrical", "ball"));
  EXPECT_TRUE(await([&] { return loadTouches(file_).empty(); }));
  EXPECT_TRUE(await([&] { return forecast().contains("isn't known"); }))
      << forecast().toStdString();
  EXPECT_TRUE(bench_->log.deeds().empty());
}

// At a high limit, and by its size, so that the touch comes soon.
TEST_F(KeptLimitTest, WhatAGraspHasShownIsStored) {
  connectTo(testing::handWith("ball"));
  type("velocity", "60");
  type("limit", "2500");
  name("ball");
  size("75");
  ASSERT_TRUE(await([&] { return isEnabled("reactiveGrasp"); }));
  click("reactiveGrasp");
  ASSERT_TRUE(await([&] { return bench_->control->status().touchesLearnt == 1; }))
      << state().toStdString();
  EXPECT_TRUE(await([&] { return remembered().contains(", 1 grasp"); }))
      << remembered().toStdString();
  EXPECT_EQ(find<QComboBox>("objectName")->itemText(0), "ball");
  ASSERT_TRUE(await([&] { return !loadTouches(file_).empty(); }));
  EXPECT_TRUE(loadTouches(file_).find("centrical", "ball"));
}

TEST_F(KeptLimitTest, ADamagedFileIsSaidOnceAndStaysUntilItIsDeleted) {
  fs::create_directories(file_.parent_path());
  std::ofstream(file_) << "{\"format\": \"palpate-touches\"";
  const std::string damaged = readTextFile(file_, 1000);
  QSignalSpy failed(&dock_->touches(), &TouchStore::failed);
  QSignalSpy recovered(&dock_->touches(), &TouchStore::recovered);
  connectTo(stillHand());
  ASSERT_EQ(failed.count(), 1);
  const QString said = failed[0][0].toString();
  EXPECT_TRUE(said.contains("touches.json")) << said.toStdString();
  EXPECT_TRUE(said.contains("deleted")) << said.toStdString();
  EXPECT_FALSE(said.contains('\n'));
  EXPECT_TRUE(bench_->control->touches().empty());
  // Known in this session: two names, of which one is forgotten.
  const auto forgetBall = [&] {
    bench_->control->setTouches(memoryOf("ball", 0.5, 1));
    dock_->touches().forget("centrical", "ball");
  };
  forgetBall();
  EXPECT_EQ(readTextFile(file_, 1000), damaged);
  fs::remove(file_);
  forgetBall();
  EXPECT_TRUE(await([&] { return recovered.count() == 1; }));
  EXPECT_TRUE(loadTouches(file_).empty());
  EXPECT_EQ(failed.count(), 1);
}

TEST_F(KeptLimitTest, AFileThatCantBeWrittenIsSaidOnce) {
  std::ofstream(folder_ / "data") << "no folder";
  QSignalSpy failed(&dock_->touches(), &TouchStore::failed);
  connectTo(stillHand());
  for (int i = 0; i < 2; ++i) {
    bench_->control->setTouches(memoryOf("ball", 0.5, 1));
    dock_->touches().forget("centrical", "ball");
  }
  ASSERT_TRUE(await([&] { return !dock_->touches().isSaving(); }));
  EXPECT_EQ(failed.count(), 1);
}

TEST_F(KeptLimitTest, WhatIsToBeExpectedIsSaidBefore) {
  applyTheme(*qApp, Theme::kDark);
  EXPECT_EQ(forecast(), "") << "nothing without a hand";
  connectTo(stillHand());
  // 200 counts at 10 deg/s: it touches so slowly that twice the limit is not exceeded.
  EXPECT_TRUE(await([&] {
    return forecast().startsWith(
        "Reactive: expect up to 400 counts, 2.0 times the limit. Where it touches isn't");
  })) << forecast().toStdString();
  EXPECT_TRUE(forecast().contains("its size or name")) << forecast().toStdString();
  EXPECT_EQ(shownColor(), colorsOf(Theme::kDark).text);
  size("70");
  EXPECT_TRUE(await([&] { return forecast().contains("at the earliest"); }))
      << forecast().toStdString();
  // At 10 deg/s the rubber of the hardest object rises by 8000 counts, of which the motors reach
  // 3020.
  find<QCheckBox>("keepLimit")->setChecked(false);
  EXPECT_TRUE(await([&] {
    return forecast().startsWith("Reactive: expect up to 3020 counts, 15.1 times");
  })) << forecast().toStdString();
  EXPECT_EQ(shownColor(), colorsOf(Theme::kDark).warning);
  applyTheme(*qApp, Theme::kLight);
  EXPECT_EQ(shownColor(), colorsOf(Theme::kLight).warning);
  type("limit", "2000");
  EXPECT_TRUE(await([&] { return forecast().contains("1.5 times the limit"); }))
      << forecast().toStdString();
  EXPECT_EQ(shownColor(), colorsOf(Theme::kLight).text);
  // A limit below what the slowest motion allows: 0.2 deg/s raise it by 160 counts.
  find<QCheckBox>("keepLimit")->setChecked(true);
  type("limit", "50");
  EXPECT_TRUE(await([&] {
    return forecast().startsWith("Reactive: expect up to 210 counts, 4.2 times");
  })) << forecast().toStdString();
  EXPECT_EQ(shownColor(), colorsOf(Theme::kLight).warning);
}

TEST_F(KeptLimitTest, OfALimitInNewtonsItIsInNewtons) {
  dock_->calibrationOf = [](const std::string&) {
    return std::optional(testing::linearCalibration({0.5, 150.0, false}));
  };
  connectTo(stillHand());
  ASSERT_TRUE(await([&] { return find<QComboBox>("limitUnit")->isEnabled(); }));
  find<QComboBox>("limitUnit")->setCurrentIndex(1);
  type("forceLimit", "2");
  EXPECT_TRUE(await([&] {
    return forecast().startsWith("Reactive: expect up to 4.0 N, 2.0 times");
  })) << forecast().toStdString();
}

TEST_F(KeptLimitTest, AHiddenDockComputesNoForecast) {
  connectTo(stillHand());
  ASSERT_TRUE(await([&] { return !forecast().isEmpty(); }));
  const QString before = forecast();
  find<QTabBar>("handPages")->setCurrentIndex(1);
  find<QCheckBox>("keepLimit")->setChecked(false);
  // Longer than a forecast takes that is seen.
  EXPECT_FALSE(QTest::qWaitFor([&] { return forecast() != before; }, 600));
  find<QTabBar>("handPages")->setCurrentIndex(0);
  EXPECT_TRUE(forecast().contains("stays so")) << forecast().toStdString();
}

TEST_F(KeptLimitTest, NoButtonMovesWhateverIsExpected) {
  connectTo(stillHand());
  const auto places = [&] {
    QCoreApplication::processEvents();
    QMap<QString, QPoint> at;
    for (const QPushButton* each : dock_->findChildren<QPushButton*>())
      at[each->objectName()] = each->mapTo(dock_.get(), QPoint());
    return at;
  };
  ASSERT_TRUE(await([&] { return forecast().contains("isn't known"); }));
  EXPECT_EQ(layoutFaults(*dock_).join("; ").toStdString(), "");
  const auto before = places();
  find<QCheckBox>("keepLimit")->setChecked(false);
  ASSERT_TRUE(await([&] { return forecast().contains("stays so"); }));
  EXPECT_EQ(places(), before);
  name("a long name of an object that is not known yet at all");
  size("70");
  find<QCheckBox>("keepLimit")->setChecked(true);
  ASSERT_TRUE(await([&] { return forecast().contains("touches in"); }));
  EXPECT_EQ(places(), before);
}

TEST_F(KeptLimitTest, AStepOfASequenceHasWhatThePageSays) {
  connectTo(stillHand());
  name("ball");
  size("70");
  const GraspRequest asked = request(GraspMode::kReactive);
  find<QTabBar>("handPages")->setCurrentIndex(2);
  QMenu* menu = find<QPushButton>("addStep")->menu();
  emit menu->aboutToShow();
  menu->findChild<QAction*>("addReactive")->trigger();
  ASSERT_TRUE(await([&] { return isEnabled("startSequence"); }));
  EXPECT_TRUE(find<QListWidget>("sequenceSteps")->item(0)->text().contains("kept, of ball"));
  // As it is read back for the next session.
  dock_->setHand(nullptr, nullptr);
  dock_ = newDock();
  dock_->show();
  dock_->setHand(bench_->session.get(), bench_->control.get());
  find<QTabBar>("handPages")->setCurrentIndex(2);
  ASSERT_TRUE(await([&] { return isEnabled("startSequence"); }));
  click("startSequence");
  ASSERT_TRUE(await([&] { return bench_->control->status().request.has_value(); }));
  const GraspRequest begun = *bench_->control->status().request;
  EXPECT_TRUE(begun.keepsLimit);
  EXPECT_EQ(begun.object, "ball");
  EXPECT_EQ(begun.touchRatio, asked.touchRatio);
}

// The limit, its box, the buttons, and below More the object; the unit of the limit needs a
// calibration.
TEST_F(KeptLimitTest, TabGoesThroughTheFieldsAsTheyStand) {
  saveTouches(memoryOf("ball", 0.82, 15), file_);
  connectTo(stillHand());
  name("ball");
  ASSERT_TRUE(await([&] { return isEnabled("reactiveGrasp") && isEnabled("forgetTouch"); }));
  find<ValueSlider>("limit")->field()->setFocus();
  QStringList met;
  for (int i = 0; i < 11; ++i) {
    QTest::keyClick(dock_->focusWidget(), Qt::Key_Tab);
    met += dock_->focusWidget()->objectName();
  }
  EXPECT_EQ(met.join(' ').toStdString(),
            "keepLimit graspHand reactiveGrasp slipAwareGrasp openHand relaxHand moreGraspOptions "
            "objectName objectSize forgetTouch eachFinger");
}

}  // namespace
}  // namespace palpate::gui::kept_limit_test
