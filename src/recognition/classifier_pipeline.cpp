#include "palpate/recognition/classifier_pipeline.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "palpate/recognition/sample_splits.h"
#include "palpate/recognition/session_offset.h"

namespace palpate {
namespace {

ClassGaussianOptions gaussianOf(const PipelineOptions& options) {
  ClassGaussianOptions gaussian = options.gaussian;
  if (options.classifier == ClassifierKind::kLda) gaussian.pooledFraction = 1.0;
  return gaussian;
}

// Fits all stages except calibration and novelty.
ClassifierPipeline fitted(const Eigen::MatrixXd& x,
                          const std::vector<int>& y,
                          std::size_t numClasses,
                          const PipelineOptions& options) {
  ClassifierPipeline pipeline;
  pipeline.classifier = options.classifier;
  pipeline.numClasses = numClasses;
  pipeline.standardisation = Standardisation::of(x);
  Eigen::MatrixXd z = pipeline.standardisation.apply(x);
  if (options.components) {
    DiscriminantOptions discriminant = options.discriminant;
    discriminant.components = *options.components;
    pipeline.discriminant = DiscriminantAnalysis::of(z, y, discriminant);
    z = pipeline.discriminant->apply(z);
  }
  if (options.classifier == ClassifierKind::kSvm)
    pipeline.svm = SupportVectorMachine::of(z, y, numClasses, options.svm);
  else
    pipeline.gaussian = GaussianClassifier::of(z, y, numClasses, gaussianOf(options));
  return pipeline;
}

Eigen::MatrixXd projected(const ClassifierPipeline& pipeline, const Eigen::MatrixXd& x) {
  const Eigen::MatrixXd z = pipeline.standardisation.apply(x);
  return pipeline.discriminant ? pipeline.discriminant->apply(z) : z;
}

// Whether at least one class has two samples.
bool hasScatter(const SampleSet& samples) {
  const std::vector<std::size_t> counts = samples.counts();
  return std::any_of(counts.begin(), counts.end(), [](std::size_t n) { return n > 1; });
}

// Scores of the test samples of all splits: decision values of the pairs (svm) or log densities.
struct HeldOut {
  Eigen::MatrixXd scores;
  std::vector<int> y;
};

HeldOut heldOut(const SampleSet& samples, const PipelineOptions& options) {
  const bool svm = options.classifier == ClassifierKind::kSvm;
  HeldOut all;
  for (const SampleSplit& split : blockSplits(samples.y, options.calibrationBlocks)) {
    // Each class with training samples in the whole set has some in every split, so that the pairs
    // are the same.
    const SampleSet train = samples.rows(split.train), test = samples.rows(split.test);
    if (!hasScatter(train)) continue;
    const ClassifierPipeline part = fitted(train.x, train.y, train.numClasses(), options);
    const Eigen::MatrixXd scores =
        svm ? part.svm.decisions(projected(part, test.x)) : part.scores(test.x);
    const Eigen::Index before = all.scores.rows();
    all.scores.conservativeResize(before + scores.rows(), scores.cols());
    all.scores.bottomRows(scores.rows()) = scores;
    all.y.insert(all.y.end(), test.y.begin(), test.y.end());
  }
  return all;
}

std::vector<Sigmoid> sigmoidsOf(const SupportVectorMachine& svm, const HeldOut& held) {
  std::vector<Sigmoid> sigmoids;
  for (std::size_t p = 0; p < svm.pairs.size(); ++p) {
    std::vector<double> decisions;
    std::vector<bool> first;
    for (std::size_t i = 0; i < held.y.size(); ++i) {
      if (held.y[i] != svm.pairs[p].first && held.y[i] != svm.pairs[p].second) continue;
      decisions.push_back(held.scores(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(p)));
      first.push_back(held.y[i] == svm.pairs[p].first);
    }
    sigmoids.push_back(decisions.empty() ? Sigmoid{} : fitSigmoid(decisions, first));
  }
  return sigmoids;
}

// Logarithms of the coupled probabilities of one sample; -infinity for classes without samples,
// which are in no pair.
Eigen::VectorXd coupledLogs(const ClassifierPipeline& pipeline, const Eigen::VectorXd& decisions) {
  std::vector<int> place(pipeline.numClasses, -1);
  int present = 0;
  for (const auto& [first, second] : pipeline.svm.pairs)
    for (const int c : {first, second})
      if (place[static_cast<std::size_t>(c)] < 0) place[static_cast<std::size_t>(c)] = present++;
  Eigen::MatrixXd r = Eigen::MatrixXd::Constant(present, present, 0.5);
  for (std::size_t p = 0; p < pipeline.svm.pairs.size(); ++p) {
    const auto [first, second] = pipeline.svm.pairs[p];
    const int i = place[static_cast<std::size_t>(first)],
              j = place[static_cast<std::size_t>(second)];
    r(i, j) = pipeline.sigmoids[p].at(decisions[static_cast<Eigen::Index>(p)]);
    r(j, i) = 1.0 - r(i, j);
  }
  const Eigen::VectorXd p = coupleProbabilities(r);
  Eigen::VectorXd all = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(pipeline.numClasses),
                                                  -std::numeric_limits<double>::infinity());
  for (std::size_t c = 0; c < place.size(); ++c)
    if (place[c] >= 0) all[static_cast<Eigen::Index>(c)] = std::log(std::max(p[place[c]], 1e-300));
  return all;
}

Eigen::MatrixXd coupledRows(const ClassifierPipeline& pipeline, const Eigen::MatrixXd& decisions) {
  Eigen::MatrixXd all(decisions.rows(), static_cast<Eigen::Index>(pipeline.numClasses));
  for (Eigen::Index i = 0; i < decisions.rows(); ++i)
    all.row(i) = coupledLogs(pipeline, decisions.row(i).transpose()).transpose();
  return all;
}

void calibrate(const SampleSet& samples,
               const PipelineOptions& options,
               ClassifierPipeline& pipeline) {
  const HeldOut held = heldOut(samples, options);
  if (options.classifier == ClassifierKind::kSvm) {
    pipeline.sigmoids = sigmoidsOf(pipeline.svm, held);
    // Coupled probabilities of many classes with few samples are far too uniform; one common
    // exponent corrects this.
    pipeline.exponent = fitExponent(coupledRows(pipeline, held.scores), held.y);
  } else {
    pipeline.exponent = fitExponent(held.scores, held.y);
  }
  pipeline.calibrated = true;
}

// Assigns the probabilities in the order of the votes, because the votes are more accurate.
Eigen::RowVectorXd inOrder(const std::vector<int>& ranking, const Eigen::RowVectorXd& p) {
  std::vector<double> sorted(p.begin(), p.end());
  std::sort(sorted.begin(), sorted.end(), std::greater<>());
  Eigen::RowVectorXd dealt(p.size());
  for (std::size_t k = 0; k < ranking.size(); ++k) dealt[ranking[k]] = sorted[k];
  return dealt;
}

ClassifierPipeline ofSession(const SampleSet& samples) {
  ClassifierPipeline pipeline;
  pipeline.classifier = ClassifierKind::kGauss;
  pipeline.numClasses = samples.numClasses();
  pipeline.sessionAdaptive =
      SessionAdaptiveClassifier::learn(samples.x, samples.y, samples.classes, samples.features);
  pipeline.calibrated = true;
  return pipeline;
}

// Weight of each feature: distance of the class means relative to the scatter within the classes.
Eigen::VectorXd separationWeights(const Eigen::MatrixXd& means, const Eigen::VectorXd& variance) {
  const Eigen::MatrixXd away = means.rowwise() - means.colwise().mean();
  const Eigen::VectorXd between =
      away.colwise().squaredNorm().transpose() / static_cast<double>(means.rows());
  const Eigen::VectorXd weights = between.cwiseQuotient(variance.cwiseMax(1e-12)).cwiseSqrt();
  return weights.sum() > 0.0 ? Eigen::VectorXd(weights / weights.sum()) : weights;
}

Eigen::VectorXd separationWeights(const SessionAdaptiveClassifier& sessionAdaptive) {
  const SessionAdaptiveParameters& data = sessionAdaptive.data();
  Eigen::MatrixXd means(static_cast<Eigen::Index>(data.classComponents.size()), data.pooled.cols());
  for (std::size_t c = 0; c < data.classComponents.size(); ++c)
    means.row(static_cast<Eigen::Index>(c)) = data.classComponents[c].mean.transpose();
  return separationWeights(means, data.pooled.diagonal());
}

Eigen::VectorXd separationWeights(const GaussianClassifier& gaussian) {
  Eigen::MatrixXd means(0, 0);
  Eigen::VectorXd variance;
  for (const GaussianClassifier::Class& one : gaussian.classes) {
    if (!one.present) continue;
    means.conservativeResize(means.rows() + 1, one.mean.size());
    means.bottomRows(1) = one.mean.transpose();
    const auto size = one.mean.size();
    const Eigen::MatrixXd root =
        one.whitening.triangularView<Eigen::Lower>().solve(Eigen::MatrixXd::Identity(size, size));
    const Eigen::VectorXd own = root.rowwise().squaredNorm();
    variance = variance.size() == 0 ? own : Eigen::VectorXd(variance + own);
  }
  return separationWeights(means, variance / static_cast<double>(means.rows()));
}

}  // namespace

