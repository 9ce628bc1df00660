#include "palpate/filter/filter_step.h"

#include <cmath>
#include <stdexcept>

#include "testing/testing.h"

namespace palpate::filter_step_test {
namespace {

TEST(FilterStep, IsReadAndWrittenAsText) {
  const FilterStep step = parseFilterStep(" bilateral : sigma_space=1.5 , diameter=5,masked=1 ");
  EXPECT_EQ(step.name, "bilateral");
  EXPECT_EQ(step.integer("diameter"), 5);
  EXPECT_EQ(step.value("sigma_space"), 1.5);
  EXPECT_EQ(step.value("sigma_value"), 50);  // the default
  EXPECT_TRUE(step.flag("masked"));
  EXPECT_EQ(filterText(step), "bilateral:diameter=5,sigma_space=1.5,masked=1");
  EXPECT_EQ(parseFilterStep(filterText(step)), step);
}

TEST(FilterStep, TheShortestTextSaysNoDefaults) {
  EXPECT_EQ(filterText(parseFilterStep("median:size=3,masked=0")), "median");
  EXPECT_EQ(filterText(parseFilterStep("opening:shape=ellipse")), "opening:shape=ellipse");
  EXPECT_EQ(filterText(parseFilterStep("kalman:q=0.1")), "kalman:q=0.1");
  EXPECT_EQ(filterText(parseFilterStep("gaussian:sigma=auto")), "gaussian");
  EXPECT_EQ(filterText(parseFilterStep("median:matrices=5+1+5")), "median:matrices=1+5");
}

TEST(FilterStep, KnowsWhatIsCausal) {
  for (const char* text : {"median",
                           "kalman",
                           "running-mean",
                           "median3d",
                           "min-median",
                           "savitzky-golay",
                           "low-pass",
                           "band-stop:low=2,high=3,order=8",
                           "kelvin-voigt:m=1,e=2,eta=3,q=4,r=5"})
    EXPECT_TRUE(parseFilterStep(text).causal()) << text;
  for (const char* text : {"rts",
                           "kalman:centred=1",
                           "running-mean:centred=1",
                           "median3d:centred=1",
                           "high-pass:centred=1",
                           "kelvin-voigt",
                           "kelvin-voigt:m=1,e=2,eta=3"})
    EXPECT_FALSE(parseFilterStep(text).causal()) << text;
}

struct Bad {
  const char* text;
  const char* says;
};

class BadFilterText : public ::testing::TestWithParam<Bad> {};

TEST_P(BadFilterText, IsRefusedWithWhatWouldBeRight) {
  try {
    parseFilterStep(GetParam().text);
    FAIL() << GetParam().text << " was taken";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find(GetParam().says), std::string::npos)
        << GetParam().text << ": " << error.what();
  }
}

INSTANTIATE_TEST_SUITE_P(
    Texts,
    BadFilterText,
    ::testing::Values(
        Bad{"", "there are: box, gaussian"},
        Bad{"sharpen", "unknown filter \"sharpen\"; there are: box, gaussian"},
        Bad{"median3D", "unknown filter"},
        Bad{"lowpass:cutoff=5", "unknown filter \"lowpass\" (did you mean low-pass?); there are:"},
        Bad{"lopass", "unknown filter \"lopass\" (did you mean low-pass?); there are:"},
        Bad{"medain:size=3", "(did you mean median?)"},
        Bad{"notch", "unknown filter \"notch\" (did you mean band-stop?)"},
        Bad{"median:radius=1", "unknown key \"radius\"; there are: size, masked"},
        Bad{"median:size", "isn't KEY=VALUE"},
        Bad{"median:", "isn't KEY=VALUE"},
        Bad{"median:size=3,size=5", "given twice"},
        Bad{"median:size=4", "size must be an odd number 1..31 taxels, is \"4\""},
        Bad{"median:size=-3", "odd number"},
        Bad{"median:size=33", "odd number"},
        Bad{"median:size=3.5", "odd number"},
        Bad{"median:size=big", "odd number"},
        Bad{"median:size=nan", "odd number"},
        Bad{"median:masked=2", "0 or 1"},
        Bad{"gaussian:sigma=-1", "sigma must be a number 0.01..100 taxels"},
        Bad{"gaussian:sigma=0", "sigma must be a number"},
        Bad{"gaussian:sigma=inf", "sigma must be a number"},
        Bad{"bilateral:sigma_value=-5", "sigma_value must be"},
        Bad{"opening:shape=star", "one of cross, rectangle, ellipse"},
        Bad{"running-mean:window=4", "odd"},
        Bad{"running-mean:window=0", "odd"},
        Bad{"temporal-min:window=4,centred=1", "window must be odd with centred=1"},
        Bad{"savitzky-golay:window=6", "odd"},
        Bad{"savitzky-golay:window=5,order=5", "order must be below the window of 5"},
        Bad{"savitzky-golay:window=5,order=1,derivative=2", "derivative 2"},
        Bad{"savitzky-golay:derivative=3", "0..2"},
        Bad{"median3d:size=31,window=1001", "size * size * window must be at most 2001"},
        Bad{"low-pass:cutoff=0", "cutoff must be a number 0.001..10000 Hz"},
        Bad{"low-pass:order=9", "order must be a whole number 1..8"},
        Bad{"low-pass:order=0", "order must be a whole number 1..8"},
        Bad{"low-pass:low=1", "unknown key \"low\"; there are: cutoff, order, centred"},
        Bad{"band-pass:low=5,high=5", "low must be below high, but 5 Hz"},
        Bad{"band-stop:low=8", "low must be below high, but 8 Hz is not below 6 Hz"},
        Bad{"kalman:r=0", "r must be"},
        Bad{"kalman:q=-1", "q must be"},
        Bad{"median:matrices=", "joined by +"},
        Bad{"median:matrices=1-3", "joined by +"},
        Bad{"median:matrices=-1", "joined by +"}));

TEST(FilterStep, ValuesSetByHandAreCheckedToo) {
  FilterStep step{.name = "median", .explicitOptions = {{"size", 4.0}}};
  EXPECT_THROW(step.validate(), std::invalid_argument);
  step.explicitOptions = {{"width", 3.0}};
  EXPECT_THROW(step.validate(), std::invalid_argument);
  step.explicitOptions = {{"size", 5.0}};
  EXPECT_NO_THROW(step.validate());
  EXPECT_THROW(step.value("sigma"), std::invalid_argument);
  EXPECT_EQ(step.valueOrZero("sigma"), 0.0);
  step = {.name = "gaussian", .explicitOptions = {{"sigma", std::nan("")}}};  // automatic
  EXPECT_NO_THROW(step.validate());
}

}  // namespace
}  // namespace palpate::filter_step_test
