#include <algorithm>
#include <cmath>
#include <csignal>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "palpate/core/json.h"
#include "palpate/core/xml.h"
#include "palpate/emulator/physical_hand.h"
#include "palpate/model/timing.h"
#include "palpate/recording/recording.h"

#include "commands/demo_grasps.h"
#include "commands/palpate_program.h"
#include "testing/background_program.h"

namespace palpate::demo_command_test {
namespace {

namespace fs = std::filesystem;
using testing::expectOneLineError;
using testing::palpate;
using testing::readFile;

// No display at all: the tour must not need one.
const std::map<std::string, std::string> kHeadless = {
    {"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}, {"QT_QPA_PLATFORM", ""}};

using Row = std::map<std::string, std::string>;
std::vector<Row> rowsOf(const std::string& csv) {
  std::istringstream lines(csv);
  std::vector<std::string> names;
  std::vector<Row> rows;
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> cells(1);
    for (const char c : line) {
      if (c == ',')
        cells.emplace_back();
      else
        cells.back() += c;
    }
    if (names.empty()) {
      names = cells;
      continue;
    }
    EXPECT_EQ(cells.size(), names.size()) << line;
    Row& row = rows.emplace_back();
    for (std::size_t i = 0; i < std::min(names.size(), cells.size()); ++i) row[names[i]] = cells[i];
  }
  return rows;
}

// When and how far the pen slips, reckoned alike from the emulator's mechanics without ports and
// from what the tour wrote down of its own. Times from the first contact of both pads on.
struct PenWay {
  double heldS = 0.0;   // the first contact itself
  double beganS = 0.0;  // it has moved by 0.1 taxel
  double movedTaxels = 0.0;
};

struct PenMoment {
  double timeS = 0.0;
  bool held = false;
  double upTaxels = 0.0;  // over matrix 1, towards the fingertip
};

std::optional<PenWay> wayOf(const std::vector<PenMoment>& moments) {
  const auto held =
      std::find_if(moments.begin(), moments.end(), [](const auto& m) { return m.held; });
  if (held == moments.end()) return std::nullopt;
  // Fingers that close move it a little; after a second they are still, and it is not pulled yet.
  const auto rest = std::find_if(
      held, moments.end(), [&](const PenMoment& m) { return m.timeS >= held->timeS + 1.0; });
  PenWay way{.heldS = held->timeS};
  for (auto at = rest; at != moments.end() && at->held; ++at) {
    const double taxels = at->upTaxels - rest->upTaxels;
    if (way.beganS == 0.0 && taxels >= 0.1) way.beganS = at->timeS - held->timeS;
    way.movedTaxels = std::max(way.movedTaxels, taxels);
  }
  return way;
}

PenWay simulatedWay() {
  PhysicalHand hand(loadScene("slipping_pen", testing::dataFolder() / "scenes"));
  std::vector<std::uint16_t> counts(hand.hand().layout->numCells());
  std::vector<PenMoment> moments;
  for (double timeS = 0.0; timeS < 8.5; timeS += 0.01) {
    hand.advanceTo(timeS);
    hand.scan(counts);
    const auto truth = hand.truth();
    moments.push_back({timeS, truth[1].contact && truth[5].contact, -truth[1].slipYTaxels});
  }
  return wayOf(moments).value();
}

// One tour for all tests that look at what it leaves. The name of its folder is made to be mistaken
// for something else.
class DemoTourTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    base_ = std::make_unique<testing::TemporaryFolder>();
    result_ = palpate({"demo", "-o", tour()}, kHeadless);
  }
  static void TearDownTestSuite() { base_.reset(); }
  void SetUp() override { ASSERT_EQ(result_.exitCode, 0) << result_.out << result_.err; }

  static fs::path tour() { return *base_ / "a tour <b> & 'c'"; }
  static Json json(const std::string& name) { return Json::parse(readFile(tour() / name)); }
  static std::vector<Row> csv(const std::string& name) { return rowsOf(readFile(tour() / name)); }

  static std::unique_ptr<testing::TemporaryFolder> base_;
  static testing::ProgramResult result_;
};
std::unique_ptr<testing::TemporaryFolder> DemoTourTest::base_;
testing::ProgramResult DemoTourTest::result_;

TEST_F(DemoTourTest, EveryStepIsDoneAndSaysItsFigure) {
  const std::vector<std::string> steps = {"emulate",
                                          "grasp",
                                          "record",
                                          "replay",
                                          "export",
                                          "signals",
                                          "slip",
                                          "recognition",
                                          "window",
                                          "report"};
  std::size_t at = 0;
  for (const std::string& step : steps) {
    const std::size_t found = result_.out.find("\n" + step + ": ok, ", at);
    EXPECT_NE(found, std::string::npos) << step << ": " << result_.out;
    at = found == std::string::npos ? at : found;
  }
  for (const char* word : {"skipped", "failed", "wrong", "later version"})
    EXPECT_EQ(result_.out.find(word), std::string::npos) << result_.out;
  EXPECT_NE(result_.out.find((tour() / "report.html").string()), std::string::npos)
      << "what is next";
  EXPECT_EQ(result_.err, "");

  const Json report = json("report.json");
  ASSERT_EQ(report.at("steps").size(), steps.size());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Json step = report.at("steps").at(i);
    EXPECT_EQ(step.at("step").asString(), steps[i]);
    EXPECT_EQ(step.at("outcome").asString(), "ok");
    EXPECT_NE(result_.out.find(steps[i] + ": ok, " + step.at("figure").asString() + "\n"),
              std::string::npos)
        << step.at("figure").asString();
  }
}

