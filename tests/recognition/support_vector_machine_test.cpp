#include "palpate/recognition/support_vector_machine.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <libsvm/svm.h>

#include "palpate/recognition/discriminant_analysis.h"
#include "palpate/recognition/sample_splits.h"
#include "palpate/recognition/standardisation.h"

#include "recognition/golden_samples.h"
#include "testing/testing.h"

namespace palpate::support_vector_machine_test {
namespace {

using testing::clouds;
using testing::goldenFolder;
using testing::goldenSamples;

// Two points: the plane halfway, |w| = 2 / distance, as long as C >= 2 / distance^2.
TEST(SupportVectorMachine, HalvesTheWayBetweenTwoPoints) {
  Eigen::MatrixXd x(2, 2);
  x << 3, 4, 0, 0;
  const auto machine = SupportVectorMachine::of(x, {0, 1}, 2, {.tolerance = 1e-6});
  ASSERT_EQ(machine.pairs.size(), 1u);
  EXPECT_NEAR(machine.weights(0, 0), 2.0 * 3.0 / 25.0, 1e-5);
  EXPECT_NEAR(machine.weights(0, 1), 2.0 * 4.0 / 25.0, 1e-5);
  EXPECT_NEAR(machine.offsets[0], -1.0, 1e-5);
  const Eigen::MatrixXd decisions = machine.decisions(x);
  EXPECT_NEAR(decisions(0, 0), 1.0, 1e-5);
  EXPECT_NEAR(decisions(1, 0), -1.0, 1e-5);
}

// Samples on a line, one on the wrong side: 0 and 2 are class 1, 1 and 3 class 0. By symmetry the
// plane is at 1.5; it minimises w^2 / 2 + 2 C (max(0, 1 - 1.5 w) + 1 + w / 2): for small C (w below
// 2/3) w = 2 C (1.5 - 0.5) = 2 C.
TEST(SupportVectorMachine, CostsWhatIsOnTheWrongSide) {
  Eigen::MatrixXd x(4, 1);
  x << 0, 2, 1, 3;
  for (const double c : {0.05, 0.2}) {
    const auto machine = SupportVectorMachine::of(x, {1, 1, 0, 0}, 2, {.c = c, .tolerance = 1e-6});
    EXPECT_NEAR(machine.weights(0, 0), 2.0 * c, 1e-5);
  }
}

struct LibsvmModel {
  explicit LibsvmModel(const Eigen::MatrixXd& x, const std::vector<int>& y, double c, double eps)
      : labels(y.begin(), y.end()) {
    for (Eigen::Index i = 0; i < x.rows(); ++i) nodes.push_back(nodesOf(x.row(i)));
    for (auto& row : nodes) rows.push_back(row.data());
    problem.l = static_cast<int>(x.rows());
    problem.y = labels.data();
    problem.x = rows.data();
    svm_parameter parameter{};
    parameter.svm_type = C_SVC;
    parameter.kernel_type = LINEAR;
    parameter.C = c;
    parameter.eps = eps;
    parameter.cache_size = 50;
    parameter.shrinking = 1;
    svm_set_print_string_function([](const char*) {});
    model = svm_train(&problem, &parameter);
  }
  ~LibsvmModel() { svm_free_and_destroy_model(&model); }
  LibsvmModel(const LibsvmModel&) = delete;
  LibsvmModel& operator=(const LibsvmModel&) = delete;

  static std::vector<svm_node> nodesOf(const Eigen::RowVectorXd& row) {
    std::vector<svm_node> list;
    for (Eigen::Index j = 0; j < row.size(); ++j) list.push_back({static_cast<int>(j) + 1, row[j]});
    list.push_back({-1, 0.0});
    return list;
  }
  // Labels come in the order of their first sample; those of these tests are ascending.
  Eigen::VectorXd decisions(const Eigen::RowVectorXd& row) const {
    const auto classes = static_cast<Eigen::Index>(svm_get_nr_class(model));
    Eigen::VectorXd values(classes * (classes - 1) / 2);
    svm_predict_values(model, nodesOf(row).data(), values.data());
    return values;
  }
  int label(const Eigen::RowVectorXd& row) const {
    return static_cast<int>(svm_predict(model, nodesOf(row).data()));
  }

