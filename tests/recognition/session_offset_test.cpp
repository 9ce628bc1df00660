#include "palpate/recognition/session_offset.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

#include "palpate/core/error.h"
#include "palpate/recognition/plateau_features.h"

namespace palpate::session_offset_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Objects that differ in size [mm] and, a little, in shape; 20 grasps each, with a scatter of .3 mm
// and .1.
class SizesWorld {
 public:
  explicit SizesWorld(std::vector<double> sizesMm) : sizesMm_(std::move(sizesMm)) {}

  VectorXd grasp(std::size_t object, double offsetMm = 0.0) {
    const double shape = static_cast<double>(object % 3);
    return VectorXd{{sizeZ(sizesMm_[object] + offsetMm + 0.3 * normal_(random_)),
                     shape + 0.1 * normal_(random_)}};
  }
  MatrixXd grasps(const std::vector<std::size_t>& objects, int each, double offsetMm) {
    MatrixXd x(static_cast<Eigen::Index>(objects.size()) * each, 2);
    Eigen::Index row = 0;
    for (const std::size_t object : objects)
      for (int i = 0; i < each; ++i) x.row(row++) = grasp(object, offsetMm).transpose();
    return x;
  }
  SessionAdaptiveClassifier model() {
    std::vector<std::string> names;
    std::vector<std::size_t> all;
    std::vector<int> y;
    for (std::size_t c = 0; c < sizesMm_.size(); ++c) {
      names.push_back("object " + std::to_string(c));
      all.push_back(c);
      y.insert(y.end(), 20, static_cast<int>(c));
    }
    return SessionAdaptiveClassifier::learn(grasps(all, 20, 0.0), y, names, {"size_z", "shape"});
  }

 private:
  std::vector<double> sizesMm_;
  std::mt19937 random_{7};
  std::normal_distribution<double> normal_;
};

