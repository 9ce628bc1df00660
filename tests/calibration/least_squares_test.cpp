#include "palpate/calibration/least_squares.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <stdexcept>

#include <Eigen/LU>

#include "palpate/core/number_text.h"

#include "testing/testing.h"

namespace palpate::least_squares_test {
namespace {

// One problem of NIST/ITL StRD (nonlinear regression; public domain), in tests/calibration/nist as
// Ceres ships it.
struct NistProblem {
  std::vector<double> starts[2], certified, certifiedSd;
  double certifiedSum = 0.0;
  std::vector<double> y;
  std::vector<std::vector<double>> x;  // per observation
};

NistProblem readNist(const std::string& name) {
  const std::string text = testing::readFile(testing::dataFolder().parent_path() /
                                             "tests/calibration/nist" / (name + ".dat"));
  NistProblem problem;
  std::istringstream lines(text);
  bool data = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("Residual Sum of Squares:"))
      problem.certifiedSum = parseDouble(line.substr(line.find(':') + 1)).value();
    std::istringstream in(line);
    std::vector<double> numbers;
    std::string first, word;
    if (line.find(" = ") != std::string::npos && line.find_first_not_of(' ') != std::string::npos &&
        line[line.find_first_not_of(' ')] == 'b') {
      in >> first >> word;
      while (in >> word)
        if (const auto number = parseDouble(word)) numbers.push_back(*number);
      if (numbers.size() != 4) continue;
      problem.starts[0].push_back(numbers[0]);
      problem.starts[1].push_back(numbers[1]);
      problem.certified.push_back(numbers[2]);
      problem.certifiedSd.push_back(numbers[3]);
      continue;
    }
    if (line.starts_with("Data:") && !problem.certified.empty()) {
      data = true;
      continue;
    }
    if (!data) continue;
    while (in >> word)
      if (const auto number = parseDouble(word)) numbers.push_back(*number);
    if (numbers.size() < 2) continue;
    problem.y.push_back(numbers[0]);
    problem.x.emplace_back(numbers.begin() + 1, numbers.end());
  }
  return problem;
}

using Model = double (*)(std::span<const double> b, double x);
struct Named {
  const char* name;
  Model model;
};

double cubics(std::span<const double> b, double x) {
  return (b[0] + x * (b[1] + x * (b[2] + x * b[3]))) / (1 + x * (b[4] + x * (b[5] + x * b[6])));
}
double threeDecays(std::span<const double> b, double x) {
  return b[0] * std::exp(-b[1] * x) + b[2] * std::exp(-b[3] * x) + b[4] * std::exp(-b[5] * x);
}
double chwirut(std::span<const double> b, double x) {
  return std::exp(-b[0] * x) / (b[1] + b[2] * x);
}
double gauss(std::span<const double> b, double x) {
  return b[0] * std::exp(-b[1] * x) + b[2] * std::exp(-std::pow((x - b[3]) / b[4], 2)) +
         b[5] * std::exp(-std::pow((x - b[6]) / b[7], 2));
}
double enso(std::span<const double> b, double x) {
  const double w = 2 * M_PI * x;
  return b[0] + b[1] * std::cos(w / 12) + b[2] * std::sin(w / 12) + b[4] * std::cos(w / b[3]) +
         b[5] * std::sin(w / b[3]) + b[7] * std::cos(w / b[6]) + b[8] * std::sin(w / b[6]);
}