  std::vector<double> labels;
  std::vector<std::vector<svm_node>> nodes;
  std::vector<svm_node*> rows;
  svm_problem problem{};
  svm_model* model = nullptr;
};

TEST(SupportVectorMachine, DecidesAsLibsvm) {
  const SampleSet samples = clouds(5, 20, 3, 3.0, 11);  // classes overlap
  for (const double c : {0.1, 1.0, 100.0}) {
    const auto machine =
        SupportVectorMachine::of(samples.x, samples.y, 5, {.c = c, .tolerance = 1e-5});
    const LibsvmModel oracle(samples.x, samples.y, c, 1e-5);
    const Eigen::MatrixXd decisions = machine.decisions(samples.x);
    double worst = 0.0;
    for (Eigen::Index i = 0; i < samples.x.rows(); ++i)
      worst = std::max(worst,
                       (decisions.row(i).transpose() - oracle.decisions(samples.x.row(i)))
                           .cwiseAbs()
                           .maxCoeff());
    // OpenCV's kernel has single precision (6e-8), and the alphas grow with C.
    EXPECT_LT(worst, 3e-4 * std::max(c, 5.0)) << "C = " << c;
  }
}

TEST(SupportVectorMachine, CallsRealGraspsAsLibsvm) {
  const auto folder = goldenFolder();
  PALPATE_NEED(folder);
  const SampleSet all = goldenSamples(*folder);
  const SampleSplit split = stratifiedSplits(all.y, 1, 4).front();
  SampleSet train = all.rows(split.train), test = all.rows(split.test);
  const Standardisation scale = Standardisation::of(train.x);
  const auto lda = DiscriminantAnalysis::of(scale.apply(train.x), train.y, {.components = 14});
  const Eigen::MatrixXd x = lda.apply(scale.apply(train.x)), z = lda.apply(scale.apply(test.x));
  const auto machine = SupportVectorMachine::of(x, train.y, all.numClasses());
  const LibsvmModel oracle(x, train.y, 100.0, 1e-3);
  const Eigen::MatrixXd decisions = machine.decisions(z);
  int same = 0;
  Eigen::Index sameSign = 0;
  for (Eigen::Index i = 0; i < z.rows(); ++i) {
    Eigen::Index called = 0;
    machine.votes(decisions.row(i).transpose()).maxCoeff(&called);
    same += called == oracle.label(z.row(i)) ? 1 : 0;
    const Eigen::VectorXd theirs = oracle.decisions(z.row(i));
    sameSign += ((theirs.array() > 0.0) == (decisions.row(i).transpose().array() > 0.0)).count();
  }
  EXPECT_GE(same, z.rows() - 2) << "LIBSVM gives a tie to the first class";
  EXPECT_GE(static_cast<double>(sameSign), 0.999 * static_cast<double>(z.rows() * 630));
}

TEST(SupportVectorMachine, TiesGoByTheSumOfDistances) {
  // Three classes win against each other in a cycle, and all of them win against class 3: 0 over 1
  // by 1, 1 over 2 by 2, 2 over 0 by 5.
  SupportVectorMachine machine;
  machine.numClasses = 4;
  machine.pairs = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
  machine.weights = Eigen::MatrixXd::Ones(6, 1);
  machine.offsets = Eigen::VectorXd::Zero(6);
  Eigen::VectorXd decisions(6);
  decisions << 1.0, -5.0, 6.0, 2.0, 6.0, 6.0;  // sums: 2, 7, 9
  const Eigen::VectorXd votes = machine.votes(decisions);
  Eigen::Index best = 0;
  votes.maxCoeff(&best);
  EXPECT_EQ(best, 2);
  EXPECT_EQ(std::floor(votes[3] + 0.5), 0.0);
  for (const int c : {0, 1, 2}) EXPECT_EQ(std::floor(votes[c] + 0.5), 2.0);
  // The same decision with a hundredth of the distance: sums 6.95, 7, 4.05.
  machine.weights(1, 0) = 100.0;
  machine.votes(decisions).maxCoeff(&best);
  EXPECT_EQ(best, 1);
}

TEST(SupportVectorMachine, ClassesWithoutSamplesTakeNoPart) {
  const SampleSet samples = clouds(2, 5, 2, 6.0, 2);
  std::vector<int> y = samples.y;
  for (int& label : y) label = label == 0 ? 1 : 3;
  const auto machine = SupportVectorMachine::of(samples.x, y, 5);
  ASSERT_EQ(machine.pairs.size(), 1u);
  EXPECT_EQ(machine.pairs[0], (std::pair<int, int>{1, 3}));
  EXPECT_EQ(machine.votes(Eigen::VectorXd::Constant(1, -2.0)).size(), 5);
}

TEST(SupportVectorMachine, RefusesWhatHasNoPairs) {
  const SampleSet samples = clouds(2, 3, 2, 6.0, 2);
  EXPECT_THROW(SupportVectorMachine::of(samples.x, std::vector<int>(6, 0), 2),
               std::invalid_argument);
  EXPECT_THROW(SupportVectorMachine::of(samples.x, {0, 1}, 2), std::invalid_argument);
  EXPECT_THROW(SupportVectorMachine::of(samples.x, {0, 0, 0, 1, 1, 2}, 2), std::invalid_argument);
  EXPECT_THROW(SupportVectorMachine::of(samples.x, samples.y, 2, {.c = 0.0}),
               std::invalid_argument);
  Eigen::MatrixXd x = samples.x;
  x(0, 0) = std::nan("");
  EXPECT_THROW(SupportVectorMachine::of(x, samples.y, 2), std::invalid_argument);
  const auto machine = SupportVectorMachine::of(samples.x, samples.y, 2);
  EXPECT_THROW(machine.decisions(Eigen::MatrixXd::Zero(1, 3)), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::support_vector_machine_test