std::string_view classifierName(ClassifierKind kind) noexcept {
  for (const auto& [word, known] : kClassifierWords)
    if (known == kind) return word;
  return {};
}

std::optional<ClassifierKind> classifierNamed(std::string_view name) noexcept {
  for (const auto& [word, kind] : kClassifierWords)
    if (word == name) return kind;
  return std::nullopt;
}

void PipelineOptions::validate() const {
  if (components)
    OptionCheck{"PipelineOptions"}(kComponents, "components", static_cast<double>(*components));
  if (components && classifier == ClassifierKind::kGauss)
    throw std::invalid_argument("PipelineOptions: gauss takes no discriminant analysis");
  if (calibrationBlocks == 1)
    throw std::invalid_argument("PipelineOptions: calibrationBlocks must be 0, or 2 and more");
  discriminant.validate();
  svm.validate();
  gaussian.validate();
}

ClassifierPipeline ClassifierPipeline::of(const SampleSet& samples,
                                          const PipelineOptions& options) {
  options.validate();
  requireLearnable(samples);
  if (options.classifier == ClassifierKind::kGauss) return ofSession(samples);
  ClassifierPipeline pipeline = fitted(samples.x, samples.y, samples.numClasses(), options);
  if (options.calibrationBlocks == 0) return pipeline;
  calibrate(samples, options, pipeline);
  pipeline.novelty = GaussianClassifier::of(projected(pipeline, samples.x),
                                            samples.y,
                                            samples.numClasses(),
                                            {.pooledFraction = 0.5, .ridge = 1e-2});
  return pipeline;
}