double sumOf(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(SessionOffset, BeforeAnythingIsKnownItIsNormal) {
  const SessionOffset unknown = unknownOffset();
  EXPECT_EQ(unknown.gridMm.size(), 65u);
  EXPECT_NEAR(sumOf(unknown.probability), 1.0, 1e-12);
  EXPECT_NEAR(unknown.mm, 0.0, 1e-12);
  EXPECT_NEAR(unknown.sdMm, 2.9, 0.1) << "3 mm, cut at 8";
  EXPECT_NEAR(unknown.probability[32] / unknown.probability[44], std::exp(0.5), 1e-9)
      << "0 to 3 mm";
  EXPECT_FALSE(unknown.trusted);
  EXPECT_FALSE(noOffset().trusted);
  EXPECT_TRUE(givenOffset(-2.0).trusted);
}

TEST(SessionOffset, IsFoundFromUnlabelledGraspsOfSeveralObjects) {
  SizesWorld world({15, 28, 37, 52, 60, 75, 90});
  const SessionAdaptiveClassifier model = world.model();
  for (const double truthMm : {-4.1, -1.0, 0.0, 3.3}) {
    const SessionOffset found = offsetFromBatch(model, world.grasps({0, 3, 5}, 6, truthMm));
    EXPECT_NEAR(found.mm, truthMm, 0.6) << truthMm;
    EXPECT_LT(found.sdMm, 0.6);
    EXPECT_EQ(found.origin, OffsetSource::kBatch);
    EXPECT_EQ(found.grasps, 18u);
    EXPECT_EQ(found.objects, 3u);
    EXPECT_TRUE(found.trusted);
    const MatrixXd x = world.grasps({4}, 10, truthMm);
    for (const OpenSetPrediction& prediction : predictAll(model, x, found)) {
      EXPECT_EQ(prediction.ranking[0], 4u);
      EXPECT_TRUE(prediction.sure);
    }
  }
}

// Objects of the same shape whose sizes differ by 3 mm: in another session any of them may be any
// other.
TEST(SessionOffset, OneObjectIsNeverEnoughToBeSure) {
  SizesWorld world({30, 90, 91, 33, 92, 93, 36, 94, 95, 39});
  const SessionAdaptiveClassifier model = world.model();
  const MatrixXd x = world.grasps({3}, 12, -3.0);
  const SessionOffset found = offsetFromBatch(model, x);
  EXPECT_LT(found.objects, 2u);
  EXPECT_FALSE(found.trusted);
  for (const OpenSetPrediction& prediction : predictAll(model, x, found))
    EXPECT_FALSE(prediction.sure);
  // A labelled grasp does not make it trusted either.
  const SessionOffset labelled = offsetFromReferences(model, x, std::vector<int>(12, 3));
  EXPECT_NEAR(labelled.mm, -3.0, 0.5);
  EXPECT_EQ(labelled.objects, 1u);
  EXPECT_FALSE(labelled.trusted);
  EXPECT_FALSE(predict(model, x.row(0).transpose(), labelled).sure);
}

// Objects of the same shape, 15 mm apart. With an offset of +- 3 mm an object that is 4 mm larger
// than one of them may be known or not; when the offset is known, it is not.
TEST(SessionOffset, WithoutAnOffsetItCannotBeKnownYetWhetherAnObjectIsKnown) {
  SizesWorld world({20, 1, 2, 35, 3, 4, 50, 5, 6, 65, 7, 8, 24});
  const MatrixXd unknown = world.grasps({12}, 10, 0.0), known = world.grasps({3}, 10, 0.0);
  SizesWorld training({20, 1, 2, 35, 3, 4, 50, 5, 6, 65});
  const SessionAdaptiveClassifier model = training.model();
  for (Eigen::Index i = 0; i < 10; ++i) {
    const auto of = [&](const MatrixXd& x, const SessionOffset& offset) {
      return predict(model, x.row(i).transpose(), offset);
    };
    for (const MatrixXd* x : {&unknown, &known}) {
      const OpenSetPrediction open = of(*x, unknownOffset());
      EXPECT_EQ(open.membership, Membership::kNotKnownYet);
      EXPECT_FALSE(open.sure);
      EXPECT_GT(open.knownFraction, 0.05);
      EXPECT_LT(open.knownFraction, 0.95);
    }
    EXPECT_EQ(of(unknown, givenOffset(0.0)).membership, Membership::kUnknown);
    EXPECT_EQ(of(unknown, givenOffset(0.0)).knownFraction, 0.0);
    EXPECT_EQ(of(known, givenOffset(0.0)).membership, Membership::kKnown);
    EXPECT_EQ(of(known, givenOffset(0.0)).knownFraction, 1.0);
  }
}

// An unknown object moves the offset that is estimated from its own grasps until it resembles a
// class. The log likelihood ratio must not profit from this.
TEST(SessionOffset, AnUnknownObjectDoesNotMakeItselfKnown) {
  SizesWorld world({20, 1, 2, 35, 3, 4, 50, 5, 6, 65, 7, 8, 38.0});
  const MatrixXd x = world.grasps({12}, 12, 0.0);
  SizesWorld training({20, 1, 2, 35, 3, 4, 50, 5, 6, 65});
  const SessionAdaptiveClassifier model = training.model();
  const SessionOffset own = offsetFromBatch(model, x);
  ASSERT_FALSE(own.trusted);
  ASSERT_NEAR(own.mm, 3.0, 0.7) << "the wrong offset with which it is the object of 35 mm";
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    const OpenSetPrediction with = predict(model, x.row(i).transpose(), own),
                            without = predict(model, x.row(i).transpose(), unknownOffset());
    EXPECT_EQ(with.logLikelihoodRatio, without.logLikelihoodRatio);
    EXPECT_EQ(with.membership, Membership::kNotKnownYet);
    EXPECT_GT(with.probability.maxCoeff(), without.probability.maxCoeff() - 1e-12)
        << "the class probabilities use the batch";
  }
}

// The Fisher information must agree with the width of the offset's distribution after a grasp at
// the mean of the class.
TEST(SessionOffset, TheBestReferenceTellsTheOffsetMostExactly) {
  SizesWorld world({15, 52, 90, 120});
  const SessionAdaptiveClassifier model = world.model();
  const auto best = bestReference(model);
  ASSERT_TRUE(best);
  SessionOffsetOptions wide;
  wide.priorSdMm = 50.0;
  wide.stepMm = 0.02;
  std::vector<double> sdMm;
  for (std::size_t c = 0; c < 4; ++c) {
    const MatrixXd x = model.data().classComponents[c].mean.transpose();
    sdMm.push_back(
        offsetFromReferences(model, x, {static_cast<int>(c)}, unknownOffset(wide), wide).sdMm);
  }
  EXPECT_EQ(best->classIndex,
            static_cast<std::size_t>(std::min_element(sdMm.begin(), sdMm.end()) - sdMm.begin()));
  EXPECT_NEAR(best->sdMm, sdMm[best->classIndex], 0.15 * sdMm[best->classIndex]);
  const SessionAdaptiveClassifier withoutSize = SessionAdaptiveClassifier::learn(
      MatrixXd::Random(8, 2), {0, 0, 0, 0, 1, 1, 1, 1}, {"a", "b"}, {"shape", "force"});
  EXPECT_FALSE(bestReference(withoutSize));
}

