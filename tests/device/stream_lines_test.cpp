// Lines of text as docs/manual/stream_protocol.md specifies them: what is read, and what a refused
// line is told.
#include "palpate/device/stream_lines.h"

#include <random>

#include <gtest/gtest.h>

#include "palpate/recording/tactile_sensor_json.h"

#include "device/stream_hands.h"

namespace palpate::testing::stream_lines_test {
namespace {

// Keeps what the views of an item showed.
struct Received {
  StreamItemKind kind;
  std::vector<double> numbers;
  std::optional<std::int64_t> deviceUs;
  std::optional<std::uint32_t> sequence;
  std::string text;
  bool operator==(const Received&) const = default;
};

struct Reading {
  std::vector<Received> items;
  StreamLineStats stats;
  std::string fault;
  std::size_t pending = 0;
};

Reading readText(const std::string& text,
                 const HandDescription& hand,
                 const StreamLineOptions& options = {},
                 std::size_t chunk = SIZE_MAX) {
  StreamLineParser parser(StreamShape(hand), options);
  Reading reading;
  const auto sink = [&](const StreamItem& item) {
    Received received{item.kind, {}, item.deviceUs, item.sequence, std::string(item.text)};
    if (item.kind == StreamItemKind::kFrame)
      received.numbers.assign(item.values.begin(), item.values.end());
    else
      received.numbers.assign(item.numbers.begin(), item.numbers.end());
    reading.items.push_back(std::move(received));
  };
  const auto bytes = std::as_bytes(std::span(text));
  for (std::size_t at = 0; at < bytes.size(); at += std::min(chunk, bytes.size() - at))
    parser.push(bytes.subspan(at, std::min(chunk, bytes.size() - at)), sink);
  if (text.ends_with('\n')) parser.cutOff(sink);
  reading.stats = parser.stats();
  reading.fault = parser.lastFault();
  reading.pending = parser.pendingBytes();
  EXPECT_EQ(reading.stats.lineBytes + reading.stats.skippedBytes + reading.pending, text.size());
  EXPECT_EQ(reading.stats.items, reading.items.size());
  return reading;
}

// The values of the only frame in `text`, for a pad of 1 x 3.
std::vector<double> valuesIn(const std::string& text) {
  const Reading reading = readText(text, padHand({{1, 3}}));
  EXPECT_EQ(reading.fault, "");
  EXPECT_EQ(reading.items.size(), 1u);
  return reading.items.empty() ? std::vector<double>() : reading.items[0].numbers;
}

std::string faultOf(const std::string& text, const StreamLineOptions& options = {}) {
  const Reading reading = readText(text, padHand({{1, 3}}), options);
  EXPECT_EQ(reading.items.size(), 0u) << text;
  EXPECT_EQ(reading.stats.refused, 1u) << text;
  return reading.fault;
}

const std::vector<double> kValues{1, 2.5, 300};

TEST(StreamLines, CommasSemicolonsAndBlanksSeparate) {
  for (const char* text : {"1,2.5,300\n",
                           "1, 2.5, 300\n",
                           "1 ,2.5 , 300\n",
                           "1;2.5;300\n",
                           "1 2.5 300\n",
                           "1\t2.5 \t300\n",
                           "  1,2.5,300  \n",
                           "1,2.5,300\r\n",
                           "1,2.5,300,\n",
                           "1;2.5;300; \n",
                           "+1,25e-1,3E2\n",
                           "0001,2.50,300.\n"})
    EXPECT_EQ(valuesIn(text), kValues) << text;
}

TEST(StreamLines, ANameMayLeadAndNumberTheFrame) {
  for (const char* text : {"pad 1 2.5 300\n",
                           "pad: 1,2.5,300\n",
                           "frame,1,2.5,300\n",
                           "left/pad_1,1,2.5,300\n",
                           "inner 1 2.5 300\n"})
    EXPECT_EQ(valuesIn(text), kValues) << text;
  const Reading reading = readText("frame#812,1,2,3\nframe#4294967296,1,2,3\n", padHand({{1, 3}}));
  ASSERT_EQ(reading.items.size(), 2u);
  EXPECT_EQ(reading.items[0].sequence, 812u);
  EXPECT_EQ(reading.items[1].sequence, 0u);  // modulo 2^32
}

TEST(StreamLines, OneNumberMoreIsATime) {
  const Reading reading =
      readText("1234,1,2,3\n1.5,1,2,3\n2e3 1 2 3\nframe#7;250;1;2;3\n", padHand({{1, 3}}));
  ASSERT_EQ(reading.items.size(), 4u) << reading.fault;
  EXPECT_EQ(reading.items[0].deviceUs, 1'234'000);
  EXPECT_EQ(reading.items[1].deviceUs, 1'500'000);
  EXPECT_EQ(reading.items[2].deviceUs, 2'000'000'000);
  EXPECT_EQ(reading.items[3].deviceUs, 250'000);
  for (const Received& item : reading.items)
    EXPECT_EQ(item.numbers, (std::vector<double>{1, 2, 3}));
}

TEST(StreamLines, ANamedUnitOfTimeMakesTheTimeAMust) {
  const auto timeIn = [](const char* text, StreamTime unit) {
    const Reading reading = readText(text, padHand({{1, 3}}), {.time = unit});
    EXPECT_EQ(reading.items.size(), 1u) << reading.fault;
    return reading.items.empty() ? std::nullopt : reading.items[0].deviceUs;
  };
  EXPECT_EQ(timeIn("5,1,2,3\n", StreamTime::kSeconds), 5'000'000);
  EXPECT_EQ(timeIn("5.25,1,2,3\n", StreamTime::kMilliseconds), 5250);
  EXPECT_EQ(timeIn("5,1,2,3\n", StreamTime::kMicroseconds), 5);
  EXPECT_EQ(faultOf("1,2,3\n", {.time = StreamTime::kMilliseconds}),
            "line 1: 3 numbers instead of 3 and a time");
  EXPECT_EQ(faultOf("4,1,2,3\n", {.time = StreamTime::kNone}), "line 1: 4 numbers instead of 3");
  EXPECT_EQ(faultOf("1e300,1,2,3\n"), "line 1: the time \"1e300\" is out of range");
}

TEST(StreamLines, AnglesAndTemperaturesHaveTheirNames) {
  const Reading reading =
      readText("angles,-12.5,90\nangles 1 2\ntemperatures: 36.6\nmask,1,2,3\n", smallHand());
  ASSERT_EQ(reading.items.size(), 4u) << reading.fault;
  EXPECT_EQ(reading.items[0],
            (Received{StreamItemKind::kAngles, {-12.5, 90}, std::nullopt, std::nullopt, ""}));
  EXPECT_EQ(reading.items[1],
            (Received{StreamItemKind::kAngles, {1, 2}, std::nullopt, std::nullopt, ""}));
  EXPECT_EQ(reading.items[2].kind, StreamItemKind::kTemperatures);
  // Three taxels on four places.
  EXPECT_EQ(reading.items[3].numbers, (std::vector<double>{1, 0, 2, 3}));
}

TEST(StreamLines, EmptyLinesAndCommentsAreNoFaults) {
  const Reading reading = readText("\n# starting\r\n  \n1,2,3\n", padHand({{1, 3}}));
  EXPECT_EQ(reading.items.size(), 1u);
  EXPECT_EQ(reading.stats.refused, 0u);
  EXPECT_EQ(reading.stats.lines, 4u);
}

TEST(StreamLines, NamesTheFaultAndItsPlace) {
  EXPECT_EQ(faultOf("\n\n1,2\n"), "line 3: 2 numbers instead of 3");
  EXPECT_EQ(faultOf("1,2,3,4,5\n"), "line 1: 5 numbers instead of 3");
  EXPECT_EQ(faultOf("1,two,3\n"), "line 1: value 2 is \"two\", not a number");
  EXPECT_EQ(faultOf("1,2x,3\n"), "line 1: value 2 is \"2x\", not a number");
  EXPECT_EQ(faultOf("a=1,b=2,c=3\n"), "line 1: value 1 is \"b=2\", not a number");
  EXPECT_EQ(faultOf("1,,3\n"), "line 1: value 2 is empty");
  EXPECT_EQ(faultOf(",1,2,3\n"), "line 1: value 1 is empty");
  EXPECT_EQ(faultOf("pad#x,1,2,3\n"), "line 1: \"pad#x\" has no number after '#'");
  EXPECT_EQ(faultOf("angles,1\n"), "line 1: 1 number instead of none: the hand has no axes");
  EXPECT_EQ(faultOf("hello\n"), "line 1: 0 numbers instead of 3");
  EXPECT_EQ(faultOf("0x10,2,3\n"), "line 1: value 1 is \"0x10\", not a number");
}

TEST(StreamLines, AnArrowAloneIsRefused) {
  for (const char* text : {">\n", "> \n", " >\t\r\n", "[>]\n", ">[]\n"})
    EXPECT_EQ(faultOf(text), "line 1: nothing follows '>'") << text;
  EXPECT_EQ(faultOf(">>\n"), "line 1: value 1 is \">\", not a number");
}

TEST(StreamLines, SaysWhatIsWrongWithDecimalCommas) {
  EXPECT_NE(faultOf("0,5;1,5;2,5\n").find("decimal points instead of decimal commas"),
            std::string::npos);
  EXPECT_NE(faultOf("0,5 1,5 2,5\n").find("decimal points instead of decimal commas"),
            std::string::npos);
  EXPECT_EQ(faultOf("0,5,1,5,2,5\n"),
            "line 1: 6 numbers instead of 3; if the values have decimal commas, send decimal "
            "points");
  // Without whole numbers the count alone would be right.
  EXPECT_NE(faultOf("1;2,5;3\n").find("commas"), std::string::npos);
}

TEST(StreamLines, ALineWithoutEndIsSkippedInBoundedMemory) {
  StreamLineParser parser{StreamShape(padHand({{1, 3}}))};
  std::size_t items = 0;
  const auto sink = [&](const StreamItem&) { ++items; };
  const std::string piece(1000, '7');
  for (int i = 0; i < 1000; ++i) {
    parser.push(std::as_bytes(std::span(piece)), sink);
    ASSERT_LE(parser.pendingBytes(), parser.longestLine());
  }
  EXPECT_EQ(parser.stats().refused, 1u);
  EXPECT_EQ(parser.lastFault(), "line 1: longer than 4171 bytes: no line of this hand is");
  const std::string next = "\n1,2,3\n1,2\n";
  parser.push(std::as_bytes(std::span(next)), sink);
  EXPECT_EQ(items, 1u);
  EXPECT_EQ(parser.lastFault(), "line 3: 2 numbers instead of 3");
  EXPECT_EQ(parser.stats().skippedBytes, 1'000'001u);
}

TEST(StreamLines, AMillionTaxelsForASmallHandAreOneFault) {
  std::string line;
  for (int i = 0; i < 1'000'000; ++i) line += "1,";
  const Reading reading = readText(line + "\n1,2,3\n", padHand({{1, 3}}), {}, 4096);
  EXPECT_EQ(reading.items.size(), 1u);
  EXPECT_EQ(reading.stats.refused, 1u);
}

TEST(StreamLines, AMillionTaxelsOfAHandOfThatSizeAreRead) {
  const HandDescription hand = padHand(std::vector<std::pair<int, int>>(16, {250, 250}));
  std::string line;
  for (int i = 0; i < 1'000'000; ++i) line += std::to_string(i % 4096) + ",";
  const Reading reading = readText(line + "\n", hand, {}, 65'536);
  ASSERT_EQ(reading.items.size(), 1u) << reading.fault;
  EXPECT_EQ(reading.items[0].numbers[999'999], 999'999 % 4096);
}

TEST(StreamLines, TheFirstLineOfARunningSenderIsNotUsed) {
  // It was "123,2,3": the right count, but a wrong number.
  const Reading reading = readText("23,2,3\n4,5,6\n", padHand({{1, 3}}), {.startsInside = true});
  ASSERT_EQ(reading.items.size(), 1u);
  EXPECT_EQ(reading.items[0].numbers, (std::vector<double>{4, 5, 6}));
  EXPECT_EQ(reading.stats.skippedBytes, 7u);
  EXPECT_EQ(reading.stats.refused, 0u);
}

TEST(StreamLines, PiecesMakeNoDifference) {
  const std::string text = "1,2,3\nframe#5 1 2 3\nbad\n{\"angles_deg\":[1]}\n# c\r\n7;8;9;\n" +
                           std::string(5000, 'x') + "\n1,2,3\n4,5";
  const Reading whole = readText(text, padHand({{1, 3}}));
  EXPECT_EQ(whole.items.size(), 4u);
  for (const std::size_t chunk : {1, 2, 3, 7, 1000}) {
    const Reading pieces = readText(text, padHand({{1, 3}}), {}, chunk);
    EXPECT_EQ(pieces.items, whole.items) << chunk;
    EXPECT_EQ(pieces.stats.refused, whole.stats.refused) << chunk;
    EXPECT_EQ(pieces.stats.lines, whole.stats.lines) << chunk;
    EXPECT_EQ(pieces.fault, whole.fault) << chunk;
  }
}

TEST(StreamLines, EveryFloatComesBackAsItWasWritten) {
  std::mt19937 random(5);
  const HandDescription hand = padHand({{1, 3}});
  for (int i = 0; i < 2000; ++i) {
    std::vector<double> sent;
    std::string line;
    for (int k = 0; k < 3; ++k) {
      const float value = static_cast<float>(random()) / 4294967296.0F * 4095.0F;
      sent.push_back(value);
      char text[32];
      std::snprintf(text, sizeof text, "%.9g,", static_cast<double>(value));
      line += text;
    }
    const Reading reading = readText(line + "\n", hand);
    ASSERT_EQ(reading.items.size(), 1u) << line << reading.fault;
    ASSERT_EQ(reading.items[0].numbers, sent) << line;
  }
}

TEST(StreamLines, WhatOnePalpateSendsAnotherOneReads) {
  const HandDescription hand = padHand({{2, 3}, {1, 2}});
  TactileFrame frame(hand.layout);
  frame.hostUs = 1'700'000'000'250'000;
  for (std::size_t i = 0; i < frame.values.size(); ++i)
    frame.values[i] = static_cast<float>(10 * i);
  std::string line;
  appendTactileSensorJson(line, frame, 41);
  const Reading reading = readText(line + "\n", hand);
  ASSERT_EQ(reading.items.size(), 1u) << reading.fault;
  EXPECT_EQ(reading.items[0].numbers,
            std::vector<double>(frame.values.begin(), frame.values.end()));
  EXPECT_EQ(reading.items[0].sequence, 41u);
  EXPECT_EQ(reading.items[0].deviceUs, frame.hostUs);
}

TEST(StreamLines, JsonHasAnglesTemperaturesAndADescription) {
  const Reading reading = readText(
      "{\"t\":1.5,\"m0\":{},\"angles_deg\":[1.5,-2],\"temperatures_degc\":[30]}\n"
      "{\"description\":{\"serial\":\"P7\"}}\n",
      smallHand());
  ASSERT_EQ(reading.items.size(), 3u) << reading.fault;
  EXPECT_EQ(reading.items[0].numbers, (std::vector<double>{1.5, -2}));
  EXPECT_EQ(reading.items[1].kind, StreamItemKind::kTemperatures);
  EXPECT_EQ(reading.items[2].text, "{\"serial\":\"P7\"}");
}

// As rosbridge sends a message of ROS 1 or 2.
TEST(StreamLines, AMessageInAnEnvelopeIsRead) {
  const auto envelope = [](const std::string& stamp) {
    return "{\"op\":\"publish\",\"topic\":\"/tactile\",\"msg\":{\"header\":{\"seq\":7,\"stamp\":{" +
           stamp +
           "},\"frame_id\":\"hand\"},\"tactile_matrix\":[{\"matrix_id\":0,\"cells_x\":3,\"cells_"
           "y\":1,"
           "\"tactile_array\":[1,2.5,300]}]}}\n";
  };
  for (const char* stamp : {"\"secs\":12,\"nsecs\":34000000", "\"sec\":12,\"nanosec\":34000000"}) {
    const Reading reading = readText(envelope(stamp), padHand({{1, 3}}));
    ASSERT_EQ(reading.items.size(), 1u) << reading.fault;
    EXPECT_EQ(reading.items[0].numbers, kValues);
    EXPECT_EQ(reading.items[0].sequence, 7u);
    EXPECT_EQ(reading.items[0].deviceUs, 12'034'000);
  }
  EXPECT_NE(faultOf("{\"op\":\"publish\"}\n").find("none of tactile_matrix"), std::string::npos);
  EXPECT_NE(faultOf("{\"op\":\"subscribe\"}\n").find("none of tactile_matrix"), std::string::npos);
}

TEST(StreamLines, JsonFaultsNameTheMatrix) {
  const auto matrix = [](int id, int rows, int columns, const std::string& values) {
    return "{\"tactile_matrix\":[{\"matrix_id\":" + std::to_string(id) +
           ",\"cells_x\":" + std::to_string(columns) + ",\"cells_y\":" + std::to_string(rows) +
           ",\"tactile_array\":[" + values + "]}]}\n";
  };
  EXPECT_EQ(valuesIn(matrix(0, 1, 3, "1,2.5,300")), kValues);
  EXPECT_EQ(faultOf(matrix(1, 1, 3, "1,2,3")), "line 1: there is no matrix 1");
  EXPECT_EQ(faultOf(matrix(0, 3, 1, "1,2,3")),
            "line 1: matrix 0 has 3 x 1 places and 3 values instead of 1 x 3");
  EXPECT_EQ(faultOf(matrix(0, 1, 3, "1,2")),
            "line 1: matrix 0 has 1 x 3 places and 2 values instead of 1 x 3");
  EXPECT_EQ(valuesIn(matrix(0, 1, 3, "1,-2,3")), (std::vector<double>{1, -2, 3}));
  EXPECT_NE(faultOf(matrix(0, 1, 3, "1,\"2\",3")).find("number"), std::string::npos);
  EXPECT_NE(faultOf("{\"tactile_matrix\":[]}\n").find("0 matrices instead of 1"),
            std::string::npos);
  EXPECT_NE(faultOf("{\"sequence\":1}\n").find("none of tactile_matrix"), std::string::npos);
  EXPECT_NE(faultOf("{\"tactile_matrix\":[{}\n").find("line 1: "), std::string::npos);
  EXPECT_EQ(faultOf("{}\n", {.acceptJson = false}),
            "line 1: this is JSON, and lines of numbers are expected");
  EXPECT_EQ(faultOf("1,2,3\n", {.acceptNumbers = false}), "line 1: \"1,2,3\" is not a JSON object");
}

TEST(StreamLines, ThreeComponentsStandInThePlaceOfEachValue) {
  const auto skin = [](std::vector<std::pair<int, int>> sizes) {
    HandDescription hand = padHand(sizes);
    std::vector<MatrixLayout> matrices = hand.layout->matrices();
    for (MatrixLayout& matrix : matrices) matrix.touch = {.components = 3, .isSigned = true};
    hand.layout = std::make_shared<const SensorLayout>(std::move(matrices));
    hand.matrices.front().name = "left";
    hand.matrices.back().name = hand.matrices.size() > 1 ? "right" : "left";
    return hand;
  };
  const std::vector<double> expected{1, -2, 3, 4, 5, -6};
  // A line, JSON, a line per row, and a line per matrix.
  const std::vector<std::pair<std::string, HandDescription>> forms = {
      {"1,-2,3,4,5,-6\n", skin({{2, 1}})},
      {"{\"tactile_matrix\":[{\"matrix_id\":0,\"cells_x\":1,\"cells_y\":2,"
       "\"tactile_array\":[1,-2,3,4,5,-6]}]}\n",
       skin({{2, 1}})},
      {"1,-2,3\n4,5,-6\n", skin({{2, 1}})},
      {"left:1,-2,3\nright:4,5,-6\n", skin({{1, 1}, {1, 1}})}};
  for (const auto& [text, hand] : forms) {
    const Reading reading = readText(text, hand);
    ASSERT_EQ(reading.items.size(), 1u) << text << reading.fault;
    EXPECT_EQ(reading.items[0].numbers, expected) << text;
  }
  // A list per taxel is not one per column, even where their lengths fit: 3 x 2 places, of which
  // two are taxels.
  for (const std::size_t pads : {std::size_t{1}, std::size_t{2}}) {
    HandDescription hand = skin(std::vector<std::pair<int, int>>(pads, {3, 2}));
    std::vector<MatrixLayout> matrices = hand.layout->matrices();
    for (MatrixLayout& matrix : matrices)
      matrix.staticMask = matrix.dynamicMask = {1, 1, 0, 0, 0, 0};
    hand.layout = std::make_shared<const SensorLayout>(std::move(matrices));
    const std::string lists = "[[1,-2,3],[4,5,-6]]\n";
    const Reading reading = readText(pads == 1 ? lists : "left:" + lists + "right:" + lists, hand);
    ASSERT_EQ(reading.items.size(), 1u) << reading.fault;
    std::vector<double> all;
    for (std::size_t m = 0; m < pads; ++m) {
      all.insert(all.end(), expected.begin(), expected.end());
      all.resize((m + 1) * 18);
    }
    EXPECT_EQ(reading.items[0].numbers, all);
  }
  // Three for a hand with one, and two of three, are refused with what is expected.
  EXPECT_NE(readText("1,2,3,4,5,6\n", padHand({{1, 2}})).fault.find("\"components\": 3"),
            std::string::npos);
  EXPECT_NE(readText("1,2,3,4\n", skin({{1, 2}})).fault.find("4 numbers instead of 6"),
            std::string::npos);
  EXPECT_NE(readText("{\"tactile_matrix\":[{\"matrix_id\":0,\"cells_x\":1,\"cells_y\":1,"
                     "\"tactile_array\":[1,-2]}]}\n",
                     skin({{1, 1}}))
                .fault.find("2 values instead of 1 x 1 with three values each"),
            std::string::npos);
}

// As `palpate stream --to tactile` divides a frame into datagrams.
TEST(StreamLines, AFrameMayComeInMessagesWithTheSameNumber) {
  StreamLineParser parser{StreamShape(padHand({{1, 2}, {1, 1}, {1, 2}}))};
  std::vector<std::vector<float>> frames;
  const auto push = [&](int seq, const std::string& matrices) {
    const std::string line = "{\"header\":{\"seq\":" + std::to_string(seq) +
                             "},\"tactile_matrix\":[" + matrices + "]}\n";
    parser.push(std::as_bytes(std::span(line)), [&](const StreamItem& item) {
      frames.emplace_back(item.values.begin(), item.values.end());
    });
  };
  const std::string a = R"({"matrix_id":0,"cells_x":2,"cells_y":1,"tactile_array":[1,2]})";
  const std::string b = R"({"matrix_id":1,"cells_x":1,"cells_y":1,"tactile_array":[3]})";
  const std::string c = R"({"matrix_id":2,"cells_x":2,"cells_y":1,"tactile_array":[4,5]})";
  push(7, a + "," + b);
  EXPECT_TRUE(frames.empty());
  push(7, c);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0], (std::vector<float>{1, 2, 3, 4, 5}));
  push(8, c + "," + b + "," + a);  // a whole one
  EXPECT_EQ(frames.size(), 2u);
  EXPECT_EQ(parser.stats().refused, 0u);
  push(9, a);  // its other matrices do not come
  push(10, b);
  EXPECT_EQ(parser.stats().refused, 1u);
  EXPECT_NE(parser.lastFault().find("frame 9 has 1 matrices instead of 3"), std::string::npos)
      << parser.lastFault();
  push(10, b);
  EXPECT_NE(parser.lastFault().find("matrix 1 is there twice"), std::string::npos);
  push(10, c + "," + a);
  EXPECT_EQ(frames.size(), 3u);
}

// Angles come in the first of them; the others hold nothing that is a frame.
TEST(StreamLines, PartsOfSignalsAreNotRefused) {
  const auto refusedOf = [](const std::string& text) {
    StreamLineParser parser{StreamShape(testing::smallHand())};
    parser.push(std::as_bytes(std::span(text)), [](const StreamItem&) {});
    return parser.stats().refused;
  };
  const std::string angles = "{\"t\":1.5,\"sequence\":3,\"angles_deg\":[1,2]}\n";
  const std::string signals = "{\"t\":1.5,\"sequence\":3,\"m0\":{\"sum\":3}}\n";
  EXPECT_EQ(refusedOf(angles + signals + signals), 0u);
  EXPECT_EQ(refusedOf(signals), 1u);
  EXPECT_EQ(refusedOf(angles + "{\"m0\":{\"sum\":3}}\n"), 1u);
}

TEST(StreamLines, ADatagramEndsItsLine) {
  StreamLineParser parser{StreamShape(padHand({{1, 3}}))};
  std::size_t items = 0;
  const auto sink = [&](const StreamItem&) { ++items; };
  for (int i = 0; i < 3; ++i) {
    const std::string datagram = "1,2,3";
    parser.push(std::as_bytes(std::span(datagram)), sink);
    parser.endLine(sink);
  }
  EXPECT_EQ(items, 3u);
  EXPECT_EQ(parser.pendingBytes(), 0u);
}

}  // namespace
}  // namespace palpate::testing::stream_lines_test