TEST_F(DemoTourTest, LeavesTheseFilesAndNoOther) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(tour())) names.insert(entry.path().filename());
  EXPECT_EQ(names,
            (std::set<std::string>{"grasp.palpate",
                                   "grasp.dsa",
                                   "grasp.dsa.notes.json",
                                   "handle.palpate",
                                   "bottle.palpate",
                                   "box.palpate",
                                   "foam_ball.palpate",
                                   "pen.palpate",
                                   "slip.palpate",
                                   "slip.csv",
                                   "slip_truth.csv",
                                   "slip.png",
                                   "window.png",
                                   "recognition.json",
                                   "report.json",
                                   "report.html"}));
  for (const char* picture : {"window.png", "slip.png"})
    EXPECT_EQ(readFile(tour() / picture).substr(1, 3), "PNG") << picture;
  std::vector<std::string> words = {"verify"};
  for (const std::string& name : names)
    if (name.ends_with(".palpate") || name.ends_with(".dsa")) words.push_back(tour() / name);
  const auto verified = palpate(words);
  EXPECT_EQ(verified.exitCode, 0) << verified.out << verified.err;
}

// All three fingertips felt the ball, at the rate of the real hand.
TEST_F(DemoTourTest, TheBallWasGraspedRecordedAndExported) {
  const Profile profile = openRecording(tour() / "grasp.palpate");
  const Profile exported = openRecording(tour() / "grasp.dsa");
  ASSERT_EQ(json("report.json").at("recording").at("frames").asInteger(),
            static_cast<std::int64_t>(profile.numFrames()));
  EXPECT_EQ(exported.numFrames(), profile.numFrames());
  EXPECT_GT(profile.numFrames(), 100u);
  EXPECT_NEAR(timingOf(profile).meanRateHz, 31.7, 1.0);
  EXPECT_GT(static_cast<double>(profile.numAngles()) * 1e6,
            50.0 * static_cast<double>(profile.durationUs()));
  for (const std::size_t fingertip : {1u, 3u, 5u}) {
    float most = 0.0F;
    for (std::size_t i = 0; i < profile.numFrames(); ++i)
      most = std::max(most, profile.frame(i).matrix(fingertip).maxCoeff());
    EXPECT_GT(most, 100.0F) << fingertip;
  }
  for (std::size_t i = 0; i < profile.numFrames(); i += 37)
    EXPECT_EQ(exported.frame(i).values, profile.frame(i).values) << i;
}

// By how many fingers each thing is held is a matter of its preshape.
TEST_F(DemoTourTest, SixThingsWereHeld) {
  const std::map<std::string, int> fingers = {
      {"ball", 3}, {"bottle", 3}, {"box", 3}, {"foam ball", 3}, {"pen", 2}, {"handle", 2}};
  const Json held = json("report.json").at("held");
  ASSERT_EQ(held.size(), fingers.size());
  for (std::size_t i = 0; i < held.size(); ++i) {
    const std::string object = held.at(i).at("object").asString();
    ASSERT_TRUE(fingers.contains(object)) << object;
    EXPECT_EQ(held.at(i).at("fingers").asInteger(), fingers.at(object)) << object;
    EXPECT_GT(held.at(i).at("force_n").asDouble(), 0.5) << object;
  }
}

