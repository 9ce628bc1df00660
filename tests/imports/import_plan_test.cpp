#include "palpate/imports/import_plan.h"

#include <map>

#include "palpate/device/sdh2.h"

#include "imports/import_samples.h"

namespace palpate::import_plan_test {
namespace {

using testing::handOf;
using testing::importText;
using testing::pad;
using testing::twoPads;

// The plan of a table whose columns all hold 0, 10, 20.
ImportPlan planOf(const std::string& header,
                  const HandDescription& hand,
                  const ImportMapping& mapping = {}) {
  const testing::TemporaryFolder folder;
  const auto columns = static_cast<std::size_t>(std::count(header.begin(), header.end(), ',')) + 1;
  std::string text = header + "\n";
  for (int line = 0; line < 3; ++line) {
    for (std::size_t c = 0; c < columns; ++c)
      text += (c > 0 ? "," : "") + std::to_string(10 * line);
    text += "\n";
  }
  testing::writeFile(folder / "t.csv", text);
  const auto source = openTable(folder / "t.csv", mapping.text);
  return planImport(*source, hand, mapping, mapping.text);
}

// For each place of the hand the position of the column in the file, from 0.
std::map<std::size_t, std::size_t> columnsByPlace(const std::string& header,
                                                  const HandDescription& hand,
                                                  const ImportMapping& mapping = {}) {
  const ImportPlan plan = planOf(header, hand, mapping);
  std::map<std::size_t, std::size_t> found;
  const PlannedSeries& frames = plan.series.front();
  for (std::size_t i = 0; i < frames.values.size(); ++i)
    if (frames.values[i].target) found[*frames.values[i].target] = frames.columns[i];
  return found;
}

ImportMapping withRate() {
  ImportMapping mapping;
  mapping.time.rateHz = 100.0;
  return mapping;
}

using Places = std::map<std::size_t, std::size_t>;
const Places kInOrder = {{0, 1}, {1, 2}, {2, 3}, {3, 4}};

TEST(ImportPlan, FindsTaxelsByTheNumbersInTheirNames) {
  for (const char* header : {"time,taxel0,taxel1,taxel2,taxel3",
                             "time,taxel1,taxel2,taxel3,taxel4",
                             "time,A3,A4,A5,A6",
                             "time,p[0][0],p[0][1],p[1][0],p[1][1]",
                             "time,p_1_1,p_1_2,p_2_1,p_2_2",
                             "time,t0_0,t0_1,t1_0,t1_1",
                             "time,matrix0_0,matrix0_1,matrix0_2,matrix0_3",
                             "time,/pad/data[0],/pad/data[1],/pad/data[2],/pad/data[3]",
                             "time,2,0,1,3"})
    if (std::string(header) != "time,2,0,1,3") {
      EXPECT_EQ(columnsByPlace(header, pad(2, 2)), kInOrder) << header;
    } else {
      EXPECT_EQ(columnsByPlace(header, pad(2, 2)), (Places{{2, 1}, {0, 2}, {1, 3}, {3, 4}}));
    }
  // Sorted as PlotJuggler does: [10] before [2].
  std::string header = "__time,p[0],p[1],p[10],p[11]";
  for (int i = 2; i < 10; ++i) header += ",p[" + std::to_string(i) + "]";
  const Places sorted = columnsByPlace(header, pad(3, 4));
  EXPECT_EQ(sorted.at(10), 3u);
  EXPECT_EQ(sorted.at(2), 5u);
  EXPECT_EQ(sorted.size(), 12u);
}

bool hasNote(const ImportPlan& plan, const std::string& words) {
  return std::any_of(plan.notes.begin(), plan.notes.end(), [&](const std::string& note) {
    return note.find(words) != std::string::npos;
  });
}

// pad(2, 3) has the places 0 1 2 / 3 4 5.
TEST(ImportPlan, LettersBeforeTheNumbersAreRowsAndColumns) {
  for (const char* header : {"time,x0y0,x1y0,x0y1,x1y1",
                             "time,c0r0,c1r0,c0r1,c1r1",
                             "time,Col0_Row0,Col1_Row0,Col0_Row1,Col1_Row1",
                             "time,pad_x[1]_y[1],pad_x[2]_y[1],pad_x[1]_y[2],pad_x[2]_y[2]"}) {
    EXPECT_EQ(columnsByPlace(header, pad(2, 2)), kInOrder) << header;
    EXPECT_FALSE(hasNote(planOf(header, pad(2, 2)), "row")) << header;
  }
  for (const char* header : {"time,x0y0,x0y1,x1y0,x1y1,x2y0,x2y1",
                             "time,c0r0,c0r1,c1r0,c1r1,c2r0,c2r1",
                             "time,p_0_0,p_0_1,p_1_0,p_1_1,p_2_0,p_2_1"})
    EXPECT_EQ(columnsByPlace(header, pad(2, 3)),
              (Places{{0, 1}, {3, 2}, {1, 3}, {4, 4}, {2, 5}, {5, 6}}))
        << header;
  EXPECT_EQ(columnsByPlace("time,r0c0,r1c0,r0c1,r1c1", pad(2, 2)),
            (Places{{0, 1}, {2, 2}, {1, 3}, {3, 4}}));
  EXPECT_EQ(columnsByPlace("time,m0_x0_y0,m0_x1_y0,m0_x0_y1,m0_x1_y1,m1_x0_y0,m1_x1_y0,m1_x0_y1,"
                           "m1_x1_y1",
                           twoPads())
                .at(1),
            2u);
}

TEST(ImportPlan, AnOrderThatIsGuessedIsNoted) {
  EXPECT_TRUE(hasNote(planOf("time,p_0_0,p_0_1,p_1_0,p_1_1,p_2_0,p_2_1", pad(2, 3)), "transposed"));
  EXPECT_TRUE(hasNote(planOf("time,p[0][0],p[0][1],p[1][0],p[1][1]", pad(2, 2)), "row and column"));
  EXPECT_FALSE(hasNote(planOf("time,p_0_0,p_0_1,p_0_2,p_1_0,p_1_1,p_1_2", pad(2, 3)), "row"));
  EXPECT_TRUE(hasNote(planOf("time,r0c0,r0c1,r1c0,r1c1,r2c0,r2c1", pad(2, 3)), "exchanged"));
  // Names with two numbers that are not rows and columns of the hand aren't taken in their order.
  const std::string refusal = testing::errorOf(
      [] { planOf("time,p_0_0,p_0_1,p_0_2,p_0_3,p_1_0,p_1_1,p_1_2,p_1_3", pad(1, 8)); });
  EXPECT_NE(refusal.find("no columns fit"), std::string::npos) << refusal;
}

TEST(ImportPlan, NamesOfTaxelsWinOverAFirstColumnThatAscends) {
  const std::string refusal =
      testing::errorOf([] { planOf("taxel_1,taxel_2,taxel_3,taxel_4,temperature", pad(2, 2)); });
  EXPECT_NE(refusal.find("no column of times was found; name that column (--time), or give the "
                         "rate of the rows (--rate)"),
            std::string::npos)
      << refusal;
  const ImportPlan plan =
      planOf("taxel_1,taxel_2,taxel_3,taxel_4,temperature", pad(2, 2), withRate());
  EXPECT_EQ(plan.notes, std::vector<std::string>());
  ASSERT_EQ(plan.series.size(), 2u);
  EXPECT_EQ(plan.series[1].description,
            std::vector<std::string>{"temperature becomes series table"});
}

// The first numbers 0, 1, 2, .. of a table of `names` and four values.
std::string countingTable(const std::string& names, int first, int step) {
  std::string text = names + "\n";
  for (int row = 0; row < 4; ++row) text += std::to_string(first + row * step) + ",7,8,9,7\n";
  return text;
}

TEST(ImportPlan, AColumnThatCountsTheRowsIsNoTime) {
  const auto refusal = [](const std::string& text, const ImportMapping& mapping) {
    const testing::TemporaryFolder folder;
    return testing::errorOf([&] { importText(folder, text, pad(2, 2), mapping); });
  };
  for (const int first : {0, 1}) {
    const std::string unnamed = refusal(countingTable("n,a,b,c,d", first, 1), {});
    EXPECT_NE(unnamed.find("n counts the rows); name that column (--time), or give the rate"),
              std::string::npos)
        << unnamed;
    const std::string named = refusal(countingTable("time,a,b,c,d", first, 1), {});
    EXPECT_NE(
        named.find("\"time\" counts the rows (0, 1, 2, ..); give the rate of the rows (--rate)"),
        std::string::npos)
        << named;
  }
  EXPECT_EQ(refusal(countingTable("n,a,b,c,d", 0, 1), withRate()), "");
  ImportMapping seconds;
  seconds.time.unit = "s";
  EXPECT_EQ(refusal(countingTable("time,a,b,c,d", 0, 1), seconds), "");
  EXPECT_EQ(refusal(countingTable("time_s,a,b,c,d", 0, 1), {}), "");
  EXPECT_EQ(refusal(countingTable("time,a,b,c,d", 0, 60), {}), "");
}

// "wrench: fx [N], fy [N]; table: battery [V]".
std::string furtherText(const ImportPlan& plan) {
  std::string text;
  for (const PlannedSeries& series : plan.series) {
    if (series.kind != PlannedSeries::Kind::kFurther) continue;
    text += (text.empty() ? "" : "; ") + series.further.name + ":";
    for (const Column& column : series.further.columns)
      text += " " + column.name + (column.unit.empty() ? "" : "[" + column.unit + "]");
  }
  return text;
}

TEST(ImportPlan, ColumnsThatAreNoTaxelsBecomeSeriesByTheirNames) {
  const std::string pads = "time_ms,p0,p1,p2,p3,";
  for (const auto& [names, series] : std::vector<std::pair<std::string, std::string>>{
           {"fx [N],fy [N],fz [N],tx [Nm],ty [Nm],tz [Nm]",
            "wrench: fx[N] fy[N] fz[N] tx[Nm] ty[Nm] tz[Nm]"},
           {"fx_N,fz_N,tz_Nm", "wrench: fx[N] fz[N] tz[Nm]"},
           {"wrist_fx,wrist_fz,battery", "wrist: fx fz; table: battery"},
           {"acc_x,acc_y,gyro_x,gyro_y", "acc: x y; gyro: x y"},
           {"imu_acc_x,imu_gyro_x", "imu: acc_x gyro_x"},
           {"ax,ay,gz", "imu: ax ay gz"},
           {"accX,accY", "acc: X Y"},
           {"/ft/wrench/force/x,/ft/wrench/torque/x", "ft_wrench: force_x torque_x"},
           {"load1,load2", "load: 1 2"},
           {"battery [V],humidity", "table: battery[V] humidity"},
           {"angles_a,angles_b", "angles_2: a b"}})
    EXPECT_EQ(furtherText(planOf(pads + names, pad(2, 2))), series) << names;
}

TEST(ImportPlan, WhatIsChosenForSomethingElseIsNoSeries) {
  const std::string pads = "time_ms,p0,p1,p2,p3,";
  const HandDescription hand = handOf({MatrixLayout::full(2, 2, 1.0)}, 2);
  ImportMapping mapping;
  mapping.angles.columns = "a,b";
  EXPECT_EQ(furtherText(planOf(pads + "a,b,c", hand, mapping)), "table: c");
  mapping.angles.columns = kNoColumns;
  EXPECT_EQ(furtherText(planOf(pads + "joint0,joint1,c", hand, mapping)), "table: c");
  // Counters, other times, masks, and what a row is from.
  EXPECT_EQ(furtherText(planOf(pads + "frame,header_stamp,mask,sensor_id", pad(2, 2))), "");
  // Many that differ by numbers are other taxels; others are split.
  std::string taxels;
  std::string others;
  for (int i = 0; i < 65; ++i) {
    taxels += (i > 0 ? ",other" : "other") + std::to_string(i);
    others += std::string(i > 0 ? "," : "") + static_cast<char>('h' + i / 26) +
              static_cast<char>('a' + i % 26) + "q";
  }
  const ImportPlan plan = planOf(pads + taxels, pad(2, 2));
  EXPECT_EQ(furtherText(plan), "");
  EXPECT_TRUE(hasNote(plan, "not used: other0, other1"));
  const ImportPlan split = planOf(pads + others, pad(2, 2));
  ASSERT_EQ(split.series.size(), 3u);
  EXPECT_EQ(split.series[1].further.name, "table");
  EXPECT_EQ(split.series[1].further.columns.size(), 64u);
  EXPECT_EQ(split.series[2].further.name, "table_2");
}

TEST(ImportPlan, AGuessedUnitIsNoted) {
  const ImportPlan plan = planOf("time,p0,p1,p2,p3,battery", pad(2, 2));
  EXPECT_EQ(
      plan.notes,
      (std::vector<std::string>{
          "time: the unit of \"time\" is guessed to be ms; choose another one by --time-unit"}));
  EXPECT_EQ(plan.series.back().further.columns, (std::vector<Column>{{"battery", ""}}));
  EXPECT_EQ(planOf("time_ms,p0,p1,p2,p3", pad(2, 2)).notes, std::vector<std::string>());
}

TEST(ImportPlan, AColumnNamedAsAnAxisIsItsAngle) {
  HandDescription hand = handOf({MatrixLayout::full(2, 2, 1.0)}, 2, 1);
  hand.axes[0].name = "opening";
  hand.axes[1].name = "turn";
  hand.temperatureSensors[0].name = "palm";
  const ImportPlan plan = planOf("time_ms,turn_rad,palm,p0,p1,p2,p3,opening", hand);
  ASSERT_EQ(plan.series.size(), 3u);
  EXPECT_EQ(plan.series[1].columns, (std::vector<std::size_t>{7, 1}));
  EXPECT_EQ(plan.series[2].columns, (std::vector<std::size_t>{2}));
  EXPECT_EQ(plan.notes,
            (std::vector<std::string>{
                "joint angles: the file gives no unit; the numbers are taken as deg",
                "temperatures: the file gives no unit; the numbers are taken as degC"}));
  EXPECT_TRUE(hasNote(planOf("time_ms,p0,p1,p2,p3,opening", hand),
                      "\"opening\" is there, but 1 of the hand's 2 are not; not imported as such"));
}

TEST(ImportPlan, SaysWhyColumnsHoldNoNumbers) {
  const auto refusal = [](const std::string& text) {
    const testing::TemporaryFolder folder;
    return testing::errorOf([&] { importText(folder, text, pad(2, 2)); });
  };
  for (const auto& [cell, words] : std::vector<std::pair<std::string, std::string>>{
           {"0x1F", "no numbers: p2 (text such as \"0x1F\": hexadecimal)"},
           {"12 mV",
            "no numbers: p2 (text such as \"12 mV\": a unit in the cell; put it into the name)"},
           {"\xE2\x88\x92"
            "5",
            "its minus is not an ASCII minus"},
           {"on", "no numbers: p2 (text such as \"on\")"}}) {
    const std::string row = ",1,2," + cell + ",4\n";
    const std::string what = refusal("time_s,p0,p1,p2,p3\n0.1" + row + "0.2" + row);
    EXPECT_NE(what.find(words), std::string::npos) << what;
  }
}

TEST(ImportPlan, FindsSeveralMatrices) {
  const Places both = {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}, {5, 6}, {6, 7}, {7, 8}};
  for (const char* header :
       {"t,m0_0,m0_1,m0_2,m0_3,m1_0,m1_1,m1_2,m1_3",
        "t,m1[0][0],m1[0][1],m1[1][0],m1[1][1],m2[0][0],m2[0][1],m2[1][0],m2[1][1]",
        "t,x0,x1,x2,x3,x4,x5,x6,x7",
        "t,left0,left1,left2,left3,right0,right1,right2,right3",
        "t,a0,a1,a2,a3,b0,b1,b2,b3"})
    EXPECT_EQ(columnsByPlace(header, twoPads()), both) << header;
  // By the names of the matrices, whatever their order.
  const Places swapped = {{4, 1}, {5, 2}, {6, 3}, {7, 4}, {0, 5}, {1, 6}, {2, 7}, {3, 8}};
  EXPECT_EQ(columnsByPlace("t,right0,right1,right2,right3,left0,left1,left2,left3", twoPads()),
            swapped);
}

// Which columns the series after the frames has, in its order.
std::vector<std::size_t> columnsOfAngles(const std::string& header, const HandDescription& hand) {
  const ImportPlan plan = planOf(header, hand);
  for (const PlannedSeries& series : plan.series)
    if (series.kind == PlannedSeries::Kind::kAngles) return series.columns;
  return {};
}

HandDescription twins() {
  HandDescription hand = twoPads();
  hand.matrices[0].shortName = "L";
  hand.matrices[1].shortName = "R";
  return hand;
}

// S3. Words of a name, or the short name, decide whatever their case and what is around them.
TEST(ImportPlan, AMatrixIsFoundByItsNameInThatOfTheColumns) {
  const Places swapped = {{4, 1}, {5, 2}, {6, 3}, {7, 4}, {0, 5}, {1, 6}, {2, 7}, {3, 8}};
  for (const char* header :
       {"t,R0,R1,R2,R3,L0,L1,L2,L3",
        "t,R_0_0,R_0_1,R_1_0,R_1_1,L_0_0,L_0_1,L_1_0,L_1_1",
        "t,R_r0c0,R_r0c1,R_r1c0,R_r1c1,L_r0c0,L_r0c1,L_r1c0,L_r1c1",
        "t,RIGHT_PAD_0,RIGHT_PAD_1,RIGHT_PAD_2,RIGHT_PAD_3,LEFT_PAD_0,LEFT_PAD_1,LEFT_PAD_2,"
        "LEFT_PAD_3",
        "t,/gripper/right/data[0],/gripper/right/data[1],/gripper/right/data[2],"
        "/gripper/right/data[3],/gripper/left/data[0],/gripper/left/data[1],/gripper/left/data[2],"
        "/gripper/left/data[3]",
        "t,rightPad0,rightPad1,rightPad2,rightPad3,leftPad0,leftPad1,leftPad2,leftPad3",
        "t,right_a,right_b,right_c,right_d,left_a,left_b,left_c,left_d",
        "t,right_a,right_b,right_c,right_d,left0,left1,left2,left3"}) {
    EXPECT_EQ(columnsByPlace(header, twins()), swapped) << header;
    EXPECT_FALSE(hasNote(planOf(header, twins()), "order of the file")) << header;
  }
  const std::string guessed = "t,b0,b1,b2,b3,a0,a1,a2,a3";
  EXPECT_TRUE(
      hasNote(planOf(guessed, twins()), "taken in the order of the file: left = b0, right = a0"));
  // One name is enough for two.
  EXPECT_EQ(columnsByPlace("t,right0,right1,right2,right3,a0,a1,a2,a3", twins()), swapped);
  const std::string two = testing::errorOf([] {
    planOf(
        "t,left_raw0,left_raw1,left_raw2,left_raw3,left_lp0,left_lp1,left_lp2,left_lp3,"
        "right_raw0,right_raw1,right_raw2,right_raw3",
        twins());
  });
  EXPECT_NE(two.find("both \"left_raw0\" and \"left_lp0\" could be left"), std::string::npos)
      << two;
  // Names with numbers in them.
  HandDescription fingers = twoPads();
  fingers.matrices[0].name = "finger 2 distal";
  fingers.matrices[1].name = "finger 1 distal";
  EXPECT_EQ(columnsByPlace("t,Finger1_distal_0,Finger1_distal_1,Finger1_distal_2,Finger1_distal_3,"
                           "Finger2_distal_0,Finger2_distal_1,Finger2_distal_2,Finger2_distal_3",
                           fingers),
            swapped);
}

// Names count before numbers: one pad of two groups that fit.
TEST(ImportPlan, TheNameOfThePadDecidesBetweenTwoGroups) {
  EXPECT_EQ(columnsByPlace("t,ft0,ft1,ft2,ft3,left0,left1,left2,left3", pad(2, 2)),
            (Places{{0, 5}, {1, 6}, {2, 7}, {3, 8}}));
}

// S7, B5.
TEST(ImportPlan, OnlyPositionsAreAngles) {
  HandDescription hand = handOf({MatrixLayout::full(2, 2, 1.0)}, 2);
  hand.axes[0].name = "thumb base";
  hand.axes[1].name = "thumb tip";
  const std::string pads = "time_ms,p0,p1,p2,p3,";
  using Columns = std::vector<std::size_t>;
  EXPECT_EQ(columnsOfAngles(pads + "Thumb_Tip_deg,THUMB_BASE_deg", hand), (Columns{6, 5}));
  EXPECT_EQ(columnsOfAngles(pads + "effort/thumb base,position/thumb base,velocity/thumb base,"
                                   "effort/thumb tip,position/thumb tip,velocity/thumb tip",
                            hand),
            (Columns{6, 9}));
  EXPECT_EQ(columnsOfAngles(pads + "joint1_target,joint1_actual,joint2_target,joint2_actual", hand),
            (Columns{6, 8}));
  EXPECT_EQ(
      columnsOfAngles(pads + "joint0_effort,joint1_effort,joint0_position,joint1_position", hand),
      (Columns{7, 8}));
  EXPECT_EQ(columnsOfAngles(pads + "joint0_raw,joint1_raw,joint0_position,joint1_position", hand),
            (Columns{7, 8}));
  const std::string speeds = pads + "joint0_velocity,joint1_velocity";
  EXPECT_EQ(columnsOfAngles(speeds, hand), Columns{});
  EXPECT_TRUE(hasNote(planOf(speeds, hand), "joint0_velocity, joint1_velocity seem to be"));
  EXPECT_EQ(columnsOfAngles(pads + "joint0 [rad/s],joint1 [rad/s]", hand), Columns{});
  EXPECT_TRUE(
      hasNote(planOf(pads + "a,b", hand), "that became series, --angles chooses joint angles"));
  // Seven joints of an arm are not those of the hand.
  hand.axes[0].name = "joint 0";
  hand.axes[1].name = "joint 1";
  EXPECT_EQ(columnsOfAngles(pads + "joint0,joint1,joint2,joint3,joint4,joint5,joint6", hand),
            Columns{});
}

// B4.
TEST(ImportPlan, ATemperatureIsFoundByTheNameOfItsSensor) {
  HandDescription hand = handOf({MatrixLayout::full(2, 2, 1.0)}, 0, 2);
  hand.temperatureSensors[0].name = "motor";
  hand.temperatureSensors[1].name = "board";
  for (const char* names : {"board temperature,motor temperature",
                            "temp_board,temp_motor",
                            "Board [degC],Motor [degF]"}) {
    const ImportPlan plan = planOf("time_ms,p0,p1,p2,p3," + std::string(names), hand);
    ASSERT_EQ(plan.series.size(), 2u) << names;
    EXPECT_EQ(plan.series[1].columns, (std::vector<std::size_t>{6, 5})) << names;
  }
}

// S6, S8.
TEST(ImportPlan, EachColumnHasItsOwnUnit) {
  HandDescription hand = pad(1, 3);
  hand.unit = "N";
  const ImportPlan plan = planOf("time_ms,p0 [N],p1 [mN],p2 [N]", hand);
  const PlannedSeries& frames = plan.series.front();
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(frames.values[i].scale, frames.columns[i] == 2 ? 0.001 : 1.0) << i;
  EXPECT_TRUE(hasNote(plan, "different units"));
  EXPECT_TRUE(hasNote(planOf("time_ms,p0,p1,p2", hand),
                      "left: the file gives no unit; the numbers are taken as N"));
}

// S11. pad(2, 3) has the places 0 1 2 / 3 4 5.
TEST(ImportPlan, ALetterAndANumberArePlaces) {
  const Places byColumn = {{0, 1}, {3, 2}, {1, 3}, {4, 4}, {2, 5}, {5, 6}};
  EXPECT_EQ(columnsByPlace("t,A1,B1,A2,B2,A3,B3", pad(2, 3)), byColumn);
  EXPECT_TRUE(hasNote(planOf("t,A1,B1,A2,B2,A3,B3", pad(2, 3)), "letters in the names"));
  EXPECT_EQ(columnsByPlace("t,pad_C1,pad_B1,pad_A1,pad_A2,pad_B2,pad_C2", pad(2, 3)),
            (Places{{2, 1}, {1, 2}, {0, 3}, {3, 4}, {4, 5}, {5, 6}}));
  EXPECT_EQ(columnsByPlace("t,A1,B1,A2,B2", pad(2, 2)), kInOrder);
}

// S5. Names with letters can't mean a matrix and a number.
TEST(ImportPlan, MatricesMayBeOneTableByTheirNames) {
  const Places side = {{0, 1}, {1, 2}, {4, 3}, {5, 4}, {2, 5}, {3, 6}, {6, 7}, {7, 8}};
  EXPECT_EQ(columnsByPlace("t,r0c0,r0c1,r0c2,r0c3,r1c0,r1c1,r1c2,r1c3", twoPads()), side);
  const Places last = {{0, 1}, {4, 2}, {1, 3}, {5, 4}, {2, 5}, {6, 6}, {3, 7}, {7, 8}};
  EXPECT_EQ(columnsByPlace("t,r0c0p0,r0c0p1,r0c1p0,r0c1p1,r1c0p0,r1c0p1,r1c1p0,r1c1p1", twoPads()),
            last);
}

// B1.
TEST(ImportPlan, AMappingMayNameTheMatrix) {
  ImportMapping mapping;
  mapping.matrices = {{std::nullopt, "Right=a*", {}, false}, {std::nullopt, "L=b*", {}, false}};
  EXPECT_EQ(columnsByPlace("t,a0,a1,a2,a3,b0,b1,b2,b3", twins(), mapping),
            (Places{{4, 1}, {5, 2}, {6, 3}, {7, 4}, {0, 5}, {1, 6}, {2, 7}, {3, 8}}));
}

// B11.
TEST(ImportPlan, SaysWhichFormsAreReadWhereNoColumnsCanBeChosen) {
  const std::string refusal = testing::errorOf([] { planOf("time,col,row,value", pad(2, 3)); });
  EXPECT_NE(refusal.find("a line per taxel is read only as palpate convert writes it"),
            std::string::npos)
      << refusal;
  EXPECT_EQ(refusal.find("--matrix"), std::string::npos) << refusal;
}

TEST(ImportPlan, MaskedPlacesMayBeLeftOut) {
  MatrixLayout matrix = MatrixLayout::full(2, 2, 1.0);
  matrix.staticMask[1] = 0;
  matrix.dynamicMask[1] = 0;
  EXPECT_EQ(columnsByPlace("t,p0,p1,p2", handOf({matrix})), (Places{{0, 1}, {2, 2}, {3, 3}}));
  EXPECT_EQ(columnsByPlace("t,p0_0,p1_0,p1_1", handOf({matrix})), (Places{{0, 1}, {2, 2}, {3, 3}}));
  EXPECT_EQ(columnsByPlace("t,p0,p1,p2,p3", handOf({matrix})), kInOrder);
}

TEST(ImportPlan, WithoutNamesTheOrderCounts) {
  EXPECT_EQ(columnsByPlace("a,b,c,d", pad(2, 2), withRate()),
            (Places{{0, 0}, {1, 1}, {2, 2}, {3, 3}}));
  // A column more that ascends is the time.
  ImportMapping mapping;
  mapping.text.header = HeaderChoice::kAbsent;
  const testing::TemporaryFolder folder;
  testing::writeFile(folder / "t.csv", "10,1,2,3,4\n20,1,2,3,4\n30,1,2,3,4\n");
  const auto source = openTable(folder / "t.csv", mapping.text);
  const ImportPlan plan = planImport(*source, pad(2, 2), mapping, mapping.text);
  EXPECT_EQ(plan.series[0].time, 0u);
  EXPECT_EQ(plan.series[0].timeUnit, TimeUnit::kMilliseconds);
  EXPECT_EQ(plan.series[0].columns, (std::vector<std::size_t>{1, 2, 3, 4}));
}

TEST(ImportPlan, AMappingChoosesColumns) {
  const std::string header = "t,a,b,c,d,e";
  const auto choose = [&](const std::string& columns, bool columnByColumn = false) {
    ImportMapping mapping;
    mapping.matrices = {{0, columns, {}, columnByColumn}};
    return columnsByPlace(header, pad(2, 2), mapping);
  };
  const Places second = {{0, 2}, {1, 3}, {2, 4}, {3, 5}};
  EXPECT_EQ(choose("b..e"), second);
  EXPECT_EQ(choose("#3..#6"), second);
  EXPECT_EQ(choose("b, c, #5, e"), second);
  EXPECT_EQ(choose("b..e", true), (Places{{0, 2}, {2, 3}, {1, 4}, {3, 5}}));
  ImportMapping pattern;
  pattern.matrices = {{std::nullopt, "raw {m}/{x}/{y}", {}, false}};
  EXPECT_EQ(
      columnsByPlace("t,raw 0/0/0,raw 0/1/0,raw 0/0/1,raw 0/1/1,other 0/0/0", pad(2, 2), pattern),
      (Places{{0, 1}, {1, 2}, {2, 3}, {3, 4}}));
  pattern.matrices = {{1, "f*_{i}", {}, false}};
  EXPECT_EQ(columnsByPlace("t,f1,foo_1,foo_2,foo_3,foo_4", twoPads(), pattern),
            (Places{{4, 2}, {5, 3}, {6, 4}, {7, 5}}));
}

TEST(ImportPlan, SaysWhatDoesNotFit) {
  const auto refused =
      [](const std::string& header, ImportMapping mapping, const HandDescription& hand) {
        return testing::errorOf([&] { columnsByPlace(header, hand, mapping); });
      };
  const auto matrix = [](const std::string& columns, std::optional<std::size_t> m = 0) {
    ImportMapping mapping;
    mapping.matrices = {{m, columns, {}, false}};
    return mapping;
  };
  const std::string header = "t,a0,a1,a2,a3,note";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {refused("t,a0,a1,a2", {}, pad(2, 2)), "1 matrix of 2 x 2, 4 places"},
      {refused("t,a0,a1,a2", {}, pad(2, 2)), "the file has t, a0, a1, a2"},
      {refused("a0,a1,a2,a3", {}, pad(2, 2)), "the rate of the rows"},
      {refused("t,a0,a1,a2,a3,b0,b1,b2,b3", {}, pad(2, 2)), "choose the columns of each matrix"},
      {refused(header, matrix("b*"), pad(2, 2)), "no column of numbers matches"},
      {refused(header, matrix("a9"), pad(2, 2)), "there is no column \"a9\"; there are t, a0"},
      {refused(header, matrix("#9"), pad(2, 2)), "has 6 columns"},
      {refused(header, matrix("a3..a0"), pad(2, 2)), "end before they begin"},
      {refused(header, matrix("a0..a2"), pad(2, 2)), "3 numbers per row; expected 2 x 2"},
      {refused(header, matrix("a0,,a1"), pad(2, 2)), "empty part"},
      {refused(header, matrix("a{z}"), pad(2, 2)), "something else than {m}"},
      {refused(header, matrix("a{i}"), pad(1, 3)), "taxel 3 of a matrix of 1 x 3"},
      {refused(header, matrix("a0..a3", 4), pad(2, 2)), "no matrix 4"},
      {refused(header, matrix("a0,a0,a1,a2"), pad(2, 2)), "used twice"}};
  for (const auto& [what, words] : cases)
    EXPECT_NE(what.find(words), std::string::npos) << what << "\n" << words;
  ImportMapping time;
  time.time.column = "clock";
  EXPECT_NE(refused(header, time, pad(2, 2)).find("no column \"clock\""), std::string::npos);
  ImportMapping unit = matrix("a0..a3");
  unit.matrices[0].values.unit = "kPa";
  EXPECT_NE(refused(header, unit, pad(2, 2)).find("can't be converted"), std::string::npos);
  ImportMapping angles;
  angles.angles.columns = "a0";
  EXPECT_NE(refused(header, angles, pad(2, 2)).find("the hand has none"), std::string::npos);
}

TEST(ImportPlan, ShapesAreNamed) {
  EXPECT_EQ(shapeText(*twoPads().layout), "2 matrices of 2 x 2, 8 places");
  EXPECT_EQ(shapeText(*sdh2().layout),
            "6 matrices of 14 x 6 and 13 x 6, 486 places with 456 taxels");
}

}  // namespace
}  // namespace palpate::import_plan_test
