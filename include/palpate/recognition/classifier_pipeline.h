// From features to classes: standardise -> discriminant analysis (where asked for) -> classifier.
// Everything is fitted to the samples it is given, so fitting inside the training fold is fitting
// to the fold.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include <palpate/core/json.h>
#include <palpate/recognition/discriminant_analysis.h>
#include <palpate/recognition/gaussian_classifier.h>
#include <palpate/recognition/probability_calibration.h>
#include <palpate/recognition/sample_set.h>
#include <palpate/recognition/session_adaptive_classifier.h>
#include <palpate/recognition/standardisation.h>
#include <palpate/recognition/support_vector_machine.h>

namespace palpate {

// svm: linear support vector machines, one against one. qda: one Gaussian distribution per class
// (quadratic discriminant analysis). lda: Gaussian distributions with a common covariance matrix.
// gauss: the session-adaptive classifier of session_adaptive_classifier.h, on the original features
// without discriminant analysis.
enum class ClassifierKind { kSvm, kQda, kLda, kGauss };
std::string_view classifierName(ClassifierKind kind) noexcept;
std::optional<ClassifierKind> classifierNamed(std::string_view name) noexcept;

struct PipelineOptions {
  ClassifierKind classifier = ClassifierKind::kSvm;
  std::optional<std::size_t> components;  // of the discriminant analysis; nothing: without it. >= 1
  DiscriminantOptions discriminant;       // its `components` isn't read
  SvmOptions svm;
  ClassGaussianOptions gaussian;  // of qda; lda takes its ridge
  // Contiguous blocks per class that calibrate probabilities (sample_splits.h); 0: none are wanted.
  std::size_t calibrationBlocks = 0;

  // Throws std::invalid_argument with the field's name.
  void validate() const;
};

struct ClassifierPipeline {
  ClassifierKind classifier = ClassifierKind::kSvm;
  std::size_t numClasses = 0;
  Standardisation standardisation;
  std::optional<DiscriminantAnalysis> discriminant;
  SupportVectorMachine svm;     // of svm
  GaussianClassifier gaussian;  // of qda, lda
  std::optional<SessionAdaptiveClassifier>
      sessionAdaptive;  // of gauss; nothing else of the pipeline is used then
  bool calibrated = false;
  std::vector<Sigmoid> sigmoids;  // per pair of svm
  double exponent = 1.0;       // on the coupled probabilities of svm, the densities of the others
  GaussianClassifier novelty;  // what the classifier sees, covariances half of all classes

  // Throws Error (requireLearnable; gauss: a class without samples), std::invalid_argument
  // (options).
  static ClassifierPipeline of(const SampleSet& samples, const PipelineOptions& options = {});

  // Samples x classes, the larger the better: votes of svm, logarithms of densities else. Throws
  // std::invalid_argument (another number of features).
  Eigen::MatrixXd scores(const Eigen::MatrixXd& x) const;
  // Samples x classes, rows of sum 1; needs calibration (std::invalid_argument). gauss: on the day
  // of training, offset 0.
  Eigen::MatrixXd probabilities(const Eigen::MatrixXd& x) const;
  // How far from everything that was learnt, per sample: squared Mahalanobis distance to the
  // nearest class; gauss: -knownness (session_offset.h).
  Eigen::VectorXd noveltyScores(const Eigen::MatrixXd& x) const;
  // Of each feature, summing to 1: how much the fitted planes or directions rest on it.
  Eigen::VectorXd featureWeights() const;
};

// Best first; equal ones in the order of classes.
std::vector<int> rankedClasses(const Eigen::VectorXd& scores);

Json jsonOf(const ClassifierPipeline& pipeline);
// Throws Error naming what is missing or of a wrong size; nothing that isn't a number gets through.
ClassifierPipeline pipelineFrom(const Json& json);

}  // namespace palpate