TEST_F(DemoTourTest, ThePenWentAsFarAsItsMechanicsSay) {
  std::map<std::int64_t, std::map<std::string, Row>> frames;
  for (const Row& row : csv("slip_truth.csv"))
    frames[std::stoll(row.at("time_ms"))][row.at("matrix")] = row;
  std::vector<PenMoment> moments;
  for (const auto& [timeMs, matrices] : frames) {
    const Row& first = matrices.at("1");
    const bool held = first.at("contact") == "1" && matrices.at("5").at("contact") == "1";
    moments.push_back({static_cast<double>(timeMs) / 1e3,
                       held,
                       held ? -std::stod(first.at("slip_y_taxels")) : 0.0});
  }
  const auto written = wayOf(moments);
  ASSERT_TRUE(written);
  const PenWay simulated = simulatedWay();
  ASSERT_GT(simulated.movedTaxels, 1.0);
  // What slips slips ever faster: a little is decided by the steps in which time is reckoned.
  EXPECT_NEAR(written->movedTaxels, simulated.movedTaxels, 0.2 * simulated.movedTaxels);
  EXPECT_NEAR(written->beganS, simulated.beganS, 0.1);

  const Json truth = json("report.json").at("slip").at("truth");
  EXPECT_NEAR(truth.at("moved_taxels").asDouble(), written->movedTaxels, 0.2);
  EXPECT_NEAR(truth.at("moved_mm").asDouble(), 3.4 * truth.at("moved_taxels").asDouble(), 1e-6);
  EXPECT_NEAR(truth.at("began_ms").asDouble() * 1e-3, written->heldS + written->beganS, 0.07);
}

TEST_F(DemoTourTest, TheSlipWasSeenSoonAfterItBegan) {
  const Json slip = json("report.json").at("slip");
  ASSERT_TRUE(slip.at("seen").asBool());
  EXPECT_EQ(slip.at("false_alarms_before").asInteger(), 0);
  const Json alarm = slip.at("alarm");
  EXPECT_EQ(alarm.at("lamp").asString(), "slipping");
  EXPECT_EQ(alarm.at("state").asString(), "slip");
  // The same in the table: the first frame of that matrix that slips, between the begin and the end
  // of the motion.
  const std::string matrix = std::to_string(alarm.at("matrix").asInteger());
  const std::int64_t frame = alarm.at("frame").asInteger();
  double imprint = 0.0;
  bool slippedBefore = false;
  std::optional<double> raisedMs;
  for (const Row& row : csv("slip.csv")) {
    if (row.at("matrix") != matrix) continue;
    const std::int64_t now = std::stoll(row.at("frame"));
    if (now == frame - 1) slippedBefore = row.at("slipping") == "1";
    if (now == frame) {
      EXPECT_EQ(row.at("slipping"), "1");
      EXPECT_EQ(row.at("state"), "slip");
      raisedMs = std::stod(row.at("time_ms"));
    }
    if (now >= frame && now <= alarm.at("last_frame").asInteger() && !row.at("ref_dx").empty())
      imprint =
          std::max(imprint, std::hypot(std::stod(row.at("ref_dx")), std::stod(row.at("ref_dy"))));
  }
  ASSERT_TRUE(raisedMs);
  EXPECT_FALSE(slippedBefore);
  const double beganMs = slip.at("truth").at("began_ms").asDouble();
  EXPECT_NEAR(alarm.at("after_s").asDouble() * 1e3, *raisedMs - beganMs, 2.0);
  EXPECT_GT(*raisedMs, beganMs - 100.0);
  EXPECT_LT(*raisedMs, slip.at("truth").at("ended_ms").asDouble()) << "while it still moved";
  EXPECT_NEAR(alarm.at("imprint_taxels").asDouble(), imprint, 1e-4);
  const double moved = slip.at("truth").at("moved_taxels").asDouble();
  EXPECT_NEAR(imprint, moved, 0.3 * moved);
  EXPECT_GT(alarm.at("moved_taxels").asDouble(), 0.0);
  EXPECT_LT(alarm.at("moved_taxels").asDouble(), 0.8 * moved);
}

TEST_F(DemoTourTest, TheTableOfTheSlipIsThatOfTheCommand) {
  const auto printed = palpate({"slip", tour() / "slip.palpate", "--reference", "rest", "--quiet"});
  EXPECT_EQ(printed.exitCode, 0) << printed.err;
  EXPECT_EQ(readFile(tour() / "slip.csv"), printed.out);
  EXPECT_GT(csv("slip.csv").size(), 200u);
}