const std::vector<Named>& models() {
  using B = std::span<const double>;
  static const std::vector<Named> all = {
      {"Misra1a", [](B b, double x) { return b[0] * (1 - std::exp(-b[1] * x)); }},
      {"Misra1b", [](B b, double x) { return b[0] * (1 - std::pow(1 + b[1] * x / 2, -2)); }},
      {"Misra1c", [](B b, double x) { return b[0] * (1 - std::pow(1 + 2 * b[1] * x, -0.5)); }},
      {"Misra1d", [](B b, double x) { return b[0] * b[1] * x / (1 + b[1] * x); }},
      {"Chwirut1", &chwirut},
      {"Chwirut2", &chwirut},
      {"Lanczos1", &threeDecays},
      {"Lanczos2", &threeDecays},
      {"Lanczos3", &threeDecays},
      {"Gauss1", &gauss},
      {"Gauss2", &gauss},
      {"Gauss3", &gauss},
      {"DanWood", [](B b, double x) { return b[0] * std::pow(x, b[1]); }},
      {"Kirby2",
       [](B b, double x) { return (b[0] + x * (b[1] + x * b[2])) / (1 + x * (b[3] + x * b[4])); }},
      {"Hahn1", &cubics},
      {"MGH17",
       [](B b, double x) {
         return b[0] + b[1] * std::exp(-x * b[3]) + b[2] * std::exp(-x * b[4]);
       }},
      {"Roszman1",
       [](B b, double x) { return b[0] - b[1] * x - std::atan(b[2] / (x - b[3])) / M_PI; }},
      {"ENSO", &enso},
      {"MGH09",
       [](B b, double x) { return b[0] * (x * x + x * b[1]) / (x * x + x * b[2] + b[3]); }},
      {"Thurber", &cubics},
      {"BoxBOD", [](B b, double x) { return b[0] * (1 - std::exp(-b[1] * x)); }},
      {"Rat42", [](B b, double x) { return b[0] / (1 + std::exp(b[1] - b[2] * x)); }},
      {"MGH10", [](B b, double x) { return b[0] * std::exp(b[1] / (x + b[2])); }},
      {"Eckerle4",
       [](B b, double x) { return b[0] / b[1] * std::exp(-0.5 * std::pow((x - b[2]) / b[1], 2)); }},
      {"Rat43",
       [](B b, double x) { return b[0] / std::pow(1 + std::exp(b[1] - b[2] * x), 1 / b[3]); }},
      {"Bennett5", [](B b, double x) { return b[0] * std::pow(b[1] + x, -1 / b[2]); }}};
  return all;
}

LeastSquaresProblem problemOf(const std::string& name, const NistProblem& nist) {
  LeastSquaresProblem problem;
  problem.numResiduals = nist.y.size();
  if (name == "Nelson") {  // log y, two predictors
    problem.residuals = [&nist](std::span<const double> b, std::span<double> r) {
      for (std::size_t i = 0; i < r.size(); ++i)
        r[i] = std::log(nist.y[i]) - (b[0] - b[1] * nist.x[i][0] * std::exp(-b[2] * nist.x[i][1]));
      return true;
    };
    return problem;
  }
  const Model model = std::find_if(models().begin(), models().end(), [&](const Named& m) {
                        return m.name == name;
                      })->model;
  problem.residuals = [&nist, model](std::span<const double> b, std::span<double> r) {
    for (std::size_t i = 0; i < r.size(); ++i) r[i] = nist.y[i] - model(b, nist.x[i][0]);
    return true;
  };
  return problem;
}

// Digits that agree (log relative error), 11 at most: more are not certified.
double digits(double found, double certified) {
  const double error = std::abs(found - certified) / std::abs(certified);
  return error == 0.0 ? 11.0 : std::clamp(-std::log10(error), 0.0, 11.0);
}

TEST(LeastSquares, SolvesAllNistProblemsFromBothStartsToFourDigits) {
  std::vector<std::string> names = {"Nelson"};
  for (const Named& model : models()) names.emplace_back(model.name);
  ASSERT_EQ(names.size(), 27u);
  double sum = 0.0;
  int runs = 0;
  for (const std::string& name : names) {
    NistProblem nist = readNist(name);
    ASSERT_FALSE(nist.certified.empty()) << name;
    ASSERT_GE(nist.y.size(), nist.certified.size()) << name;
    // NIST certifies 2.0196866396E-01; the file as Ceres ships it says 1.20196866396E-0.
    if (name == "Roszman1") nist.certified[0] = 2.0196866396E-01;
    const LeastSquaresProblem problem = problemOf(name, nist);
    for (int s = 0; s < 2; ++s) {
      SCOPED_TRACE(name + " start " + std::to_string(s + 1));
      const auto& from = nist.starts[s];
      const LeastSquaresReport report = solveLeastSquares(
          problem,
          Eigen::Map<const Eigen::VectorXd>(from.data(), static_cast<Eigen::Index>(from.size())));
      double fewest = 11.0, fewestSd = 11.0;
      for (std::size_t i = 0; i < nist.certified.size(); ++i) {
        const auto k = static_cast<Eigen::Index>(i);
        fewest = std::min(fewest, digits(report.x[k], nist.certified[i]));
        fewestSd =
            std::min(fewestSd, digits(std::sqrt(report.covariance(k, k)), nist.certifiedSd[i]));
      }
      std::printf("%-9s start %d: %4.1f digits, sd %4.1f, %d iterations%s\n",
                  name.c_str(),
                  s + 1,
                  fewest,
                  fewestSd,
                  report.iterations,
                  report.converged ? "" : ", not converged");
      EXPECT_GE(fewest, 4.0) << report.message;
      EXPECT_GE(digits(report.sumOfSquares, nist.certifiedSum),
                nist.certifiedSum < 1e-20 ? 0.0 : 4.0);
      sum += fewest;
      ++runs;
    }
  }
  std::printf("mean %.1f digits over %d runs\n", sum / runs, runs);
}

