#include "palpate/recognition/session_adaptive_classifier.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

#include "palpate/core/error.h"
#include "palpate/recognition/plateau_features.h"

namespace palpate::session_adaptive_classifier_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Two classes of four samples each in a plane, with means (0, 0) and (10, 0) and covariance
// diag(4/3, 4/3).
struct Square {
  MatrixXd x{{1, 1}, {1, -1}, {-1, 1}, {-1, -1}, {11, 1}, {11, -1}, {9, 1}, {9, -1}};
  std::vector<int> y{0, 0, 0, 0, 1, 1, 1, 1};
};

SessionAdaptiveClassifier squareModel(SessionAdaptiveOptions options = {}) {
  const Square square;
  return SessionAdaptiveClassifier::learn(
      square.x, square.y, {"left", "right"}, {"a", "b"}, options);
}

// Density of a t distribution by the textbook formula, here for an isotropic scatter s^2 I in two
// dimensions.
double lnRoundT(double squaredDistance, double variance, double nu) {
  return std::lgamma((nu + 2) / 2) - std::lgamma(nu / 2) - std::log(nu * std::numbers::pi) -
         std::log(variance) - (nu + 2) / 2 * std::log(1 + squaredDistance / variance / nu);
}

TEST(SessionAdaptiveClassifier, IsATPerClassWidenedByTheDay) {
  const SessionAdaptiveClassifier model = squareModel();
  // The variance of the class, and the same again for the session.
  const double variance = 4.0 / 3.0 * 2.0;
  const VectorXd at = model.logLikelihoods(VectorXd{{2.0, 1.0}}, 0.0);
  EXPECT_NEAR(at[0], lnRoundT(5.0, variance, 8.0), 1e-12);
  EXPECT_NEAR(at[1], lnRoundT(65.0, variance, 8.0), 1e-12);
  // Background: around (5, 0); between the means 50 along a, and one class's scatter.
  EXPECT_EQ(model.data().background.mean, (VectorXd{{5.0, 0.0}}));
  EXPECT_NEAR(model.data().background.scatter(0, 0), 50.0 + variance, 1e-12);
  EXPECT_NEAR(model.data().background.scatter(1, 1), variance, 1e-12);
}

TEST(SessionAdaptiveClassifier, DensitiesSumUpToOne) {
  const SessionAdaptiveClassifier model = squareModel();
  double sum = 0.0;
  constexpr double kStep = 0.25;
  for (double a = -60.0; a < 60.0; a += kStep)
    for (double b = -60.0; b < 60.0; b += kStep)
      sum += std::exp(model.logLikelihoods(VectorXd{{a, b}}, 0.0)[0]) * kStep * kStep;
  EXPECT_NEAR(sum, 1.0, 1e-4);
}

TEST(SessionAdaptiveClassifier, ANamedFeatureHasADayOfItsOwn) {
  SessionAdaptiveOptions options;
  options.sessionSd = {{"b", 3.0}};
  const SessionAdaptiveClassifier model = squareModel(options);
  EXPECT_NEAR(model.data().classComponents[0].scatter(0, 0), 8.0 / 3.0, 1e-12);
  EXPECT_NEAR(model.data().classComponents[0].scatter(1, 1), 4.0 / 3.0 + 9.0, 1e-12);
}