TEST_F(DemoTourTest, WhatWasHeldIsNamed) {
  const std::vector<std::pair<std::string, std::string>> held = {{"grasp.palpate", "ball"},
                                                                 {"bottle.palpate", "bottle"},
                                                                 {"box.palpate", "box"},
                                                                 {"foam_ball.palpate", "foam ball"},
                                                                 {"pen.palpate", "pen"},
                                                                 {"handle.palpate", "handle"}};
  const Json recognition = json("recognition.json");
  EXPECT_EQ(recognition.at("taught").asInteger(), 5);
  EXPECT_EQ(recognition.at("right").asInteger(), 5);
  ASSERT_EQ(recognition.at("grasps").size(), held.size());
  for (std::size_t i = 0; i < held.size(); ++i) {
    const auto& [file, object] = held[i];
    const Json grasp = recognition.at("grasps").at(i);
    EXPECT_EQ(grasp.at("file").asString(), file);
    EXPECT_EQ(grasp.at("object").asString(), object);
    const bool inTraining = object != "handle";
    EXPECT_EQ(grasp.at("taught").asBool(), inTraining);
    EXPECT_EQ(grasp.at("label").asString(), inTraining ? object : "unknown");
    EXPECT_TRUE(grasp.at("right").asBool());
    // The command says the same of the same recording.
    const auto asked = palpate({"classify",
                                testing::dataFolder() / "emulated_objects.json",
                                tour() / file,
                                "--json",
                                "--session-offset",
                                "0",
                                "--quiet"});
    ASSERT_EQ(asked.exitCode, 0) << asked.err;
    const Json said = Json::parse(asked.out).at("grasps").at(0);
    EXPECT_EQ(said.at("label").asString(), grasp.at("label").asString());
    EXPECT_EQ(said.at("top").text(), grasp.at("top").text());
    if (!inTraining) continue;
    EXPECT_EQ(grasp.at("rank").asInteger(), 1);
    EXPECT_GT(grasp.at("probability").asDouble(), 0.9) << object;
    EXPECT_TRUE(grasp.at("sure").asBool()) << object;
  }
  EXPECT_EQ(json("report.json").at("recognition").text(), recognition.text());
}

// Well-formed, with all of its pictures in it.
TEST_F(DemoTourTest, ThePageNeedsNoOtherFile) {
  struct Reader : XmlHandler {
    void startElement(std::string_view name, const char* const* attributes) override {
      EXPECT_NE(name, "script");
      EXPECT_NE(name, "link");
      for (; *attributes; attributes += 2) {
        const std::string_view key = attributes[0];
        if (key == "src") pictures.emplace_back(attributes[1]);
        EXPECT_NE(key, "href") << attributes[1];
      }
    }
    void endElement(std::string_view) override {}
    void text(std::string_view piece) override { words += piece; }
    std::vector<std::string> pictures;
    std::string words;
  } reader;
  const std::string page = readFile(tour() / "report.html");
  ASSERT_TRUE(page.starts_with("<!DOCTYPE html>\n"));
  XmlParser parser(reader, {.maxMarkupBytes = 16u << 20});
  parser.push(std::string_view(page).substr(page.find('\n') + 1));
  parser.finish();
  EXPECT_EQ(reader.pictures.size(), 8u) << "the window twice, six things";
  for (const std::string& picture : reader.pictures)
    EXPECT_TRUE(picture.starts_with("data:image/png;base64,iVBORw0KGgo")) << picture.substr(0, 60);
  const Json steps = json("report.json").at("steps");
  for (std::size_t i = 0; i + 1 < steps.size(); ++i)
    EXPECT_NE(reader.words.find(steps.at(i).at("figure").asString()), std::string::npos) << i;
}

TEST(DemoCommand, NeverWritesIntoAFolderThatExists) {
  const testing::TemporaryFolder folder;
  fs::create_directory(folder / "tour");
  auto environment = kHeadless;
  environment["PALPATE_DATA"] = folder / "nothing";  // ends at the first step
  palpate({"demo", "-o", folder / "tour"}, environment);
  palpate({"demo", "-o", (folder / "tour").string() + "/"}, environment);
  EXPECT_TRUE(fs::is_empty(folder / "tour"));
  EXPECT_TRUE(fs::exists(folder / "tour-3" / "report.json"));
  EXPECT_TRUE(fs::exists(folder / "tour-2" / "report.json"));
}

TEST(DemoCommand, SaysWhatFailed) {
  expectOneLineError(palpate({"demo", "-o", "/nowhere/tour"}, kHeadless), 1, {"/nowhere/tour"});
  const testing::TemporaryFolder folder;
  auto environment = kHeadless;
  environment["PALPATE_DATA"] = folder / "nothing";
  const auto result = palpate({"demo", "-o", folder / "tour"}, environment);
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_NE(result.out.find("emulate: failed, "), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("recognition: skipped, "), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("A step failed"), std::string::npos) << result.out;
  EXPECT_TRUE(fs::exists(folder / "tour" / "report.json"));
  EXPECT_NE(readFile(folder / "tour" / "report.html").find("failed"), std::string::npos);
}

TEST(DemoCommand, InterruptedItLeavesNothing) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const testing::TemporaryFolder folder;
    testing::BackgroundProgram program(PALPATE_PROGRAM, {"demo", "-o", folder / "tour"});
    ASSERT_TRUE(program.awaitLine("emulate: ok")) << program.out() << program.err();
    EXPECT_TRUE(fs::exists(folder / "tour" / "grasp.palpate"));  // and the others are written to
    program.signal(signal);
    EXPECT_EQ(program.wait(), 1) << program.out();
    EXPECT_EQ(program.err(), "palpate: interrupted: the files of the tour were removed\n");
    EXPECT_TRUE(fs::is_empty(folder.path()));
  }
}

}  // namespace
}  // namespace palpate::demo_command_test
