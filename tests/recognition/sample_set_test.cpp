#include "palpate/recognition/sample_set.h"

#include <limits>
#include <stdexcept>

#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"

#include "recognition/golden_samples.h"
#include "testing/testing.h"

namespace palpate::sample_set_test {
namespace {

using testing::clouds;

std::string refusalOf(const SampleSet& samples) {
  try {
    requireLearnable(samples);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST(SampleSet, TakesRowsAndColumnsByIndex) {
  const SampleSet all = clouds(3, 4, 2, 10.0, 1);
  const std::vector<std::size_t> rows = {11, 0};
  const SampleSet part = all.rows(rows);
  EXPECT_EQ(part.y, (std::vector<int>{2, 0}));
  EXPECT_EQ(part.x.row(0), all.x.row(11));
  EXPECT_EQ(part.numClasses(), 3u) << "classes without samples stay";
  EXPECT_EQ(part.counts(), (std::vector<std::size_t>{1, 0, 1}));
  const std::vector<std::size_t> columns = {1};
  EXPECT_EQ(all.columns(columns).features, (std::vector<std::string>{"feature 1"}));
  EXPECT_EQ(all.columns(columns).x.col(0), all.x.col(1));
  const std::vector<std::size_t> beyond = {12};
  EXPECT_THROW(all.rows(beyond), std::out_of_range);
}

TEST(SampleSet, RefusesWhatTeachesNothingAndSaysWhy) {
  EXPECT_EQ(refusalOf(clouds(3, 4, 2, 10.0, 1)), "");
  EXPECT_NE(refusalOf(clouds(1, 4, 2, 10.0, 1)).find("only one class (class 0)"),
            std::string::npos);
  EXPECT_NE(refusalOf(clouds(3, 1, 2, 10.0, 1)).find("no class has more than one"),
            std::string::npos);
  EXPECT_NE(refusalOf({Eigen::MatrixXd(0, 1), {}, {"a", "b"}, {"f"}}).find("no grasp"),
            std::string::npos);
  SampleSet samples = clouds(2, 3, 2, 10.0, 1);
  samples.x(4, 1) = std::numeric_limits<double>::quiet_NaN();
  const std::string refusal = refusalOf(samples);
  for (const char* word : {"grasp 4", "class 1", "feature 1"})
    EXPECT_NE(refusal.find(word), std::string::npos) << refusal;
  samples.x.setConstant(3.0);
  EXPECT_NE(refusalOf(samples).find("no feature varies"), std::string::npos);
  samples.y.pop_back();
  EXPECT_THROW(requireLearnable(samples), std::invalid_argument) << "a broken contract is no Error";
}

TEST(SampleSet, SaysWhatIsWeak) {
  SampleSet samples = clouds(3, 2, 2, 10.0, 1);
  EXPECT_TRUE(learningNotes(samples).empty());
  samples.x.col(1).setConstant(5.0);
  samples.y = {0, 0, 1, 1, 1, 2};
  const auto notes = learningNotes(samples);
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_NE(notes[0].find("feature 1"), std::string::npos);
  EXPECT_NE(notes[1].find("class 2"), std::string::npos);
}

TEST(SampleSet, ComesFromATableAndRefusesRowsWithoutClass) {
  FeatureTable table;
  table.names = {"a"};
  table.rows.resize(3);
  table.rows[0] = {"pen", "x.dsa", 1, 2, 1, 2, 0, {1.5}};
  table.rows[1] = {"ball", "y.dsa", 1, 2, 1, 2, 0, {2.5}};
  table.rows[2] = {"pen", "z.dsa", 1, 2, 1, 2, 0, {3.5}};
  const SampleSet samples = samplesOf(table);
  EXPECT_EQ(samples.classes, (std::vector<std::string>{"ball", "pen"}));
  EXPECT_EQ(samples.y, (std::vector<int>{1, 0, 1}));
  EXPECT_EQ(samples.x(2, 0), 3.5);
  EXPECT_THROW(samplesOf(table, {"pen"}), FileError);
  table.rows[1].className.clear();
  EXPECT_THROW(samplesOf(table), FileError);
}

TEST(SampleSet, PartsOfTheStudyAreThoseOfItsTable) {
  const auto names = featureNames(FeatureSet::kStudy, sdh2());
  const SampleSet study{Eigen::MatrixXd::Zero(1, 54), {0}, {"a"}, names};
  EXPECT_EQ(studyPart(study, StudyPart::kDiameter).features,
            (std::vector<std::string>{"diameter"}));
  EXPECT_EQ(studyPart(study, StudyPart::kFirst4).features,
            (std::vector<std::string>{"diameter", "compressibility", "std_1", "std_5"}));
  EXPECT_EQ(studyPart(study, StudyPart::kMoments).features.front(), "m1_T00");
  EXPECT_EQ(studyPart(study, StudyPart::kMoments).numFeatures(), 50u);
  EXPECT_EQ(studyPart(study, StudyPart::kAll).numFeatures(), 54u);
  EXPECT_THROW(studyPart(clouds(2, 2, 2, 1.0, 1), StudyPart::kAll), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::sample_set_test
