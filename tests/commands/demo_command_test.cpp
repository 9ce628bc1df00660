#include <algorithm>
#include <csignal>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "palpate/core/json.h"
#include "palpate/emulator/physical_hand.h"
#include "palpate/model/timing.h"
#include "palpate/recording/recording.h"

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

// How far the pen slips over matrix 1 towards the fingertip, by the emulator's mechanics without
// ports: between the begin of the pull and the release.
double simulatedWayTaxels() {
  PhysicalHand hand(loadScene("slipping_pen", testing::dataFolder() / "scenes"));
  std::vector<std::uint16_t> counts(hand.hand().layout->numCells());
  const auto upTaxelsAt = [&](double timeS) {
    hand.advanceTo(timeS);
    hand.scan(counts);
    return -hand.truth()[1].slipYTaxels;
  };
  const double rested = upTaxelsAt(4.0);
  return upTaxelsAt(6.99) - rested;
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

  static std::unique_ptr<testing::TemporaryFolder> base_;
  static testing::ProgramResult result_;
};
std::unique_ptr<testing::TemporaryFolder> DemoTourTest::base_;
testing::ProgramResult DemoTourTest::result_;

TEST_F(DemoTourTest, EveryStepIsDoneAndSaysItsFigure) {
  const std::vector<std::string> steps = {
      "emulate", "grasp", "record", "replay", "export", "slip", "recognition", "window"};
  std::size_t at = 0;
  for (const std::string& step : steps) {
    const std::size_t found = result_.out.find("\n" + step + ": ok, ", at);
    EXPECT_NE(found, std::string::npos) << step << ": " << result_.out;
    at = found == std::string::npos ? at : found;
  }
  for (const char* word : {"skipped", "failed", "wrong", "later version"})
    EXPECT_EQ(result_.out.find(word), std::string::npos) << result_.out;
  EXPECT_NE(result_.out.find((tour() / "report.json").string()), std::string::npos)
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
                                   "window.png",
                                   "report.json"}));
  EXPECT_EQ(readFile(tour() / "window.png").substr(1, 3), "PNG");
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
  const Json truth = json("report.json").at("slip").at("truth");
  const double moved = truth.at("moved_taxels").asDouble(), simulated = simulatedWayTaxels();
  ASSERT_GT(simulated, 1.0);
  // What slips slips ever faster: a little is decided by the steps in which time is reckoned.
  EXPECT_NEAR(moved, simulated, 0.2 * simulated);
  EXPECT_NEAR(truth.at("moved_mm").asDouble(), 3.4 * moved, 1e-6);
}

TEST_F(DemoTourTest, TheSlipWasSeenSoonAfterItBegan) {
  const Json slip = json("report.json").at("slip");
  ASSERT_TRUE(slip.at("seen").asBool());
  EXPECT_EQ(slip.at("false_alarms_before").asInteger(), 0);
  const Json alarm = slip.at("alarm");
  EXPECT_EQ(alarm.at("lamp").asString(), "slipping");
  const double beganMs = slip.at("truth").at("began_ms").asDouble();
  const double raisedMs = beganMs + alarm.at("after_s").asDouble() * 1e3;
  EXPECT_GT(raisedMs, beganMs - 100.0);
  EXPECT_LT(raisedMs, slip.at("truth").at("ended_ms").asDouble()) << "while it still moved";
  const double moved = slip.at("truth").at("moved_taxels").asDouble();
  EXPECT_NEAR(alarm.at("imprint_taxels").asDouble(), moved, 0.3 * moved);
  EXPECT_GT(alarm.at("moved_taxels").asDouble(), 0.0);
  EXPECT_LT(alarm.at("moved_taxels").asDouble(), 0.8 * moved);
  // The command says the same of that frame.
  const Profile profile = openRecording(tour() / "slip.palpate");
  const auto frame = static_cast<std::size_t>(alarm.at("frame").asInteger());
  EXPECT_NEAR(static_cast<double>(profile.frameTimeUs(frame)) * 1e-3, raisedMs, 2.0);
  const auto printed = palpate({"slip", tour() / "slip.palpate", "--reference", "rest", "--quiet"});
  ASSERT_EQ(printed.exitCode, 0) << printed.err;
  const std::string matrix = "," + std::to_string(alarm.at("matrix").asInteger()) + ",";
  const auto slips = [&](std::size_t at) {
    std::istringstream lines(printed.out);
    const std::string begin = std::to_string(at) + ",";
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with(begin) &&
          line.find(matrix, begin.size()) == line.find(',', begin.size()))
        return line.ends_with(",slip,1");
    return false;
  };
  EXPECT_TRUE(slips(frame));
  EXPECT_FALSE(slips(frame - 1));
}

TEST_F(DemoTourTest, WhatWasHeldIsNamed) {
  const std::vector<std::pair<std::string, std::string>> held = {{"grasp.palpate", "ball"},
                                                                 {"bottle.palpate", "bottle"},
                                                                 {"box.palpate", "box"},
                                                                 {"foam_ball.palpate", "foam ball"},
                                                                 {"pen.palpate", "pen"},
                                                                 {"handle.palpate", "handle"}};
  const Json recognition = json("report.json").at("recognition");
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
  EXPECT_NE(readFile(folder / "tour" / "report.json").find("failed"), std::string::npos);
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