// r = y - (a + b x) of five points.
LeastSquaresProblem line() {
  LeastSquaresProblem problem;
  problem.numResiduals = 5;
  problem.residuals = [](std::span<const double> b, std::span<double> r) {
    const double y[] = {1.0, 3.2, 5.0, 7.1, 8.7};
    for (std::size_t i = 0; i < 5; ++i) r[i] = y[i] - b[0] - b[1] * static_cast<double>(i);
    return true;
  };
  return problem;
}

TEST(LeastSquares, SolvesALineWithItsCovariance) {
  // Sums: n 5, x 10, xx 30, y 25, xy 69.3; b = (5 69.3 - 250) / 50 = 1.93, a = 5 - 2 b = 1.14.
  const LeastSquaresReport report = solveLeastSquares(line(), Eigen::Vector2d(0.0, 0.0));
  EXPECT_TRUE(report.converged);
  EXPECT_NEAR(report.x[0], 1.14, 1e-9);
  EXPECT_NEAR(report.x[1], 1.93, 1e-9);
  double sum = 0.0;
  const double y[] = {1.0, 3.2, 5.0, 7.1, 8.7};
  for (int i = 0; i < 5; ++i) sum += std::pow(y[i] - 1.14 - 1.93 * i, 2);
  EXPECT_NEAR(report.sumOfSquares, sum, 1e-12);
  EXPECT_NEAR(report.residualSd, std::sqrt(sum / 3.0), 1e-12);
  // s^2 (X^T X)^-1 = s^2 / 50 [30 -10; -10 5]
  EXPECT_NEAR(report.covariance(0, 0), sum / 3.0 * 0.6, 1e-9);
  EXPECT_NEAR(report.covariance(0, 1), sum / 3.0 * -0.2, 1e-9);
  EXPECT_NEAR(report.covariance(1, 1), sum / 3.0 * 0.1, 1e-9);
}

TEST(LeastSquares, UsesGivenDerivatives) {
  LeastSquaresProblem problem = line();
  int calls = 0;
  problem.jacobian = [&calls](std::span<const double>, std::span<double> jacobian) {
    ++calls;
    for (std::size_t i = 0; i < 5; ++i) {
      jacobian[2 * i] = -1.0;
      jacobian[2 * i + 1] = -static_cast<double>(i);
    }
    return true;
  };
  EXPECT_NEAR(solveLeastSquares(problem, Eigen::Vector2d(0.0, 0.0)).x[1], 1.93, 1e-9);
  EXPECT_GT(calls, 0);
}

// The mean of a constant model, robustly: y = 0, 1, 2, 3, 20 and scale 2. Huber: (0 + 1 + 2 + 3 - 4
// x + 2) = 0 gives x = 2. Cauchy: zero of sum r / (1 + r^2 / 4), by bisection.
LeastSquaresProblem location(LeastSquaresLoss loss) {
  LeastSquaresProblem problem;
  problem.numResiduals = 5;
  problem.residuals = [](std::span<const double> b, std::span<double> r) {
    const double y[] = {0.0, 1.0, 2.0, 3.0, 20.0};
    for (std::size_t i = 0; i < 5; ++i) r[i] = y[i] - b[0];
    return true;
  };
  problem.loss = loss;
  problem.lossScale = 2.0;
  return problem;
}

