#include "palpate/signals/signal_name.h"

#include "palpate/emulator/synthetic_profile.h"
#include "palpate/signals/formula.h"

#include "testing/testing.h"
#include "testing/wrist_profile.h"

namespace palpate::signal_name_test {
namespace {

using Kind = SeriesChoice::Kind;

class SignalNameTest : public ::testing::Test {
 protected:
  const Profile profile_ = synthesize({.durationS = 1.0, .grasps = 1});
  const SensorLayout& layout_ = profile_.layout();
};

TEST_F(SignalNameTest, BothSpellingsMeanTheSame) {
  const std::vector<std::pair<const char*, const char*>> pairs = {{"m1_mean", "1:mean"},
                                                                  {"hand_sum", "hand:sum"},
                                                                  {"m0_area_mm2", "0:area_mm2"},
                                                                  {"m5_x2_y9", "5:2:9"}};
  for (const auto& [written, older] : pairs) {
    const auto choice = signalNamed(written, layout_);
    ASSERT_TRUE(choice) << written;
    EXPECT_EQ(signalNamed(older, layout_), choice) << older;
    EXPECT_EQ(nameOf(*choice, layout_), written);
    EXPECT_EQ(parseSignalName(older), parseSignalName(written));
  }
  const auto taxel = signalNamed("m5_x2_y9", layout_);
  EXPECT_EQ(taxel->kind, Kind::kTaxels);
  EXPECT_TRUE(taxel->taxels.contains(5, 9, 2)) << "column 2, row 9";
  EXPECT_EQ(taxel->taxels.count(), 1u);
  for (const char* name : {"angle3", "temperature8", "hand_filtered_mean", "m2_active"})
    EXPECT_EQ(nameOf(*signalNamed(name, layout_), layout_), name);
}

TEST_F(SignalNameTest, ATextThatIsNoneIsNone) {
  for (const char* name : {"",         "_",          ":",       "mean",     "m_mean",
                           "m0_meen",  "hand_x1_y1", "hm",      "m-1_mean", "angle",
                           "angle-1",  "m1_x_y",     "1:",      "1:2:",     "m+1_mean",
                           "hand:1:2", "1:2:3:4",    "m1:mean", "1_mean",   "angle 3"})
    EXPECT_FALSE(parseSignalName(name)) << name;
  // These are names, but this hand has no such matrix or taxel.
  for (const char* name : {"m6_mean", "m1_x9_y7", "m1_x2_y99", "6:mean", "1:9:7", "m9_x1_y1"}) {
    EXPECT_TRUE(parseSignalName(name)) << name;
    EXPECT_FALSE(signalNamed(name, layout_)) << name;
  }
}

TEST_F(SignalNameTest, AGroupAndAForceHaveNoName) {
  SeriesChoice group = *signalNamed("m1_x2_y7", layout_);
  group.taxels.toggle(1, 8, 2);
  EXPECT_EQ(nameOf(group, layout_), "");
  EXPECT_EQ(nameOf({.kind = Kind::kForce, .index = 1}, layout_), "");
}

TEST_F(SignalNameTest, FormulasTakeTheOlderSpelling) {
  EXPECT_EQ(withSignalNames("1:sum-3:sum"), "m1_sum-m3_sum");
  EXPECT_EQ(withSignalNames("der( hand:mean )+t"), "der( hand_mean )+t");
  // What else a colon parts stays as it is.
  EXPECT_EQ(withSignalNames("t>1 ? 5 : 2"), "t>1 ? 5 : 2");
  EXPECT_EQ(withSignalNames("t>1?5:m2_mean"), "t>1?5:m2_mean");
  EXPECT_EQ(withSignalNames("x1:mean"), "x1:mean");
  EXPECT_EQ(withSignalNames("2"), "2");
  EXPECT_EQ(Formula("1:sum - hand:sum").names(), (std::vector<std::string>{"hand_sum", "m1_sum"}));
  EXPECT_EQ(Formula("1:sum").text(), "1:sum");
}

TEST_F(SignalNameTest, ColumnsOfFurtherSeriesAreNamedWithTheirSeries) {
  const Profile wrist = testing::withWrist(profile_);
  for (const auto& [name, column] : {std::pair("wrist_fz", "fz"), {"wrist_Torque_Z", "Torque Z"}}) {
    const auto choice = signalNamed(name, wrist);
    ASSERT_TRUE(choice) << name;
    EXPECT_EQ(*choice, (SeriesChoice{.kind = Kind::kColumn, .series = "wrist", .column = column}));
    EXPECT_EQ(nameOf(*choice, layout_), name);
    EXPECT_FALSE(signalNamed(name, profile_)) << "of a recording without it";
  }
  for (const char* name : {"wrist", "wrist_", "wrist_f", "wrist_fzz", "fz", "_fz", "angles_0"})
    EXPECT_FALSE(signalNamed(name, wrist)) << name;
  EXPECT_EQ(signalNamed("m1_mean", wrist), signalNamed("m1_mean", layout_));
}

TEST_F(SignalNameTest, SignalsOfTheHandComeBeforeSeriesOfTheirName) {
  ProfileBuilder builder(profile_.hand());
  builder.addSeries({"hand", "", {{"sum", "N"}, {"grip", "N"}}, ""});
  const Profile profile = builder.finish({});
  EXPECT_EQ(signalNamed("hand_sum", profile)->kind, Kind::kMatrix);
  EXPECT_EQ(signalNamed("hand_grip", profile)->kind, Kind::kColumn);
}

}  // namespace
}  // namespace palpate::signal_name_test
