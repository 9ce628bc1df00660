#include "palpate/slip/contact_outline.h"

#include <cmath>
#include <random>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "slip_scene.h"
#include "testing/testing.h"

namespace palpate::contact_outline_test {
namespace {

using testing::viewOf;

TEST(ContactOutline, OfABlockRunsThroughCenters) {
  MatrixValues values = MatrixValues::Zero(14, 6);
  values.block(3, 1, 2, 2).setConstant(300.0F);
  ContactOutline outline(14, 6);
  OutlineShape shape = outline.describe(viewOf(values));
  EXPECT_EQ(shape.groups, 1);
  EXPECT_DOUBLE_EQ(shape.area, 1.0);
  EXPECT_DOUBLE_EQ(shape.length, 4.0);
  EXPECT_DOUBLE_EQ(shape.roundness, M_PI / 4.0);
  values.block(9, 0, 4, 3).setConstant(200.0F);  // larger
  shape = outline.describe(viewOf(values));
  EXPECT_EQ(shape.groups, 2);
  EXPECT_DOUBLE_EQ(shape.area, 6.0);
  EXPECT_DOUBLE_EQ(shape.length, 10.0);
}

TEST(ContactOutline, LinesAndPointsEncloseNothing) {
  ContactOutline outline(14, 6);
  MatrixValues values = MatrixValues::Zero(14, 6);
  EXPECT_EQ(outline.describe(viewOf(values)).groups, 0);
  values(0, 5) = 1.0F;
  OutlineShape shape = outline.describe(viewOf(values));
  EXPECT_EQ(shape.groups, 1);
  EXPECT_EQ(shape.length, 0.0);
  EXPECT_EQ(shape.roundness, 0.0);
  values.col(5).setConstant(7.0F);
  shape = outline.describe(viewOf(values));
  EXPECT_EQ(shape.area, 0.0);
  // The border runs there and back.
  EXPECT_DOUBLE_EQ(shape.length, 26.0);
}

// Compares random patterns with the border following of OpenCV.
TEST(ContactOutline, IsThatOfOpenCv) {
  std::mt19937 random(5);
  for (const auto& [rows, columns] : {std::pair{14, 6}, {13, 6}, {1, 9}, {9, 1}, {30, 40}}) {
    ContactOutline outline(rows, columns);
    for (int trial = 0; trial < 300; ++trial) {
      const unsigned density = 2 + random() % 8;
      MatrixValues values(rows, columns);
      cv::Mat image(rows, columns, CV_8U);
      for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
          const bool on = random() % 10 < density;
          values(y, x) = on ? 100.0F : 0.0F;
          image.at<unsigned char>(y, x) = on ? 255 : 0;
        }
      std::vector<std::vector<cv::Point>> contours;
      cv::findContours(image, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
      double area = 0.0;
      double length = 0.0;
      for (const auto& contour : contours) {
        const double a = cv::contourArea(contour);
        const double l = cv::arcLength(contour, true);
        if (a > area || (a == area && l > length)) {
          area = a;
          length = l;
        }
      }
      const OutlineShape shape = outline.describe(viewOf(values));
      ASSERT_NEAR(shape.area, area, 1e-9) << values;
      // Of two groups with the same area the longer one counts, so that one length remains.
      ASSERT_NEAR(shape.length, length, 1e-4) << values;
    }
  }
}

TEST(ContactOutline, RefusesASizeThatNoMatrixHas) {
  EXPECT_THROW(ContactOutline(0, 6), std::invalid_argument);
  EXPECT_THROW(ContactOutline(14, 257), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::contact_outline_test
