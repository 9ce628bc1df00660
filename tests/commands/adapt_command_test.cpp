#include <filesystem>

#include "palpate/core/json.h"
#include "palpate/recognition/trained_model.h"

#include "commands/recognition_folder.h"

namespace palpate::adapt_command_test {
namespace {

using testing::expectOneLineError;
using testing::kOneDayUs;
using testing::palpate;
using testing::saveGrasps;
using testing::saveThings;
using testing::saveTouches;

class AdaptCommand : public testing::ModelFolder {
 protected:
  std::string adapted() const { return folder_ / "m2.json"; }
};

TEST_F(AdaptCommand, StoresTheOffsetOfTheSession) {
  saveThings(folder_ / "today", 1, 50, 2.5, kLaterUs);
  const auto result = palpate({"adapt", model(), folder_ / "today", "-o", adapted()});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const Json json = Json::parse(result.out);
  EXPECT_NEAR(json.at("session_offset").at("mm").asDouble(), 2.5, 0.8);
  EXPECT_GT(json.at("session_offset").at("sd_mm").asDouble(), 0.0);
  EXPECT_EQ(json.at("session_offset").at("origin").asString(), "references");
  EXPECT_EQ(json.at("classes").size(), 4u);
  const TrainedModel stored = loadModel(adapted());
  EXPECT_EQ(stored.adaptedFrom.size(), 4u);
  EXPECT_EQ(stored.inputs.size(), 4u);
  EXPECT_EQ(loadModel(model()).offset.mm, 0.0) << "the model itself stays";
  // Then classify uses it by itself.
  saveGrasps(folder_ / "t.dsa", 16.0 + 2.5, 3, 90, kLaterUs);
  const auto called = palpate({"classify", adapted(), folder_ / "t.dsa", "--json"});
  ASSERT_EQ(called.exitCode, 0) << called.err;
  const Json said = Json::parse(called.out);
  EXPECT_EQ(said.at("session_offset").at("mm").asDouble(),
            json.at("session_offset").at("mm").asDouble());
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(said.at("grasps").at(i).at("label").asString(), "small box");
}

TEST_F(AdaptCommand, OfTwoDaysTheNewestCountsAndTheOtherIsSaid) {
  // 28 hours apart, read 1 mm small, then 4 mm small.
  saveThings(folder_ / "later", 1, 50, -1.0, kLaterUs);
  for (const char* thing : {"pen", "bottle"})
    saveGrasps(folder_ / "later" / thing / "b.dsa",
               (thing == std::string("pen") ? 8.0 : 32.0) - 4.0,
               2,
               70,
               kLaterUs + 28 * (kOneDayUs / 24));
  const auto both = palpate({"adapt", model(), folder_ / "later", "-o", adapted()});
  EXPECT_EQ(both.exitCode, 3) << both.err;
  EXPECT_NE(both.err.find("4 grasps are of an earlier session, more than 8 h before"),
            std::string::npos)
      << both.err;
  const Json json = Json::parse(both.out);
  EXPECT_NEAR(json.at("session_offset").at("mm").asDouble(), -4.0, 0.8);
  EXPECT_EQ(json.at("session_offset").at("grasps").asInteger(), 4);
  EXPECT_EQ(json.at("classes").size(), 2u);
}

TEST_F(AdaptCommand, OneObjectIsNotEnoughToBeSure) {
  saveGrasps(folder_ / "today/pen/a.dsa", 8.0 + 2.5, 3, 50, kLaterUs);
  const auto result = palpate({"adapt", model(), folder_ / "today", "-o", adapted()});
  ASSERT_EQ(result.exitCode, 0);
  EXPECT_NE(result.err.find("no answer will be sure"), std::string::npos) << result.err;
  EXPECT_FALSE(loadModel(adapted()).offset.trusted);
}

TEST_F(AdaptCommand, RefusesWhatItCant) {
  ASSERT_EQ(palpate({"train", folder_ / "all", "-o", folder_ / "svm.json", "--classifier", "svm"})
                .exitCode,
            0);
  const std::string out = adapted();
  expectOneLineError(
      palpate({"adapt", folder_ / "svm.json", folder_ / "all", "-o", out}), 1, {"gauss"});
  saveGrasps(folder_ / "today/teapot/a.dsa", 20.0, 1, 50);
  expectOneLineError(palpate({"adapt", model(), folder_ / "today", "-o", out}), 1, {"teapot"});
  expectOneLineError(palpate({"adapt", model(), folder_ / "all"}), 2, {"-o"});
  expectOneLineError(
      palpate({"adapt", model(), folder_ / "all", "-o", folder_ / "svm.json"}), 1, {"svm.json"});
  testing::writeFile(folder_ / "cut.json", testing::readFile(model()).substr(0, 900));
  expectOneLineError(
      palpate({"adapt", folder_ / "cut.json", folder_ / "all", "-o", out}), 1, {"cut.json"});
  EXPECT_FALSE(std::filesystem::exists(out));
}

// The joints say 4 mm more between pads that touch than they did on the day of training.
TEST_F(AdaptCommand, TheTouchOfTheEmptyHandIsEnough) {
  saveTouches(folder_ / "zero.dsa", -1.0 + 4.0, 2, kLaterUs);
  const auto result =
      palpate({"adapt", model(), "--empty-hand-zero", folder_ / "zero.dsa", "-o", adapted()});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_NE(result.err.find("2 touches, zero.dsa"), std::string::npos) << result.err;
  const Json offset = Json::parse(result.out).at("session_offset");
  EXPECT_NEAR(offset.at("mm").asDouble(), 4.0, 0.3);
  EXPECT_EQ(offset.at("origin").asString(), "empty_hand");
  EXPECT_TRUE(offset.at("trusted").asBool());
  EXPECT_EQ(offset.at("empty_hand").at("origin").asString(), "zero.dsa");
  EXPECT_EQ(offset.at("empty_hand").at("sha256").asString().size(), 64u);
  // Then classify uses it by itself; a single thing, and sure of it.
  saveGrasps(folder_ / "t.dsa", 16.0 + 4.0, 3, 90, kLaterUs);
  const auto called = palpate({"classify", adapted(), folder_ / "t.dsa", "--json"});
  ASSERT_EQ(called.exitCode, 0) << called.err;
  const Json said = Json::parse(called.out);
  EXPECT_EQ(said.at("session_offset").at("origin").asString(), "empty_hand");
  EXPECT_EQ(said.at("session_offset").at("empty_hand").at("touches").asDouble(), 2.0);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(said.at("grasps").at(i).at("label").asString(), "small box");
    EXPECT_TRUE(said.at("grasps").at(i).at("sure").asBool());
  }
  const auto text = palpate({"classify", adapted(), folder_ / "t.dsa"});
  EXPECT_NE(text.out.find(" mm, from the empty hand); zero of the empty hand: "), std::string::npos)
      << text.out;
  // Of yesterday it is trusted no more.
  saveGrasps(folder_ / "next.dsa", 16.0 + 4.0, 1, 91, kLaterUs + kOneDayUs);
  const auto next = palpate({"classify", adapted(), folder_ / "next.dsa", "--json"});
  EXPECT_FALSE(Json::parse(next.out).at("grasps").at(0).at("sure").asBool());
  EXPECT_NE(next.err.find("no answer is sure"), std::string::npos) << next.err;
}

TEST_F(AdaptCommand, LabelledGraspsNarrowTheZeroOfTheDay) {
  saveTouches(folder_ / "zero.dsa", -1.0 + 4.0, 2, kLaterUs);
  saveThings(folder_ / "today", 1, 50, 4.0, kLaterUs);
  const auto sdOf = [&](const std::vector<std::string>& words) {
    const auto result = palpate(words);
    EXPECT_EQ(result.exitCode, 0) << result.err;
    return Json::parse(result.out).at("session_offset").at("sd_mm").asDouble();
  };
  const std::string zero = folder_ / "zero.dsa", today = folder_ / "today";
  const double alone = sdOf({"adapt", model(), "--empty-hand-zero", zero, "-o", adapted()});
  EXPECT_LT(sdOf({"adapt", adapted(), today, "-o", folder_ / "m3.json"}), alone)
      << "one call after the other";
  EXPECT_LT(sdOf({"adapt", model(), today, "--empty-hand-zero", zero, "-o", folder_ / "m4.json"}),
            alone);
  EXPECT_EQ(loadModel(folder_ / "m3.json").adaptedFrom.size(), 4u);
  // The next day it is forgotten.
  saveThings(folder_ / "next", 1, 60, -3.0, kLaterUs + 2 * kOneDayUs);
  sdOf({"adapt", folder_ / "m4.json", folder_ / "next", "-o", folder_ / "m5.json"});
  const TrainedModel next = loadModel(folder_ / "m5.json");
  EXPECT_NEAR(next.offset.mm, -3.0, 0.8);
  EXPECT_FALSE(next.sessionZero);
  EXPECT_EQ(next.adaptedFrom.size(), 4u);
}

TEST_F(AdaptCommand, AZeroThatIsNoneIsRefused) {
  const std::string zero = folder_ / "zero.dsa";
  expectOneLineError(palpate({"adapt", model(), "-o", adapted()}), 2, {"--empty-hand-zero"});
  saveGrasps(zero, 30.0, 1, 7, kLaterUs);
  expectOneLineError(palpate({"adapt", model(), "--empty-hand-zero", zero, "-o", adapted()}),
                     1,
                     {"zero.dsa", "mm apart while they touch"});
  saveTouches(folder_ / "other_day.dsa", 3.0, 1, kLaterUs + 3 * kOneDayUs);
  saveThings(folder_ / "today", 1, 50, 4.0, kLaterUs);
  const auto otherDay = palpate({"adapt",
                                 model(),
                                 folder_ / "today",
                                 "-q",
                                 "--empty-hand-zero",
                                 folder_ / "other_day.dsa",
                                 "-o",
                                 adapted()});
  expectOneLineError(otherDay, 1, {"other_day.dsa", "another session"});
  // A model that was trained without such a touch, and a classifier that knows no offset.
  ASSERT_EQ(palpate({"train", folder_ / "all", "-o", folder_ / "bare.json"}).exitCode, 0);
  expectOneLineError(palpate({"adapt",
                              "-q",
                              folder_ / "bare.json",
                              "--empty-hand-zero",
                              folder_ / "touch.dsa",
                              "-o",
                              adapted()}),
                     1,
                     {"no zero of the empty hand", "--empty-hand-zero"});
  EXPECT_FALSE(std::filesystem::exists(adapted()));
  expectOneLineError(palpate({"train",
                              "-q",
                              folder_ / "all",
                              "-o",
                              folder_ / "late.json",
                              "--empty-hand-zero",
                              folder_ / "other_day.dsa"}),
                     1,
                     {"another session"});
}

}  // namespace
}  // namespace palpate::adapt_command_test