TEST(SessionAdaptiveClassifier, TheOffsetMovesTheSizeAndNothingElse) {
  MatrixXd x(6, 2);
  std::vector<int> y;
  for (int i = 0; i < 6; ++i) {
    x.row(i) << (i % 2 == 0 ? 1.0 : 2.0) + i * 0.01, sizeZ(30.0 + (i % 2) * 20.0 + 0.1 * i);
    y.push_back(i % 2);
  }
  const SessionAdaptiveClassifier model =
      SessionAdaptiveClassifier::learn(x, y, {"a", "b"}, {"ln_major", "size_z"});
  ASSERT_EQ(model.data().sizeColumn, 1u);
  const VectorXd true30{{1.0, sizeZ(30.0)}}, read26{{1.0, sizeZ(26.0)}};
  EXPECT_NEAR((model.withoutOffset(read26, -4.0) - true30).norm(), 0.0, 1e-12);
  EXPECT_NEAR(
      (model.logLikelihoods(read26, -4.0) - model.logLikelihoods(true30, 0.0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR(model.logBackground(read26, -4.0), model.logBackground(true30, 0.0), 1e-9);
}

TEST(SessionAdaptiveClassifier, WhatWasSeenTodayCountsWhereItFitsBetter) {
  SessionAdaptiveClassifier model = squareModel();
  const VectorXd at{{4.0, 0.0}};
  const double before = model.logLikelihoods(at, 0.0)[1];
  model.addSessionComponents(MatrixXd{{4.0, 0.0}}, {1}, 0.0);
  ASSERT_EQ(model.data().today.size(), 1u);
  // K = 1: scatter 1.5 * 2 * S_w = 4 I.
  EXPECT_NEAR(model.logLikelihoods(at, 0.0)[1], lnRoundT(0.0, 4.0, 8.0), 1e-12);
  EXPECT_GT(model.logLikelihoods(at, 0.0)[1], before);
  EXPECT_EQ(model.logPrior(), (VectorXd{{0.0, 3.0}}));
  // If the training component fits better, it is used.
  EXPECT_NEAR(
      model.logLikelihoods(VectorXd{{10.0, 0.0}}, 0.0)[1], lnRoundT(0.0, 8.0 / 3.0, 8.0), 1e-12);
  // A second call with three grasps replaces the component.
  model.addSessionComponents(MatrixXd{{4.0, 0.0}, {5.0, 0.0}, {6.0, 0.0}}, {1, 1, 1}, 0.0);
  ASSERT_EQ(model.data().today.size(), 1u);
  EXPECT_EQ(model.data().today[0].count, 3u);
  EXPECT_NEAR(model.logLikelihoods(VectorXd{{5.0, 0.0}}, 0.0)[1],
              lnRoundT(0.0, 1.5 * 4 / 3 * 4.0 / 3.0, 8.0),
              1e-12);
}

TEST(SessionAdaptiveClassifier, WhatCannotBeLearntIsSaid) {
  const Square square;
  const auto said =
      [](const MatrixXd& x, const std::vector<int>& y, std::vector<std::string> classes) {
        try {
          SessionAdaptiveClassifier::learn(x, y, std::move(classes), {"a", "b"});
        } catch (const Error& error) {
          return std::string(error.what());
        }
        return std::string("nothing");
      };
  EXPECT_EQ(said(square.x, std::vector<int>(8, 0), {"one"}), "a model needs two classes or more");
  EXPECT_EQ(said(square.x, square.y, {"l", "r", "nobody"}), "class 'nobody' has no sample");
  EXPECT_EQ(said(MatrixXd{{1, 2}, {3, 4}}, {0, 1}, {"l", "r"}),
            "every class has one sample only: record at least two grasps of an object");
  MatrixXd bad = square.x;
  bad(3, 1) = std::nan("");
  EXPECT_EQ(said(bad, square.y, {"l", "r"}), "features that are not numbers");
  EXPECT_THROW(SessionAdaptiveClassifier::learn(square.x, {0, 1}, {"l", "r"}, {"a", "b"}),
               std::invalid_argument);
  EXPECT_THROW(SessionAdaptiveClassifier::learn(square.x, square.y, {"l", "r"}, {"a"}),
               std::invalid_argument);
  EXPECT_THROW(
      SessionAdaptiveClassifier::learn(square.x, std::vector<int>(8, 2), {"l", "r"}, {"a", "b"}),
      std::invalid_argument);
  SessionAdaptiveOptions options;
  options.degreesOfFreedom = 2.0;
  EXPECT_THROW(squareModel(options), std::invalid_argument);
  SessionAdaptiveClassifier model = squareModel();
  EXPECT_THROW(model.logLikelihoods(VectorXd{{1.0}}, 0.0), std::invalid_argument);
  EXPECT_THROW(model.logLikelihoods(VectorXd{{1.0, std::nan("")}}, 0.0), std::invalid_argument);
  EXPECT_THROW(model.addSessionComponents(MatrixXd{{1.0, 1.0}}, {7}, 0.0), std::invalid_argument);
}

TEST(SessionAdaptiveClassifier, AConstantFeatureOrASingleSampleBreaksNothing) {
  MatrixXd x = Square().x;
  x.col(1).setConstant(7.0);
  const SessionAdaptiveClassifier model =
      SessionAdaptiveClassifier::learn(x, Square().y, {"l", "r"}, {"a", "b"});
  EXPECT_EQ(model.constantFeatures(), std::vector<std::string>{"b"});
  EXPECT_TRUE(model.logLikelihoods(VectorXd{{0.0, 7.0}}, 0.0).allFinite());
  EXPECT_TRUE(model.logLikelihoods(VectorXd{{0.0, 8.0}}, 0.0).allFinite());
  // A class with a single sample uses the scatter of the others.
  const SessionAdaptiveClassifier single =
      SessionAdaptiveClassifier::learn(MatrixXd{{0, 0}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}},
                                       {0, 1, 1, 1, 1},
                                       {"one", "more"},
                                       {"a", "b"});
  EXPECT_NEAR(single.data().classComponents[0].scatter(0, 0), 8.0 / 3.0, 1e-12);
  EXPECT_EQ(single.data().classComponents[0].scatter, single.data().classComponents[1].scatter);
}

TEST(SessionAdaptiveClassifier, TravelsThroughAFile) {
  SessionAdaptiveClassifier model = squareModel();
  model.addSessionComponents(MatrixXd{{4.0, 0.25}}, {1}, 0.0);
  const SessionAdaptiveClassifier back =
      sessionAdaptiveFrom(Json::parse(sessionAdaptiveJson(model).text()));
  EXPECT_EQ(back.data(), model.data());
  EXPECT_EQ(back.logLikelihoods(VectorXd{{3.0, 1.0}}, 0.0),
            model.logLikelihoods(VectorXd{{3.0, 1.0}}, 0.0));
}

// Whatever is wrong with it: the message begins alike and names the member.
TEST(SessionAdaptiveClassifier, TheMessageNamesTheDamagedMember) {
  const auto saidOf = [](const std::string& key, Json value) {
    try {
      sessionAdaptiveFrom(Json(sessionAdaptiveJson(squareModel())).set(key, std::move(value)));
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  EXPECT_EQ(saidOf("bells", "x"), "model: 'bells' isn't a list");
  EXPECT_EQ(saidOf("today", 1), "model: 'today' isn't a list");
  EXPECT_EQ(saidOf("pooled", Json()), "model: 'pooled' isn't a list");
  EXPECT_EQ(saidOf("pooled", Json::array()), "model: 'pooled' has no rows");
  EXPECT_EQ(saidOf("pooled", Json::parse("[[1, 0], 1]")),
            "model: 'pooled' has a row that isn't a list");
  EXPECT_EQ(saidOf("pooled", Json::parse("[[1, 0], [0]]")),
            "model: 'pooled' has 1 entries instead of 2");
  EXPECT_EQ(saidOf("background", Json::object().set("mean", Json::array().push(1.0))),
            "model: 'scatter' is missing");
}

TEST(SessionAdaptiveClassifier, ADamagedFileIsSaid) {
  const Json good = sessionAdaptiveJson(squareModel());
  for (const std::string& key : good.keys()) {
    Json bad = Json::object();
    for (const std::string& other : good.keys())
      if (other != key) bad.set(other, good.at(other));
    if (key == "size_column") continue;
    EXPECT_THROW(sessionAdaptiveFrom(bad), Error) << key;
    EXPECT_THROW(sessionAdaptiveFrom(Json(good).set(key, Json("x"))), Error) << key;
  }
  EXPECT_THROW(sessionAdaptiveFrom(Json(good).set("format", 2)), Error);
  EXPECT_THROW(sessionAdaptiveFrom(Json::array()), Error);
  SessionAdaptiveParameters data = squareModel().data();
  data.classComponents[1].scatter(0, 1) = data.classComponents[1].scatter(1, 0) = 100.0;
  EXPECT_THROW(SessionAdaptiveClassifier{data}, Error) << "not positive definite";
  data = squareModel().data();
  data.classComponents.pop_back();
  EXPECT_THROW(SessionAdaptiveClassifier{data}, Error);
  data = squareModel().data();
  data.classComponents[0].mean[0] = std::nan("");
  EXPECT_THROW(SessionAdaptiveClassifier{data}, Error);
}

}  // namespace
}  // namespace palpate::session_adaptive_classifier_test
