#include "palpate/control/grasp_request.h"

#include <limits>
#include <stdexcept>

#include "palpate/core/json.h"
#include "palpate/device/sdh2.h"
#include "palpate/model/preshape.h"

#include "testing/testing.h"

namespace palpate::grasp_request_test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

GraspRequest reactive() {
  GraspRequest request;
  request.mode = GraspMode::kReactive;
  request.closeRatio = 1.0;
  return request;
}

GraspReport reportOf(const GraspRequest& request) {
  GraspReport report;
  report.request = request;
  return report;
}

TEST(GraspRequest, RefusesWhatIsOutOfRangeOrNoNumber) {
  EXPECT_NO_THROW(GraspRequest{}.validate());
  EXPECT_NO_THROW(reactive().validate());
  for (const double value : {-0.01, 1.01, kNan, kInf, -kInf}) {
    GraspRequest request;
    request.closeRatio = value;
    EXPECT_THROW(request.validate(), std::invalid_argument) << value;
    request = {};
    request.startRatio = value;
    EXPECT_THROW(request.validate(), std::invalid_argument) << value;
  }
  for (const double value : {0.0, 0.19, 100.5, -10.0, kNan, kInf}) {
    GraspRequest request;
    request.velocityDegPerS = value;
    EXPECT_THROW(request.validate(), std::invalid_argument) << value;
  }
  for (const int value : {2, 0, -5, 3301, std::numeric_limits<int>::max()}) {
    GraspRequest request = reactive();
    request.limitCounts = value;
    EXPECT_THROW(request.validate(), std::invalid_argument) << value;
  }
  for (const double value : {-0.01, 1.01, kNan}) {
    GraspRequest request = reactive();
    request.touchRatio = value;
    EXPECT_THROW(request.validate(), std::invalid_argument) << value;
  }
  for (const std::string& name : {std::string("two\nlines"), std::string(101, 'x')}) {
    GraspRequest request = reactive();
    request.object = name;
    EXPECT_THROW(request.validate(), std::invalid_argument) << name;
  }
  GraspRequest unknown;
  unknown.preshape = "fist";
  EXPECT_THROW(unknown.validate(), std::invalid_argument);
}

TEST(GraspRequest, SaysWhatIsWrong) {
  GraspRequest request;
  request.velocityDegPerS = 250.0;
  try {
    request.validate();
    FAIL();
  } catch (const std::invalid_argument& error) {
    const std::string text = error.what();
    for (const char* word : {"velocity", "250", "0.2..100", "deg/s"})
      EXPECT_NE(text.find(word), std::string::npos) << text;
  }
}

// The study's table of preshapes, columns phi0 | f0 | f1 | f2, c = 0.5.
TEST(GraspRequest, NamesAllAxesOfTheHand) {
  struct Row {
    const char* preshape;
    std::vector<double> deg;
  };
  for (const Row& row : {Row{"parallel", {0, -34, 34, -34, 34, -34, 34}},
                         Row{"cylindrical", {0, -15, 47.5, -15, 47.5, -15, 47.5}},
                         Row{"centrical", {60, -34, 34, -34, 34, -34, 34}},
                         Row{"spherical", {60, -27.5, 47.5, -27.5, 47.5, -27.5, 47.5}},
                         Row{"pinch-parallel", {90, -30.5, 30.5, -90, 0, -30.5, 30.5}},
                         Row{"pinch-tilted", {90, -20, 16.5, -90, 0, -20, 16.5}},
                         Row{"calibration", {90, 0, 0, -90, -90, -90, -90}}}) {
    GraspRequest request;
    request.preshape = row.preshape;
    const MoveJoints move = motionTo(request, 0.5, sdh2());
    EXPECT_EQ(move.targetDeg, row.deg) << row.preshape;
    EXPECT_EQ(move.velocityDegPerS, std::vector<double>(7, 10.0));
  }
}

TEST(GraspRequest, EveryPreshapeStaysInRangeAtEveryRatio) {
  for (const Preshape& preshape : sdh2Preshapes())
    for (int percent = 0; percent <= 100; ++percent) {
      GraspRequest request;
      request.preshape = preshape.name;
      EXPECT_NO_THROW(motionTo(request, percent / 100.0, sdh2())) << preshape.name << percent;
    }
}

TEST(GraspRequest, ASlowAxisGoesAsFastAsItCan) {
  GraspRequest request;
  request.velocityDegPerS = 100.0;
  const MoveJoints move = motionTo(request, 1.0, sdh2());
  EXPECT_EQ(move.velocityDegPerS, (std::vector<double>{83, 100, 100, 100, 100, 100, 100}));
  EXPECT_FALSE(move.ramp);
  EXPECT_TRUE(motionTo(reactive(), 1.0, sdh2()).ramp);
}