TEST(LeastSquares, MinimisesRobustLosses) {
  const Eigen::VectorXd start = Eigen::VectorXd::Constant(1, 1.0);
  const LeastSquaresReport huber = solveLeastSquares(location(LeastSquaresLoss::kHuber), start);
  EXPECT_NEAR(huber.x[0], 2.0, 1e-6);
  // Weights a / |r| beyond a = 2: 1, 1, 1, 1, 2/18; the sum of rho: 4 + 1 + 0 + 1 + (2 2 18 - 4).
  ASSERT_EQ(huber.weights.size(), 5u);
  EXPECT_NEAR(huber.weights[4], 1.0 / 9.0, 1e-6);
  EXPECT_NEAR(huber.sumOfSquares, 74.0, 1e-6);
  // Of the weighted squares: (4 + 1 + 0 + 1 + 324 / 9) / 4, over the sum of weights.
  EXPECT_NEAR(huber.residualSd * huber.residualSd, 42.0 / 4.0, 1e-4);
  EXPECT_NEAR(huber.covariance(0, 0), 42.0 / 4.0 / (4.0 + 1.0 / 9.0), 1e-4);

  const LeastSquaresReport cauchy = solveLeastSquares(location(LeastSquaresLoss::kCauchy), start);
  const auto slope = [](double x) {
    double sum = 0.0;
    for (const double y : {0.0, 1.0, 2.0, 3.0, 20.0})
      sum += (y - x) / (1.0 + (y - x) * (y - x) / 4.0);
    return sum;
  };
  double low = 0.0, high = 3.0;
  for (int i = 0; i < 100; ++i) (slope(0.5 * (low + high)) > 0.0 ? low : high) = 0.5 * (low + high);
  EXPECT_NEAR(cauchy.x[0], low, 1e-6);
  EXPECT_NEAR(cauchy.weights[4], 1.0 / (1.0 + std::pow((20.0 - low) / 2.0, 2)), 1e-6);
}

// A line through points of which one is far away, against weighted squares that are solved again
// until the weights no longer change.
TEST(LeastSquares, FindsTheLineOfReweightedSquares) {
  const Eigen::VectorXd y =
      (Eigen::VectorXd(8) << 1.0, 3.2, 5.0, 7.1, 8.7, 40.0, 13.1, 14.8).finished();
  Eigen::MatrixX2d columns(8, 2);
  for (int i = 0; i < 8; ++i) columns.row(i) << 1.0, i;
  for (const LeastSquaresLoss loss : {LeastSquaresLoss::kHuber, LeastSquaresLoss::kCauchy}) {
    const double scale = 0.5;
    const bool huber = loss == LeastSquaresLoss::kHuber;
    Eigen::Vector2d expected(1.0, 2.0);
    Eigen::ArrayXd weights;
    Eigen::Matrix2d inverse;
    for (int i = 0; i < 500; ++i) {
      const Eigen::ArrayXd ratio = (y - columns * expected).array().abs() / scale;
      weights = huber ? Eigen::ArrayXd(1.0 / ratio.max(1.0))
                      : Eigen::ArrayXd(1.0 / (1.0 + ratio.square()));
      const Eigen::Matrix2Xd weighted = columns.transpose() * weights.matrix().asDiagonal();
      inverse = (weighted * columns).inverse();
      expected = inverse * (weighted * y);
    }
    const Eigen::ArrayXd residuals = y - columns * expected;
    double sum = 0.0;
    for (const double r : residuals)
      sum += !huber                 ? scale * scale * std::log1p(r * r / (scale * scale))
             : std::abs(r) <= scale ? r * r
                                    : 2.0 * scale * std::abs(r) - scale * scale;
    LeastSquaresProblem problem;
    problem.numResiduals = 8;
    problem.residuals = [&](std::span<const double> b, std::span<double> r) {
      Eigen::Map<Eigen::VectorXd>(r.data(), 8) = y - columns * Eigen::Vector2d(b[0], b[1]);
      return true;
    };
    problem.jacobian = [&](std::span<const double>, std::span<double> jacobian) {
      Eigen::Map<Eigen::Matrix<double, 8, 2, Eigen::RowMajor>>(jacobian.data()) = -columns;
      return true;
    };
    problem.loss = loss;
    problem.lossScale = scale;
    // The line through the first two points: two residuals are 0 at the start.
    const LeastSquaresReport report = solveLeastSquares(problem, Eigen::Vector2d(1.0, 2.2));
    EXPECT_TRUE(report.converged);
    const double variance = (weights * residuals.square()).sum() / 6.0;
    EXPECT_NEAR(report.sumOfSquares, sum, 1e-9 * sum);
    EXPECT_NEAR(report.residualSd, std::sqrt(variance), 1e-6);
    for (int r = 0; r < 2; ++r) {
      EXPECT_NEAR(report.x[r], expected[r], 1e-6);
      for (int c = 0; c < 2; ++c)
        EXPECT_NEAR(report.covariance(r, c), variance * inverse(r, c), 1e-6);
    }
  }
}

