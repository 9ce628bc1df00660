#include "palpate/recording/label_table.h"

#include <gtest/gtest.h>

#include "palpate/core/error.h"
#include "palpate/emulator/synthetic_profile.h"

namespace palpate::label_table_test {
namespace {

Profile tenSeconds() { return synthesize({.durationS = 10.0, .grasps = 1}); }

std::string csvOf(std::span<const Event> events, const Profile& profile) {
  std::string csv;
  writeTableText(*labelRows(events, profile), {}, [&](const auto& text) { csv += text; });
  return csv;
}

TEST(LabelTable, HasARowForEachLabelInOrderOfTime) {
  const Profile profile = tenSeconds();
  const std::int64_t t0 = profile.frameTimeUs(0);
  const std::vector<Event> events = {
      {t0 + 4'000'001, t0 + 5'500'000, "segment", std::nullopt, "grasp", ""},
      {t0, t0, "gap", std::nullopt, "", ""},
      {t0 + 1'250'000, t0 + 1'250'000, "label", 3, "slips, a little", ""}};
  EXPECT_EQ(csvOf(events, profile),
            "begin_s,end_s,kind,text,matrix\n"
            "1.250000,1.250000,label,\"slips, a little\",3\n"
            "4.000001,5.500000,segment,grasp,\n");
}

TEST(LabelTable, ReadsBackTheSameEvents) {
  const Profile profile = tenSeconds();
  const std::int64_t t0 = profile.frameTimeUs(0);
  const std::int64_t t1 = profile.frameTimeUs(profile.numFrames() - 1);
  std::vector<Event> events = {
      {t0, t1, "note", std::nullopt, "all of it; \"quoted\"\nin two lines", ""},
      {t0 + 7, t0 + 123'457, "label", 0, "a\tb", ""},
      {t1, t1, "mark", 5, "=1+1", ""}};
  const LabelTable table = readLabelTable(csvOf(events, profile), profile);
  EXPECT_TRUE(table.problems.empty());
  EXPECT_EQ(table.events, events);
  EXPECT_TRUE(newLabels(table, events).empty());
  EXPECT_EQ(newLabels(table, std::span(events).first(1)).size(), 2u);
}

TEST(LabelTable, TakesColumnsInAnyOrderAndOtherDelimiters) {
  const Profile profile = tenSeconds();
  const LabelTable table =
      readLabelTable("\xEF\xBB\xBFtext;extra;begin_s\r\nball;9;2.5\r\n\r\ncube;;3\r\n", profile);
  ASSERT_EQ(table.events.size(), 2u);
  EXPECT_EQ(table.events[0].kind, "label");
  EXPECT_EQ(table.events[0].text, "ball");
  EXPECT_EQ(table.events[0].tUs, profile.frameTimeUs(0) + 2'500'000);
  EXPECT_EQ(table.events[0].t1Us, table.events[0].tUs);
  EXPECT_EQ(table.events[1].text, "cube");
}

TEST(LabelTable, NamesBadRowsByTheirLine) {
  const LabelTable table = readLabelTable(
      "begin_s,end_s,kind,text,matrix\n"
      "abc,1,label,a,\n"
      "1,2,label,\"two\nlines\",\n"
      "3,2,label,b,\n"
      "1,99,label,c,\n"
      "1,2,gap,d,\n"
      "1,2,label,e,6\n"
      "1,2,label,,\n"
      "1,2,label\n"
      "1,2,label,\"never closed,\n",
      tenSeconds());
  ASSERT_EQ(table.events.size(), 1u);
  ASSERT_EQ(table.problems.size(), 8u);
  EXPECT_EQ(table.problems[0], "line 2: begin_s 'abc' is not a number");
  EXPECT_EQ(table.problems[1], "line 5: ends before it begins");
  EXPECT_TRUE(table.problems[2].starts_with("line 6: end_s '99' is outside the recording"))
      << table.problems[2];
  EXPECT_EQ(table.problems[3], "line 7: kind 'gap' is not label, note, mark or segment");
  EXPECT_EQ(table.problems[4], "line 8: matrix '6' is not in 0..5");
  EXPECT_EQ(table.problems[5], "line 9: has no text");
  EXPECT_EQ(table.problems[6], "line 10: has 3 cells, the first line has 5");
  EXPECT_EQ(table.problems[7], "line 11: a quote is never closed");
}

// stranger S15, B12.
TEST(LabelTable, TakesNamesAsAPersonWritesThemAndUtf8Only) {
  const Profile profile = tenSeconds();
  const LabelTable table = readLabelTable(
      "Begin_S, End_S, Text, Matrix\n1, 2, grasp, 1\n3, 4, gr\xF6\xDF, 0\n5, 6, a b, " +
          profile.hand().matrices[2].name + "\n7, 8, c, palm\n",
      profile);
  ASSERT_EQ(table.events.size(), 2u);
  EXPECT_EQ(table.events[0].text, "grasp");
  EXPECT_EQ(table.events[0].matrix, 1);
  EXPECT_EQ(table.events[1].text, "a b");
  EXPECT_EQ(table.events[1].matrix, 2);
  ASSERT_EQ(table.problems.size(), 2u);
  EXPECT_EQ(table.problems[0], "line 3: its text is not UTF-8: save the table as UTF-8");
  EXPECT_EQ(table.problems[1], "line 5: matrix 'palm' is not in 0..5, and no matrix has this name");
  for (const std::string_view utf16 : {std::string_view("\xFF\xFE"
                                                        "b\0",
                                                        4),
                                       std::string_view("\0b\0e", 4)})
    try {
      readLabelTable(utf16, profile);
      FAIL();
    } catch (const Error& error) {
      EXPECT_STREQ(error.what(), "is a text in UTF-16; save it as UTF-8");
    }
}

TEST(LabelTable, ReadingEndsAtTheFirstLabelTooManyAndAtAHundredProblems) {
  const Profile profile = tenSeconds();
  std::string csv = "begin_s,text\n";
  for (int i = 0; i < 10'002; ++i) csv += "1," + std::to_string(i) + "\n";
  const LabelTable full = readLabelTable(csv, profile);
  EXPECT_EQ(full.events.size(), 10'000u);
  EXPECT_EQ(full.problems,
            std::vector<std::string>{"line 10002: a table has at most 10000 labels"});
  csv = "begin_s,text\n";
  for (int i = 0; i < 101; ++i) csv += "x,a\n";
  const LabelTable bad = readLabelTable(csv, profile);
  EXPECT_EQ(bad.problems.size(), 100u);
  EXPECT_TRUE(bad.more);
}

TEST(LabelTable, ALabelThatStandsTwiceIsAddedOnce) {
  const Profile profile = tenSeconds();
  const LabelTable table =
      readLabelTable("begin_s,text,matrix\n1,a,\n1,a,\n1,a,0\n2,a,\n1,b,\n", profile);
  Event there = table.events[3];
  there.json = "{}";
  EXPECT_EQ(newLabels(table, std::vector{there}),
            (std::vector{table.events[0], table.events[2], table.events[4]}));
}

TEST(LabelTable, RefusesATableWithoutItsColumns) {
  EXPECT_THROW(readLabelTable("start,label\n1,a\n", tenSeconds()), Error);
  EXPECT_THROW(readLabelTable("", tenSeconds()), Error);
}

}  // namespace
}  // namespace palpate::label_table_test
