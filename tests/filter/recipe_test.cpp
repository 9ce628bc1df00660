#include "palpate/filter/recipe.h"

#include "palpate/core/error.h"
#include "palpate/filter/filter_chain.h"

#include "testing/testing.h"

namespace palpate::recipe_test {
namespace {

Recipe recipeOf(const std::vector<std::string>& texts) { return parseRecipe(texts); }

std::string messageOf(const std::string& json) {
  try {
    recipeFromJson(Json::parse(json));
  } catch (const Error& error) {
    return error.what();
  }
  return "taken";
}

TEST(Recipe, IsReadAndWrittenAsText) {
  const Recipe recipe = recipeOf({"median:size=5 | (kalman:q=0.1)", "box"});
  ASSERT_EQ(recipe.steps.size(), 3u);
  EXPECT_TRUE(recipe.steps[0].enabled);
  EXPECT_FALSE(recipe.steps[1].enabled);
  EXPECT_EQ(recipeText(recipe), "median:size=5 | (kalman:q=0.1) | box");
  EXPECT_EQ(recipeOf({recipeText(recipe)}), recipe);
  EXPECT_TRUE(Recipe{}.empty());
  EXPECT_TRUE(recipeOf({"(median)"}).empty());
  EXPECT_FALSE(recipe.empty());
}

TEST(Recipe, GoesThroughJsonAndBack) {
  Recipe recipe = recipeOf({"gaussian:size=5,sigma=1.25",
                            "opening:shape=ellipse,masked=1",
                            "median:matrices=1+5",
                            "kelvin-voigt:m=2",
                            "(rts:q=1e-3)"});
  recipe.name = "mine \"and\" yours";
  const std::string text = recipeJson(recipe).text();
  EXPECT_EQ(recipeFromJson(Json::parse(text)), recipe);
  // In words of the field, for people and other programs.
  const Json step = recipeJson(recipe).at("steps").at(1);
  EXPECT_EQ(step.at("filter").asString(), "opening");
  EXPECT_EQ(step.at("shape").asString(), "ellipse");
  EXPECT_EQ(step.at("size").asInteger(), 3);
  EXPECT_TRUE(step.at("masked").asBool());
  EXPECT_EQ(recipeJson(recipe).at("format").asString(), "palpate-recipe");
}

TEST(Recipe, TakesStepsAsTextsToo) {
  const Recipe recipe = recipeFromJson(Json::parse(
      R"({"format": "palpate-recipe", "version": 1, "steps": ["median:size=5", {"filter": "kalman"}]})"));
  EXPECT_EQ(recipeText(recipe), "median:size=5 | kalman");
}

TEST(Recipe, BadJsonSaysWhichStepAndWhat) {
  const std::string head = R"({"format": "palpate-recipe", "version": 1, "steps": )";
  EXPECT_NE(messageOf(head + R"([{"filter": "median"}, {"filter": "median", "sise": 3}]})")
                .find("step 2: median: unknown key \"sise\"; there are: size"),
            std::string::npos);
  EXPECT_NE(
      messageOf(head + R"([{"filter": "blur"}]})").find("unknown filter \"blur\"; there are:"),
      std::string::npos);
  EXPECT_NE(messageOf(head + R"([{"size": 3}]})").find("must have \"filter\""), std::string::npos);
  EXPECT_NE(messageOf(head + R"([{"filter": "median", "size": 4}]})").find("odd"),
            std::string::npos);
  EXPECT_NE(messageOf(head + R"([{"filter": "median", "size": [3, 5]}]})").find("step 1"),
            std::string::npos);
  EXPECT_NE(messageOf(head + R"([{"filter": "median", "size=3,masked": 1}]})").find("step 1"),
            std::string::npos);
  EXPECT_NE(messageOf(head + R"([{"filter": "median", "matrices": 3}]})").find("list"),
            std::string::npos);
  EXPECT_NE(messageOf(head + R"([{"filter": 7}]})").find("step 1"), std::string::npos);
  EXPECT_NE(messageOf(head + R"("median"})").find("steps"), std::string::npos);
  EXPECT_NE(messageOf(R"({"steps": []})").find("format"), std::string::npos);
  EXPECT_NE(messageOf(R"([])").find("format"), std::string::npos);
  EXPECT_NE(messageOf(R"({"format": "palpate-recipe", "version": 2, "steps": []})").find("version"),
            std::string::npos);
  std::string many = head + "[";
  for (int i = 0; i < 65; ++i) many += i > 0 ? ",\"box\"" : "\"box\"";
  EXPECT_NE(messageOf(many + "]}").find("at most 64"), std::string::npos);
}

TEST(Recipe, IsAFile) {
  const testing::TemporaryFolder folder;
  const Recipe recipe = recipeOf({"median", "kalman"});
  writeRecipe(folder / "r.json", recipe, false);
  EXPECT_EQ(readRecipe(folder / "r.json"), recipe);
  EXPECT_THROW(writeRecipe(folder / "r.json", recipe, false), FileError);
  EXPECT_NO_THROW(writeRecipe(folder / "r.json", recipe, true));
  EXPECT_THROW(readRecipe(folder / "none.json"), FileError);
  EXPECT_THROW(readRecipe(folder.path()), FileError);
  testing::writeFile(folder / "bad.json", "{\"format\": ");
  EXPECT_THROW(readRecipe(folder / "bad.json"), FormatError);
  testing::writeFile(folder / "large.json", std::string(2 << 20, ' '));
  EXPECT_THROW(readRecipe(folder / "large.json"), FormatError);
}

TEST(Recipe, PresetsAreSoundAndTheFirstRunsLive) {
  for (const Recipe& preset : recipePresets()) {
    EXPECT_NO_THROW(preset.validate()) << preset.name;
    EXPECT_FALSE(preset.name.empty());
    EXPECT_FALSE(preset.empty()) << preset.name;
  }
  // What docs/notes/ghosting.md says of it: live, a frame late.
  EXPECT_TRUE(highSensitivityRecipe().causal());
  EXPECT_EQ(latencyFrames(highSensitivityRecipe()), 1);
}

}  // namespace
}  // namespace palpate::recipe_test