TEST(GraspRequest, IsRefusedByAHandThatCannotReachIt) {
  HandDescription hand = sdh2();
  hand.axes[1].minimumDeg = -60.0;
  EXPECT_THROW(motionTo(GraspRequest{}, 0.0, hand), std::invalid_argument);
  EXPECT_NO_THROW(motionTo(GraspRequest{}, 0.5, hand));
  hand.axes.pop_back();
  EXPECT_THROW(motionTo(GraspRequest{}, 0.5, hand), std::invalid_argument);
}

TEST(GraspReport, IsAnEventWithParametersAndOutcome) {
  GraspReport report;
  report.request = reactive();
  report.request.startRatio = 0.25;
  report.beginUs = 5'000'000;
  report.endUs = 7'000'000;
  const Event begin = beginEvent(report);
  EXPECT_EQ(begin.kind, "grasp");
  EXPECT_EQ(begin.tUs, 5'000'000);
  EXPECT_EQ(begin.t1Us, 5'000'000);
  EXPECT_EQ(begin.text, "reactive grasp: centrical, from 0.25 to 1, 10 deg/s, limit 200 counts");
  const Json parameters = Json::parse(begin.json);
  EXPECT_EQ(parameters.at("mode").asString(), "reactive");
  EXPECT_EQ(parameters.at("start").asDouble(), 0.25);
  EXPECT_EQ(parameters.at("limit_counts").asInteger(), 200);
  EXPECT_FALSE(parameters.contains("outcome"));

  report.outcome = GraspOutcome::kLimitReached;
  report.text = "limit reached";
  report.peak = {3, 4, 5, 231.0F};
  const Event end = endEvent(report);
  EXPECT_EQ(end.tUs, 5'000'000);
  EXPECT_EQ(end.t1Us, 7'000'000);
  EXPECT_EQ(end.matrix, 3);
  const Json outcome = Json::parse(end.json);
  EXPECT_EQ(outcome.at("outcome").asString(), "limit_reached");
  EXPECT_EQ(outcome.at("x").asInteger(), 5);
  EXPECT_EQ(outcome.at("y").asInteger(), 4);
  EXPECT_EQ(outcome.at("counts").asDouble(), 231.0);
  EXPECT_EQ(outcome.at("preshape").asString(), "centrical");

  GraspReport plain;
  plain.outcome = GraspOutcome::kFinished;
  plain.heldAxes = {1, 5};
  const Json held = Json::parse(endEvent(plain).json);
  EXPECT_EQ(held.at("held_axes").at(1).asInteger(), 5);
  EXPECT_FALSE(held.contains("limit_counts"));
  EXPECT_FALSE(endEvent(plain).matrix.has_value());
}

// The same check gives the text of the refusal and marks matrices before the request.
TEST(GraspRequest, ItsHighestLimitIsJudgedOnTheFingersThatItMoves) {
  std::vector<MatrixSettings> settings = {
      {0.5, 150}, {0.5, 300}, {0.5, 150}, {0.5, 300}, {0.5, 150}, {0.5, 300}};
  settings[0].thresholdCounts = 2000;  // leaves 2095: enough for 200, not for 2200 and its margin
  settings[3].thresholdCounts = 4095;  // leaves nothing; finger 1
  const auto matrices = [&](GraspMode mode, const std::string& preshape) {
    GraspRequest request;
    request.mode = mode;
    request.preshape = preshape;
    std::vector<std::size_t> found;
    for (const UnmeasurableLimit& each : unmeasurableLimits(sdh2(), settings, request))
      found.push_back(each.matrix);
    return found;
  };
  using Matrices = std::vector<std::size_t>;
  EXPECT_EQ(matrices(GraspMode::kPlain, "centrical"), Matrices{});
  EXPECT_EQ(matrices(GraspMode::kReactive, "centrical"), Matrices{3});
  EXPECT_EQ(matrices(GraspMode::kReactive, "pinch-parallel"), Matrices{}) << "finger 1 is folded";
  EXPECT_EQ(matrices(GraspMode::kSlip, "pinch-parallel"), Matrices{0});
  EXPECT_EQ(matrices(GraspMode::kSlip, "centrical"), (Matrices{0, 3}));
}

TEST(GraspRequest, LimitsOfFingersAreOnePerFingerAndNotAboveTheCommonOne) {
  GraspRequest request = reactive();
  request.limitCounts = 500;
  for (const std::vector<int>& good : {std::vector<int>{}, {500, 3, 200}}) {
    request.fingerLimitCounts = good;
    EXPECT_NO_THROW(request.validate());
  }
  for (const std::vector<int>& bad :
       {std::vector<int>{200}, {200, 200}, {200, 200, 200, 200}, {501, 200, 200}, {2, 200, 200}}) {
    request.fingerLimitCounts = bad;
    EXPECT_THROW(request.validate(), std::invalid_argument) << bad.size() << ' ' << bad[0];
  }
  request.fingerLimitCounts = {500, 300, 200};
  EXPECT_EQ(limitOf(request, 1), 300);
  EXPECT_EQ(limitOf(request, -1), 200) << "of no finger: the lowest";
  EXPECT_EQ(describe(request),
            "reactive grasp: centrical, to 1, 10 deg/s, limit 500, 300, 200 counts");
}