TEST(SessionOffset, RefusesAFractionThatIsNone) {
  OpenSetOptions options;
  options.minKnownFraction = 1.5;
  EXPECT_THROW(options.validate(), std::invalid_argument);
  options.minKnownFraction = std::nan("");
  EXPECT_THROW(options.validate(), std::invalid_argument);
}

TEST(SessionOffset, LabelledGraspsOfTwoObjectsAreTrusted) {
  SizesWorld world({30, 45, 60, 75});
  const SessionAdaptiveClassifier model = world.model();
  const SessionOffset found = offsetFromReferences(model, world.grasps({0, 2}, 1, 2.0), {0, 2});
  EXPECT_NEAR(found.mm, 2.0, 0.5);
  EXPECT_EQ(found.objects, 2u);
  EXPECT_EQ(found.grasps, 2u);
  EXPECT_TRUE(found.trusted);
  // More grasps of one object count as two, because the offset of this object does not average out.
  const double two = offsetFromReferences(model, world.grasps({1}, 2, 2.0), {1, 1}).sdMm;
  const double twenty =
      offsetFromReferences(model, world.grasps({1}, 20, 2.0), std::vector<int>(20, 1)).sdMm;
  EXPECT_NEAR(twenty, two, 0.3 * two);
}

TEST(SessionOffset, WhatTheEmptyHandSaysIsKeptAndNarrowed) {
  SizesWorld world({15, 28, 37, 52, 60, 75, 90});
  const SessionAdaptiveClassifier model = world.model();
  const SessionOffset zero = measuredOffset(-4.0, 0.6, OffsetSource::kEmptyHand);
  EXPECT_EQ(zero.mm, -4.0);
  EXPECT_TRUE(zero.trusted);
  const SessionOffset narrowed = offsetFromBatch(model, world.grasps({1}, 8, -4.2), zero);
  EXPECT_EQ(narrowed.origin, OffsetSource::kEmptyHand);
  EXPECT_NEAR(narrowed.mm, -4.2, 0.5);
  EXPECT_LT(narrowed.sdMm, 0.6);
  EXPECT_TRUE(narrowed.trusted) << "one object, but the hand was measured";
  EXPECT_FALSE(measuredOffset(-4.0, 2.0, OffsetSource::kEmptyHand).trusted);
  // Values outside of the grid, and much finer than its step.
  const SessionOffset far = measuredOffset(20.0, 0.05, OffsetSource::kEmptyHand);
  double mean = 0.0;
  for (std::size_t i = 0; i < far.gridMm.size(); ++i) mean += far.gridMm[i] * far.probability[i];
  EXPECT_NEAR(mean, 20.0, 1e-3);
}

TEST(SessionOffset, AGivenOneIsNotChanged) {
  SizesWorld world({15, 28, 37});
  const SessionAdaptiveClassifier model = world.model();
  const MatrixXd x = world.grasps({0, 1}, 5, 3.0);
  for (const SessionOffset& before : {givenOffset(1.0), noOffset()}) {
    const SessionOffset after = offsetFromBatch(model, x, before);
    EXPECT_EQ(after.mm, before.mm);
    EXPECT_EQ(after.origin, before.origin);
    EXPECT_EQ(after.trusted, before.trusted);
  }
}

TEST(SessionOffset, AVerdictSumsOverWhatIsNotKnown) {
  // One class has 30 mm, the other 33 mm; the measured size is 30 mm. With offset 0 it is the
  // first, with -3 the second; with an uncertainty of +-3 mm both are likely.
  SizesWorld world({30, 90, 91, 33});
  const SessionAdaptiveClassifier model = world.model();
  const VectorXd x{{sizeZ(30.0), 0.0}};
  EXPECT_EQ(predict(model, x, givenOffset(0.0)).ranking[0], 0u);
  EXPECT_EQ(predict(model, x, givenOffset(-3.0)).ranking[0], 3u);
  const OpenSetPrediction open = predict(model, x, unknownOffset());
  EXPECT_NEAR(open.probability.sum(), 1.0, 1e-12);
  EXPECT_GT(open.probability[0], 0.5);
  EXPECT_GT(open.probability[3], 0.2);
  EXPECT_FALSE(open.sure);
}

