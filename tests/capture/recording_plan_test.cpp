#include "palpate/capture/recording_plan.h"

#include <stdexcept>

#include "palpate/core/error.h"

#include "testing/testing.h"

namespace palpate::recording_plan_test {
namespace {

RecordingPlan ballAndCup() {
  RecordingPlan plan;
  plan.addRow({.object = "ball", .run = "left", .repetitions = 2, .notes = "slowly"});
  plan.addRow({.object = "cup", .run = "", .repetitions = 1, .notes = ""});
  return plan;
}

std::string refusalOfTable(std::string_view csv) {
  try {
    readPlanTable(csv);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(RecordingPlan, GoesFromTheTopThroughAllRepetitions) {
  RecordingPlan plan = ballAndCup();
  EXPECT_EQ(plan.total(), 3);
  EXPECT_EQ(plan.next(), (PlanStep{0, 1}));
  plan.addTake(0, {.file = "/r/a.palpate"});
  EXPECT_EQ(plan.next(), (PlanStep{0, 2}));
  plan.addTake(0, {.file = "/r/b.palpate"});
  EXPECT_EQ(plan.next(), (PlanStep{1, 1}));
  plan.addTake(1, {.file = "/r/c.palpate"});
  EXPECT_EQ(plan.next(), std::nullopt);
  EXPECT_EQ(plan.numDone(), 3);
}

TEST(RecordingPlan, WhatIsRejectedOrDiscardedComesAgain) {
  RecordingPlan plan = ballAndCup();
  plan.addTake(0, {.file = "/r/a.palpate"});
  plan.addTake(0, {.file = "/r/b.palpate"});
  EXPECT_TRUE(plan.reject("/r/a.palpate"));
  EXPECT_EQ(plan.numDone(), 1);
  EXPECT_EQ(plan.next(), (PlanStep{0, 2}));
  EXPECT_TRUE(plan.forget("/r/b.palpate"));
  EXPECT_EQ(plan.rows()[0].takes.size(), 1u);
  EXPECT_EQ(plan.next(), (PlanStep{0, 1}));
  EXPECT_FALSE(plan.forget("/r/b.palpate"));
  EXPECT_FALSE(plan.reject("/r/none.palpate"));
}

TEST(RecordingPlan, ABadTakeThatNobodyDecidedIsNotDoneButKeepsItsPlace) {
  RecordingPlan plan = ballAndCup();
  plan.addTake(0, {.file = "/r/a.palpate"});
  plan.setProblem("/r/a.palpate", "nothing was touched");
  EXPECT_EQ(plan.numDone(), 0);
  EXPECT_EQ(plan.numUndecided(), 1);
  EXPECT_EQ(plan.next(), (PlanStep{0, 2}));
  EXPECT_TRUE(planCsv(plan).ends_with("slowly,0\ncup,,1,,0\n")) << planCsv(plan);
  EXPECT_TRUE(plan.keep("/r/a.palpate"));
  EXPECT_EQ(plan.numDone(), 1);
  EXPECT_EQ(plan.numUndecided(), 0);
  EXPECT_EQ(RecordingPlan::fromJson(plan.json()), plan) << "that it is kept is kept";
  EXPECT_TRUE(plan.reject("/r/a.palpate"));
  EXPECT_EQ(plan.next(), (PlanStep{0, 1}));
  EXPECT_FALSE(plan.keep("/r/none.palpate"));
}

TEST(RecordingPlan, ATakeOfAnEarlierVersionIsReadWithoutAWordWhetherItIsKept) {
  const RecordingPlan plan = RecordingPlan::fromJson(
      R"({"plan":1,"rows":[{"object":"ball","run":"","repetitions":1,"notes":"",)"
      R"("takes":[{"file":"/r/a.palpate","problem":"1 gap","rejected":false}]}]})");
  EXPECT_EQ(plan.numUndecided(), 1);
}

TEST(RecordingPlan, ATakeKeepsItsProblemUnderItsNewName) {
  RecordingPlan plan = ballAndCup();
  plan.addTake(0, {.file = "/r/a.palpate"});
  EXPECT_TRUE(plan.setProblem("/r/a.palpate", "nothing was touched"));
  EXPECT_TRUE(plan.rename("/r/a.palpate", "/r/z.palpate"));
  EXPECT_EQ(plan.find("/r/a.palpate"), nullptr);
  ASSERT_NE(plan.find("/r/z.palpate"), nullptr);
  EXPECT_EQ(plan.find("/r/z.palpate")->problem, "nothing was touched");
}

TEST(RecordingPlan, MoreTakesOfOneRowDontStandForThoseOfAnother) {
  RecordingPlan plan = ballAndCup();
  plan.addTake(1, {.file = "/r/a.palpate"});
  plan.addTake(1, {.file = "/r/b.palpate"});
  EXPECT_EQ(plan.numDone(), 1);
  EXPECT_EQ(plan.next(), (PlanStep{0, 1}));
}

TEST(RecordingPlan, ARowIsChangedWithItsTakesKept) {
  RecordingPlan plan = ballAndCup();
  plan.addTake(0, {.file = "/r/a.palpate"});
  plan.setRow(0, {.object = "foam ball", .run = "right", .repetitions = 1});
  EXPECT_EQ(plan.rows()[0].object, "foam ball");
  EXPECT_EQ(plan.rows()[0].takes.size(), 1u);
  EXPECT_EQ(plan.next(), (PlanStep{1, 1}));
  EXPECT_THROW(plan.setRow(0, {.object = ""}), Error);
  EXPECT_THROW(plan.setRow(0, {.object = "a", .repetitions = 1000}), Error);
  EXPECT_EQ(plan.rows()[0].object, "foam ball") << "refused: unchanged";
  EXPECT_THROW(plan.setRow(2, {.object = "a"}), std::out_of_range);
  plan.removeRow(0);
  EXPECT_EQ(plan.total(), 1);
  EXPECT_THROW(plan.removeRow(1), std::out_of_range);
  EXPECT_THROW(plan.addTake(1, {}), std::out_of_range);
}

TEST(RecordingPlan, BegunAnewItKeepsItsRows) {
  RecordingPlan plan = ballAndCup();
  plan.addTake(0, {.file = "/r/a.palpate"});
  plan.forgetTakes();
  EXPECT_EQ(plan, ballAndCup());
}

TEST(RecordingPlan, JsonGivesItBack) {
  RecordingPlan plan = ballAndCup();
  plan.addTake(0, {"/r/Zoë \"1\".palpate", "1 gap of 2.0 s", true});
  plan.addTake(1, {"/r/c.palpate", "", false});
  EXPECT_EQ(RecordingPlan::fromJson(plan.json()), plan);
  EXPECT_EQ(RecordingPlan::fromJson(RecordingPlan().json()), RecordingPlan());
}

TEST(RecordingPlan, WhatIsNoPlanIsRefused) {
  for (const char* text :
       {"",
        "7",
        "{}",
        R"({"plan":2,"rows":[]})",
        R"({"plan":1,"rows":[{"object":1}]})",
        R"({"plan":1,"rows":[{"object":"","run":"","repetitions":1,"notes":"","takes":[]}]})"})
    EXPECT_THROW(RecordingPlan::fromJson(text), Error) << text;
}

TEST(RecordingPlanTable, ColumnsStandInAnyOrderAndOthersArePassedOver) {
  const PlanTable table = readPlanTable(
      "notes;weight;object;repetitions\n"
      "\"a; b\";12; ball ;3\n"
      ";;cup;\n");
  EXPECT_TRUE(table.problems.empty());
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0],
            (PlanRow{.object = "ball", .run = "", .repetitions = 3, .notes = "a; b"}));
  EXPECT_EQ(table.rows[1], (PlanRow{.object = "cup"})) << "one repetition";
}

// Its JSON would hold other texts.
TEST(RecordingPlanTable, TextThatIsNotUtf8IsRefused) {
  const PlanTable table = readPlanTable("object,notes\npen,f\xC3\xBCr rechts\nball,\x92s\n");
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_EQ(table.rows[0].notes, "f\xC3\xBCr rechts");
  ASSERT_EQ(table.problems.size(), 1u);
  EXPECT_NE(table.problems[0].find("notes: is not UTF-8"), std::string::npos) << table.problems[0];
  PlanRow row{.object = std::string("pen\0", 4)};
  EXPECT_EQ(problemOf(row), "object: has a control character");
  row.object = "pen\tblue\nlong";
  EXPECT_EQ(problemOf(row), "");
}

TEST(RecordingPlanTable, BadRowsAreNamedByLineAndColumn) {
  const PlanTable table = readPlanTable(
      "object,run,repetitions\n"
      "ball,1,x\n"
      ",1,2\n"
      "cup,1\n"
      "pen,1,0\n"
      "pen,1,99999999999\n"
      "pen,1,2.5\n"
      "good,1,2\n");
  EXPECT_EQ(table.problems,
            (std::vector<std::string>{"line 2, repetitions: 'x' is not a whole number",
                                      "line 3, object: is empty",
                                      "line 4: has 2 cells, the first line has 3",
                                      "line 5, repetitions: must be 1..999",
                                      "line 6, repetitions: must be 1..999",
                                      "line 7, repetitions: '2.5' is not a whole number"}));
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_EQ(table.rows[0].object, "good");
}

TEST(RecordingPlanTable, ReadingEndsAtTheFirstRowTooMany) {
  std::string csv = "object\n";
  for (int i = 0; i < 10'002; ++i) csv += "a\n";
  const PlanTable table = readPlanTable(csv);
  EXPECT_EQ(table.rows.size(), 10'000u);
  // Only the first one is named.
  EXPECT_EQ(table.problems, std::vector<std::string>{"line 10002: a plan has at most 10000 rows"});
  EXPECT_FALSE(table.more);
}

TEST(RecordingPlanTable, ReadingEndsAtAHundredProblems) {
  std::string csv = "object,repetitions\n";
  for (int i = 0; i < 100; ++i) csv += "a,x\n";
  EXPECT_EQ(readPlanTable(csv).problems.size(), 100u);
  EXPECT_FALSE(readPlanTable(csv).more);
  const PlanTable table = readPlanTable(csv + "good,1\n");
  EXPECT_EQ(table.problems.size(), 100u);
  EXPECT_TRUE(table.more);
  EXPECT_TRUE(table.rows.empty());
}

TEST(RecordingPlanTable, AMessageRepeatsNoLongCell) {
  const PlanTable table =
      readPlanTable("object,repetitions\na," + std::string(1 << 20, 'x') + "\n");
  ASSERT_EQ(table.problems.size(), 1u);
  EXPECT_LT(table.problems[0].size(), 200u);
}

TEST(RecordingPlanTable, ATableOfSomethingElseIsRefused) {
  EXPECT_EQ(refusalOfTable(""), "the table is empty");
  EXPECT_EQ(refusalOfTable("time,value\n1,2\n"),
            "the first line must name the column object (and may name run, repetitions, notes)");
  EXPECT_EQ(refusalOfTable("object,object\n"), "the first line names the column object twice");
}

TEST(RecordingPlanTable, WhatIsWrittenIsReadBack) {
  RecordingPlan plan = ballAndCup();
  plan.addRow({.object = "cup, \"large\"", .run = "2", .repetitions = 5, .notes = "two\nlines"});
  plan.addTake(0, {.file = "/r/a.palpate"});
  EXPECT_TRUE(
      planCsv(plan).starts_with("object,run,repetitions,notes,done\nball,left,2,slowly,1\n"))
      << planCsv(plan);
  const PlanTable table = readPlanTable(planCsv(plan));
  EXPECT_TRUE(table.problems.empty());
  plan.forgetTakes();
  EXPECT_EQ(table.rows, plan.rows());
}

}  // namespace
}  // namespace palpate::recording_plan_test
