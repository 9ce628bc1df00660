// Classifier pipeline, from features to classes: standardisation, discriminant analysis (optional),
// classifier. All stages are fitted to the given samples only, so that in cross-validation no test
// sample is used for fitting. A TrainedModel contains one.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include <palpate/core/json.h>
#include <palpate/core/option_check.h>
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
inline constexpr std::array<OptionWord<ClassifierKind>, 4> kClassifierWords{
    {{"svm", ClassifierKind::kSvm},
     {"qda", ClassifierKind::kQda},
     {"lda", ClassifierKind::kLda},
     {"gauss", ClassifierKind::kGauss}}};
std::string_view classifierName(ClassifierKind kind) noexcept;
std::optional<ClassifierKind> classifierNamed(std::string_view name) noexcept;

struct PipelineOptions {
  ClassifierKind classifier = ClassifierKind::kSvm;
  // Number of components of the discriminant analysis; empty: no discriminant analysis.
  static constexpr OptionRange kComponents{1, 10'000};
  std::optional<std::size_t> components;
  // Its field `components` is not used.
  DiscriminantOptions discriminant;
  SvmOptions svm;
  // Of qda; lda uses its ridge only.
  ClassGaussianOptions gaussian;
  // Number of contiguous blocks per class (sample_splits.h) used to calibrate the probabilities; 0:
  // no calibration.
  std::size_t calibrationBlocks = 0;

  // Throws std::invalid_argument with the field's name.
  void validate() const;
};

struct ClassifierPipeline {
  ClassifierKind classifier = ClassifierKind::kSvm;
  std::size_t numClasses = 0;
  Standardisation standardisation;
  std::optional<DiscriminantAnalysis> discriminant;
  // Of svm.
  SupportVectorMachine svm;
  // Of qda and lda.
  GaussianClassifier gaussian;
  // Of gauss; the other stages are not used then.
  std::optional<SessionAdaptiveClassifier> sessionAdaptive;
  bool calibrated = false;
  // Calibration of svm, one per pair of classes.
  std::vector<Sigmoid> sigmoids;
  // Calibration exponent of the coupled probabilities of svm, or of the densities of the other
  // classifiers.
  double exponent = 1.0;
  // Novelty model in the space that the classifier works in; half of each covariance is the pooled
  // one.
  GaussianClassifier novelty;

  // Fits a pipeline to samples. Throws Error (requireLearnable; gauss: a class without samples),
  // std::invalid_argument (options).
  static ClassifierPipeline of(const SampleSet& samples, const PipelineOptions& options = {});

  // Scores, samples x classes; larger is better. They are votes for svm, log densities otherwise.
  // Throws std::invalid_argument (another number of features).
  Eigen::MatrixXd scores(const Eigen::MatrixXd& x) const;
  // Probabilities, samples x classes; each row sums to 1. Needs calibration (std::invalid_argument
  // otherwise). For gauss they hold for the training session (offset 0).
  Eigen::MatrixXd probabilities(const Eigen::MatrixXd& x) const;
  // Novelty score per sample: squared Mahalanobis distance to the nearest class. For gauss it is
  // the negative log likelihood ratio against the background (session_offset.h).
  Eigen::VectorXd noveltyScores(const Eigen::MatrixXd& x) const;
  // Relative weight of each feature in the fitted hyperplanes or directions; the weights sum to 1.
  Eigen::VectorXd featureWeights() const;
};

// Class indices from best to worst score; equal scores in the order of the classes.
std::vector<int> rankedClasses(const Eigen::VectorXd& scores);

Json jsonOf(const ClassifierPipeline& pipeline);
// Reads a pipeline from JSON. Throws Error naming what is missing or has a wrong size; values that
// are not numbers are refused.
ClassifierPipeline pipelineFrom(const Json& json);

}  // namespace palpate
