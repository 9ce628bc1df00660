#include <filesystem>

#include "palpate/core/json.h"
#include "palpate/recognition/trained_model.h"

#include "commands/recognition_folder.h"

namespace palpate {
namespace {

using testing::expectOneLineError;
using testing::kOneDayUs;
using testing::kPinchStartUs;
using testing::palpate;
using testing::saveGrasps;
using testing::saveThings;
using testing::TemporaryFolder;

constexpr std::int64_t kLaterUs = kPinchStartUs + 70 * kOneDayUs;

TEST(AdaptCommand, StoresTheOffsetOfTheSession) {
  const TemporaryFolder folder;
  saveThings(folder / "all", 10, 1);
  ASSERT_EQ(palpate({"train", folder / "all", "-o", folder / "m.json"}).exitCode, 0);
  saveThings(folder / "today", 1, 50, 2.5, kLaterUs);
  const auto result =
      palpate({"adapt", folder / "m.json", folder / "today", "-o", folder / "m2.json"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const Json json = Json::parse(result.out);
  EXPECT_NEAR(json.at("session_offset").at("mm").asDouble(), 2.5, 0.8);
  EXPECT_GT(json.at("session_offset").at("sd_mm").asDouble(), 0.0);
  EXPECT_EQ(json.at("session_offset").at("origin").asString(), "references");
  EXPECT_EQ(json.at("classes").size(), 4u);
  const TrainedModel adapted = loadModel(folder / "m2.json");
  EXPECT_EQ(adapted.adaptedFrom.size(), 4u);
  EXPECT_EQ(adapted.inputs.size(), 4u);
  EXPECT_EQ(loadModel(folder / "m.json").offset.mm, 0.0) << "the model itself stays";
  // Then classify uses it by itself.
  saveGrasps(folder / "t.dsa", 16.0 + 2.5, 3, 90, kLaterUs);
  const auto called = palpate({"classify", folder / "m2.json", folder / "t.dsa", "--json"});
  ASSERT_EQ(called.exitCode, 0) << called.err;
  const Json said = Json::parse(called.out);
  EXPECT_EQ(said.at("session_offset").at("mm").asDouble(),
            json.at("session_offset").at("mm").asDouble());
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(said.at("grasps").at(i).at("label").asString(), "small box");
}

TEST(AdaptCommand, OneObjectIsNotEnoughToBeSure) {
  const TemporaryFolder folder;
  saveThings(folder / "all", 10, 1);
  ASSERT_EQ(palpate({"train", folder / "all", "-o", folder / "m.json"}).exitCode, 0);
  saveGrasps(folder / "today/pen/a.dsa", 8.0 + 2.5, 3, 50, kLaterUs);
  const auto result =
      palpate({"adapt", folder / "m.json", folder / "today", "-o", folder / "m2.json"});
  ASSERT_EQ(result.exitCode, 0);
  EXPECT_NE(result.err.find("nothing will be sure"), std::string::npos) << result.err;
  EXPECT_FALSE(loadModel(folder / "m2.json").offset.trusted);
}

TEST(AdaptCommand, RefusesWhatItCant) {
  const TemporaryFolder folder;
  saveThings(folder / "all", 6, 1);
  ASSERT_EQ(palpate({"train", folder / "all", "-o", folder / "m.json"}).exitCode, 0);
  ASSERT_EQ(
      palpate({"train", folder / "all", "-o", folder / "svm.json", "--classifier", "svm"}).exitCode,
      0);
  const std::string out = folder / "m2.json";
  expectOneLineError(
      palpate({"adapt", folder / "svm.json", folder / "all", "-o", out}), 1, {"gauss"});
  saveGrasps(folder / "today/teapot/a.dsa", 20.0, 1, 50);
  expectOneLineError(
      palpate({"adapt", folder / "m.json", folder / "today", "-o", out}), 1, {"teapot"});
  expectOneLineError(palpate({"adapt", folder / "m.json", folder / "all"}), 2, {"-o"});
  expectOneLineError(
      palpate({"adapt", folder / "m.json", folder / "all", "-o", folder / "svm.json"}),
      1,
      {"svm.json"});
  testing::writeFile(folder / "cut.json", testing::readFile(folder / "m.json").substr(0, 900));
  expectOneLineError(
      palpate({"adapt", folder / "cut.json", folder / "all", "-o", out}), 1, {"cut.json"});
  EXPECT_FALSE(std::filesystem::exists(out));
}

}  // namespace
}  // namespace palpate
