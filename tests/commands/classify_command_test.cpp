#include "palpate/core/json.h"

#include "commands/recognition_folder.h"

namespace palpate::classify_command_test {
namespace {

using testing::expectOneLineError;
using testing::palpate;
using testing::saveGrasps;
using testing::saveThings;

class ClassifyCommand : public testing::ModelFolder {
 protected:
  Json classify(std::vector<std::string> more, std::string* said = nullptr) const {
    more.insert(more.begin(), {"classify", model(), "--json"});
    const auto result = palpate(more);
    EXPECT_EQ(result.exitCode, 0) << result.err;
    if (said) *said = result.err;
    return Json::parse(result.out);
  }
};

TEST_F(ClassifyCommand, NamesWhatWasGrasped) {
  saveGrasps(folder_ / "t.dsa", 24.0, 3, 77);
  const Json json = classify({folder_ / "t.dsa"});
  ASSERT_EQ(json.at("grasps").size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const Json grasp = json.at("grasps").at(i);
    EXPECT_EQ(grasp.at("label").asString(), "golf ball");
    EXPECT_TRUE(grasp.at("sure").asBool()) << "in the session of the training";
    EXPECT_EQ(grasp.at("begin").asInteger(), 10 + 45 * static_cast<int>(i));
    EXPECT_EQ(grasp.at("end").asInteger(), 39 + 45 * static_cast<int>(i));
    ASSERT_GE(grasp.at("top").size(), 3u);
    EXPECT_EQ(grasp.at("top").at(0).at("label").asString(), "golf ball");
    EXPECT_GE(grasp.at("top").at(0).at("p").asDouble(), grasp.at("top").at(1).at("p").asDouble());
    EXPECT_EQ(grasp.at("confidence").asDouble(), grasp.at("top").at(0).at("p").asDouble());
  }
  EXPECT_EQ(json.at("session_offset").at("mm").asDouble(), 0.0);
  EXPECT_EQ(json.at("session_offset").at("sd_mm").asDouble(), 0.0);
  EXPECT_EQ(json.at("session_offset").at("origin").asString(), "none");
}

TEST_F(ClassifyCommand, OnAnotherDayItIsNotSureWithoutAnOffset) {
  saveGrasps(folder_ / "t.dsa", 24.0, 3, 77, kLaterUs);
  std::string said;
  const Json json = classify({folder_ / "t.dsa"}, &said);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_FALSE(json.at("grasps").at(i).at("sure").asBool());
  EXPECT_NE(said.find("no answer is sure"), std::string::npos);
  EXPECT_EQ(json.at("session_offset").at("origin").asString(), "unknown");
  EXPECT_EQ(json.at("grasps").at(0).at("membership").asString(), "not_known_yet");
  EXPECT_NE(said.find("can't be known yet"), std::string::npos) << said;
  EXPECT_NE(said.find("label grasps of two objects"), std::string::npos) << said;
  const auto text = palpate({"classify", model(), folder_ / "t.dsa"});
  EXPECT_NE(text.out.find(": not known yet; most similar: "), std::string::npos) << text.out;
  const Json given = classify({folder_ / "t.dsa", "--session-offset", "0"});
  EXPECT_EQ(given.at("grasps").at(0).at("membership").asString(), "known");
  EXPECT_TRUE(given.at("grasps").at(0).at("sure").asBool()) << "the person's word";
  EXPECT_EQ(given.at("session_offset").at("origin").asString(), "given");
}

TEST_F(ClassifyCommand, ABatchTellsItsOffset) {
  saveThings(folder_ / "later", 4, 60, -2.5, kLaterUs);
  const Json json = classify({folder_ / "later", "--session-offset", "batch"});
  EXPECT_NEAR(json.at("session_offset").at("mm").asDouble(), -2.5, 0.8);
  EXPECT_EQ(json.at("session_offset").at("origin").asString(), "batch");
  EXPECT_EQ(json.at("grasps").size(), 16u);
  // With one object it is applied, but warned of, and nothing is sure.
  std::string said;
  const Json one = classify({folder_ / "later/pen/a.dsa", "--session-offset", "batch"}, &said);
  EXPECT_NE(one.at("session_offset").at("mm").asDouble(), 0.0);
  EXPECT_NE(said.find("no answer is sure"), std::string::npos) << said;
  for (std::size_t i = 0; i < one.at("grasps").size(); ++i)
    EXPECT_FALSE(one.at("grasps").at(i).at("sure").asBool());
}

TEST_F(ClassifyCommand, WithoutJsonALineForAPerson) {
  saveGrasps(folder_ / "t.dsa", 8.0, 1, 77);
  const auto result = palpate({"classify", model(), folder_ / "t.dsa"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_NE(result.out.find("10-39: pen (sure)"), std::string::npos) << result.out;
}

TEST_F(ClassifyCommand, SaysWhatItCant) {
  saveRecording(testing::otherSensorProfile(60), {}, folder_ / "pad.dsa");
  const auto pad = palpate({"classify", model(), folder_ / "pad.dsa", "--json"});
  EXPECT_EQ(pad.exitCode, 1);
  EXPECT_NE(pad.err.find("pad.dsa"), std::string::npos) << pad.err;
  saveRecording(
      testing::pinchProfile(std::vector<testing::PinchStep>(60, {40.0})), {}, folder_ / "e.dsa");
  const auto empty = palpate({"classify", model(), folder_ / "e.dsa"});
  EXPECT_EQ(empty.exitCode, 1) << "no contact at all";
  EXPECT_NE(empty.err.find("e.dsa"), std::string::npos) << empty.err;
  saveGrasps(folder_ / "t.dsa", 8.0, 1, 77);
  testing::writeFile(folder_ / "bad.dsa", "no recording");
  EXPECT_EQ(palpate({"classify", model(), folder_ / "t.dsa", folder_ / "bad.dsa"}).exitCode, 3);
  std::string later = testing::readFile(model());
  const std::string version = "\"format_version\":2";
  ASSERT_NE(later.find(version), std::string::npos);
  later.replace(later.find(version), version.size(), "\"format_version\":9");
  testing::writeFile(folder_ / "later.json", later);
  expectOneLineError(
      palpate({"classify", folder_ / "later.json", folder_ / "t.dsa"}), 1, {"later.json", "9"});
  expectOneLineError(palpate({"classify", folder_ / "t.dsa", folder_ / "t.dsa"}), 1, {"t.dsa"});
  expectOneLineError(
      palpate({"classify", model(), folder_ / "t.dsa", "--session-offset", "far"}), 2, {"far"});
  expectOneLineError(palpate({"classify", model()}), 2, {});
}

}  // namespace
}  // namespace palpate::classify_command_test
