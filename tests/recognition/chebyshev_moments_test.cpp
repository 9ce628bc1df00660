#include "palpate/recognition/chebyshev_moments.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

#include "palpate/core/json.h"

#include "testing/testing.h"

namespace palpate::chebyshev_moments_test {
namespace {

// t_p(x) as the study defines it (6.6.4): an alternating sum of falling factorials, in long double.
double studyPolynomial(int size, int p, double x) {
  const auto factorial = [](int n) {
    long double product = 1.0L;
    for (int i = 2; i <= n; ++i) product *= i;
    return product;
  };
  const long double beta =
      std::sqrt(factorial(size + p) / ((2.0L * p + 1.0L) * factorial(size - p - 1)));
  long double sum = 0.0L;
  for (int r = 0; r <= p; ++r) {
    long double falling = 1.0L;
    for (int i = 0; i < r; ++i) falling *= static_cast<long double>(x) - i;
    const long double term =
        factorial(p + r) * factorial(size - r - 1) /
        (factorial(p - r) * factorial(r) * factorial(r) * factorial(size - p - 1)) * falling;
    sum += (p + r) % 2 == 0 ? term : -term;
  }
  return static_cast<double>(sum / beta);
}

Eigen::MatrixXd blob(int size, double cx, double cy, double along, double across, double angleRad) {
  Eigen::MatrixXd picture(size, size);
  const double c = std::cos(angleRad), s = std::sin(angleRad);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const double u = (x - cx) * c + (y - cy) * s, v = -(x - cx) * s + (y - cy) * c;
      // The image has a longer tail towards rising u.
      const double reach = u > 0.0 ? 1.6 * along : along;
      picture(y, x) = std::exp(-u * u / (2 * reach * reach) - v * v / (2 * across * across));
    }
  return picture;
}

TEST(ChebyshevMoments, PolynomialsAreThoseOfTheFormula) {
  for (const int size : {5, 14}) {
    const ChebyshevPolynomials polynomials(size, 4);
    double values[5];
    for (const double x : {0.0, 1.0, 2.0, 4.0, 0.37, -9.25, 13.5}) {
      polynomials.at(x, values);
      for (int p = 0; p <= 4; ++p) {
        const double expected = studyPolynomial(size, p, x);
        EXPECT_NEAR(values[p], expected, 1e-11 * std::max(1.0, std::abs(expected)))
            << size << " " << p << " " << x;
      }
    }
  }
}

TEST(ChebyshevMoments, PolynomialsAreOrthonormal) {
  for (const int size : {1, 2, 14, 20}) {
    const ChebyshevPolynomials polynomials(size, std::min(size - 1, 32));
    Eigen::MatrixXd values(polynomials.order() + 1, size);
    for (int x = 0; x < size; ++x) polynomials.at(x, values.col(x).data());
    const Eigen::MatrixXd products = values * values.transpose();
    EXPECT_LT((products - Eigen::MatrixXd::Identity(products.rows(), products.cols()))
                  .cwiseAbs()
                  .maxCoeff(),
              1e-8)
        << size;
  }
}

TEST(ChebyshevMoments, OfAConstantPictureOnlyTheFirstIsLeft) {
  const auto moments =
      chebyshevMoments(Eigen::MatrixXd::Constant(14, 14, 2.0), ChebyshevPolynomials(14, 4));
  EXPECT_NEAR(moments(0, 0), 28.0, 1e-12);  // 2 * 196 / 14
  EXPECT_NEAR(moments.squaredNorm(), 28.0 * 28.0, 1e-10);
}

TEST(ChebyshevMoments, AreSumsOverThePixelsWithPOfX) {
  Eigen::MatrixXd picture = Eigen::MatrixXd::Zero(14, 14);
  picture(3, 11) = 0.5;  // y = 3, x = 11
  const auto moments = chebyshevMoments(picture, ChebyshevPolynomials(14, 4));
  for (int p = 0; p <= 4; ++p)
    for (int q = 0; q <= 4; ++q)
      EXPECT_NEAR(
          moments(p, q), 0.5 * studyPolynomial(14, p, 11) * studyPolynomial(14, q, 3), 1e-13);
}

TEST(ChebyshevMoments, AllOfThemGiveThePictureBack) {
  const Eigen::MatrixXd picture = blob(14, 5.3, 7.1, 2.0, 1.0, 0.4);
  double last = 1.0;
  for (const int order : {0, 2, 4, 8, 13}) {
    const ChebyshevPolynomials polynomials(14, order);
    const double error = reconstructionError(
        picture, reconstructImage(chebyshevMoments(picture, polynomials), polynomials));
    EXPECT_LT(error, last) << order;
    last = error;
    // Parseval: the squared error is the energy of the missing moments.
    const double energy = chebyshevMoments(picture, polynomials).squaredNorm();
    EXPECT_NEAR(error * error, 1.0 - energy / picture.squaredNorm(), 1e-9);
  }
  EXPECT_LT(last, 1e-6);
  const Eigen::MatrixXd nothing = Eigen::MatrixXd::Zero(3, 3);
  EXPECT_EQ(reconstructionError(nothing, nothing), 0.0);
  EXPECT_EQ(reconstructionError(nothing, nothing.array() + 1.0),
            std::numeric_limits<double>::infinity());
}

TEST(ChebyshevMoments, InvariantsDoNotSeeShifts) {
  const ChebyshevPolynomials polynomials(20, 4);
  const Eigen::MatrixXd small = blob(9, 4.2, 3.7, 1.2, 0.6, 0.5);
  for (const auto angle :
       {ImageOrientation::kNone, ImageOrientation::kStudy, ImageOrientation::kResolved}) {
    const auto here = chebyshevInvariants(padToSquare(small, 20, 1, 2), polynomials, angle);
    const auto there = chebyshevInvariants(padToSquare(small, 20, 10, 7), polynomials, angle);
    EXPECT_NEAR(there.centroidX, here.centroidX + 5.0, 1e-10);
    EXPECT_NEAR(there.centroidY, here.centroidY + 9.0, 1e-10);
    EXPECT_LT((here.moments - there.moments).norm(), 1e-9 * here.moments.norm());
  }
}

TEST(ChebyshevMoments, InvariantsDoNotSeeTurnsAndTheHalfTurnIsResolved) {
  const int size = 41;
  const ChebyshevPolynomials polynomials(size, 4);
  const auto of = [&](double angleRad, ImageOrientation how) {
    return chebyshevInvariants(blob(size, 20, 20, 3.5, 2.0, angleRad), polynomials, how);
  };
  const auto straight = of(0.0, ImageOrientation::kResolved);
  EXPECT_NEAR(straight.angleRad, 0.0, 1e-6);
  for (const double angleRad : {0.3, 1.2, 2.0, 3.0, -0.7, -2.9}) {
    const auto turned = of(angleRad, ImageOrientation::kResolved);
    ASSERT_TRUE(turned.angleDetermined);
    EXPECT_NEAR(turned.angleRad, angleRad, 2e-3);
    EXPECT_LT((turned.moments - straight.moments).norm(), 2e-3 * straight.moments.norm())
        << angleRad;
  }
  // atan determines neither which axis is the long one nor its direction.
  EXPECT_NEAR(of(0.3, ImageOrientation::kStudy).angleRad, 0.3, 2e-3);
  EXPECT_NEAR(of(1.2, ImageOrientation::kStudy).angleRad, 1.2 - std::numbers::pi / 2, 2e-3);
  EXPECT_GT((of(3.0, ImageOrientation::kStudy).moments - straight.moments).norm(),
            0.05 * straight.moments.norm());
}

// When the linear and mixed second moments are 0, three of them are multiples of the first one
// (reference/grasp_features.md).
TEST(ChebyshevMoments, SixOfTheStudysAreRedundant) {
  const auto found = chebyshevInvariants(
      blob(14, 6.4, 5.8, 2.0, 1.0, 0.6), ChebyshevPolynomials(14, 4), ImageOrientation::kStudy);
  const Eigen::MatrixXd& moments = found.moments;
  EXPECT_NEAR(moments(0, 1) / moments(0, 0), -1.6124515, 1e-7);
  EXPECT_NEAR(moments(1, 0) / moments(0, 0), -1.6124515, 1e-7);
  EXPECT_NEAR(moments(1, 1) / moments(0, 0), 2.6, 1e-9);
}

TEST(ChebyshevMoments, WhatHasNoAxisSaysSo) {
  const ChebyshevPolynomials polynomials(14, 4);
  const Eigen::MatrixXd nothing = Eigen::MatrixXd::Zero(14, 14);
  const auto empty = chebyshevInvariants(nothing, polynomials, ImageOrientation::kStudy);
  EXPECT_TRUE(empty.empty);
  EXPECT_EQ(empty.moments.norm(), 0.0);
  Eigen::MatrixXd square = nothing;
  square.block(4, 5, 2, 2).setOnes();
  Eigen::MatrixXd pixel = nothing;
  pixel(4, 5) = 1.0;
  for (const Eigen::MatrixXd& picture : {square, pixel})
    for (const auto how : {ImageOrientation::kStudy, ImageOrientation::kResolved}) {
      const auto found = chebyshevInvariants(picture, polynomials, how);
      EXPECT_FALSE(found.angleDetermined);
      EXPECT_EQ(found.angleRad, 0.0);
      EXPECT_TRUE(found.moments.allFinite());
    }
  // A bar has an axis, but no direction.
  Eigen::MatrixXd bar = nothing;
  bar.block(4, 5, 1, 4).setOnes();
  EXPECT_TRUE(chebyshevInvariants(bar, polynomials, ImageOrientation::kStudy).angleDetermined);
  EXPECT_FALSE(chebyshevInvariants(bar, polynomials, ImageOrientation::kResolved).angleDetermined);
}

TEST(ChebyshevMoments, WrongQuestionsAreRefused) {
  EXPECT_THROW(ChebyshevPolynomials(0, 0), std::invalid_argument);
  EXPECT_THROW(ChebyshevPolynomials(257, 4), std::invalid_argument);
  EXPECT_THROW(ChebyshevPolynomials(4, 4), std::invalid_argument);
  EXPECT_THROW(ChebyshevPolynomials(4, -1), std::invalid_argument);
  const ChebyshevPolynomials polynomials(14, 4);
  EXPECT_THROW(chebyshevMoments(Eigen::MatrixXd::Zero(13, 14), polynomials), std::invalid_argument);
  Eigen::MatrixXd bad = Eigen::MatrixXd::Zero(14, 14);
  bad(0, 0) = std::nan("");
  EXPECT_THROW(chebyshevInvariants(bad, polynomials, ImageOrientation::kNone),
               std::invalid_argument);
  EXPECT_THROW(reconstructImage(Eigen::MatrixXd::Zero(4, 4), polynomials), std::invalid_argument);
  EXPECT_THROW(padToSquare(Eigen::MatrixXd::Zero(13, 6), 14, 2, 4), std::invalid_argument);
  EXPECT_THROW(reconstructionError(bad, Eigen::MatrixXd::Zero(2, 2)), std::invalid_argument);
}

Eigen::MatrixXd matrixOf(const Json& json) {
  Eigen::MatrixXd matrix(json.size(), json.at(std::size_t{0}).size());
  for (std::size_t row = 0; row < json.size(); ++row)
    for (std::size_t column = 0; column < json.at(row).size(); ++column) {
      const Json value = json.at(row).at(column);
      matrix(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) =
          value.isNull() ? std::nan("") : value.asDouble();
    }
  return matrix;
}

// floor: tolerance relative to the largest value (the golden numbers are sums of terms that nearly
// cancel).
void expectNear(const Eigen::MatrixXd& ours,
                const Eigen::MatrixXd& golden,
                double relative,
                double floorPart = 1e-9) {
  ASSERT_LE(ours.rows(), golden.rows());
  const double floor = floorPart * golden.cwiseAbs().maxCoeff();
  for (Eigen::Index p = 0; p < ours.rows(); ++p)
    for (Eigen::Index q = 0; q < ours.cols(); ++q)
      EXPECT_NEAR(ours(p, q), golden(p, q), relative * std::abs(golden(p, q)) + floor)
          << "T" << p << q;
}

// Compares with the results of an independent program.
TEST(ChebyshevMoments, AgreeWithIndependentNumbers) {
  const auto folder = testing::goldenFolder();
  PALPATE_NEED(folder);
  const Json cases = Json::parse(testing::readFile(*folder / "chebyshev.json"));
  ASSERT_EQ(cases.size(), 18u);
  std::size_t compared = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Json one = cases.at(i);
    SCOPED_TRACE(one.at("name").asString());
    const int size = static_cast<int>(one.at("N").asInteger());
    const Json pad = one.at("pad");
    const Eigen::MatrixXd picture = padToSquare(matrixOf(one.at("frame")),
                                                size,
                                                static_cast<int>(pad.at("top").asInteger()),
                                                static_cast<int>(pad.at("left").asInteger()));
    const ChebyshevPolynomials to8(size, 8), to4(size, 4);
    expectNear(chebyshevMoments(picture, to8), matrixOf(one.at("T")), 1e-9);
    const auto turned = chebyshevInvariants(picture, to4, ImageOrientation::kStudy);
    if (turned.empty) {
      EXPECT_EQ(picture.norm(), 0.0);
      continue;
    }
    EXPECT_NEAR(turned.centroidX, one.at("centroid").at(std::size_t{0}).asDouble(), 1e-9);
    EXPECT_NEAR(turned.centroidY, one.at("centroid").at(std::size_t{1}).asDouble(), 1e-9);
    expectNear(chebyshevInvariants(picture, to8, ImageOrientation::kNone).moments,
               matrixOf(one.at("T_translation")),
               3e-6,
               3e-6);
    const Json theta = one.at("theta");
    if (theta.isNull() || !turned.angleDetermined) continue;
    EXPECT_NEAR(turned.angleRad, theta.asDouble(), 1e-8);
    expectNear(turned.moments, matrixOf(one.at("T_rotation_translation")), 1e-6);
    ++compared;
  }
  EXPECT_GE(compared, 10u);
}

}  // namespace
}  // namespace palpate::chebyshev_moments_test
