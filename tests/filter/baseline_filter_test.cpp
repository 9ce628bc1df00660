// The filter "baseline": its text, what it does to a pad that is never 0, and what it refuses.
#include <stdexcept>

#include "palpate/core/error.h"
#include "palpate/filter/filter_chain.h"
#include "palpate/filter/filtered_profile.h"
#include "palpate/model/profile_builder.h"

#include "testing/testing.h"

namespace palpate::baseline_filter_test {
namespace {

using Values = std::vector<float>;

Recipe recipeOf(const std::string& text) { return parseRecipe(std::vector<std::string>{text}); }

std::shared_ptr<const SensorLayout> pads() {
  return std::make_shared<const SensorLayout>(
      std::vector<MatrixLayout>{MatrixLayout::full(1, 2, 1.0), MatrixLayout::full(1, 1, 1.0)});
}

// Taxels that rest at 100 with noise of 3, at 7, and at 0; from 2 s on something presses by 40 on
// the first and by 1 on the second.
Profile noisy() {
  ProfileBuilder builder(pads());
  for (int i = 0; i < 40; ++i) {
    TactileFrame frame(pads());
    frame.hostUs = 5'000'000 + 100'000 * i;
    const float noise = i % 2 == 0 ? 3.0F : -3.0F;
    const bool pressed = i >= 20;
    frame.values = {100.0F + noise + (pressed ? 40.0F : 0.0F), pressed ? 8.0F : 7.0F, 0.0F};
    builder.addFrame(frame);
  }
  return builder.finish({});
}

TEST(BaselineFilter, RestNoiseIsNoContact) {
  // Sixteen frames of +-3: the deviation is 3 sqrt(16/15) = 3.0984.
  const Profile filtered = filteredProfile(noisy(), recipeOf("baseline:to=1.5,sigmas=4"));
  for (std::size_t i = 0; i < 20; ++i)
    EXPECT_EQ(filtered.frame(i).values, (Values{0.0F, 0.0F, 0.0F})) << i;
  EXPECT_EQ(filtered.frame(20).values, (Values{43.0F, 1.0F, 0.0F}));
  EXPECT_EQ(filtered.frame(21).values, (Values{37.0F, 1.0F, 0.0F}));
  const Profile above = filteredProfile(noisy(), recipeOf("baseline:to=1.5,above=40"));
  EXPECT_EQ(above.frame(20).values, (Values{43.0F, 0.0F, 0.0F}));
  EXPECT_EQ(above.frame(21).values, (Values{0.0F, 0.0F, 0.0F}));
  const Profile masked = filteredProfile(noisy(), recipeOf("baseline:to=1.5,masked=1"));
  EXPECT_EQ(masked.frame(20).values, (Values{143.0F, 8.0F, 0.0F})) << "as recorded";
  const Profile one = filteredProfile(noisy(), recipeOf("baseline:to=1.5,matrices=1"));
  EXPECT_EQ(one.frame(20).values, noisy().frame(20).values);
}

TEST(BaselineFilter, TheRestIsOfWhatComesIntoTheStep) {
  const Recipe made = withRest(recipeOf("threshold:above=50 | baseline:from=0.5,to=1.5"), noisy());
  ASSERT_TRUE(made.steps[1].rest);
  // Frames 5 to 15: five of +3, six of -3.
  EXPECT_FLOAT_EQ(made.steps[1].rest->rest[0], 100.0F - 3.0F / 11.0F);
  EXPECT_EQ(made.steps[1].rest->rest[1], 0.0F);
  EXPECT_TRUE(made.causal());
  EXPECT_FALSE(recipeOf("baseline").causal());
  EXPECT_EQ(withRest(made, noisy()), made) << "it is there";
  EXPECT_FALSE(withRest(recipeOf("(baseline)"), noisy()).steps[0].rest) << "it is off";
}

class Collector final : public FrameSink {
 public:
  void take(TactileFrame& frame) override { frames.push_back(frame); }
  std::vector<TactileFrame> frames;
};

TEST(BaselineFilter, IsTheSameLiveAndOnARecording) {
  const Recipe made = withRest(recipeOf("baseline:to=1.5"), noisy());
  const Profile filtered = filteredProfile(noisy(), recipeOf(recipeText(made)));
  Collector live;
  FilterChain chain(made, live);
  for (std::size_t i = 0; i < 40; ++i) {
    TactileFrame frame = noisy().frame(i);
    chain.push(frame);
    ASSERT_EQ(live.frames.size(), i + 1) << "at once";
    EXPECT_EQ(live.frames[i].values, filtered.frame(i).values) << i;
  }
}

TEST(BaselineFilter, ItsRestIsInTextAndFile) {
  FilterStep step{.name = "baseline", .explicitOptions = {{"sigmas", 3.0}}};
  step.rest = Baseline{{0.1F, -2.5F, 4'095.0F}, {0.3F, 0.0F, 1e-7F}};
  EXPECT_EQ(filterText(step), "baseline:sigmas=3,rest=0.1/-2.5/4095,noise=0.3/0/1e-07");
  EXPECT_EQ(parseFilterStep(filterText(step)), step);
  EXPECT_EQ(shownFilterText(step), "baseline:sigmas=3,rest=3 values");
  EXPECT_EQ(fullFilterText(step), "baseline:sigmas=3,above=0,masked=0,rest=3 values");
  Recipe recipe;
  recipe.steps = {step};
  EXPECT_EQ(shownRecipeText(recipe), shownFilterText(step));
  EXPECT_EQ(recipeFromJson(Json::parse(recipeJson(recipe).text())), recipe);
  step.rest->noise.clear();
  EXPECT_EQ(parseFilterStep(filterText(step)), step);
  EXPECT_FALSE(step.uses(*step.kind().option("from")));
  EXPECT_TRUE(step.uses(*step.kind().option("above")));
  step.rest.reset();
  EXPECT_TRUE(step.uses(*step.kind().option("from")));
}

TEST(BaselineFilter, RefusesBadInput) {
  for (const char* text : {"baseline:from=1,to=1",
                           "baseline:from=nan",
                           "baseline:to=-1",
                           "baseline:above=-1",
                           "baseline:sigmas=-1",
                           "threshold:above=-1",
                           "threshold:rest=1/2",
                           "baseline:noise=1/2",
                           "baseline:rest=1/2,noise=1",
                           "baseline:rest=1/2,noise=1/-1",
                           "baseline:rest=1/nan",
                           "baseline:rest=1/inf",
                           "baseline:rest=1//2",
                           "baseline:rest=1/2,to=3"})
    EXPECT_THROW(parseFilterStep(text), std::invalid_argument) << text;
  for (const char* text : {"baseline:to=4",            // the recording lasts 3.9 s
                           "baseline:from=2,to=2.05",  // one frame
                           "baseline:rest=1/2"}) {     // of another hand
    EXPECT_THROW(filteredProfile(noisy(), recipeOf(text)), std::invalid_argument) << text;
  }
  EXPECT_THROW(filteredProfile(ProfileBuilder(pads()).finish({}), recipeOf("baseline")),
               std::invalid_argument);
  EXPECT_THROW(makeFrameFilter(parseFilterStep("baseline"), pads()), std::invalid_argument)
      << "nothing was taken";
  EXPECT_THROW(recipeFromJson(Json::parse(R"({"format": "palpate-recipe", "version": 1,
                                     "steps": [{"filter": "baseline", "rest": [1, "x"]}]})")),
               Error);
}

}  // namespace
}  // namespace palpate::baseline_filter_test
