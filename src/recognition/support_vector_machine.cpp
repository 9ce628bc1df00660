#include "palpate/recognition/support_vector_machine.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include <opencv2/core.hpp>
#include <opencv2/ml.hpp>

namespace palpate {
namespace {

[[noreturn]] void refuseSupportVectorMachine(const std::string& what) {
  throw std::invalid_argument("SupportVectorMachine: " + what);
}

cv::Ptr<cv::ml::SVM> trained(const Eigen::MatrixXd& x,
                             const std::vector<int>& y,
                             const SvmOptions& options) {
  cv::Mat samples(static_cast<int>(x.rows()), static_cast<int>(x.cols()), CV_32F);
  for (int i = 0; i < samples.rows; ++i)
    for (int j = 0; j < samples.cols; ++j) samples.at<float>(i, j) = static_cast<float>(x(i, j));
  const cv::Mat labels(y, true);
  const auto svm = cv::ml::SVM::create();
  svm->setType(cv::ml::SVM::C_SVC);
  svm->setKernel(cv::ml::SVM::LINEAR);
  svm->setC(options.c);
  svm->setTermCriteria({cv::TermCriteria::MAX_ITER + cv::TermCriteria::EPS,
                        options.maxIterations,
                        options.tolerance});
  svm->train(samples, cv::ml::ROW_SAMPLE, labels);
  return svm;
}

// Each decision function is a sum over support vectors minus rho.
void takePlanes(const cv::ml::SVM& svm, SupportVectorMachine& machine) {
  const cv::Mat vectors = svm.getSupportVectors();
  const auto pairs = static_cast<Eigen::Index>(machine.pairs.size());
  machine.weights = Eigen::MatrixXd::Zero(pairs, vectors.cols);
  machine.offsets.resize(pairs);
  cv::Mat alpha, index;
  for (Eigen::Index p = 0; p < pairs; ++p) {
    machine.offsets[p] = -svm.getDecisionFunction(static_cast<int>(p), alpha, index);
    for (int k = 0; k < static_cast<int>(alpha.total()); ++k) {
      const auto* vector = vectors.ptr<float>(index.at<int>(k));
      for (int j = 0; j < vectors.cols; ++j)
        machine.weights(p, j) += alpha.at<double>(k) * static_cast<double>(vector[j]);
    }
  }
}

}  // namespace

void SvmOptions::validate() const {
  constexpr OptionCheck check{"SvmOptions"};
  check(kC, "c", c);
  check(tolerance > 0.0, "tolerance", tolerance);
  check(maxIterations >= 1, "maxIterations", maxIterations);
}

SupportVectorMachine SupportVectorMachine::of(const Eigen::MatrixXd& x,
                                              const std::vector<int>& y,
                                              std::size_t numClasses,
                                              const SvmOptions& options) {
  options.validate();
  if (static_cast<std::size_t>(x.rows()) != y.size())
    refuseSupportVectorMachine(std::to_string(x.rows()) + " samples, " + std::to_string(y.size()) +
                               " labels");
  std::vector<bool> present(numClasses, false);
  for (const int label : y) {
    if (label < 0 || static_cast<std::size_t>(label) >= numClasses)
      refuseSupportVectorMachine("label " + std::to_string(label) + " of " +
                                 std::to_string(numClasses) + " classes");
    present[static_cast<std::size_t>(label)] = true;
  }
  // OpenCV reports invalid input by its own exception and prints it on stderr, so that invalid
  // input is refused before.
  if (!x.allFinite()) refuseSupportVectorMachine("a feature is not a number");
  if (x.cols() == 0) refuseSupportVectorMachine("no features");
  SupportVectorMachine machine;
  machine.numClasses = numClasses;
  // The pairs are in OpenCV's order.
  for (std::size_t a = 0; a < numClasses; ++a)
    for (std::size_t b = a + 1; b < numClasses; ++b)
      if (present[a] && present[b])
        machine.pairs.emplace_back(static_cast<int>(a), static_cast<int>(b));
  if (machine.pairs.empty()) refuseSupportVectorMachine("fewer than two classes with samples");
  takePlanes(*trained(x, y, options), machine);
  return machine;
}

Eigen::MatrixXd SupportVectorMachine::decisions(const Eigen::MatrixXd& x) const {
  if (x.cols() != weights.cols())
    refuseSupportVectorMachine(std::to_string(x.cols()) + " features, fitted to " +
                               std::to_string(weights.cols()));
  return (x * weights.transpose()).rowwise() + offsets.transpose();
}

Eigen::VectorXd SupportVectorMachine::votes(const Eigen::VectorXd& decisions) const {
  if (static_cast<std::size_t>(decisions.size()) != pairs.size())
    refuseSupportVectorMachine(std::to_string(decisions.size()) + " decisions of " +
                               std::to_string(pairs.size()) + " pairs");
  const auto classes = static_cast<Eigen::Index>(numClasses);
  Eigen::VectorXd votes = Eigen::VectorXd::Zero(classes), distance = votes;
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const auto at = static_cast<Eigen::Index>(p);
    const auto [first, second] = pairs[p];
    votes[decisions[at] > 0.0 ? first : second] += 1.0;
    const double length = weights.row(at).norm();
    const double along = length > 0.0 ? decisions[at] / length : 0.0;
    distance[first] += along;
    distance[second] -= along;
  }
  for (Eigen::Index c = 0; c < classes; ++c)
    votes[c] += 0.49 * distance[c] / (1.0 + std::abs(distance[c]));
  return votes;
}

Eigen::VectorXd SupportVectorMachine::featureWeights() const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(weights.cols());
  for (Eigen::Index p = 0; p < weights.rows(); ++p) {
    const double length = weights.row(p).squaredNorm();
    if (length > 0.0) sum += weights.row(p).cwiseAbs2().transpose() / length;
  }
  const Eigen::VectorXd root = sum.cwiseSqrt();
  const double total = root.sum();
  return total > 0.0 ? Eigen::VectorXd(root / total) : root;
}

}  // namespace palpate
