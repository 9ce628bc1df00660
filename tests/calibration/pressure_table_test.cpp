#include "palpate/calibration/pressure_table.h"

#include <fstream>

#include "palpate/core/error.h"

#include "testing/testing.h"

namespace palpate::pressure_table_test {
namespace {

TEST(PressureTable, ReadsRowsInAnyOrderOfColumns) {
  const auto rows = parsePressureTable(
      "\xEF\xBB\xBFpressure_kpa,note,file,temperature_c\r\n17.8,x,A1.dsa,\r\n\r\n26.7,\"a, b\",\"B "
      "1.dsa\", 31.5\r\n",
      "t.csv");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].file, "A1.dsa");
  EXPECT_EQ(rows[0].pressureKpa, 17.8);
  EXPECT_FALSE(rows[0].temperatureC);
  EXPECT_EQ(rows[1].file, "B 1.dsa");
  EXPECT_EQ(rows[1].temperatureC, 31.5);
  EXPECT_EQ(rows[1].line, 4u);
  EXPECT_TRUE(rows[1].problem.empty());
}

TEST(PressureTable, SaysWhatIsWrongWithARow) {
  const auto rows = parsePressureTable(
      "file,pressure_kpa,temperature_c\nA,heavy,\n,5,\nB,5,warm\nC,-1\nD,nan\nE,5,30\n", "t.csv");
  ASSERT_EQ(rows.size(), 6u);
  EXPECT_NE(rows[0].problem.find("heavy"), std::string::npos);
  EXPECT_NE(rows[1].problem.find("no file"), std::string::npos);
  EXPECT_NE(rows[2].problem.find("warm"), std::string::npos);
  EXPECT_FALSE(rows[3].problem.empty());
  EXPECT_FALSE(rows[4].problem.empty());
  EXPECT_TRUE(rows[5].problem.empty());
}

TEST(PressureTable, RefusesWhatIsNoTable) {
  for (const char* bad : {"", "\n\n", "file,pressure_kpa\n", "a,b\n1,2\n", "A1.dsa,17.8\n"})
    EXPECT_THROW(parsePressureTable(bad, "t.csv"), FormatError) << bad;
}

TEST(PressureTable, IsReadFromAFile) {
  const testing::TemporaryFolder folder;
  const auto path = folder / "t.csv";
  std::ofstream(path) << "file,pressure_kpa\nA.dsa,5\n";
  EXPECT_EQ(readPressureTable(path).at(0).pressureKpa, 5.0);
  EXPECT_THROW(readPressureTable(folder / "none.csv"), FileError);
  EXPECT_THROW(readPressureTable(folder / "."), FileError);
}

TEST(PressureTable, ARowWithoutAStepIsASampleThatIsNotUsed) {
  StepReport none;
  none.notes.push_back("no step: matrix 1 is never loaded");
  const auto samples = samplesOf({.file = "A.dsa", .pressureKpa = 5.0}, none, "00");
  ASSERT_EQ(samples.size(), 1u);
  EXPECT_FALSE(samples[0].used);
  EXPECT_NE(samples[0].notes.at(0).find("never loaded"), std::string::npos);
}

TEST(PressureTable, TheTablesTemperatureGoesFirst) {
  StepReport report;
  FittedStep step;
  step.fit.converged = step.fit.identifiable = step.fit.steadyStateReached = true;
  step.fit.parameters = StepParameters::ofTimes(300.0, 8.0, 0.5, 0.1);
  step.characteristics.steadyS = 1.5;
  step.nearestDegC = 31.0;
  step.durationS = 9.5;
  report.steps.push_back(step);
  EXPECT_EQ(samplesOf({.file = "A", .pressureKpa = 5.0}, report, "")[0].nearestDegC, 31.0);
  EXPECT_EQ(
      samplesOf({.file = "A", .pressureKpa = 5.0, .temperatureC = 40.0}, report, "")[0].nearestDegC,
      40.0);
  EXPECT_TRUE(samplesOf({.file = "A", .pressureKpa = 5.0}, report, "")[0].used);
  EXPECT_EQ(samplesOf({.file = "A", .pressureKpa = 5.0}, report, "")[0].durationS, 9.5);
  EXPECT_EQ(medianSteadyS({report}), 1.5);
  EXPECT_EQ(medianSteadyS({}), 0.0);
}

}  // namespace
}  // namespace palpate::pressure_table_test