Eigen::MatrixXd ClassifierPipeline::scores(const Eigen::MatrixXd& x) const {
  if (sessionAdaptive) {
    Eigen::MatrixXd all(x.rows(), static_cast<Eigen::Index>(numClasses));
    for (Eigen::Index i = 0; i < x.rows(); ++i)
      all.row(i) = sessionAdaptive->logLikelihoods(x.row(i).transpose(), 0.0).transpose();
    return all;
  }
  const Eigen::MatrixXd z = projected(*this, x);
  if (classifier != ClassifierKind::kSvm) return gaussian.logDensity(z);
  const Eigen::MatrixXd decisions = svm.decisions(z);
  Eigen::MatrixXd votes(z.rows(), static_cast<Eigen::Index>(numClasses));
  for (Eigen::Index i = 0; i < z.rows(); ++i)
    votes.row(i) = svm.votes(decisions.row(i).transpose()).transpose();
  return votes;
}

Eigen::MatrixXd ClassifierPipeline::probabilities(const Eigen::MatrixXd& x) const {
  if (!calibrated) throw std::invalid_argument("ClassifierPipeline: not calibrated");
  if (sessionAdaptive) {
    Eigen::MatrixXd all(x.rows(), static_cast<Eigen::Index>(numClasses));
    for (Eigen::Index i = 0; i < x.rows(); ++i)
      all.row(i) =
          predict(*sessionAdaptive, x.row(i).transpose(), givenOffset(0.0)).probability.transpose();
    return all;
  }
  if (classifier != ClassifierKind::kSvm) return softmaxRows(scores(x), exponent);
  const Eigen::MatrixXd decisions = svm.decisions(projected(*this, x));
  Eigen::MatrixXd all = softmaxRows(coupledRows(*this, decisions), exponent);
  for (Eigen::Index i = 0; i < all.rows(); ++i)
    all.row(i) = inOrder(rankedClasses(svm.votes(decisions.row(i).transpose())), all.row(i));
  return all;
}

Eigen::VectorXd ClassifierPipeline::noveltyScores(const Eigen::MatrixXd& x) const {
  if (sessionAdaptive) {
    Eigen::VectorXd all(x.rows());
    for (Eigen::Index i = 0; i < x.rows(); ++i)
      all[i] =
          -predict(*sessionAdaptive, x.row(i).transpose(), givenOffset(0.0)).logLikelihoodRatio;
    return all;
  }
  if (novelty.classes.empty()) throw std::invalid_argument("ClassifierPipeline: not calibrated");
  return novelty.nearestSquaredDistance(projected(*this, x));
}

Eigen::VectorXd ClassifierPipeline::featureWeights() const {
  if (sessionAdaptive) return separationWeights(*sessionAdaptive);
  if (!discriminant) {
    if (classifier == ClassifierKind::kSvm) return svm.featureWeights();
    return separationWeights(gaussian);
  }
  if (classifier != ClassifierKind::kSvm) return discriminant->featureWeights();
  // Transforms the hyperplanes back to the features.
  SupportVectorMachine back = svm;
  back.weights = svm.weights * discriminant->directions.transpose();
  return back.featureWeights();
}

std::vector<int> rankedClasses(const Eigen::VectorXd& scores) {
  std::vector<int> order(static_cast<std::size_t>(scores.size()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return scores[a] > scores[b]; });
  return order;
}

}  // namespace palpate
