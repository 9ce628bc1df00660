#include "palpate/core/json.h"

#include "commands/palpate_program.h"

namespace palpate::step_benchmark_command_test {
namespace {

using testing::palpate;

TEST(StepBenchmarkCommand, PrintsTheCoverageOfEveryKindOfStep) {
  const auto result = palpate({"step-benchmark", "--trials", "3", "--quiet"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const Json json = Json::parse(result.out);
  EXPECT_EQ(json.at("usable_and_not_identifiable").asDouble(), 0.0);
  ASSERT_GE(json.at("steps").size(), 100u);
  for (std::size_t i = 0; i < json.at("steps").size(); ++i) {
    const Json step = json.at("steps").at(i);
    EXPECT_EQ(step.at("trials").asDouble(), 3.0);
    for (const char* key : {"noise", "length_s", "drift_per_s", "usable", "not_identifiable"})
      EXPECT_TRUE(step.at(key).isNumber()) << key;
    const Json gain = step.at("stated").at("K");
    EXPECT_LE(gain.at("inside").asDouble(), gain.at("stated").asDouble());
    EXPECT_EQ(gain.at("low").isNumber(), gain.at("stated").asDouble() > 0.0);
  }
}

TEST(StepBenchmarkCommand, RefusesWhatMakesNoSense) {
  EXPECT_EQ(palpate({"step-benchmark", "--trials", "0"}).exitCode, 2);
  EXPECT_EQ(palpate({"step-benchmark", "--seed", "-1"}).exitCode, 2);
  EXPECT_EQ(palpate({"step-benchmark", "file.dsa"}).exitCode, 2);
}

}  // namespace
}  // namespace palpate::step_benchmark_command_test
