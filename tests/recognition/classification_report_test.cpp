#include "palpate/recognition/classification_report.h"

#include <cmath>
#include <stdexcept>

#include "testing/testing.h"

namespace palpate::classification_report_test {
namespace {

// Values of Newcombe 1998, "Two-sided confidence intervals for the single proportion", Statistics
// in Medicine 17, table I, method 3 (score).
TEST(ClassificationReport, WilsonIntervalsAreThePublishedOnes) {
  const struct {
    std::size_t r, n;
    double low, high;
  } rows[] = {{81, 263, 0.2553, 0.3662},
              {15, 148, 0.0624, 0.1605},
              {0, 20, 0.0, 0.1611},
              {1, 29, 0.0061, 0.1718}};
  for (const auto& row : rows) {
    const BinomialInterval interval = wilsonInterval(row.r, row.n);
    EXPECT_NEAR(interval.low, row.low, 5e-5);
    EXPECT_NEAR(interval.high, row.high, 5e-5);
  }
  EXPECT_EQ(wilsonInterval(20, 20).high, 1.0);
  EXPECT_EQ(wilsonInterval(0, 0).low, 0.0);
  EXPECT_EQ(wilsonInterval(0, 0).high, 1.0);
  EXPECT_THROW(wilsonInterval(2, 1), std::invalid_argument);
}

ConfusionMatrix example() {
  ConfusionMatrix confusion({"a", "b", "c"});
  for (int i = 0; i < 6; ++i) confusion.add(0, 0);
  for (int i = 0; i < 2; ++i) confusion.add(0, 1);
  for (int i = 0; i < 4; ++i) confusion.add(1, 1);
  return confusion;
}

TEST(ClassificationReport, FiguresOfClassesGoByTheirDefinition) {
  ConfusionMatrix confusion = example();
  const auto classMetrics = confusion.classMetrics();
  EXPECT_DOUBLE_EQ(classMetrics[0].precision, 1.0);
  EXPECT_DOUBLE_EQ(classMetrics[0].recall, 6.0 / 8.0);
  EXPECT_DOUBLE_EQ(classMetrics[0].f, 2.0 * 0.75 / 1.75);
  EXPECT_EQ(classMetrics[0].support, 8u);
  EXPECT_DOUBLE_EQ(classMetrics[1].precision, 4.0 / 6.0);
  EXPECT_EQ(classMetrics[2].support, 0u);
  EXPECT_EQ(classMetrics[2].f, 0.0) << "no division by nothing";
  EXPECT_DOUBLE_EQ(confusion.accuracy(), 10.0 / 12.0);
  confusion.add(example());
  EXPECT_EQ(confusion.at(0, 1), 4u);
  EXPECT_EQ(confusion.total(), 24u);
  EXPECT_THROW(confusion.add(3, 0), std::out_of_range);
  EXPECT_THROW(confusion.add(0, -2), std::out_of_range);
  EXPECT_THROW(confusion.add(ConfusionMatrix({"x"})), std::invalid_argument);
}

TEST(ClassificationReport, UnknownIsAColumnAndCountsAsWrong) {
  ConfusionMatrix confusion = example();
  EXPECT_EQ(confusion.confusionJson().at("labels").size(), 3u);
  confusion.add(1, ConfusionMatrix::kUnknown);
  EXPECT_EQ(confusion.right(), 10u);
  EXPECT_DOUBLE_EQ(confusion.classMetrics()[1].recall, 0.8);
  const Json json = confusion.confusionJson();
  EXPECT_EQ(json.at("labels").at(3).asString(), "unknown");
  EXPECT_EQ(json.at("counts").at(1).at(3).asInteger(), 1);
  EXPECT_EQ(json.at("counts").at(0).at(1).asInteger(), 2);
  EXPECT_EQ(confusion.classesJson().at(1).at("support").asInteger(), 5);
}

TEST(ClassificationReport, CoverageGoesFromTheSurestDown) {
  const auto curve = coverageCurve({{0.5, false}, {0.9, true}, {0.7, true}, {0.7, false}});
  ASSERT_EQ(curve.size(), 3u) << "equal confidences are one point";
  EXPECT_DOUBLE_EQ(curve[0].coverage, 0.25);
  EXPECT_DOUBLE_EQ(curve[0].accuracy, 1.0);
  EXPECT_DOUBLE_EQ(curve[1].confidence, 0.7);
  EXPECT_DOUBLE_EQ(curve[1].accuracy, 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(curve[2].coverage, 1.0);
  EXPECT_TRUE(coverageCurve({}).empty());
}

TEST(ClassificationReport, SureNeedsEnoughAnswers) {
  std::vector<ScoredPrediction> answers(40, {0.9, true});
  EXPECT_GT(confidenceThreshold(answers), 1.0) << "40 of 40 may still be 93 of 100";
  answers.resize(60, {0.9, true});
  EXPECT_DOUBLE_EQ(confidenceThreshold(answers), 0.9);
  for (int i = 0; i < 20; ++i) answers.push_back({0.6, i % 2 == 0});
  EXPECT_DOUBLE_EQ(confidenceThreshold(answers), 0.9);
  EXPECT_GT(confidenceThreshold({}), 1.0);
}

TEST(ClassificationReport, CalibrationErrorIsTheMeanGap) {
  std::vector<ScoredPrediction> answers;
  for (int i = 0; i < 10; ++i) answers.push_back({0.85, i < 6});
  EXPECT_NEAR(expectedCalibrationError(answers), 0.25, 1e-12);
  for (int i = 0; i < 10; ++i) answers.push_back({0.35, i < 3});
  EXPECT_NEAR(expectedCalibrationError(answers), (0.25 + 0.05) / 2.0, 1e-12);
  EXPECT_EQ(expectedCalibrationError({}), 0.0);
}

TEST(ClassificationReport, AurocCountsPairs) {
  const std::vector<double> positive = {3, 1, 2}, negative = {0, 2};
  EXPECT_DOUBLE_EQ(auroc(positive, negative), (2.0 + 1.0 + 1.5) / 6.0);
  EXPECT_DOUBLE_EQ(auroc(negative, negative), 0.5);
  EXPECT_TRUE(std::isnan(auroc(positive, {})));
}

}  // namespace
}  // namespace palpate::classification_report_test