TEST(LeastSquares, StaysWithinBounds) {
  LeastSquaresProblem bounded = line();
  bounded.lowerBounds = Eigen::Vector2d(-10.0, -10.0);
  bounded.upperBounds = Eigen::Vector2d(10.0, 1.5);
  const LeastSquaresReport report = solveLeastSquares(bounded, Eigen::Vector2d(0.0, 0.0));
  EXPECT_NEAR(report.x[1], 1.5, 1e-9);
  EXPECT_NEAR(report.x[0], 5.0 - 1.5 * 2.0, 1e-6) << "the mean of y less the slope times that of x";
  EXPECT_THROW(solveLeastSquares(bounded, Eigen::Vector2d(0.0, 2.0)), std::invalid_argument);
  bounded.upperBounds = Eigen::VectorXd::Constant(1, 1.0);
  EXPECT_THROW(solveLeastSquares(bounded, Eigen::Vector2d(0.0, 0.0)), std::invalid_argument);
}

TEST(LeastSquares, TellsOfDependentParametersAndOfAModelThatIsNotDefined) {
  LeastSquaresProblem twins = line();
  twins.residuals = [](std::span<const double> b, std::span<double> r) {
    for (std::size_t i = 0; i < 5; ++i) r[i] = 3.0 - b[0] - b[1];
    return true;
  };
  const LeastSquaresReport report = solveLeastSquares(twins, Eigen::Vector2d(0.0, 0.0));
  EXPECT_NEAR(report.x.sum(), 3.0, 1e-6);
  EXPECT_TRUE(std::isnan(report.covariance(0, 0)));
  LeastSquaresProblem undefined = line();
  undefined.residuals = [](std::span<const double>, std::span<double>) { return false; };
  const LeastSquaresReport none = solveLeastSquares(undefined, Eigen::Vector2d(1.0, 2.0));
  EXPECT_FALSE(none.converged);
  EXPECT_EQ(none.x[1], 2.0);
  EXPECT_NE(none.message.find("not defined"), std::string::npos);
}

TEST(LeastSquares, RefusesBrokenContracts) {
  const Eigen::Vector2d start(0.0, 0.0);
  EXPECT_THROW(solveLeastSquares({}, start), std::invalid_argument);
  LeastSquaresProblem few = line();
  few.numResiduals = 1;
  EXPECT_THROW(solveLeastSquares(few, start), std::invalid_argument);
  EXPECT_THROW(solveLeastSquares(line(), Eigen::Vector2d(0.0, std::nan(""))),
               std::invalid_argument);
  EXPECT_THROW(solveLeastSquares(line(), start, {.maxIterations = 0}), std::invalid_argument);
  EXPECT_THROW(solveLeastSquares(line(), start, {.tolerance = 0.0}), std::invalid_argument);
  EXPECT_THROW(solveLeastSquares(line(), start, {.firstRadii = {}}), std::invalid_argument);
  LeastSquaresProblem flat = line();
  flat.lossScale = 0.0;
  EXPECT_THROW(solveLeastSquares(flat, start), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::least_squares_test
