// Session-adaptive classifier. Each class is a multivariate Student t distribution (heavy tails),
// whose scatter matrix is enlarged by the variance between sessions. One feature, size_z, is
// shifted by an unknown size offset of the hand (session_offset.h). A background distribution over
// all class means (multivariate t, too) represents objects in general: a sample that no class
// explains sufficiently better than the background is classified as unknown (OpenSetOptions).
// Source: Kotz and Nadarajah 2004, Multivariate t Distributions; background model: Reynolds,
// Quatieri, Dunn 2000. It is the classifier `gauss` of ClassifierPipeline.
//
// Scatter of class c = classCovarianceFraction S_c + (1 - classCovarianceFraction) S_w, with
// off-diagonal elements multiplied by correlationScale, plus the diagonal matrix of the session
// variances (regularised discriminant analysis, Friedman 1989).
//   ln p(x | c, o) = ln t_nu(x with D - o; mean_c, scatter_c)
// S_c is the covariance matrix of class c, S_w the pooled within-class covariance matrix. All
// classes have the same prior probability. x holds one sample per row.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <palpate/core/json.h>

namespace palpate {

// The defaults were chosen on the last third of each recording of September 2014 and on sessions
// simulated from them; the standard deviations of a session come from earlier work.
// docs/notes/recognition.md ("How the constants were chosen") says what this means for the reported
// accuracies.
struct SessionAdaptiveOptions {
  double classCovarianceFraction = 0.5;  // 0..1
  double correlationScale = 1.0;         // 0..1
  // Degrees of freedom nu of the t distribution, > 2; a smaller value gives heavier tails.
  double degreesOfFreedom = 8.0;
  // Session variance of a feature as a fraction of its pooled variance, >= 0. It is used for all
  // features that `sessionSd` does not name.
  double sessionVarianceFraction = 1.0;
  // Standard deviation between sessions of the features named here, in the unit of the feature.
  std::vector<std::pair<std::string, double>> sessionSd = {
      {"size_z", 0.225}, {"ln_sum", 0.175}, {"closing_mm", 0.6}};
  // Name of the feature that the size offset shifts. If no feature has this name, the offset
  // has no effect.
  std::string sizeFeature = "size_z";
  // Few-shot components (addSessionComponents()): their scatter matrix is fewShotScatterScale (1 +
  // 1/K) S_w for K labelled grasps. seenInSessionLogPrior is the prior log odds [ln] of a class
  // that was grasped in this session over one that was not.
  double fewShotScatterScale = 1.5;    // > 0
  double seenInSessionLogPrior = 3.0;  // >= 0

  // Throws std::invalid_argument with the field's name.
  void validate() const;
};

// One multivariate t component: its location vector and its scatter matrix.
struct StudentTComponent {
  Eigen::VectorXd mean;
  Eigen::MatrixXd scatter;  // symmetric, positive definite
  bool operator==(const StudentTComponent&) const = default;
};

// Component of one class, made from grasps of the present session whose class is known.
struct SessionComponent {
  std::size_t classIndex = 0;
  // Number K of grasps that the component was made from.
  std::size_t count = 0;
  StudentTComponent distribution;
  bool operator==(const SessionComponent&) const = default;
};

// All parameters of a fitted model, as the model file stores them.
struct SessionAdaptiveParameters {
  std::vector<std::string> features, classes;
  std::optional<std::size_t> sizeColumn;
  double degreesOfFreedom = 8.0;
  double fewShotScatterScale = 1.5;
  double seenInSessionLogPrior = 3.0;
  // One per class.
  std::vector<StudentTComponent> classComponents;
  // Pooled within-class covariance matrix S_w.
  Eigen::MatrixXd pooled;
  StudentTComponent background;
  // Components of the present session.
  std::vector<SessionComponent> today;
  bool operator==(const SessionAdaptiveParameters&) const = default;
};

class SessionAdaptiveClassifier {
 public:
  // Fits a classifier to samples x (rows) of classes y (0..classes-1). Throws std::invalid_argument
  // (sizes that do not agree, options); Error, one line, when it can't be fitted: values that are
  // not numbers, fewer than two classes, no class with two samples, a class without samples.
  static SessionAdaptiveClassifier learn(const Eigen::MatrixXd& x,
                                         const std::vector<int>& y,
                                         std::vector<std::string> classes,
                                         std::vector<std::string> features,
                                         const SessionAdaptiveOptions& options = {});
  // Throws Error naming what is inconsistent (sizes, a scatter matrix that is not positive
  // definite, values that are not finite).
  explicit SessionAdaptiveClassifier(SessionAdaptiveParameters data);

  const SessionAdaptiveParameters& data() const noexcept { return data_; }
  std::size_t numClasses() const noexcept { return data_.classes.size(); }
  std::size_t numFeatures() const noexcept { return data_.features.size(); }
  // Names of the features that were constant in the training samples. They were given a small
  // variance, because otherwise any other value would have probability 0.
  const std::vector<std::string>& constantFeatures() const noexcept { return constant_; }

  // Returns ln p(x | class, offset) for each class: the larger of the densities of the training
  // component and of this session's component. Throws
  // std::invalid_argument: another number of features, values that aren't finite.
  Eigen::VectorXd logLikelihoods(const Eigen::VectorXd& x, double offsetMm) const;
  // Log prior [ln] of each class: seenInSessionLogPrior for classes grasped in this session, else
  // 0.
  Eigen::VectorXd logPrior() const;
  // Returns ln p(x | background, offset).
  double logBackground(const Eigen::VectorXd& x, double offsetMm) const;

  // Adds one component per class, made from labelled grasps of this session; their size feature is
  // corrected by `offsetMm` [mm] first. A component that the class already has for this session is
  // replaced. Throws std::invalid_argument as learn() does.
  void addSessionComponents(const Eigen::MatrixXd& x, const std::vector<int>& y, double offsetMm);

  // Returns the features that the hand would measure with an offset of 0.
  Eigen::VectorXd withoutOffset(const Eigen::VectorXd& x, double offsetMm) const;

 private:
  struct Prepared {
    Eigen::VectorXd mean;
    // Lower triangular W: |W (x - mean)|^2 is the squared Mahalanobis distance.
    Eigen::MatrixXd whitening;
    // ln of the density at the mean.
    double constant = 0.0;
  };
  Prepared prepare(const StudentTComponent& distribution, const std::string& what) const;
  double logDensity(const Prepared& distribution, const Eigen::VectorXd& x) const;
  Eigen::VectorXd moved(const Eigen::VectorXd& x, double offsetMm) const;

  SessionAdaptiveParameters data_;
  std::vector<Prepared> classComponents_, sessionComponents_;
  Prepared background_;
  std::vector<std::string> constant_;
};

Json sessionAdaptiveJson(const SessionAdaptiveClassifier& model);
// Reads a classifier from JSON. Throws Error naming what is missing or wrong.
SessionAdaptiveClassifier sessionAdaptiveFrom(const Json& json);

}  // namespace palpate
