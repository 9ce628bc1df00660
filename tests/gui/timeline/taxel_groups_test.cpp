#include "gui/timeline/taxel_groups.h"

#include <QSignalSpy>
#include <QTest>
#include <QTreeWidget>

#include "palpate/device/sdh2.h"
#include <palpate/model/hand_description.h>

#include "gui/timeline/signal_tree.h"
#include "testing/testing.h"
#include "testing/wrist_profile.h"

namespace palpate::gui::taxel_groups_test {
namespace {

class TaxelGroupsTest : public ::testing::Test {
 protected:
  QSettings& settings() {
    if (!settings_)
      settings_ = std::make_unique<QSettings>(
          QString::fromStdString((folder_ / "palpate.ini").string()), QSettings::IniFormat);
    return *settings_;
  }
  static TaxelSelection tip() {
    TaxelSelection taxels(*sdh2().layout);
    taxels.add(3, 0, 2, 2, 3);
    return taxels;
  }
  testing::TemporaryFolder folder_;
  std::unique_ptr<QSettings> settings_;
};

TEST_F(TaxelGroupsTest, AreKeptFromDayToDay) {
  {
    TaxelGroups groups(settings());
    QSignalSpy changed(&groups, &TaxelGroups::changed);
    EXPECT_TRUE(groups.keep("  thumb   tip ", tip()));
    EXPECT_EQ(changed.size(), 1);
  }
  settings_.reset();
  TaxelGroups groups(settings());
  const auto of = groups.of(*sdh2().layout);
  ASSERT_EQ(of.size(), 1u);
  EXPECT_EQ(of[0].name, "thumb tip");
  EXPECT_EQ(of[0].taxels, tip());
}

TEST_F(TaxelGroupsTest, OfAnotherSensorAreNotOffered) {
  TaxelGroups groups(settings());
  groups.keep("thumb tip", tip());
  EXPECT_TRUE(groups.of(SensorLayout({MatrixLayout::full(4, 4, 3.4)})).empty());
}

TEST_F(TaxelGroupsTest, NamesAreUniqueAndNotEmpty) {
  TaxelGroups groups(settings());
  EXPECT_FALSE(groups.keep("  ", tip()));
  EXPECT_FALSE(groups.keep("nothing", TaxelSelection(*sdh2().layout)));
  EXPECT_TRUE(groups.keep("a", tip()));
  EXPECT_TRUE(groups.keep("b", tip()));
  TaxelSelection other(*sdh2().layout);
  other.addAll(0);
  EXPECT_TRUE(groups.keep("a", other)) << "replaces it";
  EXPECT_EQ(groups.of(*sdh2().layout).size(), 2u);
  EXPECT_FALSE(groups.rename("a", "b"));
  EXPECT_TRUE(groups.rename("a", "c"));
  groups.forget("b");
  ASSERT_EQ(groups.of(*sdh2().layout).size(), 1u);
  EXPECT_EQ(groups.of(*sdh2().layout)[0].taxels, other);
}

TEST_F(TaxelGroupsTest, ATornSettingsFileStopsNothing) {
  settings().beginWriteArray("taxel_groups", 3);
  settings().setArrayIndex(0);
  settings().setValue("name", "bad");
  settings().setValue("taxels", "9:1");
  settings().setArrayIndex(2);
  settings().setValue("name", "good");
  settings().setValue("taxels", QString::fromStdString(tip().text()));
  settings().endArray();
  const auto of = TaxelGroups(settings()).of(*sdh2().layout);
  ASSERT_EQ(of.size(), 1u);
  EXPECT_EQ(of[0].name, "good");
}

TEST_F(TaxelGroupsTest, TheListTicksThem) {
  TaxelGroups groups(settings());
  groups.keep("thumb tip", tip());
  FormulaCurves formulas(settings());
  SignalTree tree(groups, formulas);
  tree.setSource(sdh2(), {.hasAngles = true});
  QSignalSpy changed(&tree, &SignalTree::extrasChanged);
  EXPECT_TRUE(tree.lines().contains("[x] the chosen taxels (none now)"));
  EXPECT_TRUE(tree.setTicked("thumb tip", true));
  EXPECT_TRUE(tree.setTicked("finger 1 distal", true));
  EXPECT_EQ(changed.size(), 2);
  EXPECT_TRUE(tree.extras().groups.contains("thumb tip"));
  EXPECT_EQ(tree.extras().angles, (std::set<int>{4}));
  EXPECT_FALSE(tree.setTicked("motor 0", true)) << "the recording has no temperatures";
  EXPECT_TRUE(tree.setTicked("thumb tip", false));
  EXPECT_TRUE(tree.extras().groups.empty());
  tree.setNumChosen(5);
  EXPECT_TRUE(tree.lines().contains("[x] the chosen taxels (5)"));
}

TEST_F(TaxelGroupsTest, AClickAnywhereOnALineTicksIt) {
  TaxelGroups groups(settings());
  FormulaCurves formulas(settings());
  SignalTree tree(groups, formulas);
  tree.setSource(sdh2(), {.hasAngles = true});
  tree.resize(300, 500);
  tree.show();
  auto* list = tree.findChild<QTreeWidget*>("signalList");
  const auto rectOf = [list](const char* name) {
    return list->visualItemRect(list->findItems(name, Qt::MatchExactly | Qt::MatchRecursive).at(0));
  };
  QTest::mouseClick(list->viewport(), Qt::LeftButton, {}, rectOf("finger 1 distal").center());
  EXPECT_EQ(tree.extras().angles, (std::set<int>{4}));
  const QRect other = rectOf("finger 2 distal");
  constexpr int kInTheBox = 8;  // [px]
  QTest::mouseClick(
      list->viewport(), Qt::LeftButton, {}, QPoint(other.left() + kInTheBox, other.center().y()));
  EXPECT_EQ(tree.extras().angles, (std::set<int>{4, 6})) << "its box";
  const QTreeWidgetItem* heading = list->topLevelItem(0);
  QTest::mouseClick(list->viewport(), Qt::LeftButton, {}, list->visualItemRect(heading).center());
  EXPECT_EQ(heading->data(0, Qt::CheckStateRole), QVariant()) << "a heading has no box";
}

TEST_F(TaxelGroupsTest, TheListStaysOnTheScreen) {
  TaxelGroups groups(settings());
  FormulaCurves formulas(settings());
  SignalTree tree(groups, formulas);
  tree.setSource(sdh2(), {.hasAngles = true, .hasTemperatures = true});
  tree.winId();  // without a display, the first window is moved by a frame that popups don't have
  QWidget button(nullptr, Qt::FramelessWindowHint);
  const QRect screen = button.screen()->availableGeometry();
  for (const double share : {0.0, 0.3, 0.5, 0.7, 1.0}) {
    const int top = screen.top() + static_cast<int>(share * (screen.height() - 20));
    button.setGeometry(screen.right() - 80, top, 80, 20);
    tree.openBelow(button);
    EXPECT_TRUE(screen.contains(tree.geometry()))
        << share << ": " << tree.x() << "," << tree.y() << " " << tree.width() << "x"
        << tree.height() << " in " << screen.width() << "x" << screen.height();
    EXPECT_FALSE(tree.geometry().intersects(button.geometry())) << share;
    tree.hide();
  }
}

TEST_F(TaxelGroupsTest, WhatIsTickedIsRemembered) {
  const PlottedExtras extras{.chosenTaxels = false,
                             .groups = {"a", "b, c"},
                             .angles = {1, 6},
                             .temperatures = {0},
                             .forces = {2, 6}};
  savePlottedExtras(extras, settings());
  EXPECT_EQ(loadPlottedExtras(settings()), extras);
  settings().setValue("plotted/angles", QStringList{"-1", "x", "3", "9999"});
  EXPECT_EQ(loadPlottedExtras(settings()).angles, (std::set<int>{3}));
}

TEST_F(TaxelGroupsTest, FurtherSeriesHaveASectionEach) {
  TaxelGroups groups(settings());
  FormulaCurves formulas(settings());
  SignalTree tree(groups, formulas);
  const SeriesDescription imu{"imu", "", {{"fz", ""}}, ""};
  tree.setSource(sdh2(), {.series = {testing::wristSeries(), imu}});
  EXPECT_TRUE(tree.lines().contains("[ ] wrist fx (N)"));
  EXPECT_TRUE(tree.lines().contains("[ ] wrist Torque Z (N m)"));
  EXPECT_TRUE(tree.lines().contains("[ ] imu fz")) << "no unit";
  EXPECT_TRUE(tree.setTicked("wrist fz", true));
  EXPECT_EQ(tree.extras().columns, (std::set<QString>{"wrist fz"}));
  // By name: another recording has another order.
  tree.setSource(sdh2(), {.series = {imu, testing::wristSeries()}});
  EXPECT_TRUE(tree.lines().contains("[x] wrist fz (N)"));
  EXPECT_TRUE(tree.lines().contains("[ ] imu fz"));
  tree.setSource(sdh2(), {});
  EXPECT_TRUE(tree.lines().filter("wrist").isEmpty());
  EXPECT_EQ(tree.extras().columns.size(), 1u) << "for recordings that have it";
  savePlottedExtras(tree.extras(), settings());
  EXPECT_EQ(loadPlottedExtras(settings()), tree.extras());
}

TEST_F(TaxelGroupsTest, ComputedSeriesAreListedAndSayWhatTheyNeed) {
  TaxelGroups groups(settings());
  FormulaCurves formulas(settings());
  SignalTree tree(groups, formulas);
  const std::size_t hand = sdh2().layout->numMatrices();
  tree.setSource(
      sdh2(),
      {.computed = {
           {{"hand_force", kComputedRole, {{"n", "N"}}, ""},
            ComputedKind::kForce,
            hand,
            {"force"},
            "needs a calibration"},
           {{"m0_slip", kComputedRole, {{"mm", "mm"}}, ""}, ComputedKind::kSlip, 0, {"slip"}}}});
  EXPECT_FALSE(tree.setTicked("force of the whole hand", true));
  EXPECT_FALSE(tree.setTicked("matrices in kPa and N", true));
  const auto* list = tree.findChild<QTreeWidget*>("signalList");
  const auto found =
      list->findItems("force of the whole hand", Qt::MatchStartsWith | Qt::MatchRecursive);
  ASSERT_EQ(found.size(), 1);
  EXPECT_EQ(found[0]->toolTip(0), "needs a calibration");
  EXPECT_TRUE(tree.setTicked("slip on", true));
  EXPECT_EQ(tree.extras().columns, (std::set<QString>{"m0_slip mm"}));
  PlottedExtras calibrated = tree.extras();
  calibrated.calibrated = true;
  savePlottedExtras(calibrated, settings());
  EXPECT_EQ(loadPlottedExtras(settings()), calibrated);
}

}  // namespace
}  // namespace palpate::gui::taxel_groups_test