TEST(GraspRequest, ForceLimitsAreOneForAllOrOnePerFinger) {
  GraspRequest request = reactive();
  request.forceLimitsN = {2.5};
  EXPECT_NO_THROW(request.validate());
  EXPECT_EQ(forceLimitOf(request, 2), 2.5);
  EXPECT_EQ(describe(request),
            "reactive grasp: centrical, to 1, 10 deg/s, limit 200 counts, 2.5 N");
  request.forceLimitsN = {1.0, 2.0, 3.0};
  EXPECT_NO_THROW(request.validate());
  EXPECT_EQ(forceLimitOf(request, 2), 3.0);
  const Json event = Json::parse(beginEvent(reportOf(request)).json);
  EXPECT_EQ(event.at("force_limit_n").at(1).asDouble(), 2.0);
  for (const std::vector<double>& bad :
       {std::vector<double>{1.0, 2.0}, {0.0}, {-1.0}, {501.0}, {kNan}, {kInf}, {1.0, kNan, 1.0}}) {
    request.forceLimitsN = bad;
    EXPECT_THROW(request.validate(), std::invalid_argument) << bad[0];
  }
}

TEST(GraspRequest, AMotionToJointAnglesNamesEveryAxisAndRespectsItsRange) {
  GraspRequest request;
  request.targetDeg.assign(7, std::nullopt);
  request.targetDeg[2] = 30.0;
  request.title = "axis 2";
  const std::vector<double> present{60, -75, 75, -75, 75, -75, 75};
  const MoveJoints move = motionTo(request, 0.0, sdh2(), present);
  EXPECT_EQ(move.targetDeg, (std::vector<double>{60, -75, 30, -75, 75, -75, 75}));
  EXPECT_EQ(move.velocityDegPerS, std::vector<double>(7, 10.0));
  EXPECT_EQ(describe(request), "motion: axis 2, 10 deg/s");
  EXPECT_FALSE(isOpening(request));
  EXPECT_TRUE(Json::parse(beginEvent(reportOf(request)).json).at("target_deg").at(0).isNull());
  // Beyond the range of the axis (-90..90 deg), no number, and with unknown present angles.
  for (const double value : {90.1, -90.1, kNan, kInf}) {
    request.targetDeg[2] = value;
    EXPECT_THROW(motionTo(request, 0.0, sdh2(), present), std::invalid_argument) << value;
  }
  request.targetDeg[2] = 30.0;
  EXPECT_THROW(motionTo(request, 0.0, sdh2()), std::invalid_argument);
  EXPECT_THROW(motionTo(request, 0.0, sdh2(), {1, 2, 3}), std::invalid_argument);
  std::vector<double> beyond = present;
  beyond[1] = -90.03;  // a real joint is a little beyond its range
  EXPECT_EQ(motionTo(request, 0.0, sdh2(), beyond).targetDeg[1], -90.0);
  beyond[1] = -95.0;
  EXPECT_THROW(motionTo(request, 0.0, sdh2(), beyond), std::invalid_argument);
  request.targetDeg.pop_back();
  EXPECT_THROW(motionTo(request, 0.0, sdh2(), present), std::invalid_argument);
  request.targetDeg.assign(7, 0.0);
  request.mode = GraspMode::kSlip;
  EXPECT_THROW(request.validate(), std::invalid_argument);
  request.mode = GraspMode::kReactive;
  request.startRatio = 0.0;
  EXPECT_THROW(request.validate(), std::invalid_argument);
}

TEST(GraspRequest, LimitsOfFingersAreJudgedOneByOne) {
  std::vector<MatrixSettings> settings(6, {0.5, 150});
  settings[3].thresholdCounts = 3000;  // finger 1 reads no more than 1095
  GraspRequest request = reactive();
  request.limitCounts = 1500;
  EXPECT_EQ(unmeasurableLimits(sdh2(), settings, request).size(), 1u);
  request.fingerLimitCounts = {1500, 500, 1500};
  EXPECT_TRUE(unmeasurableLimits(sdh2(), settings, request).empty());
  EXPECT_LE(highestMeasurableLimit(sdh2(), settings, request), 1095 - 200);
  EXPECT_GT(highestMeasurableLimit(sdh2(), settings, request), 1095 - 200 - 50);
  settings[3].thresholdCounts = 4095;
  EXPECT_EQ(highestMeasurableLimit(sdh2(), settings, request), 0);
}

}  // namespace
}  // namespace palpate::grasp_request_test
