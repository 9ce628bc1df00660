// Forms of lines that sketches and programs print: rows, a line per matrix, labels, lists; times
// that were guessed; values outside of the description.
#include <functional>

#include <gtest/gtest.h>

#include "palpate/device/stream_lines.h"
#include "palpate/imports/label_places.h"

#include "device/stream_hands.h"

namespace palpate::testing::stream_line_forms_test {
namespace {

using Values = std::vector<float>;

struct FormReading {
  std::vector<Values> frames;
  std::vector<std::optional<std::int64_t>> timesUs;
  StreamLineStats stats;
  std::string fault, outOfRange, guess;
  std::vector<std::string> labelNotes;
};

FormReading readForm(const std::string& text,
                     const HandDescription& hand,
                     const StreamLineOptions& options = {},
                     std::size_t chunk = SIZE_MAX,
                     bool isCutOff = false) {
  StreamLineParser parser(StreamShape(hand), options);
  FormReading reading;
  const auto sink = [&](const StreamItem& item) {
    reading.frames.emplace_back(item.values.begin(), item.values.end());
    reading.timesUs.push_back(item.deviceUs);
  };
  const auto bytes = std::as_bytes(std::span(text));
  for (std::size_t at = 0; at < bytes.size(); at += std::min(chunk, bytes.size() - at))
    parser.push(bytes.subspan(at, std::min(chunk, bytes.size() - at)), sink);
  if (isCutOff) parser.cutOff(sink);
  reading.stats = parser.stats();
  reading.fault = parser.lastFault();
  reading.outOfRange = parser.lastOutOfRange();
  reading.guess = parser.guess();
  reading.labelNotes = parser.notes();
  EXPECT_EQ(reading.stats.lineBytes + reading.stats.skippedBytes + parser.pendingBytes(),
            text.size());
  return reading;
}

// As the program reads the labels.
StreamLineOptions withLabels(const HandDescription& hand, bool startsInside = false) {
  return {.startsInside = startsInside, .placesOfLabels = std::bind_front(placesOfLabels, hand)};
}

// Two matrices of 2 x 2, "left" and "right".
HandDescription twoPads() {
  HandDescription hand = padHand({{2, 2}, {2, 2}});
  hand.matrices[0].name = "left";
  hand.matrices[0].shortName = "L";
  hand.matrices[1].name = "right";
  hand.matrices[1].shortName = "R";
  return hand;
}

const std::vector<Values> kTwoFrames{{0, 1, 2, 3, 4, 5}, {10, 11, 12, 13, 14, 15}};

// --- Rows

TEST(StreamLineForms, AFrameMayHaveALinePerRow) {
  for (const char* text : {"0 1 2 \r\n3 4 5 \r\n\r\n10 11 12 \r\n13 14 15 \r\n\r\n",
                           "0,1,2\n3,4,5\n10,11,12\n13,14,15\n",
                           "START\n0,1,2\n3,4,5\nSTART\n10,11,12\n13,14,15\n",
                           "flag:\n0,1,2\n3,4,5\nflag:\n10,11,12\n13,14,15\n",
                           "[[0, 1, 2],\n [3, 4, 5]]\n[[10, 11, 12],\n [13, 14, 15]]\n"})
    for (const std::size_t chunk : {std::size_t{1}, std::size_t{7}, SIZE_MAX}) {
      const FormReading reading = readForm(text, padHand({{2, 3}}), {}, chunk);
      EXPECT_EQ(reading.frames, kTwoFrames) << text;
      EXPECT_EQ(reading.stats.refused, 0u) << text << reading.fault;
    }
}

TEST(StreamLineForms, AFrameWithAMissingOrWrongRowIsRefusedAlone) {
  const FormReading missing =
      readForm("0,1,2\n3,4,5\n\n7,8,9\n\n10,11,12\n13,14,15\n\n", padHand({{2, 3}}));
  EXPECT_EQ(missing.frames, kTwoFrames);
  EXPECT_EQ(missing.fault, "line 5: a frame of 1 row instead of 2");
  EXPECT_EQ(missing.stats.refused, 1u);
  for (const char* wrong : {"7,8", "7,x,9", "7,8,9,10"}) {
    // With a wrong row in the place of a row, also without empty lines.
    const FormReading reading = readForm(
        "0,1,2\n3,4,5\n1,2,3\n" + std::string(wrong) + "\n10,11,12\n13,14,15\n", padHand({{2, 3}}));
    EXPECT_EQ(reading.frames, kTwoFrames) << wrong;
    EXPECT_EQ(reading.stats.refused, 1u) << wrong << reading.fault;
  }
  EXPECT_EQ(readForm("0,1,2\n3,4\n", padHand({{2, 3}})).fault,
            "line 2: 2 numbers instead of 3 in row 2");
}

TEST(StreamLineForms, ARowTooManyIsRefused) {
  const FormReading reading =
      readForm("0,1,2\n3,4,5\n\n0,1,2\n3,4,5\n6,7,8\n\n10,11,12\n13,14,15\n\n", padHand({{2, 3}}));
  EXPECT_EQ(reading.frames.size(), 3u);
  EXPECT_EQ(reading.frames.back(), kTwoFrames[1]);
  EXPECT_EQ(reading.fault, "line 6: more than 2 rows in a frame");
}

// The first line of a running sender is skipped, and so is the rest of its frame.
TEST(StreamLineForms, OfARunningSenderTheFirstSeparatorIsAwaited) {
  const StreamLineOptions inside{.startsInside = true};
  const FormReading reading =
      readForm("9\n7,8,9\n\n0,1,2\n3,4,5\n\n10,11,12\n13,14,15\n\n", padHand({{2, 3}}), inside);
  EXPECT_EQ(reading.frames, kTwoFrames);
  EXPECT_EQ(reading.stats.refused, 0u) << reading.fault;
  const FormReading endless =
      readForm("9\n0,1,2\n3,4,5\n10,11,12\n13,14,15\n", padHand({{2, 3}}), inside);
  EXPECT_EQ(endless.frames.size(), 0u);
  EXPECT_EQ(endless.fault,
            "line 5: it is not known with which row a frame begins: print an empty line after each "
            "frame");
}

// A line cut off to the length of a row is none in a stream of whole frames.
TEST(StreamLineForms, RowsDoNotMixWithWholeFrames) {
  const FormReading reading =
      readForm("0,1,2,3,4,5\n3,4,5\n0,1,2\n10,11,12,13,14,15\n", padHand({{2, 3}}));
  EXPECT_EQ(reading.frames, kTwoFrames);
  EXPECT_EQ(reading.stats.refused, 2u);
  EXPECT_EQ(reading.fault, "line 3: 3 numbers instead of 6");
}

TEST(StreamLineForms, AWordIsRefusedWhereNoRowsFollow) {
  const FormReading reading = readForm("booting\n0,1,2,3,4,5\n", padHand({{2, 3}}));
  EXPECT_EQ(reading.frames.size(), 1u);
  EXPECT_EQ(reading.fault, "line 1: 0 numbers instead of 6");
}

// A sketch that prints what went wrong beside its frames.
TEST(StreamLineForms, AnotherWordThanTheSeparatorIsRefused) {
  const std::string frames =
      "START\n0,1,2\nERROR\n3,4,5\nSTART\n10,11,12\noverflow\nERROR\n13,14,15\n";
  const FormReading reading = readForm(frames, padHand({{2, 3}}));
  EXPECT_EQ(reading.frames, kTwoFrames);
  EXPECT_EQ(reading.stats.refused, 3u);
  EXPECT_EQ(reading.fault, "line 8: \"ERROR\" is not \"START\", which separates frames");
  const FormReading late =
      readForm("0,1,2\n3,4,5\nEND\n10,11,12\n13,14,15\nEND\nbad\nbad\n", padHand({{2, 3}}));
  EXPECT_EQ(late.frames, kTwoFrames);
  EXPECT_EQ(late.stats.refused, 2u);
}

TEST(StreamLineForms, AGreetingIsNotTheSeparatorForLong) {
  const FormReading reading = readForm(
      "Ready\n0,1,2\n3,4,5\nEND\n10,11,12\n13,14,15\nEND\n1,2,3\nEND\n", padHand({{2, 3}}));
  EXPECT_EQ(reading.frames, kTwoFrames);
  EXPECT_EQ(reading.stats.refused, 2u);
  EXPECT_EQ(reading.fault, "line 9: a frame of 1 row instead of 2");
}

// --- A line per matrix

TEST(StreamLineForms, AFrameMayHaveALinePerMatrix) {
  const std::vector<Values> frames{{1, 2, 3, 4, 5, 6, 7, 8}, {9, 9, 9, 9, 0, 0, 0, 1}};
  for (const char* text : {"L:1,2,3,4\nR:5,6,7,8\nL:9,9,9,9\nR:0,0,0,1\n",
                           "right 5 6 7 8\nleft 1 2 3 4\nRIGHT: 0 0 0 1\nLeft: 9 9 9 9\n"}) {
    const FormReading reading = readForm(text, twoPads());
    EXPECT_EQ(reading.frames, frames) << text << reading.fault;
    EXPECT_EQ(reading.stats.refused, 0u) << reading.fault;
  }
  const FormReading timed = readForm("L,50,1,2,3,4\nR,51,5,6,7,8\n", twoPads());
  EXPECT_EQ(timed.timesUs, (std::vector<std::optional<std::int64_t>>{50'000}));
  EXPECT_EQ(readForm("L:1,2,3,4\nR:5,6,7,8\n1,2,3,4,5,6,7,8\n", twoPads()).frames.size(), 2u);
}

TEST(StreamLineForms, AMatrixThatDidNotComeIsAFault) {
  const FormReading reading = readForm("L:1,2,3,4\nL:1,2,3,4\nR:5,6,7,8\nR:5,6,7,8\n", twoPads());
  EXPECT_EQ(reading.frames.size(), 1u);
  EXPECT_EQ(reading.stats.refused, 2u);
  EXPECT_EQ(reading.fault, "line 4: \"R\" came before the first matrix of its frame");
  EXPECT_EQ(readForm("A:1,2,3,4\n", twoPads()).fault,
            "line 1: 4 numbers instead of 8; a line per matrix begins with the name of its matrix, "
            "as the hand has it");
}

// --- Labels

TEST(StreamLineForms, ValuesMayHaveLabels) {
  for (const char* text : {"A0:0,A1:1,A2:2,A3:3,A4:4,A5:5\nA0:10,A1:11,A2:12,A3:13,A4:14,A5:15\n",
                           "A0: 0 A1: 1 A2: 2 A3: 3 A4: 4 A5: 5\n"
                           "A1: 11 A0: 10 A2: 12 A3: 13 A5: 15 A4: 14\n",
                           ">A0:0\n>A1:1\n>A2:2\n>A3:3\n>A4:4\n>A5:5\n"
                           ">A0:10\n>A1:11\n>A2:12\n>A3:13\n>A4:14\n>A5:15\n"}) {
    const FormReading reading = readForm(text, padHand({{2, 3}}));
    EXPECT_EQ(reading.frames, kTwoFrames) << text << reading.fault;
    EXPECT_EQ(reading.stats.refused, 0u) << reading.fault;
  }
  const FormReading timed = readForm("ms:50,a:1,b:2,c:3\nms:60,a:1,b:2,c:3\n", padHand({{1, 3}}));
  EXPECT_EQ(timed.timesUs, (std::vector<std::optional<std::int64_t>>{50'000, 60'000}));
  EXPECT_EQ(timed.guess, "");
}

// The port was opened within a frame: the numbers of the labels say the order.
TEST(StreamLineForms, LabelsOfARunningSenderAreOrderedByTheirNumbers) {
  std::string text = "half\n";
  for (int value = 3; value < 36; ++value)
    text += "A" + std::to_string(value % 12) + ":" + std::to_string(value) + "\n";
  const HandDescription hand = padHand({{3, 4}});
  const FormReading reading = readForm(text, hand, withLabels(hand, true));
  ASSERT_EQ(reading.frames.size(), 1u) << reading.fault;
  EXPECT_EQ(reading.frames[0], (Values{24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35}));
  const HandDescription small = padHand({{1, 3}});
  EXPECT_EQ(readForm("half\nb:1\nc:2\na:3\nb:4\n", small, withLabels(small, true)).fault,
            "line 5: the order of the values is not known: send all of a frame in one line");
}

// stranger S2: they were taken in the order of the first frame.
TEST(StreamLineForms, LabelsSayWhichTaxelTheyAre) {
  const HandDescription hand = padHand({{2, 3}});
  for (const char* text : {"p5:5 p4:4 p3:3 p2:2 p1:1 p0:0\np0:10 p1:11 p2:12 p3:13 p4:14 p5:15\n",
                           "x0y0:0 x0y1:3 x1y0:1 x1y1:4 x2y0:2 x2y1:5\n"
                           "x0y0:10 x0y1:13 x1y0:11 x1y1:14 x2y0:12 x2y1:15\n",
                           "p5:5\np4:4\np3:3\np2:2\np1:1\np0:0\n"
                           "p5:15\np4:14\np3:13\np2:12\np1:11\np0:10\n"}) {
    const FormReading reading = readForm(text, hand, withLabels(hand));
    EXPECT_EQ(reading.frames, kTwoFrames) << text << reading.fault;
    EXPECT_EQ(reading.labelNotes, std::vector<std::string>{});
  }
  const FormReading pads =
      readForm("right0:5 right1:6 right2:7 right3:8 left0:1 left1:2 left2:3 left3:4\n",
               twoPads(),
               withLabels(twoPads()));
  EXPECT_EQ(pads.frames, (std::vector<Values>{{1, 2, 3, 4, 5, 6, 7, 8}}));
  const HandDescription three = padHand({{1, 3}});
  const FormReading named = readForm("c:1,a:2,b:3\n", three, withLabels(three));
  EXPECT_EQ(named.frames, (std::vector<Values>{{1, 2, 3}}));
  ASSERT_EQ(named.labelNotes.size(), 1u);
  EXPECT_NE(named.labelNotes[0].find("are taken in the order of the first frame"),
            std::string::npos);
}

// stranger S9: "145" without its last digit was recorded as 14.
TEST(StreamLineForms, ALineThatIsCutOffIsRefused) {
  const FormReading cut =
      readForm("0,1,2,3,4,5\n10,11,12,13,14,1", padHand({{2, 3}}), {}, SIZE_MAX, true);
  EXPECT_EQ(cut.frames, std::vector<Values>{kTwoFrames[0]});
  EXPECT_EQ(cut.stats.refused, 1u);
  EXPECT_EQ(cut.fault, "line 2: the last line has no end: its last number may be cut off");
  for (const char* whole : {"0,1,2,3,4,5\n[10,11,12,13,14,15]",
                            "0,1,2,3,4,5\n10,11,12,13,14,15\n",
                            "0,1,2,3,4,5\n10,11,12,13,14,15\n# end"}) {
    const FormReading reading = readForm(whole, padHand({{2, 3}}), {}, SIZE_MAX, true);
    EXPECT_EQ(reading.frames, kTwoFrames) << whole;
    EXPECT_EQ(reading.stats.refused, 0u) << whole << reading.fault;
  }
}

// Each label of the second frame is looked up: none stands where it stood in the first one.
TEST(StreamLineForms, ManyLabelsMayComeInAnyOrder) {
  constexpr int kCount = 64'000;
  std::string lines, ofEach;
  Values expected;
  for (int i = 0; i < kCount; ++i) {
    lines += "A" + std::to_string(i) + ":0,";
    ofEach += "A" + std::to_string(i) + ":0\n";
    expected.push_back(static_cast<float>(i % 4096));
  }
  lines += "\n";
  ofEach += "A0:0\n";
  for (int i = kCount - 1; i >= 0; --i) {
    const std::string value = "A" + std::to_string(i) + ":" + std::to_string(i % 4096);
    lines += value + ",";
    if (i > 0) ofEach += value + "\n";
  }
  for (const std::string& text : {lines + "\n", ofEach}) {
    const FormReading reading = readForm(text, padHand({{250, 256}}));
    ASSERT_EQ(reading.frames.size(), 2u) << reading.fault;
    EXPECT_EQ(reading.frames[1], expected);
  }
}

TEST(StreamLineForms, WrongLabelsAreNamed) {
  const std::string first = "a:1,b:2,c:3\n";
  const auto faultOf = [&](const std::string& line) {
    return readForm(first + line + "\n", padHand({{1, 3}})).fault;
  };
  EXPECT_EQ(faultOf("a:1,b:2,d:3"), "line 2: the label \"d\" was not in the first frame");
  EXPECT_EQ(faultOf("a:1,b:2,b:3"), "line 2: the label \"b\" is there twice");
  EXPECT_EQ(faultOf("a:1,b:2"), "line 2: 2 values with labels instead of 3");
  EXPECT_EQ(faultOf("a:1,b:x,c:3"), "line 2: the value of \"b\" is \"x\", not a number");
  EXPECT_EQ(faultOf("a:1,b:2,3"), "line 2: \"3\" has no label, as the other values have");
  EXPECT_EQ(faultOf("angles slide:40,index:30"),
            "line 2: \"angles\" are read without labels, in the order of the hand's");
}

TEST(StreamLineForms, ListsInBracketsAreNumbers) {
  for (const char* text : {"[0, 1, 2, 3, 4, 5]\n[10, 11, 12, 13, 14, 15]\n",
                           "(0,1,2,3,4,5)\n(10,11,12,13,14,15)\n",
                           "[[0, 1, 2], [3, 4, 5]]\n[[10, 11, 12], [13, 14, 15]]\n",
                           "frame: [0 1 2 3 4 5]\nframe: [10 11 12 13 14 15]\n",
                           "[0, 1, 2, 3, 4, 5],\n[10, 11, 12, 13, 14, 15],\n"})
    EXPECT_EQ(readForm(text, padHand({{2, 3}})).frames, kTwoFrames) << text;
  EXPECT_EQ(readForm("[]\n", padHand({{2, 3}})).fault, "line 1: an empty list");
}

TEST(StreamLineForms, AnyEndOfALineAndAByteOrderMark) {
  for (const char* text : {"0,1,2,3,4,5\r10,11,12,13,14,15\r",
                           "0,1,2,3,4,5\n\r10,11,12,13,14,15\n\r",
                           "0,1,2,3,4,5\r\r\n10,11,12,13,14,15\r\r\n",
                           "\xEF\xBB\xBF"
                           "0,1,2,3,4,5\r\n10,11,12,13,14,15\r\n"})
    for (const std::size_t chunk : {std::size_t{1}, std::size_t{5}, SIZE_MAX}) {
      const FormReading reading = readForm(text, padHand({{2, 3}}), {}, chunk);
      EXPECT_EQ(reading.frames, kTwoFrames) << text;
      EXPECT_EQ(reading.stats.refused, 0u) << reading.fault;
      EXPECT_EQ(reading.stats.lines, 2u) << text;
    }
}

// println() into a file that Windows opened as text ends a line with "\r\r\n"; "\r\r" is an empty
// line between two frames.
TEST(StreamLineForms, ASecondReturnIsAnEmptyLineUnlessAFeedFollows) {
  const std::pair<const char*, std::uint64_t> kTexts[]{
      {"0,1,2\r\r\n3,4,5\r\r\n10,11,12\r\r\n13,14,15\r\r\n", 4},
      {"0,1,2\r\r\n3,4,5\r\r\n\r\r\n10,11,12\r\r\n13,14,15\r\r\n", 5},
      {"0,1,2\r3,4,5\r\r10,11,12\r13,14,15\r", 5},
      {"0,1,2\r3,4,5\r\r\r10,11,12\r13,14,15\r", 6}};
  for (const auto& [text, lines] : kTexts)
    for (const std::size_t chunk : {std::size_t{1}, std::size_t{5}, SIZE_MAX}) {
      const FormReading reading = readForm(text, padHand({{2, 3}}), {}, chunk);
      EXPECT_EQ(reading.frames, kTwoFrames) << text;
      EXPECT_EQ(reading.stats.refused, 0u) << reading.fault;
      EXPECT_EQ(reading.stats.lines, lines) << text;
    }
  const FormReading missing = readForm("0,1,2\r\r10,11,12\r13,14,15\r", padHand({{2, 3}}));
  EXPECT_EQ(missing.fault, "line 2: a frame of 1 row instead of 2");
  EXPECT_EQ(missing.frames, std::vector<Values>{kTwoFrames[1]});
}

// Each line once searched the whole rest of what was read for the other end.
TEST(StreamLineForms, AMillionLinesOfReturnsAreReadInOneRead) {
  std::string text;
  for (int i = 0; i < 1'000'000; ++i) text += "#\r";
  const FormReading reading = readForm(text + "0,1,2,3,4,5\r", padHand({{2, 3}}));
  EXPECT_EQ(reading.frames, std::vector<Values>{kTwoFrames[0]});
  EXPECT_EQ(reading.stats.lines, 1'000'001u);
}

// --- Other lines between those of the frames

// The pad of the case "never silently wrong": 2 x 3, named as its matrix.
HandDescription onePad(int rows, int columns) {
  HandDescription hand = padHand({{rows, columns}});
  hand.name = "Pad";
  hand.matrices[0].name = "pad";
  return hand;
}

TEST(StreamLineForms, LinesWithAnotherNameAreNoFramesOnceOwnOnesCame) {
  for (const char* text : {"pad:0,1,2,3,4,5\nimu:0,1,2,9,5,6\npad:10,11,12,13,14,15\n",
                           "0,1,2,3,4,5\nimu:0,1,2,9,5,6\n10,11,12,13,14,15\n",
                           "frame#1,0,1,2,3,4,5\nimu#1,0,1,2,9,5,6\nframe#2,10,11,12,13,14,15\n",
                           "p0:0,p1:1,p2:2,p3:3,p4:4,p5:5\nimu:0,1,2,9,5,6\n"
                           "p0:10,p1:11,p2:12,p3:13,p4:14,p5:15\n",
                           "0,1,2,3,4,5\nax:0,ay:1,az:2,gx:9,gy:5,gz:6\n10,11,12,13,14,15\n",
                           "0,1,2\n3,4,5\n\nimu:0,1,2,9,5,6\n10,11,12\n13,14,15\n\n"}) {
    const HandDescription hand = onePad(2, 3);
    const FormReading reading = readForm(text, hand, withLabels(hand));
    EXPECT_EQ(reading.frames, kTwoFrames) << text;
    EXPECT_EQ(reading.stats.refused, 1u) << text << reading.fault;
    EXPECT_NE(reading.fault.find(" is not one of the hand's names, and its frames come without it"),
              std::string::npos)
        << reading.fault;
  }
  EXPECT_EQ(readForm("L:1,2,3,4\nR:5,6,7,8\nimu:8,7,6,5,4,3,2,1\nL:1,2,3,4\nR:5,6,7,8\n", twoPads())
                .frames.size(),
            2u);
}

// It isn't known yet that it is none: it waits.
TEST(StreamLineForms, AFirstLineWithAnotherNameWaitsForTheNextOne) {
  for (const char* own : {"", "pad:"}) {
    const std::string text = "imu:9,9,9,9,9,9\n" + std::string(own) +
                             "0,1,2,3,4,5\nimu:9,9,9,9,9,9\n" + std::string(own) +
                             "10,11,12,13,14,15\n";
    const FormReading reading = readForm(text, onePad(2, 3));
    EXPECT_EQ(reading.frames, kTwoFrames);
    EXPECT_EQ(reading.stats.refused, 2u);
    EXPECT_EQ(reading.labelNotes, std::vector<std::string>{});
  }
  EXPECT_EQ(readForm("offsets: 512 510 498 505 500 511\n0,1,2,3,4,5\n", onePad(2, 3)).fault,
            "line 1: \"offsets\" is not one of the hand's names, and its frames come without it");
}

TEST(StreamLineForms, ALoneOtherNameIsReadAndSaid) {
  const std::vector<std::string> note{
      "lines with \"raw\" are taken for the frames: it is not one of the hand's names, but no "
      "other lines are frames"};
  const FormReading alone = readForm("raw 0,1,2,3,4,5\nraw 10,11,12,13,14,15\n", onePad(2, 3));
  EXPECT_EQ(alone.frames, kTwoFrames);
  EXPECT_EQ(alone.labelNotes, note);
  EXPECT_EQ(alone.stats.refused, 0u);
  const FormReading both = readForm(
      "raw 0,1,2,3,4,5\nfiltered 1,1,1,1,1,1\nraw 10,11,12,13,14,15\nfiltered 1,1,1,1,1,1\n",
      onePad(2, 3));
  EXPECT_EQ(both.frames, kTwoFrames);
  EXPECT_EQ(both.labelNotes, note);
  EXPECT_EQ(both.stats.refused, 2u);
  EXPECT_EQ(both.fault,
            "line 4: \"filtered\" is not one of the hand's names, and the first frames were lines "
            "with \"raw\"");
  const FormReading last = readForm("raw 0,1,2,3,4,5\n", onePad(2, 3), {}, SIZE_MAX, true);
  EXPECT_EQ(last.frames, std::vector<Values>{kTwoFrames[0]});
  EXPECT_EQ(last.labelNotes, note);
}

// 21.5 degC were a force.
TEST(StreamLineForms, ATemperatureIsNoForceOfAHandWithOneTaxel) {
  for (const char* text : {"force: 3\ntemperature: 21.5\nforce: 56\ntemperature: 21.6\n",
                           ">force:3\n>temp:21.5\n>force:56\n>temp:21.6\n",
                           "temp: 21.5\npad: 3\ntemp: 21.6\npad: 56\n"}) {
    const FormReading reading = readForm(text, onePad(1, 1));
    EXPECT_EQ(reading.frames, (std::vector<Values>{{3}, {56}})) << text;
    EXPECT_EQ(reading.stats.refused, 2u) << text << reading.fault;
  }
}

TEST(StreamLineForms, ALabelBetweenThoseOfAFrameIsLeftOut) {
  std::string text;
  for (const int first : {0, 10}) {
    for (int k = 0; k < 6; ++k)
      text += ">A" + std::to_string(k) + ":" + std::to_string(first + k) + "\n";
    text += ">temp:21.5\n";
  }
  const HandDescription hand = onePad(2, 3);
  for (const std::string& each : {text, ">temp:21.4\n" + text}) {
    const FormReading reading = readForm(each, hand, withLabels(hand));
    EXPECT_EQ(reading.frames, kTwoFrames) << each;
    EXPECT_GE(reading.stats.refused, 2u);
    EXPECT_NE(reading.fault.find("the label \"temp\""), std::string::npos) << reading.fault;
  }
}

TEST(StreamLineForms, ALineWithoutItsTimeOrAValueIsRefused) {
  const FormReading less =
      readForm("100,0,1,2,3,4,5\n110,6,7,9,10,11\n120,10,11,12,13,14,15\n", padHand({{2, 3}}));
  EXPECT_EQ(less.frames, kTwoFrames);
  EXPECT_EQ(less.fault, "line 2: 6 numbers instead of 7, as in the lines before");
  const FormReading more =
      readForm("0,1,2,3,4,5\n6,7,8,99,9,10,11\n10,11,12,13,14,15\n", padHand({{2, 3}}));
  EXPECT_EQ(more.frames, kTwoFrames);
  EXPECT_EQ(more.fault, "line 2: 7 numbers instead of 6, as in the lines before");
  EXPECT_EQ(more.guess, "");
  // Six places, five taxels: "#.#" is the second row.
  const FormReading masked = readForm("1,0,2,3\n4,5,6\n7,0,8,9\n", smallHand());
  EXPECT_EQ(masked.frames, (std::vector<Values>{{1, 0, 2, 3}, {7, 0, 8, 9}}));
  EXPECT_EQ(masked.fault, "line 2: 3 numbers instead of 4, as in the lines before");
  const FormReading pads =
      readForm("L,50,1,2,3,4\nR,50,5,6,7,8\nL,2,3,4,5\nR,60,5,6,7,8\n", twoPads());
  EXPECT_EQ(pads.frames.size(), 1u);
  EXPECT_EQ(readForm("angles,500,1,2\nangles,1,2\n", smallHand()).stats.refused, 1u);
}

// A pipe that begins within a line: the first line has lost its time.
TEST(StreamLineForms, AFirstLineThatWasCutOffIsNotTheMeasure) {
  const FormReading reading = readForm(
      "9,9,9,9,9,9\n100,1,1,1,1,1,1\n110,0,1,2,3,4,5\n120,10,11,12,13,14,15\n", padHand({{2, 3}}));
  EXPECT_EQ(reading.frames,
            (std::vector<Values>{{9, 9, 9, 9, 9, 9}, kTwoFrames[0], kTwoFrames[1]}));
  EXPECT_EQ(reading.stats.refused, 1u);
  EXPECT_EQ(reading.labelNotes,
            (std::vector<std::string>{"lines have 7 numbers from line 3 on, 6 before: the frames "
                                      "before it may be wrong"}));
}

TEST(StreamLineForms, ListsOfColumnsAreTransposed) {
  const std::vector<std::string> note{
      "the lists of a frame have columns x rows and are transposed"};
  const FormReading reading =
      readForm("[[0, 3], [1, 4], [2, 5]]\n[[10, 13], [11, 14], [12, 15]]\n", padHand({{2, 3}}));
  EXPECT_EQ(reading.frames, kTwoFrames);
  EXPECT_EQ(reading.labelNotes, note);
  const FormReading timed = readForm("[100, [[0, 3], [1, 4], [2, 5]]]\n", padHand({{2, 3}}));
  EXPECT_EQ(timed.frames, std::vector<Values>{kTwoFrames[0]});
  EXPECT_EQ(timed.timesUs, (std::vector<std::optional<std::int64_t>>{100'000}));
  // Rows first where both fit; a list per matrix; two matrices of different sizes.
  const FormReading square = readForm("[[1, 2], [3, 4]]\n", padHand({{2, 2}}));
  EXPECT_EQ(square.frames, (std::vector<Values>{{1, 2, 3, 4}}));
  EXPECT_EQ(square.labelNotes, std::vector<std::string>{});
  EXPECT_EQ(readForm("[[1, 2, 3, 4], [5, 6, 7, 8]]\n", twoPads()).frames,
            (std::vector<Values>{{1, 2, 3, 4, 5, 6, 7, 8}}));
  EXPECT_EQ(readForm("[[[1, 4], [2, 5], [3, 6]], [[7], [8]]]\n", padHand({{2, 3}, {2, 1}})).frames,
            (std::vector<Values>{{1, 2, 3, 4, 5, 6, 7, 8}}));
  HandDescription named = padHand({{2, 3}, {1, 1}});
  named.matrices[0].shortName = "L";
  named.matrices[1].shortName = "R";
  EXPECT_EQ(readForm("L: [[1, 4], [2, 5], [3, 6]]\nR: [7]\n", named).frames,
            (std::vector<Values>{{1, 2, 3, 4, 5, 6, 7}}));
  EXPECT_EQ(readForm("[[1, 2, 3, 4, 5, 6], [7, 8, 9, 10, 11, 12]]\n", padHand({{3, 4}})).fault,
            "line 1: its lists have neither the rows nor the columns of the hand: send a list per "
            "row");
}

TEST(StreamLineForms, LabelsOfAnEarlierConnectionKeepTheirValues) {
  const HandDescription hand = padHand({{2, 3}});
  StreamLineParser first(StreamShape(hand), withLabels(hand));
  const std::string before = "a:0,b:1,c:2,d:3,e:4,f:5\n";
  first.push(std::as_bytes(std::span(before)), [](const StreamItem&) {});
  for (const char* after : {"f:15,e:14,d:13,c:12,b:11,a:10\n",
                            "c:12\nd:13\ne:14\nf:15\na:10\nb:11\nc:9\n",
                            "f,e,d,c,b,a\n15,14,13,12,11,10\n"}) {
    StreamLineParser second(StreamShape(hand), withLabels(hand));
    second.knowLabelsOf(first);
    std::vector<Values> frames;
    const std::string text = after;
    second.push(std::as_bytes(std::span(text)), [&](const StreamItem& item) {
      frames.emplace_back(item.values.begin(), item.values.end());
    });
    // The second text begins within a frame, whose beginning isn't there.
    if (text.starts_with("c:"))
      EXPECT_EQ(frames, std::vector<Values>{});
    else
      EXPECT_EQ(frames, std::vector<Values>{kTwoFrames[1]}) << after;
  }
}

TEST(StreamLineForms, APipeThatBeginsWithinAFrameOfNumberedLabels) {
  std::string text;
  for (int value = 3; value < 18; ++value)
    text += ">A" + std::to_string(value % 6) + ":" + std::to_string(value) + "\n";
  const HandDescription hand = padHand({{2, 3}});
  const FormReading reading = readForm(text, hand, withLabels(hand));
  EXPECT_EQ(reading.frames, (std::vector<Values>{{6, 7, 8, 9, 10, 11}, {12, 13, 14, 15, 16, 17}}));
  EXPECT_EQ(reading.stats.refused, 1u);
  EXPECT_EQ(reading.fault, "line 7: a frame of 3 values with labels instead of 6");
}

TEST(StreamLineForms, ALineOfNamesSaysTheOrder) {
  const HandDescription hand = padHand({{2, 3}});
  const auto read = [&](const std::string& text) { return readForm(text, hand, withLabels(hand)); };
  const FormReading reversed =
      read("p5,p4,p3,p2,p1,p0\n5,4,3,2,1,0\np0,p1,p2,p3,p4,p5\n10,11,12,13,14,15\n");
  EXPECT_EQ(reversed.frames, kTwoFrames);
  EXPECT_EQ(reversed.stats.refused, 0u) << reversed.fault;
  EXPECT_EQ(reversed.labelNotes,
            (std::vector<std::string>{
                "the values after line 1 are in the order of its names (\"p5\" to \"p0\")"}));
  const FormReading timed = read("ms,p1,p0,p2,p3,p4,p5\n7,1,0,2,3,4,5\n");
  EXPECT_EQ(timed.frames, std::vector<Values>{kTwoFrames[0]});
  EXPECT_EQ(timed.timesUs, (std::vector<std::optional<std::int64_t>>{7'000}));
  // Names that don't say the taxels: the first ones are the order.
  const FormReading words = read("a,b,c,d,e,f\n0,1,2,3,4,5\nf,e,d,c,b,a\n15,14,13,12,11,10\n");
  EXPECT_EQ(words.frames, kTwoFrames);
  EXPECT_EQ(words.stats.refused, 1u);
  EXPECT_EQ(words.fault, "line 1: value 1 is \"b\", not a number");
}

TEST(StreamLineForms, TextInUtf16IsNamed) {
  const std::string ascii = "0,1,2,3,4,5\n0,1,2,3,4,5\n";
  std::string wide = "\xFF\xFE";
  for (const char c : ascii) wide += {c, '\0'};
  const FormReading reading = readForm(wide, padHand({{2, 3}}), {}, SIZE_MAX, true);
  EXPECT_EQ(reading.frames.size(), 0u);
  EXPECT_EQ(
      reading.fault,
      "line 3: it has bytes of 0, as UTF-16 and packets have: send ASCII or UTF-8, and packets "
      "only from the beginning on");
}

// --- Values and times

TEST(StreamLineForms, ValuesOutsideOfTheDescriptionAreKeptAndCounted) {
  const FormReading reading =
      readForm("1,5880,3\n1,-2.5,3\n1,nan,3\n1,2,1e999\n1,2,3\n", padHand({{1, 3}}));
  EXPECT_EQ(reading.frames,
            (std::vector<Values>{{1, 5880, 3}, {1, -2.5F, 3}, {1, 0, 3}, {1, 2, 0}, {1, 2, 3}}));
  EXPECT_EQ(reading.stats.outOfRange, 4u);
  EXPECT_EQ(reading.stats.refused, 0u);
  EXPECT_EQ(reading.outOfRange, "line 4: value 3 is inf: 0 is kept");
  const FormReading masked = readForm("1,nan,2,3\n", smallHand());
  EXPECT_EQ(masked.frames, (std::vector<Values>{{1, 0, 2, 3}}));
  EXPECT_EQ(masked.stats.outOfRange, 0u);
}

TEST(StreamLineForms, AGuessedTimeIsTold) {
  EXPECT_EQ(readForm("5,1,2,3\n6,1,2,3\n", padHand({{1, 3}})).guess,
            "the first of 4 numbers of a frame is taken for its time in milliseconds; if it is "
            "not, name its unit (--time s, ms or us) or --time none");
  EXPECT_NE(readForm("0.5,1,2,3\n", padHand({{1, 3}})).guess.find("in seconds"), std::string::npos);
  EXPECT_EQ(readForm("5,1,2,3\n", padHand({{1, 3}}), {.time = StreamTime::kMicroseconds}).guess,
            "");
  EXPECT_EQ(readForm("1,2,3\n", padHand({{1, 3}})).guess, "");
}

// A temperature behind the taxels makes the first taxel a time.
TEST(StreamLineForms, AFirstNumberThatDoesNotAscendIsNoTime) {
  std::string constant, varying;
  for (int i = 0; i < 40; ++i) {
    constant += "5,6,7,8,9,10,300\n";
    varying += std::to_string(i * 7 % 11) + ",6,7,8,9,10,300\n";
  }
  for (const std::string& text : {constant, varying}) {
    const FormReading reading = readForm(text, padHand({{2, 3}}));
    EXPECT_LE(reading.frames.size(), 11u);
    EXPECT_EQ(reading.frames.size() + reading.stats.refused, 40u);
    EXPECT_NE(reading.fault.find("does not ascend"), std::string::npos) << reading.fault;
    EXPECT_NE(reading.fault.find("--time none"), std::string::npos) << reading.fault;
  }
}

// Two frames per millisecond, a counter of 8 bits, a sender that starts anew.
TEST(StreamLineForms, ClocksThatWrapOrAreCoarseAscend) {
  std::string coarse, wrapping;
  for (int i = 0; i < 2000; ++i) {
    coarse += std::to_string(i % 1000 / 2) + ",1,2,3\n";
    wrapping += std::to_string(i % 256) + ",1,2,3\n";
  }
  EXPECT_EQ(readForm(coarse, padHand({{1, 3}})).frames.size(), 2000u);
  EXPECT_EQ(readForm(wrapping, padHand({{1, 3}})).frames.size(), 2000u);
}

// `frames` frames of a line per matrix; all lines of frame i have the time timeMs(i).
std::string padLines(int matrices, int frames, const std::function<int(int)>& timeMs) {
  std::string text;
  for (int i = 0; i < frames; ++i)
    for (int k = 0; k < matrices; ++k)
      text += "p" + std::to_string(k) + "," + std::to_string(timeMs(i)) + ",1,2\n";
  return text;
}

HandDescription namedPads(int matrices) {
  HandDescription hand =
      padHand(std::vector<std::pair<int, int>>(static_cast<std::size_t>(matrices), {1, 2}));
  for (MatrixDescription& matrix : hand.matrices) matrix.shortName.insert(0, "p");
  return hand;
}

// Each of the lines of a frame has its time: that of one of them is compared.
TEST(StreamLineForms, MatricesOfAFrameHaveOneTime) {
  const FormReading twelve =
      readForm(padLines(12, 50, [](int i) { return 10 * i; }), namedPads(12));
  EXPECT_EQ(twelve.frames.size(), 50u) << twelve.fault;
  EXPECT_EQ(twelve.timesUs.back(), 490'000);
  const FormReading six = readForm(padLines(6, 200, [](int i) { return i / 2; }), namedPads(6));
  EXPECT_EQ(six.frames.size(), 200u) << six.fault;
  const FormReading constant = readForm(padLines(6, 50, [](int) { return 7; }), namedPads(6));
  EXPECT_EQ(constant.frames.size(), 11u);
  EXPECT_NE(constant.fault.find("taken in 11 frames"), std::string::npos) << constant.fault;
}

std::string numberedLine(int number, int timeMs) {
  return "f#" + std::to_string(number) + "," + std::to_string(timeMs) + ",1,2,3\n";
}

TEST(StreamLineForms, TimesOfOvertakenFramesAreNotCompared) {
  std::string overtaken, twice;
  for (int n = 0; n < 400; n += 4) {
    for (const int k : {1, 0, 3, 2}) overtaken += numberedLine(n + k, 10 * (n + k));
    for (const int k : {0, 0, 0, 1, 3, 3, 2, 2}) twice += numberedLine(n + k, 10 * (n + k));
  }
  EXPECT_EQ(readForm(overtaken, padHand({{1, 3}})).frames.size(), 400u);
  EXPECT_EQ(readForm(twice, padHand({{1, 3}})).frames.size(), 800u);
}

TEST(StreamLineForms, TheClocksOfTwoNumberedSendersAreNotCompared) {
  for (const int ahead : {0, 7, 12'000}) {
    std::string text;
    for (int n = 0; n < 500; ++n)
      text += numberedLine(n + ahead, 10 * n) + numberedLine(n, 3'000'000 + 10 * n);
    const FormReading reading = readForm(text, padHand({{1, 3}}));
    EXPECT_EQ(reading.frames.size(), 1000u) << ahead << reading.fault;
  }
}

TEST(StreamLineForms, FramesWithOneNumberForAllAreCompared) {
  std::string text;
  for (int i = 0; i < 40; ++i) text += numberedLine(0, i * 7 % 11);
  EXPECT_NE(readForm(text, padHand({{1, 3}})).fault.find("does not ascend"), std::string::npos);
}

// A second sender without numbers was stopped: the times ascend again.
TEST(StreamLineForms, TimesThatAscendAgainAreTaken) {
  std::string text;
  for (int i = 0; i < 50; ++i)
    text += std::to_string(10 * i) + ",1,2,3\n" + std::to_string(50'000 + 10 * i) + ",1,2,3\n";
  const std::size_t mixed = readForm(text, padHand({{1, 3}})).frames.size();
  EXPECT_LT(mixed, 10u);
  for (int i = 50; i < 350; ++i) text += std::to_string(10 * i) + ",1,2,3\n";
  const FormReading reading = readForm(text, padHand({{1, 3}}));
  EXPECT_EQ(reading.frames.size(), mixed + 300 - 100);
  EXPECT_EQ(reading.timesUs.back(), 3'490'000);
}

}  // namespace
}  // namespace palpate::testing::stream_line_forms_test