TEST(SessionOffset, WhatFitsNoClassIsUnknown) {
  SizesWorld world({15, 28, 37, 52, 60, 75, 90});
  const SessionAdaptiveClassifier model = world.model();
  const OpenSetPrediction known = predict(model, world.grasp(2), givenOffset(0.0));
  EXPECT_FALSE(known.unknown);
  EXPECT_TRUE(known.sure);
  const OpenSetPrediction between = predict(model, VectorXd{{sizeZ(44.0), 1.0}}, givenOffset(0.0));
  EXPECT_LT(between.logLikelihoodRatio, known.logLikelihoodRatio);
  EXPECT_TRUE(between.unknown);
  EXPECT_FALSE(between.sure);
  OpenSetOptions generous;
  generous.minLogLikelihoodRatio = -1e6;
  EXPECT_FALSE(predict(model, VectorXd{{sizeZ(44.0), 1.0}}, givenOffset(0.0), generous).unknown);
}

TEST(SessionOffset, IsSaidInOneLine) {
  SessionOffset offset = measuredOffset(-3.44, 0.31, OffsetSource::kBatch);
  offset.objects = 4;
  offset.trusted = true;
  EXPECT_EQ(offset.text(), "today the hand reads 3.4 mm small (+- 0.3 mm, from 4 objects)");
  offset.objects = 1;
  offset.trusted = false;
  EXPECT_EQ(offset.text(),
            "today the hand reads 3.4 mm small (+- 0.3 mm, from 1 object), so no answer is "
            "called sure");
  offset = measuredOffset(0.04, 0.2, OffsetSource::kBatch);
  offset.objects = 5;
  EXPECT_EQ(offset.text(),
            "today the hand reads sizes as it did in training (+- 0.2 mm, from 5 objects), so no "
            "answer is called sure");
  EXPECT_EQ(givenOffset(2.0).text(), "today the hand reads 2.0 mm large (given)");
  EXPECT_EQ(measuredOffset(1.0, 0.5, OffsetSource::kEmptyHand).text(),
            "today the hand reads 1.0 mm large (+- 0.5 mm, from the empty hand)");
}

TEST(SessionOffset, TravelsThroughAFile) {
  SizesWorld world({15, 28, 37, 52});
  const SessionOffset offset = offsetFromBatch(world.model(), world.grasps({0, 3}, 4, -2.0));
  const SessionOffset back = sessionOffsetFrom(Json::parse(sessionOffsetJson(offset).text()));
  EXPECT_EQ(back.mm, offset.mm);
  EXPECT_EQ(back.sdMm, offset.sdMm);
  EXPECT_EQ(back.origin, offset.origin);
  EXPECT_EQ(back.objects, offset.objects);
  EXPECT_EQ(back.grasps, offset.grasps);
  EXPECT_EQ(back.trusted, offset.trusted);
  EXPECT_EQ(back.gridMm, offset.gridMm);
  EXPECT_EQ(back.probability, offset.probability);
  const Json good = sessionOffsetJson(offset);
  for (const std::string& key : good.keys())
    EXPECT_THROW(sessionOffsetFrom(Json(good).set(key, Json("x"))), Error) << key;
  try {
    sessionOffsetFrom(Json(good).set("origin", "x"));
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "model: 'origin' isn't known to this version: 'x'");
  }
}

TEST(SessionOffset, WrongQuestionsAreRefused) {
  SizesWorld world({15, 28, 37});
  const SessionAdaptiveClassifier model = world.model();
  EXPECT_THROW(givenOffset(std::nan("")), std::invalid_argument);
  EXPECT_THROW(givenOffset(1.0, -1.0), std::invalid_argument);
  EXPECT_THROW(measuredOffset(1.0, 0.0, OffsetSource::kEmptyHand), std::invalid_argument);
  EXPECT_THROW(offsetFromBatch(model, MatrixXd::Zero(1, 3)), std::invalid_argument);
  EXPECT_THROW(offsetFromReferences(model, MatrixXd::Zero(1, 2), {5}), std::invalid_argument);
  EXPECT_THROW(offsetFromReferences(model, MatrixXd::Zero(1, 2), {}), std::invalid_argument);
  EXPECT_THROW(predict(model, VectorXd::Zero(2), SessionOffset{}), std::invalid_argument);
  SessionOffsetOptions options;
  options.stepMm = 0.0;
  EXPECT_THROW(options.validate(), std::invalid_argument);
  OpenSetOptions prediction;
  prediction.sureProbability = 0.2;
  EXPECT_THROW(prediction.validate(), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::session_offset_test
