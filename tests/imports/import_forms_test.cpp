// The forms of texts that programs write: dates, times in several columns or in another file,
// frames of several lines, lists.
#include <map>

#include "palpate/imports/recording_import.h"

#include "imports/import_samples.h"

namespace palpate::import_forms_test {
namespace {
namespace fs = std::filesystem;

using testing::importText;
using testing::pad;
using testing::TemporaryFolder;
using testing::twoPads;

// imports 14.
TEST(ImportForms, BytesZeroOfAPowerCutAreLeftOutAndCounted) {
  const TemporaryFolder folder;
  const std::string before = "time_ms,a,b\n10,1,2\n20,3,4\n";
  // Longer than what is read at once, and than the longest line.
  const std::string block(5'000'000, '\0');
  const auto behind = importText(folder, before + block, pad(1, 2));
  EXPECT_EQ(behind.report.frames, 2u);
  EXPECT_EQ(behind.report.refused.total(), 0u);
  EXPECT_TRUE(behind.report.isPartial());
  EXPECT_EQ(behind.report.lossText(), "5000000 bytes 0 left out (a power cut?), from line 4 on");
  EXPECT_EQ(behind.report.notes, std::vector<std::string>());
  // Within a row: neither its beginning nor what follows in the same line is taken.
  const auto within = importText(
      folder, before + "30,5,6" + std::string(100, '\0') + "50,7,8\n60,9,10\n", pad(1, 2));
  EXPECT_EQ(within.report.frames, 3u);
  EXPECT_EQ(within.profile.frameTimeUs(2), 60'000);
  EXPECT_EQ(within.report.refused.wrongCount, 2u);
  EXPECT_EQ(within.report.refused.first, "line 4 is cut off by bytes 0");
  EXPECT_EQ(within.report.nulBytes.count, 100u);
  EXPECT_EQ(within.report.nulBytes.line, 4u);
  const std::string strict = testing::errorOf([&] {
    importText(
        folder, before + block, pad(1, 2), {}, {.strict = true, .overwrite = Overwrite::kReplace});
  });
  EXPECT_NE(strict.find("5000000 bytes 0"), std::string::npos) << strict;
}

TEST(ImportForms, RowsBelowLaterNamesAreReadByThem) {
  const TemporaryFolder folder;
  const std::string first = "time_ms,a,b\n10,1,2\n";
  const auto moved =
      importText(folder, first + "b,time_ms,a\n4,20,3\n6,30,5\ntime_ms,a,b\n40,7,8\n", pad(1, 2));
  ASSERT_EQ(moved.report.frames, 4u);
  EXPECT_EQ(moved.profile.frameTimeUs(2), 30'000);
  EXPECT_EQ(moved.profile.frame(1).values, (std::vector<float>{3, 4}));
  EXPECT_EQ(moved.profile.frame(2).values, (std::vector<float>{5, 6}));
  EXPECT_EQ(moved.profile.frame(3).values, (std::vector<float>{7, 8}));
  EXPECT_EQ(moved.report.refused.total(), 2u);
  EXPECT_EQ(moved.report.refused.first,
            "line 3 has the names in another order: the rows below it are read by them");
  // Rows of another table are none of this one.
  const auto other =
      importText(folder, first + "time_ms,x,y\n20,900,901\ntime_ms,a,b\n30,5,6\n", pad(1, 2));
  ASSERT_EQ(other.report.frames, 2u);
  EXPECT_EQ(other.profile.frame(1).values, (std::vector<float>{5, 6}));
  EXPECT_EQ(other.report.refused.wrongCount, 1u);
  EXPECT_EQ(other.report.refused.total(), 3u);
  // A row of words is no line of names.
  for (const char* row : {"off,off,off\n", "sensor,not,ready\n"}) {
    const auto words = importText(folder, first + row + "20,3,4\n", pad(1, 2));
    EXPECT_EQ(words.report.frames, 2u) << row;
    EXPECT_EQ(words.report.refused.total(), 1u) << row;
  }
}

// imports 22.
TEST(ImportForms, DatesAndTimesOfDayOfTheUsualForms) {
  const TemporaryFolder folder;
  constexpr std::int64_t kDayUs = 86'400'000'000;
  // 2025-03-30 is 20,177 days after 1970 (Python: date(2025, 3, 30).toordinal() - 719163).
  constexpr std::int64_t kMarch30Us = 20'177 * kDayUs;
  constexpr std::int64_t kOneUs = 13 * 3'600'000'000LL;
  const auto start = [&](const std::string& times, const ImportMapping& mapping = {}) {
    std::string text = "Zeit;p0;p1\n";
    for (const char* second : {"00", "01"}) {
      std::string time = times;
      text += time.replace(time.find("SS"), 2, second) + ";1;2\n";
    }
    const auto made = importText(folder, text, pad(1, 2), mapping);
    EXPECT_EQ(made.report.frames, 2u) << text << made.report.refused.first;
    EXPECT_EQ(made.profile.frameTimeUs(1) - made.profile.frameTimeUs(0), 1'000'000) << text;
    return made.profile.frameTimeUs(0);
  };
  EXPECT_EQ(start("30.03.2025 13:00:SS,5"), kMarch30Us + kOneUs + 500'000);
  EXPECT_EQ(start("3/30/2025 1:00:SS PM"), kMarch30Us + kOneUs);
  EXPECT_EQ(start("30/3/2025 13:00:SS"), kMarch30Us + kOneUs);
  EXPECT_EQ(start("2025-03-30-13:00:SS"), kMarch30Us + kOneUs);
  EXPECT_EQ(start("13:00:SS.250"), kOneUs + 250'000);
  ImportMapping day;
  day.time.startUs = kMarch30Us;
  EXPECT_EQ(start("13:00:SS.250", day), kMarch30Us + kOneUs + 250'000);
  const std::string clock = "t,p0,p1\n23:59:59,1,2\n00:00:00,3,4\n00:00:01,5,6\n";
  const auto night = importText(folder, clock, pad(1, 2), day);
  ASSERT_EQ(night.report.frames, 3u) << night.report.refused.first;
  EXPECT_EQ(night.profile.frameTimeUs(2), kMarch30Us + kDayUs + 1'000'000);
  EXPECT_EQ(importText(folder, clock, pad(1, 2)).report.notes,
            std::vector<std::string>{"time: \"t\" has times of day without a date; give the day by "
                                     "--start 2026-11-22"});
}

// imports 13.
TEST(ImportForms, ATimeInTwoColumnsIsJoined) {
  const TemporaryFolder folder;
  // 2014-11-27 10:31:05 UTC.
  constexpr std::int64_t kUs = 1'417'084'265'000'000;
  const std::string rows = "2014-11-27,10:31:05.000,1,2\n2014-11-27,10:31:05.010,3,4\n";
  ImportMapping byPosition;
  byPosition.time.column = "#1,#2";
  ImportMapping byName;
  byName.time.column = "Date, Time";
  for (const auto& [head, mapping] : std::vector<std::pair<std::string, ImportMapping>>{
           {"Date,Time,p0,p1\n", {}}, {"Date,Time,p0,p1\n", byName}, {"", {}}, {"", byPosition}}) {
    const auto made = importText(folder, head + rows, pad(1, 2), mapping);
    ASSERT_EQ(made.report.frames, 2u) << head << made.report.refused.first;
    EXPECT_EQ(made.profile.frameTimeUs(0), kUs);
    EXPECT_EQ(made.profile.frameTimeUs(1), kUs + 10'000);
    EXPECT_EQ(made.report.refused.total(), 0u);
    EXPECT_EQ(made.report.notes.size(), 2u) << "joined, and UTC";
  }
  const std::string german = "Datum;Zeit;p0;p1\n27.11.2014;10:31:05,5;1;2\n";
  EXPECT_EQ(importText(folder, german, pad(1, 2)).profile.frameTimeUs(0), kUs + 500'000);
  // ROS 2: seconds and nanoseconds, with and without names; one row is damaged.
  const std::string ros = "1417084265,999999000,1,2\n1417084266,1000000,3,4\n1417084266,x,5,6\n";
  for (const auto& [head, mapping] : std::vector<std::pair<std::string, ImportMapping>>{
           {"header.stamp.sec,header.stamp.nanosec,p0,p1\n", {}},
           {"sec,nanosec,p0,p1\n", {}},
           {"", byPosition}}) {
    const auto made = importText(folder, head + ros, pad(1, 2), mapping);
    ASSERT_EQ(made.report.frames, 2u) << head << made.report.refused.first;
    EXPECT_EQ(made.profile.frameTimeUs(0), kUs + 999'999);
    EXPECT_EQ(made.profile.frameTimeUs(1), kUs + 1'001'000);
    EXPECT_EQ(made.report.refused.text, 1u);
  }
  // A stamp from 0 on looks like one time in two units; its name says that it is none.
  const auto fromZero = importText(
      folder, "stamp.secs,stamp.nsecs,p0,p1\n0,0,1,2\n0,10000000,3,4\n1,500000,5,6\n", pad(1, 2));
  ASSERT_EQ(fromZero.report.frames, 3u) << fromZero.report.refused.first;
  EXPECT_EQ(fromZero.profile.frameTimeUs(1) - fromZero.profile.frameTimeUs(0), 10'000);
  EXPECT_EQ(fromZero.profile.frameTimeUs(2) - fromZero.profile.frameTimeUs(0), 1'000'500);
  ImportMapping wrong;
  wrong.time.column = "p0,p1";
  const std::string what =
      testing::errorOf([&] { importText(folder, "t,p0,p1\n1,0.5,2\n2,3,4\n", pad(1, 2), wrong); });
  EXPECT_NE(what.find("\"p0,p1\" are not a date and a time of day"), std::string::npos) << what;
}

// imports 22.
TEST(ImportForms, ASerialMonitorsTimesBeforeTheLines) {
  const TemporaryFolder folder;
  constexpr std::int64_t kUs = 37'860'123'000;  // 10:31:00.123 after midnight
  for (const char* text :
       {"10:31:00.123 -> 1,2,3,4\r\n10:31:01.123 -> 5,6,7,8\r\n",
        "10:31:00.100 -> a,b,c,d\n10:31:00.123 -> 1,2,3,4\n10:31:01.123 -> 5,6,7,8\n",
        "[10:31:00.123] 1 2 3 4\n[10:31:01.123] 5 6 7 8\n",
        "10:31:00.123 -> A0:1,A1:2,A2:3,A3:4\n10:31:01.123 -> A0:5,A1:6,A2:7,A3:8\n",
        "[1970-01-01 10:31:00.123] 1;2;3;4\n[1970-01-01 10:31:01.123] 5;6;7;8\n"}) {
    const auto made = importText(folder, text, pad(2, 2));
    ASSERT_EQ(made.report.frames, 2u) << text << made.report.refused.first;
    EXPECT_EQ(made.profile.frameTimeUs(0), kUs) << text;
    EXPECT_EQ(made.profile.frameTimeUs(1), kUs + 1'000'000) << text;
    EXPECT_EQ(made.profile.frame(1).values, (std::vector<float>{5, 6, 7, 8})) << text;
    EXPECT_EQ(made.report.refused.total(), 0u) << text;
  }
  // A line that the monitor did not stamp is refused.
  const auto one = importText(folder,
                              "10:31:00.123 -> 1,2\n3,4\n10:31:01.123 -> 5,6\n"
                              "10:31:02.123 -> 7,8\n",
                              pad(1, 2));
  EXPECT_EQ(one.report.frames, 3u);
  EXPECT_EQ(one.report.refused.first, "line 2 has 2 cells instead of 3");
}

TEST(ImportForms, ADayThatMayBeTheMonthIsAsked) {
  const TemporaryFolder folder;
  const std::string text = "t,p0,p1\n03/04/2025 13:00:00,1,2\n03/04/2025 13:00:01,3,4\n";
  EXPECT_NE(testing::errorOf([&] { importText(folder, text, pad(1, 2)); })
                .find("the day or the month may come first in \"03/04/2025 13:00:00\"; choose by "
                      "--time-unit dmy or mdy"),
            std::string::npos);
  ImportMapping mapping;
  mapping.time.unit = "dmy";
  // date -u -d "2025-04-03 13:00" +%s; 2025-03-04.
  EXPECT_EQ(importText(folder, text, pad(1, 2), mapping).profile.frameTimeUs(0),
            1'743'685'200'000'000);
  mapping.time.unit = "mdy";
  EXPECT_EQ(importText(folder, text, pad(1, 2), mapping).profile.frameTimeUs(0),
            1'741'093'200'000'000);
  const std::string noon = "t,p0,p1\n3/4/2025 1:00:00 PM,1,2\n3/4/2025 1:00:01 PM,3,4\n";
  const auto guessed = importText(folder, noon, pad(1, 2));
  EXPECT_EQ(guessed.profile.frameTimeUs(0), 1'741'093'200'000'000);
  ASSERT_FALSE(guessed.report.notes.empty());
  EXPECT_NE(guessed.report.notes[0].find("the month is taken to come first"), std::string::npos);
}

// imports 17.
TEST(ImportForms, AFrameOfSeveralLines) {
  const TemporaryFolder folder;
  ImportMapping rate;
  rate.time.rateHz = 100.0;
  const std::vector<float> second{10, 11, 12, 13, 14, 15};
  for (const char* text : {"0 1 2 \r\n3 4 5 \r\n\r\n10 11 12 \r\n13 14 15 \r\n\r\n",
                           "START\n0,1,2\n3,4,5\nSTART\n10,11,12\n13,14,15\n",
                           "frame 1 of 2\n0 1 2\n3 4 5\nframe 2 of 2\n10 11 12\n13 14 15\n",
                           "0,1,2\n3,4,5\n10,11,12\n13,14,15\n",
                           "boot: ready\n0,1,2,\n3,4,5,\n10,11,12,\n13,14,15,\n"}) {
    const auto made = importText(folder, text, pad(2, 3), rate);
    ASSERT_EQ(made.report.frames, 2u) << text << made.report.refused.first;
    EXPECT_EQ(made.profile.frame(0).values, (std::vector<float>{0, 1, 2, 3, 4, 5})) << text;
    EXPECT_EQ(made.profile.frame(1).values, second) << text;
    EXPECT_EQ(made.report.refused.total(), 0u) << text << made.report.refused.first;
    ASSERT_FALSE(made.report.notes.empty());
    EXPECT_NE(made.report.notes[0].find("a frame is 2 lines of 3 numbers"), std::string::npos);
  }
  // Two matrices, one below the other; a time that stands alone before each frame.
  const auto two = importText(folder,
                              "10\n1 2\n3 4\n5 6\n7 8\n20\n0 0\n0 1\n0 2\n0 3\n"
                              "45\n0 0\n0 1\n0 2\n0 3\n",
                              twoPads());
  ASSERT_EQ(two.report.frames, 3u) << two.report.refused.first;
  EXPECT_EQ(two.profile.frame(0).values, (std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(two.profile.frameTimeUs(2), 45'000);
}

TEST(ImportForms, AFrameThatLacksALineIsRefusedAndShiftsNoOther) {
  const TemporaryFolder folder;
  ImportMapping rate;
  rate.time.rateHz = 100.0;
  const auto marked =
      importText(folder, "0 1\n2 3\n\n4 5\n\n6 7\n8 9\n\n1 1\n2 2\n\n3 3\n", pad(2, 2), rate);
  EXPECT_EQ(marked.report.frames, 3u);
  EXPECT_EQ(marked.report.refused.wrongCount, 2u) << "one within, and the last one";
  EXPECT_EQ(marked.report.refused.first, "line 4 begins a frame of 1 line instead of 2");
  EXPECT_EQ(marked.profile.frame(1).values, (std::vector<float>{6, 7, 8, 9}));
  EXPECT_EQ(marked.profile.frameTimeUs(1), 20'000);
  // Where nothing marks frames, none is taken after a line that is none of a frame.
  std::string text;
  for (int i = 0; i < 300; ++i) text += "1 2\n3 4\n";
  text += "5 6\nreset\n7 8\n9 1\n2 3\n";
  const auto counted = importText(folder, text, pad(2, 2), rate);
  EXPECT_EQ(counted.report.frames, 300u);
  EXPECT_EQ(counted.report.refused.wrongCount, 2u);
  EXPECT_NE(counted.report.refused.first.find("line 602"), std::string::npos)
      << counted.report.refused.first;
}

// The head and the frames of Tekscan's ASCII export.
TEST(ImportForms, AMovieOfTekscanHasItsRate) {
  const TemporaryFolder folder;
  std::string text =
      "DATA_TYPE MOVIE\r\nVERSION 2\r\nROWS 2\r\nCOLS 3\r\nROW_SPACING 5.08 mm\r\n"
      "SECONDS_PER_FRAME 0.01\r\nSTART_FRAME 1\r\nEND_FRAME 8\r\nUNITS Raw\r\n"
      "ASCII_DATA @@\r\n\r\n";
  for (const char* number : {"1", "2", "3", "4", "5", "6", "7", "8"})
    text += std::string("Frame ") + number + "\r\n" + number + ",1,2\r\n3,4,5\r\n\r\n";
  const auto made = importText(folder, text + "@@\r\n", pad(2, 3));
  ASSERT_EQ(made.report.frames, 8u) << made.report.refused.first;
  EXPECT_EQ(made.profile.frameTimeUs(1) - made.profile.frameTimeUs(0), 10'000);
  EXPECT_EQ(made.profile.frame(7).values, (std::vector<float>{8, 1, 2, 3, 4, 5}));
  EXPECT_EQ(made.report.notes[0], "time: the file gives a rate of 100 Hz");
}

// stranger S10: later frames were one period too early.
TEST(ImportForms, AHoleInTheNumbersOfFramesIsLoss) {
  const TemporaryFolder folder;
  std::string movie = "DATA_TYPE MOVIE\nROWS 2\nCOLS 3\nSECONDS_PER_FRAME 0.05\nASCII_DATA @@\n\n";
  std::string counted = "frame,p0,p1,p2,p3,p4,p5\n";
  std::string unnamed, timed = "seq,t_ms,p0,p1,p2,p3,p4,p5\n";
  for (const char* number : {"1", "2", "3", "4", "6", "7", "8", "9"}) {
    const std::string values = std::string(number) + ",1,2,3,4,5\n";
    movie += std::string("Frame ") + number + "\n" + number + ",1,2\n3,4,5\n\n";
    counted += std::string(number) + "," + values;
    unnamed += std::string(number) + "," + values;
    timed += std::string(number) + "," + number + "0," + values;
  }
  ImportMapping at20Hz;
  at20Hz.time.rateHz = 20.0;
  for (const auto& [text, mapping, periodUs] :
       std::vector<std::tuple<std::string, ImportMapping, std::int64_t>>{{movie, {}, 50'000},
                                                                         {counted, at20Hz, 50'000},
                                                                         {unnamed, at20Hz, 50'000},
                                                                         {timed, {}, 10'000}}) {
    const auto made = importText(folder, text, pad(2, 3), mapping);
    ASSERT_EQ(made.report.frames, 8u) << text << made.report.refused.first;
    EXPECT_EQ(made.report.missingFrames, 1u) << text;
    EXPECT_TRUE(made.report.isPartial());
    EXPECT_NE(made.report.lossText().find("1 frame is missing by the numbers in the file"),
              std::string::npos)
        << made.report.lossText();
    EXPECT_EQ(made.profile.frameTimeUs(3) - made.profile.frameTimeUs(0), 3 * periodUs) << text;
    EXPECT_EQ(made.profile.frameTimeUs(4) - made.profile.frameTimeUs(0), 5 * periodUs) << text;
    EXPECT_EQ(made.profile.frame(4).values, (std::vector<float>{6, 1, 2, 3, 4, 5}));
  }
  // A line that is refused is no second loss; numbers that start anew are none at all.
  const std::string damaged =
      "frame,p0,p1\n1,1,1\n2,1,1\n3,1,1\n4,1\n5,1,1\n1,1,1\n2,1,1\n3,1,1\n4,1,1\n5,1,1\n";
  const auto made = importText(folder, damaged, pad(1, 2), at20Hz);
  EXPECT_EQ(made.report.missingFrames, 0u);
  EXPECT_EQ(made.report.refused.wrongCount, 1u);
  EXPECT_EQ(made.profile.frameTimeUs(3), 200'000);
  EXPECT_EQ(made.profile.frameTimeUs(8), 450'000);
}

// stranger B10.
TEST(ImportForms, AMovieOfTekscanMayHaveBlockedCellsAndAnotherShape) {
  const TemporaryFolder folder;
  std::string text = "DATA_TYPE MOVIE\nROWS 2\nCOLS 3\nSECONDS_PER_FRAME 0.05\nASCII_DATA @@\n\n";
  for (const char* number : {"1", "2", "3"})
    text += std::string("Frame ") + number + "\n1,B,3\n4,5," + number + "\n\n";
  const auto made = importText(folder, text, pad(2, 3));
  ASSERT_EQ(made.report.frames, 3u) << made.report.refused.first;
  EXPECT_EQ(made.profile.frame(2).values, (std::vector<float>{1, 0, 3, 4, 5, 3}));
  EXPECT_NE(made.report.notes[1].find("blocked cells (B) are read as 0"), std::string::npos);
  const std::string what = testing::errorOf([&] { importText(folder, text, pad(3, 2)); });
  EXPECT_NE(what.find("; its head says 2 rows x 3 columns"), std::string::npos) << what;
}

// stranger S12: `info` of the recording told of it.
TEST(ImportForms, AGapAfterTheFirstFrameIsCounted) {
  const TemporaryFolder folder;
  std::string text = "t_ms,p0,p1\n0,1,2\n";
  for (int i = 0; i < 20; ++i) text += std::to_string(100'000 + 10 * i) + ",1,2\n";
  const auto made = importText(folder, text, pad(1, 2));
  EXPECT_EQ(made.report.gaps, 1u);
  EXPECT_EQ(made.report.longestGapS, 100.0);
  EXPECT_EQ(importText(folder, text.substr(0, text.find("100000")), pad(1, 2)).report.gaps, 0u);
}

// stranger B3, S16.
TEST(ImportForms, UnitsOfTime) {
  const TemporaryFolder folder;
  const auto lengthUs = [&](const std::string& head, const std::string& rows) {
    const auto made = importText(folder, head + ",p0,p1\n" + rows, pad(1, 2));
    EXPECT_EQ(made.report.refused.total(), 0u) << made.report.refused.first;
    return made.profile.frameTimeUs(made.report.frames - 1) - made.profile.frameTimeUs(0);
  };
  const std::string rows = "0.0,1,2\n0.5,3,4\n1.5,5,6\n";
  EXPECT_EQ(lengthUs("time [min]", rows), 90'000'000);
  EXPECT_EQ(lengthUs("elapsed (h)", rows), 5'400'000'000);
  EXPECT_EQ(lengthUs("time_min", rows), 90'000'000);
  EXPECT_EQ(lengthUs("time [hours]", "1,1,2\n2,3,4\n3,5,6\n"), 7'200'000'000);
  const std::string parts = "1700000000,900,1,2\n1700000000,950,3,4\n1700000001,0,5,6\n";
  EXPECT_EQ(lengthUs("sec,ms", parts), 100'000);
  ImportMapping joined;
  joined.time.column = "sec,ms";
  EXPECT_EQ(importText(folder, "sec,ms,p0,p1\n" + parts, pad(1, 2), joined).report.frames, 3u);
  const auto refusal = [&](const std::string& head, const ImportMapping& mapping = {}) {
    return testing::errorOf(
        [&] { importText(folder, head + ",p0,p1\n" + rows, pad(1, 2), mapping); });
  };
  const std::string unknown = refusal("time [fortnight]");
  EXPECT_NE(unknown.find("the unit \"fortnight\" of \"time [fortnight]\" is not known; name it by "
                         "--time-unit (s, ms, us, ns, min, h)"),
            std::string::npos)
      << unknown;
  ImportMapping minutes;
  minutes.time.unit = "min";
  EXPECT_EQ(refusal("time [fortnight]", minutes), "");
}

// stranger B2, B6, B7.
TEST(ImportForms, TimesThatCanNotBeReadSayWhy) {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& name,
                           std::initializer_list<const char*> times,
                           const ImportMapping& mapping = {}) {
    std::string text = name + ",p0,p1\n";
    for (const char* time : times) text += std::string(time) + ",1,2\n";
    return testing::errorOf([&] { importText(folder, text, pad(1, 2), mapping); });
  };
  ImportMapping chosen;
  chosen.time.column = "when";
  for (const std::string& what : {refusal("time", {"27 Nov 2026 10:00:00", "27 Nov 2026 10:00:01"}),
                                  refusal("elapsed", {"0:59.95", "1:00.00"}),
                                  refusal("TimeStamp", {"0.05s", "0.10s"}),
                                  refusal("when", {"10:00:00:050", "10:00:00:060"}, chosen)})
    EXPECT_NE(what.find(", which is not a readable time: numbers, 2026-11-22T10:31:05.123Z"),
              std::string::npos)
        << what;
  const std::string large = refusal("time_s", {"1700000000000", "1700000000050"});
  EXPECT_NE(large.find("the time 1700000000000 is too large for s; is it in ms (--time-unit)?"),
            std::string::npos)
      << large;
  const std::string falling = refusal("time_s", {"0.3", "0.2", "0.1"});
  EXPECT_NE(falling.find("time: it descends from row to row; sort the file by time"),
            std::string::npos)
      << falling;
}

// stranger B8, B9.
TEST(ImportForms, WhatIsNoTableNamesTheFormsThatAreRead) {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& text) {
    return testing::errorOf([&] { importText(folder, text, pad(1, 2)); });
  };
  const std::string array = refusal("[\n {\n  \"t\": 0.0,\n  \"pad\": [1, 2]\n }\n]\n");
  EXPECT_NE(array.find("is JSON over several lines; save an object in each line"),
            std::string::npos)
      << array;
  const std::string columns = refusal("{\"time\": [0, 1, 2], \"pad\": [[1, 2], [3, 4], [5, 6]]}\n");
  EXPECT_NE(columns.find("JSON is read as an object or a list in each line, one for each frame"),
            std::string::npos)
      << columns;
  const std::string pipes = refusal("time|p0|p1\n0|1|2\n1|3|4\n");
  EXPECT_NE(pipes.find("(cells are separated by commas, semicolons, tabs or blanks)"),
            std::string::npos)
      << pipes;
}

// imports 20.
TEST(ImportForms, ListsInCellsAndInLines) {
  const TemporaryFolder folder;
  for (const char* text : {"time_ms,data\n10,\"[1, 2, 3, 4]\"\n20,\"[5, 6, 7, 8]\"\n",
                           "time_ms,data\n10,[1 2 3 4]\n20,[ 5  6  7  8]\n",
                           "time_ms,data\n10,[1, 2, 3, 4]\n20,[5, 6, 7, 8]\n",
                           "10;(1, 2, 3, 4)\n20;(5, 6, 7, 8)\n",
                           "[10, 1, 2, 3, 4]\n[20, 5, 6, 7, 8]\n",
                           "(10, 1, 2, 3, 4)\n(20, 5, 6, 7, 8)\n",
                           "[10, [[1, 2], [3, 4]]]\n[20, [[5, 6], [7, 8]]]\n",
                           "{\"t\": 0.01, \"id\": \"a\", \"data\": [1, 2, 3, 4]}\n"
                           "{\"t\": 0.02, \"id\": \"b\", \"data\": [5, 6, 7, 8]}\n",
                           "{\"time_ms\":10,\"pad\":{\"raw\":[[1,2],[3,4]]}}\r\n"
                           "{\"pad\":{\"raw\":[[5,6],[7,8]]},\"time_ms\":20}\r\n"}) {
    ImportMapping mapping;
    if (text[0] == '[' && std::string_view(text).find("[[") != std::string_view::npos)
      mapping.time.column = "list[0]";
    if (std::string_view(text).starts_with("10;")) mapping.time.column = "#1";
    const auto made = importText(folder, text, pad(2, 2), mapping);
    ASSERT_EQ(made.report.frames, 2u) << text << made.report.refused.first;
    EXPECT_EQ(made.profile.frameTimeUs(0), 10'000) << text;
    EXPECT_EQ(made.profile.frameTimeUs(1), 20'000) << text;
    EXPECT_EQ(made.profile.frame(1).values, (std::vector<float>{5, 6, 7, 8})) << text;
    EXPECT_EQ(made.report.refused.total(), 0u) << text << made.report.refused.first;
  }
  // A number too many, one too few, a list that is cut.
  const auto damaged = importText(folder,
                                  "time_ms,data\n10,\"[1, 2]\"\n20,\"[1, 2]\"\n30,\"[1, 2, 3]\"\n"
                                  "40,\"[1]\"\n50,\"[1, \n60,\"[5, 6]\"\n",
                                  pad(1, 2));
  EXPECT_EQ(damaged.report.frames, 3u);
  EXPECT_EQ(damaged.report.refused.wrongCount, 2u);
  EXPECT_EQ(damaged.report.refused.missing, 1u);
  EXPECT_NE(damaged.report.refused.first.find("line 4 has"), std::string::npos)
      << damaged.report.refused.first;
}

// imports 25.
TEST(ImportForms, TimesOfAnotherFile) {
  const TemporaryFolder folder;
  testing::writeFile(folder / "t_ns.csv", "1417084265000250000\n1417084265010250000\n");
  testing::writeFile(folder / "times.csv", "frame,time_ms\n0,10\n1,25\n2,40\n");
  ImportMapping mapping;
  mapping.time.column = "t_ns.csv";
  const auto made = importText(folder, "1,2\n3,4\n", pad(1, 2), mapping);
  ASSERT_EQ(made.report.frames, 2u) << made.report.refused.first;
  EXPECT_EQ(made.profile.frameTimeUs(1), 1'417'084'265'010'250);
  EXPECT_EQ(made.profile.frame(1).values, (std::vector<float>{3, 4}));
  EXPECT_EQ(made.report.notes, std::vector<std::string>());
  // A row without a time is refused; a time without a row is said.
  const auto less = importText(folder, "1,2\n3,4\n5,6\n", pad(1, 2), mapping);
  EXPECT_EQ(less.report.frames, 2u);
  EXPECT_EQ(less.report.refused.missing, 1u);
  mapping.time.column = "times.csv";
  const auto more = importText(folder, "1,2\n3,4\n", pad(1, 2), mapping);
  EXPECT_EQ(more.profile.frameTimeUs(1), 25'000);
  ASSERT_FALSE(more.report.notes.empty());
  EXPECT_EQ(more.report.notes.back(), "time: times.csv has more times than table.csv has rows");
}

TEST(ImportForms, AFolderWithAFilePerFrame) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "session");
  const auto write = [&](const char* name, const std::string& text) {
    testing::writeFile(folder / "session" / name, text);
  };
  write("frame_2.csv", "5,6\n7,8\n");
  write("frame_10.csv", "9,1\n2,3\n");
  write("frame_1.csv", "1,2\n3,4\n");
  write("frame_11.csv", "1,2\n");
  write("notes.txt", "nothing");
  ImportMapping mapping;
  mapping.time.rateHz = 100.0;
  const ImportReport report =
      importRecording(folder / "session", pad(2, 2), mapping, folder / "o.palpate");
  EXPECT_EQ(report.frames, 3u) << report.refused.first;
  EXPECT_EQ(report.refused.first, "file 4 (frame_11.csv) has 2 numbers instead of 2 x 2");
  const Profile profile = openRecording(folder / "o.palpate");
  EXPECT_EQ(profile.frame(1).values, (std::vector<float>{5, 6, 7, 8}));
  EXPECT_EQ(profile.frame(2).values, (std::vector<float>{9, 1, 2, 3}));
  // The numbers in the names may be the times.
  mapping.time = {};
  mapping.time.column = "file";
  mapping.time.unit = "ms";
  importRecording(folder / "session",
                  pad(2, 2),
                  mapping,
                  folder / "o.palpate",
                  {.overwrite = Overwrite::kReplace});
  EXPECT_EQ(openRecording(folder / "o.palpate").frameTimeUs(2), 10'000);
}

// imports 26.
TEST(ImportForms, TheRateAndTheDatesOfAnHdf5FileAreUsed) {
  const TemporaryFolder folder;
  testing::runPython(folder, R"(
import sys, numpy as np, h5py
folder = sys.argv[1] + '/'
dates = [b'2026-11-22T10:31:05.00Z', b'2026-11-22T10:31:05.25Z', b'2026-11-22T10:31:05.50Z', b'2026-11-22T10:31:06.00Z']
def write(name, fill):
  with h5py.File(folder + name, 'w') as f:
    f['tactile/pad'] = np.arange(8.).reshape(4, 2)
    fill(f)
def file_rate(f): f.attrs['sampling_rate'] = 250.0
def array_rate(f): f['tactile/pad'].attrs['sample_rate'] = np.int32(250)
def group_rate(f): f['tactile'].attrs['fs'] = np.float32(250)
def two_rates(f): file_rate(f); f['tactile'].attrs['fs'] = 100.0
def with_times(f): file_rate(f); f['time_s'] = np.arange(4) * 0.5
def variable(f): f.create_dataset('stamp', data=[d.decode() for d in dates], dtype=h5py.string_dtype())
def fixed(f): f['stamp'] = np.array(dates)
def both(f): fixed(f); file_rate(f)
def words(f): variable(f); f['label'] = np.array([b'a', b'b', b'c', b'd'])
for fill in [file_rate, array_rate, group_rate, two_rates, with_times, variable, fixed, both, words]:
  write(fill.__name__ + '.h5', fill)
)");
  const auto import = [&](const std::string& name) {
    return importRecording(folder / (name + ".h5"),
                           pad(1, 2),
                           {},
                           folder / "o.palpate",
                           {.overwrite = Overwrite::kReplace});
  };
  const std::string note = "time: the file gives a rate of 250 Hz";
  for (const char* name : {"file_rate", "array_rate", "group_rate"}) {
    const ImportReport report = import(name);
    const Profile made = openRecording(folder / "o.palpate");
    ASSERT_EQ(made.numFrames(), 4u) << name;
    EXPECT_EQ(made.frameTimeUs(3) - made.frameTimeUs(0), 12'000) << name;
    EXPECT_EQ(std::count(report.notes.begin(), report.notes.end(), note), 1) << name;
  }
  EXPECT_NE(testing::errorOf([&] { import("two_rates"); }).find("--rate"), std::string::npos);
  EXPECT_EQ(import("with_times").notes, std::vector<std::string>());
  EXPECT_EQ(openRecording(folder / "o.palpate").frameTimeUs(3), 1'500'000);
  for (const char* name : {"variable", "fixed", "both", "words"}) {
    import(name);
    const Profile made = openRecording(folder / "o.palpate");
    ASSERT_EQ(made.numFrames(), 4u) << name;
    // Python: datetime(2026, 11, 22, 10, 31, 5, tzinfo=timezone.utc).timestamp()
    EXPECT_EQ(made.frameTimeUs(0), 1'795'343'465'000'000) << name;
    EXPECT_EQ(made.frameTimeUs(3) - made.frameTimeUs(0), 1'000'000) << name;
  }
}

// imports 25: a file per matrix.
TEST(ImportForms, AFolderWithAFilePerMatrixIsReadByTheNamesOfTheFiles) {
  const TemporaryFolder folder;
  const fs::path data = folder / "session";
  fs::create_directory(data);
  // In the order of the names the right one comes first.
  HandDescription hand = twoPads();
  hand.matrices[0].name = "thumb tip";
  hand.matrices[1].name = "palm";
  const auto import = [&](const ImportMapping& mapping = {}) {
    return importRecording(
        data, hand, mapping, folder / "o.palpate", {.overwrite = Overwrite::kReplace});
  };
  testing::writeFile(data / "thumb_tip.csv",
                     "time_ms,a,b,c,d\n0,1,2,3,4\n10,5,6,7,8\n20,9,10,11,12\n");
  testing::writeFile(data / "palm.csv",
                     "time_ms,a,b,c,d\n0,21,22,23,24\n10,25,26,27,28\n20,29,30,31,32\n");
  const ImportReport report = import();
  EXPECT_EQ(report.frames, 3u);
  EXPECT_FALSE(report.isPartial());
  const Profile made = openRecording(folder / "o.palpate");
  EXPECT_EQ(made.frame(1).values, (std::vector<float>{5, 6, 7, 8, 25, 26, 27, 28}));
  EXPECT_EQ(made.frameTimeUs(2), 20'000);
  // A row that can't be used costs one frame; so does one with another time.
  testing::writeFile(data / "palm.csv",
                     "time_ms,a,b,c,d\n0,21,22,23\n11,25,26,27,28\n20,29,30,31,32\n");
  const ImportReport partly = import();
  EXPECT_EQ(partly.frames, 1u);
  EXPECT_EQ(partly.refused.wrongCount, 2u);
  EXPECT_NE(partly.refused.first.find("palm.csv, line 2"), std::string::npos)
      << partly.refused.first;
  // Another number of rows, another name, times in one file only: nothing is imported.
  testing::writeFile(data / "palm.csv", "time_ms,a,b,c,d\n0,21,22,23,24\n10,25,26,27,28\n");
  EXPECT_NE(testing::errorOf([&] { import(); }).find("palm.csv has 2 rows, thumb_tip.csv has more"),
            std::string::npos);
  testing::writeFile(data / "palm.csv", "a,b,c,d\n21,22,23,24\n25,26,27,28\n29,30,31,32\n");
  EXPECT_NE(testing::errorOf([&] { import(); }).find("has times in some of its files only"),
            std::string::npos);
  testing::writeFile(data / "palm.csv",
                     "time_ms,a,b,c,d\n0,21,22,23,24\n10,25,26,27,28\n20,29,30,31,32\n");
  fs::rename(data / "palm.csv", data / "hand.csv");
  EXPECT_NE(testing::errorOf([&] { import(); }).find("no file has the name of the matrix \"palm\""),
            std::string::npos);
  ImportMapping chosen;
  chosen.matrices = {{0, "thumb_tip*", {}, false}, {1, "hand*", {}, false}};
  import(chosen);
  EXPECT_EQ(openRecording(folder / "o.palpate").frame(2).values,
            (std::vector<float>{9, 10, 11, 12, 29, 30, 31, 32}));
}

// Frames stay whole where lines are missing, as in a stream (docs/manual/stream_protocol.md).
TEST(ImportForms, ALinePerMatrixIsAFrame) {
  const TemporaryFolder folder;
  ImportMapping rate;
  rate.time.rateHz = 100.0;
  const auto made =
      importText(folder,
                 "left:1,2,3,4\nright:5,6,7,8\n\nleft:11,12,13,14\nright:15,16,17,18\n",
                 twoPads(),
                 rate);
  ASSERT_EQ(made.report.frames, 2u);
  EXPECT_EQ(made.profile.frame(1).values, (std::vector<float>{11, 12, 13, 14, 15, 16, 17, 18}));
  EXPECT_EQ(
      std::count(made.report.notes.begin(),
                 made.report.notes.end(),
                 "a frame is a line for each of \"left\", \"right\", and begins with the first "
                 "of them"),
      1);
  // By the names, not by the order.
  EXPECT_EQ(importText(folder, "right: 5 6 7 8\nleft: 1 2 3 4\n", twoPads(), rate)
                .profile.frame(0)
                .values,
            (std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8}));
  // With a serial monitor's times, and a line of the time.
  const auto stamped = importText(folder,
                                  "10:31:00.000 -> left:1,2,3,4\n10:31:00.004 -> right:5,6,7,8\n"
                                  "10:31:00.020 -> left:1,2,3,4\n10:31:00.024 -> right:5,6,7,9\n",
                                  twoPads());
  ASSERT_EQ(stamped.report.frames, 2u);
  EXPECT_EQ(stamped.profile.frameTimeUs(1) - stamped.profile.frameTimeUs(0), 20'000);
  const auto timed = importText(
      folder,
      "time_ms:0\nleft:1,2,3,4\nright:5,6,7,8\ntime_ms:30\nleft:1,2,3,4\nright:5,6,7,9\n",
      twoPads());
  ASSERT_EQ(timed.report.frames, 2u);
  EXPECT_EQ(timed.profile.frameTimeUs(1), 30'000);
  // Each line that is missing, comes twice or is short costs its frame only.
  const auto lossy = importText(folder,
                                "left 1:1,2,3,4\nright 1:5,6,7,8\n"
                                "left 2:1,2,3,4\n"
                                "left 3:2,2,3,4\nright 3:6,6,7,8\n"
                                "right 4:1,1,1,1\n"
                                "left 5:3,2,3,4\nright 6:1,1,1,1\n"
                                "left 7:4,2,3,4\nright 7:1,1,1\n"
                                "left 8:5,2,3,4\nright 8:7,6,7,8\n",
                                twoPads(),
                                rate);
  EXPECT_EQ(lossy.report.frames, 3u);
  EXPECT_EQ(lossy.report.refused.wrongCount, 4u);
  EXPECT_EQ(lossy.report.refused.first, "line 3 begins a frame without \"right\"");
  EXPECT_EQ(lossy.profile.frame(1).values, (std::vector<float>{2, 2, 3, 4, 6, 6, 7, 8}));
  EXPECT_EQ(lossy.profile.frame(2).values, (std::vector<float>{5, 2, 3, 4, 7, 6, 7, 8}));
}

// As pandas writes arrays that NumPy printed (15 numbers of 4 digits need two lines).
TEST(ImportForms, AListThatIsWrappedInItsCellIsOne) {
  const TemporaryFolder folder;
  const auto made =
      importText(folder,
                 "time,data\n0.0,\"[1 2 3\n 4 5 6]\"\n0.01,\"[[7 8 9]\n [10 11 12]]\"\n"
                 "0.02,[13 14 15 16 17 18]\n",
                 pad(2, 3));
  EXPECT_EQ(made.report.frames, 2u);
  EXPECT_EQ(made.profile.frame(0).values, (std::vector<float>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(made.profile.frame(1).values, (std::vector<float>{13, 14, 15, 16, 17, 18}));
  // The list of another shape is refused, with the line in which its row begins.
  EXPECT_EQ(made.report.refused.wrongCount, 1u);
  EXPECT_EQ(made.report.refused.first.find("line 4 "), 0u) << made.report.refused.first;
  // A list that doesn't end takes no other row with it.
  const auto open =
      importText(folder,
                 "time,data\n0.0,\"[1 2 3\n0.01,[7 8 9]\n0.02,\"[1 2\n 3]\"\n0.03,[1 2 3]\n",
                 pad(1, 3));
  EXPECT_EQ(open.report.frames, 3u);
  EXPECT_EQ(open.report.refused.total(), 1u);
  const std::string left = testing::errorOf([&] {
    importText(folder, "time,data\n0.0,[0 1 2 ... 5 6 7]\n0.01,[0 1 2 ... 5 6 7]\n", pad(2, 3));
  });
  EXPECT_NE(left.find("NumPy left numbers out"), std::string::npos) << left;
}

// Imports a folder of files; a file without a word in it is not written.
ImportReport importFolder(const TemporaryFolder& folder,
                          const std::map<std::string, std::string>& files,
                          const HandDescription& hand,
                          const ImportMapping& mapping) {
  fs::remove_all(folder / "frames");
  fs::create_directory(folder / "frames");
  for (const auto& [name, text] : files) testing::writeFile(folder / "frames" / name, text);
  return importRecording(
      folder / "frames", hand, mapping, folder / "o.palpate", {.overwrite = Overwrite::kReplace});
}

TEST(ImportForms, FilesAreInTheOrderOfAllNumbersInTheirNames) {
  const TemporaryFolder folder;
  ImportMapping mapping;
  mapping.time.rateHz = 100.0;
  for (const std::vector<std::string>& names :
       {std::vector<std::string>{
            "frame_0001_pad2.csv", "frame_0002_pad2.csv", "frame_0010_pad2.csv"},
        {"pad_10-00-58.csv", "pad_10-00-59.csv", "pad_10-01-00.csv"},
        {"t_0.95.csv", "t_1.00.csv", "t_1.5.csv"},
        {"frame (9).csv", "frame (10).csv", "frame (11).csv"},
        {"frame-7.csv", "frame-8.csv", "frame-10.csv"},
        {"t_-3.csv", "t_-2.csv", "t_1.csv"},
        {"9_pad.csv", "10_pad.csv", "11_pad.csv"}}) {
    importFolder(folder,
                 {{names[0], "1,2\n"}, {names[1], "3,4\n"}, {names[2], "5,6\n"}},
                 pad(1, 2),
                 mapping);
    const Profile profile = openRecording(folder / "o.palpate");
    ASSERT_EQ(profile.numFrames(), 3u) << names[0];
    EXPECT_EQ(profile.frame(0).values, (std::vector<float>{1, 2})) << names[0];
    EXPECT_EQ(profile.frame(1).values, (std::vector<float>{3, 4})) << names[0];
    EXPECT_EQ(profile.frame(2).values, (std::vector<float>{5, 6})) << names[0];
  }
  // The number may be the time, with its decimals.
  mapping.time = {};
  mapping.time.column = "file";
  mapping.time.unit = "s";
  importFolder(folder, {{"t_0.95.csv", "1,2\n"}, {"t_1.50.csv", "3,4\n"}}, pad(1, 2), mapping);
  const Profile timed = openRecording(folder / "o.palpate");
  EXPECT_EQ(timed.frameTimeUs(1) - timed.frameTimeUs(0), 550'000);
}

TEST(ImportForms, FilesWhoseOrderCanNotBeToldAreRefused) {
  const TemporaryFolder folder;
  ImportMapping mapping;
  mapping.time.rateHz = 100.0;
  const auto refusal = [&](const std::vector<std::string>& names) {
    std::map<std::string, std::string> files;
    for (const std::string& name : names) files[name] = "1,2\n";
    return testing::errorOf([&] { importFolder(folder, files, pad(1, 2), mapping); });
  };
  // Two names for each number, in the same or in different patterns; hexadecimal numbers.
  EXPECT_NE(refusal({"f_1.csv", "f_01.csv", "f_2.csv"}).find("two files of the same number"),
            std::string::npos);
  for (const std::vector<std::string>& names :
       {std::vector<std::string>{"a_1.csv", "a_2.csv", "b_1.csv", "b_2.csv"},
        {"0008.csv", "0009.csv", "000a.csv", "000b.csv"}})
    EXPECT_NE(refusal(names).find("is unclear"), std::string::npos) << refusal(names);
  const ImportReport report =
      importFolder(folder,
                   {{"f1.csv", "1,2\n"}, {"f2.csv", "1,2\n"}, {"offset.csv", "9,9\n"}},
                   pad(1, 2),
                   mapping);
  EXPECT_EQ(report.frames, 2u);
  EXPECT_EQ(report.notes,
            (std::vector<std::string>{"files that are not used: offset.csv", "not used: file"}));
}

TEST(ImportForms, FilesHaveRowsAndColumns) {
  const TemporaryFolder folder;
  ImportMapping mapping;
  mapping.time.rateHz = 100.0;
  const std::string tall = "1,4\n2,5\n3,6\n";
  const ImportReport report =
      importFolder(folder, {{"f1.csv", tall}, {"f2.csv", tall}}, pad(2, 3), mapping);
  EXPECT_EQ(openRecording(folder / "o.palpate").frame(1).values,
            (std::vector<float>{1, 2, 3, 4, 5, 6}));
  ASSERT_FALSE(report.notes.empty());
  EXPECT_NE(report.notes[0].find("transposed"), std::string::npos) << report.notes[0];
  // One of another shape is refused, as is a hand of another shape.
  const ImportReport mixed =
      importFolder(folder,
                   {{"f1.csv", "1,2,3\n4,5,6\n"}, {"f2.csv", tall}, {"f3.csv", "1,2,3\n4,5,6\n"}},
                   pad(2, 3),
                   mapping);
  EXPECT_EQ(mixed.frames, 2u);
  EXPECT_EQ(mixed.refused.first, "file 2 (f2.csv) has 3 x 2 numbers instead of 2 x 3");
  EXPECT_NE(testing::errorOf([&] {
              importFolder(folder, {{"f1.csv", tall}, {"f2.csv", tall}}, pad(1, 6), mapping);
            }).find("no columns fit"),
            std::string::npos);
}

TEST(ImportForms, AFileThatIsMissingShiftsNoTime) {
  const TemporaryFolder folder;
  ImportMapping mapping;
  mapping.time.rateHz = 20.0;
  std::map<std::string, std::string> files;
  for (const int number : {4, 6, 7, 8, 9, 10})
    files["frame_" + std::to_string(number) + ".csv"] = "1," + std::to_string(number) + "\n";
  const ImportReport report = importFolder(folder, files, pad(1, 2), mapping);
  const Profile profile = openRecording(folder / "o.palpate");
  ASSERT_EQ(profile.numFrames(), 6u);
  EXPECT_EQ(profile.frameTimeUs(1), 100'000);
  EXPECT_EQ(profile.frameTimeUs(5), 300'000);
  EXPECT_EQ(report.missingFrames, 1u);
}

// Issue 52: text was NaN, and with that 0; the first file alone said what a frame is; other files
// of frames were a note.
TEST(ImportForms, FilesThatDontFitAreNamedAndCounted) {
  const TemporaryFolder folder;
  ImportMapping mapping;
  mapping.time.rateHz = 10.0;
  const std::string good = "1,2,3\n4,5,6\n";
  const auto made = [&](const std::string& third, const std::string& first = "") {
    return importFolder(folder,
                        {{"f_1.csv", first.empty() ? good : first},
                         {"f_2.csv", good},
                         {"f_3.csv", third},
                         {"f_4.csv", good}},
                        pad(2, 3),
                        mapping);
  };
  for (const auto& [bad, words] : std::map<std::string, std::string>{
           {"1,ERR,3\n4,5,6\n", "file 3, number 2: ERR is not a number"},
           {"1,,3\n4,5,6\n", "file 3, number 2: nan"},
           {"1,2,3\n4,5\n", "f_3.csv: line 2"},
           {"1,2,3\n", "(f_3.csv) has 3 numbers instead of 2 x 3"},
           {"", "f_3.csv: holds no row"},
           {std::string("\x93NUMPY\x01\0v\0", 10), "f_3.csv"},
           {good + std::string(8, '\0'), "f_3.csv: holds bytes 0"}}) {
    SCOPED_TRACE(words);
    const ImportReport report = made(bad);
    EXPECT_EQ(report.frames, 3u);
    EXPECT_EQ(report.refused.total(), 1u);
    EXPECT_EQ(report.outside.total(), 0u);
    EXPECT_NE(report.refused.first.find(words), std::string::npos) << report.refused.first;
    EXPECT_EQ(openRecording(folder / "o.palpate").frameTimeUs(2), 300'000);
  }
  // The first one may be it.
  const ImportReport first = made(good, "1,2,3\n");
  EXPECT_EQ(first.frames, 3u);
  EXPECT_EQ(first.refused.first, "file 1 (f_1.csv) has 3 numbers instead of 2 x 3");
  EXPECT_NE(testing::errorOf([&] {
              importFolder(folder, {{"f_1.csv", "?"}, {"f_2.csv", "?"}}, pad(2, 3), mapping);
            }).find("f_1.csv: "),
            std::string::npos);
  const ImportReport other = importFolder(
      folder,
      {{"f_1.csv", good}, {"f_2.csv", good}, {"f_3.csv", "1,2,3\n4,5,6"}, {"f_4 (1).csv", good}},
      pad(2, 3),
      mapping);
  EXPECT_EQ(other.frames, 3u);
  EXPECT_EQ(other.doubts,
            (std::vector<std::string>{
                "1 file of another name left out, which may be a frame: f_4 (1).csv"}));
  EXPECT_EQ(other.notes.back(),
            "1 file has no line end at the end, first f_3.csv: a last number may be cut off");
  // Names of files of SD cards, and a line of names that is told.
  mapping.text.header = HeaderChoice::kPresent;
  EXPECT_EQ(importFolder(folder,
                         {{"LOG1.CSV", "a,b,c\n" + good}, {"LOG2.CSV", "a,b,c\n" + good}},
                         pad(2, 3),
                         mapping)
                .frames,
            2u);
}

TEST(ImportForms, HolesInTheNumbersOfFilesAreSaid) {
  const TemporaryFolder folder;
  const auto report = [&](const std::vector<std::string>& numbers, const std::string& time) {
    std::map<std::string, std::string> files;
    for (const std::string& number : numbers) files["f_" + number + ".csv"] = "1,2\n";
    ImportMapping mapping;
    mapping.time.column = time;
    if (time.empty())
      mapping.time.rateHz = 10.0;
    else
      mapping.time.unit = "ms";
    return importFolder(folder, files, pad(1, 2), mapping);
  };
  using Texts = std::vector<std::string>;
  const std::vector<std::string> tens = {"0", "10", "20", "40", "50", "80"};
  EXPECT_EQ(report(tens, "").doubts,
            (Texts{"the numbers in the names ascend by 10, but 2 times by more, first by 20 before "
                   "f_40.csv: files may be missing, and the times don't show it"}));
  EXPECT_EQ(report(tens, "file").doubts, Texts());  // the times have it
  EXPECT_EQ(report({"0", "33", "67", "100", "133"}, "").doubts, Texts());
  // Numbers that count the frames are counted already, unless they leap by more than any loss.
  EXPECT_EQ(report({"1", "2", "4", "5", "6"}, "").doubts, Texts());
  EXPECT_EQ(report({"1", "2", "4", "5", "6"}, "").missingFrames, 1u);
  EXPECT_EQ(report({"1", "2", "3", "2000", "2001"}, "").doubts.size(), 1u);
  const auto several = report({"1-00", "1-30", "2-00"}, "");
  EXPECT_EQ(several.notes.front(),
            "several numbers in the names differ: missing files can't be detected from them");
}

}  // namespace
}  // namespace palpate::import_forms_test
