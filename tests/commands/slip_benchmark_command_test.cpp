#include "palpate/core/json.h"

#include "commands/palpate_program.h"

namespace palpate::slip_benchmark_command_test {
namespace {

using testing::palpate;

TEST(SlipBenchmarkCommand, PrintsEveryMethodBesideTheBound) {
  const auto result = palpate({"slip-benchmark", "--noise", "20", "--quiet"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const Json methods = Json::parse(result.out).at("methods");
  for (const char* name : {"centroid",
                           "alcazar",
                           "ncc-paraboloid",
                           "ncc-gauss3",
                           "phase",
                           "phase-normalized",
                           "register",
                           "contest"}) {
    ASSERT_TRUE(methods.contains(name)) << name;
    for (const char* key : {"rmse",
                            "bias",
                            "gain_x",
                            "gain_y",
                            "drift_100",
                            "rmse_deg",
                            "crb",
                            "crb_deg",
                            "ns_per_step"})
      EXPECT_TRUE(methods.at(name).at(key).isNumber()) << name << " " << key;
    EXPECT_EQ(methods.at(name).at("shapes").size(), 6U);
    EXPECT_GT(methods.at(name).at("ns_per_step").asDouble(), 0.0);
  }
  const Json best = methods.at("register");
  EXPECT_LT(best.at("rmse").asDouble(), 1.2 * best.at("crb").asDouble());
}

TEST(SlipBenchmarkCommand, TakesShapesAndASeed) {
  const auto one =
      palpate({"slip-benchmark", "--shape", "bar", "--shape", "disc", "--trials", "1"});
  ASSERT_EQ(one.exitCode, 0) << one.err;
  const Json shapes = Json::parse(one.out).at("methods").at("centroid").at("shapes");
  EXPECT_EQ(shapes.keys(), (std::vector<std::string>{"bar", "disc"}));
  // A disc has no angle that could be bounded.
  EXPECT_EQ(shapes.at("disc").at("crb_deg").asDouble(), 0.0);
  EXPECT_GT(shapes.at("bar").at("crb_deg").asDouble(), 0.0);
  const auto other = palpate(
      {"slip-benchmark", "--shape", "bar", "--shape", "disc", "--trials", "1", "--seed", "2"});
  EXPECT_NE(Json::parse(other.out).at("methods").at("centroid").at("rmse").asDouble(),
            Json::parse(one.out).at("methods").at("centroid").at("rmse").asDouble());
}

TEST(SlipBenchmarkCommand, TakesTheWidthOfTheEdges) {
  const auto result =
      palpate({"slip-benchmark", "--shape", "disc", "--trials", "1", "--edge", "0.6", "--quiet"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const Json json = Json::parse(result.out);
  EXPECT_EQ(json.at("edge_taxels").asDouble(), 0.6);
  const Json method = json.at("methods").at("register");
  EXPECT_EQ(method.at("drift_10_to_100").size(), 10U);
  EXPECT_GT(method.at("tilt_worst_x").asDouble(), 0.0);
  EXPECT_GT(method.at("normalised_later").asDouble(), 0.5);
  // A soft edge determines the motion less than a sharp one.
  const auto sharp = palpate({"slip-benchmark", "--shape", "disc", "--trials", "1", "--quiet"});
  EXPECT_GT(method.at("crb").asDouble(),
            Json::parse(sharp.out).at("methods").at("register").at("crb").asDouble());
}

TEST(SlipBenchmarkCommand, RefusesWhatItDoesNotKnow) {
  const auto shape = palpate({"slip-benchmark", "--shape", "square"});
  EXPECT_EQ(shape.exitCode, 2);
  EXPECT_NE(shape.err.find("two-blobs"), std::string::npos);
  EXPECT_EQ(palpate({"slip-benchmark", "--noise", "-1"}).exitCode, 2);
  EXPECT_EQ(palpate({"slip-benchmark", "--edge", "0"}).exitCode, 2);
  EXPECT_EQ(palpate({"slip-benchmark", "file.dsa"}).exitCode, 2);
}

}  // namespace
}  // namespace palpate::slip_benchmark_command_test
