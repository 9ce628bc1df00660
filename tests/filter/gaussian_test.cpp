#include "palpate/filter/gaussian.h"

#include <cmath>
#include <random>
#include <stdexcept>

#include <opencv2/imgproc.hpp>

#include "palpate/core/json.h"
#include "palpate/device/sdh2.h"
#include "palpate/model/hand_description.h"

#include "testing/testing.h"

namespace palpate::gaussian_test {
namespace {

MatrixValues randomMatrix(int rows, int columns, unsigned seed) {
  std::mt19937 random(seed);
  MatrixValues values(rows, columns);
  for (Eigen::Index i = 0; i < values.size(); ++i)
    values.data()[i] = random() % 2 ? static_cast<float>(random() % 4096) : 0.0F;
  return values;
}

// OpenCV is the reference: an independent implementation with the same definition.
TEST(Gaussian, AgreesWithOpenCvWhereNothingIsMasked) {
  for (const auto& [size, sigma] : {std::pair{3, 0.0}, {3, 0.5}, {5, 0.0}, {7, 2.0}, {31, 4.0}}) {
    MatrixValues values = randomMatrix(14, 6, static_cast<unsigned>(size));
    const MatrixLayout layout = MatrixLayout::full(14, 6, 3.4);
    const GaussianOptions options{size, sigma};
    cv::Mat expected;
    cv::GaussianBlur(cv::Mat(14, 6, CV_32F, values.data()),
                     expected,
                     cv::Size(size, size),
                     options.effectiveSigma(),
                     options.effectiveSigma(),
                     cv::BORDER_REPLICATE);
    const MatrixValues filtered = gaussianFiltered(values, layout, options);
    for (int y = 0; y < 14; ++y)
      for (int x = 0; x < 6; ++x)
        ASSERT_NEAR(filtered(y, x), expected.at<float>(y, x), 2e-3) << size << " " << y << " " << x;
  }
}

TEST(Gaussian, DefaultIsTheBinomialKernel) {
  // sigma 0.849322 = 2 / 2.3548: neighbours weigh half the middle, so [1 2 1] / 4 both ways.
  MatrixValues values = MatrixValues::Zero(5, 5);
  values(2, 2) = 16.0F;
  const MatrixValues out = gaussianFiltered(values, MatrixLayout::full(5, 5, 1.0));
  EXPECT_NEAR(out(2, 2), 4.0, 1e-4);
  EXPECT_NEAR(out(2, 1), 2.0, 1e-4);
  EXPECT_NEAR(out(1, 1), 1.0, 1e-4);
  EXPECT_EQ(out(0, 0), 0.0F);
}

TEST(Gaussian, MaskedTaxelsAreNeitherReadNorWritten) {
  const MatrixLayout& layout = sdh2().layout->matrix(1);  // a fingertip: two corners cut off
  MatrixValues values = MatrixValues::Constant(layout.rows, layout.columns, 100.0F);
  MatrixValues poisoned = values;
  for (int y = 0; y < layout.rows; ++y)
    for (int x = 0; x < layout.columns; ++x)
      if (!layout.exists(y, x)) poisoned(y, x) = std::nanf("");
  const MatrixValues out = gaussianFiltered(poisoned, layout);
  for (int y = 0; y < layout.rows; ++y)
    for (int x = 0; x < layout.columns; ++x)
      EXPECT_NEAR(out(y, x), layout.exists(y, x) ? 100.0F : 0.0F, 1e-4) << y << " " << x;
}

TEST(Gaussian, EqualsTheIndependentNumbers) {
  const auto folder = testing::goldenFolder();
  PALPATE_NEED(folder);
  const Json settings = Json::parse(testing::readFile(*folder / "filters.json"));
  const HandDescription& hand = sdh2();
  const auto frameOf = [&](const Json& setting) {
    TactileFrame frame(hand.layout);
    const Json values = setting.at("cells");
    for (std::size_t i = 0; i < frame.values.size(); ++i)
      frame.values[i] = static_cast<float>(values.at(i).asDouble());
    return frame;
  };
  const TactileFrame input = frameOf(settings.at(0));
  ASSERT_EQ(settings.at(0).at("filter").asString(), "none");
  int compared = 0;
  for (std::size_t s = 0; s < settings.size(); ++s) {
    const Json setting = settings.at(s);
    if (setting.at("filter").asString() != "gaussian") continue;
    const auto radius = static_cast<int>(setting.at("params").at("radius").asInteger());
    const GaussianOptions options{2 * radius + 1, setting.at("params").at("sigma").asDouble()};
    const TactileFrame expected = frameOf(setting);
    for (std::size_t m = 0; m < hand.layout->numMatrices(); ++m) {
      // The reference reads the masked corners as zeros: compare with a full matrix.
      const auto& shape = hand.layout->matrix(m);
      const MatrixLayout full = MatrixLayout::full(shape.rows, shape.columns, shape.pitchMm);
      const MatrixValues out = gaussianFiltered(input.matrix(m), full, options);
      EXPECT_LT((out - expected.matrix(m)).cwiseAbs().maxCoeff(), 1e-3) << s << " matrix " << m;
    }
    ++compared;
  }
  EXPECT_GE(compared, 3);
}

TEST(Gaussian, RefusesBadOptions) {
  const MatrixLayout layout = MatrixLayout::full(3, 3, 1.0);
  const MatrixValues values = MatrixValues::Zero(3, 3);
  EXPECT_THROW(gaussianFiltered(values, layout, {2, 0.0}), std::invalid_argument);
  EXPECT_THROW(gaussianFiltered(values, layout, {-3, 0.0}), std::invalid_argument);
  EXPECT_THROW(gaussianFiltered(values, layout, {33, 0.0}), std::invalid_argument);
  EXPECT_THROW(gaussianFiltered(values, layout, {3, -1.0}), std::invalid_argument);
  EXPECT_THROW(gaussianFiltered(values, layout, {3, std::nan("")}), std::invalid_argument);
  EXPECT_THROW(gaussianFiltered(MatrixValues::Zero(2, 3), layout), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::gaussian_test
