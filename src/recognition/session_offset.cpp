#include "palpate/recognition/session_offset.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include <Eigen/Cholesky>

#include "palpate/core/number_text.h"
#include "palpate/recognition/plateau_features.h"

namespace palpate {
namespace {

constexpr double kNever = -std::numeric_limits<double>::infinity();

double lnSumExp(const Eigen::VectorXd& values) {
  const double largest = values.maxCoeff();
  if (!std::isfinite(largest)) return largest;
  return largest + std::log((values.array() - largest).exp().sum());
}

// Logarithm of the distribution.
Eigen::VectorXd lnOf(const SessionOffset& offset) {
  Eigen::VectorXd out(static_cast<Eigen::Index>(offset.probability.size()));
  for (std::size_t i = 0; i < offset.probability.size(); ++i)
    out[static_cast<Eigen::Index>(i)] =
        offset.probability[i] > 0.0 ? std::log(offset.probability[i]) : kNever;
  return out;
}

void setDistribution(SessionOffset& offset, const Eigen::VectorXd& ln) {
  const double total = lnSumExp(ln);
  offset.probability.clear();
  for (const double value : ln) offset.probability.push_back(std::exp(value - total));
  offset.mm = 0.0;
  for (std::size_t i = 0; i < offset.gridMm.size(); ++i)
    offset.mm += offset.probability[i] * offset.gridMm[i];
  double variance = 0.0;
  for (std::size_t i = 0; i < offset.gridMm.size(); ++i)
    variance +=
        offset.probability[i] * (offset.gridMm[i] - offset.mm) * (offset.gridMm[i] - offset.mm);
  offset.sdMm = std::sqrt(variance);
}

SessionOffset priorOffset(double mm, double sdMm, const SessionOffsetOptions& options) {
  SessionOffset out;
  const auto steps = static_cast<int>(std::lround(options.gridHalfWidthMm / options.stepMm));
  Eigen::VectorXd ln(2 * steps + 1);
  for (int i = -steps; i <= steps; ++i) {
    out.gridMm.push_back(i * options.stepMm);
    const double away = (out.gridMm.back() - mm) / sdMm;
    ln[i + steps] = -0.5 * away * away;
  }
  setDistribution(out, ln);
  return out;
}

SessionOffset oneValue(double mm, OffsetSource origin) {
  SessionOffset out;
  out.mm = mm;
  out.origin = origin;
  out.gridMm = {mm};
  out.probability = {1.0};
  return out;
}

// Returns ln p(x | class, offset) with one row per class and one column per offset of the grid.
Eigen::MatrixXd overGrid(const SessionAdaptiveClassifier& model,
                         const Eigen::VectorXd& x,
                         const SessionOffset& offset) {
  Eigen::MatrixXd out(static_cast<Eigen::Index>(model.numClasses()),
                      static_cast<Eigen::Index>(offset.gridMm.size()));
  for (std::size_t i = 0; i < offset.gridMm.size(); ++i)
    out.col(static_cast<Eigen::Index>(i)) = model.logLikelihoods(x, offset.gridMm[i]);
  return out;
}

// Mahalanobis distance of two classes in all features but size, with the mean scatter matrix of the
// classes (including the variance between sessions).
class ShapeDistance {
 public:
  explicit ShapeDistance(const SessionAdaptiveClassifier& model) : model_(model) {
    for (std::size_t f = 0; f < model.numFeatures(); ++f)
      if (f != model.data().sizeColumn) columns_.push_back(static_cast<Eigen::Index>(f));
    Eigen::MatrixXd scatter =
        Eigen::MatrixXd::Zero(model.data().pooled.rows(), model.data().pooled.cols());
    for (const StudentTComponent& distribution : model.data().classComponents)
      scatter += distribution.scatter;
    scatter /= static_cast<double>(model.numClasses());
    scatter_.compute(scatter(columns_, columns_));
  }
  double operator()(std::size_t a, std::size_t b) const {
    if (columns_.empty()) return 0.0;
    const Eigen::VectorXd apart =
        (model_.data().classComponents[a].mean - model_.data().classComponents[b].mean)(columns_);
    return std::sqrt(apart.dot(scatter_.solve(apart)));
  }

 private:
  const SessionAdaptiveClassifier& model_;
  std::vector<Eigen::Index> columns_;
  Eigen::LDLT<Eigen::MatrixXd> scatter_;
};

// Counts different objects: classes that were recognised with enough probability in enough grasps,
// and that a wrong offset cannot confuse with one another.
std::size_t objectsIn(const SessionAdaptiveClassifier& model,
                      const std::vector<std::pair<std::size_t, double>>& confident,
                      const SessionOffsetOptions& options) {
  std::vector<std::size_t> times(model.numClasses(), 0);
  for (const auto& [best, probability] : confident)
    if (probability >= options.objectProbability) ++times[best];
  // A single grasp among many does not count as an object.
  constexpr double kStray = 0.15;
  const auto needed = static_cast<std::size_t>(
      std::clamp(std::ceil(kStray * static_cast<double>(confident.size())), 1.0, 2.0));
  const auto column = model.data().sizeColumn;
  const auto sizeOf = [&](std::size_t c) {
    return column ? distanceOfSizeZ(
                        model.data().classComponents[c].mean[static_cast<Eigen::Index>(*column)])
                  : 0.0;
  };
  const ShapeDistance shapeDistance(model);
  std::vector<std::size_t> different;
  for (std::size_t c = 0; c < times.size(); ++c)
    if (times[c] >= needed &&
        std::all_of(different.begin(), different.end(), [&](std::size_t other) {
          return std::abs(sizeOf(c) - sizeOf(other)) > options.objectGapMm ||
                 shapeDistance(c, other) > options.minShapeDistance;
        }))
      different.push_back(c);
  return different.size();
}

void setTrust(SessionOffset& offset, const SessionOffsetOptions& options) {
  offset.trusted = offset.sdMm <= options.maxSdMm && (offset.objects >= options.minObjects ||
                                                      offset.origin == OffsetSource::kEmptyHand);
}

void requireColumns(const SessionAdaptiveClassifier& model, const Eigen::MatrixXd& x) {
  if (static_cast<std::size_t>(x.cols()) != model.numFeatures())
    throw std::invalid_argument("session offset: " + std::to_string(x.cols()) + " values for " +
                                std::to_string(model.numFeatures()) + " features");
}

// Compares the best class with the background. `likelihoods` as overGrid() returns them.
void setMembership(const SessionAdaptiveClassifier& model,
                   const Eigen::VectorXd& x,
                   const SessionOffset& offset,
                   const Eigen::MatrixXd& likelihoods,
                   const OpenSetOptions& options,
                   OpenSetPrediction& out) {
  const Eigen::VectorXd ln = lnOf(offset);
  Eigen::VectorXd background(ln.size());
  out.knownFraction = 0.0;
  for (Eigen::Index i = 0; i < ln.size(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    background[i] = model.logBackground(x, offset.gridMm[at]);
    if (likelihoods.col(i).maxCoeff() - background[i] >= options.minLogLikelihoodRatio)
      out.knownFraction += offset.probability[at];
  }
  double best = kNever;
  for (Eigen::Index c = 0; c < likelihoods.rows(); ++c)
    best = std::max(best, lnSumExp(likelihoods.row(c).transpose() + ln));
  out.logLikelihoodRatio = best - lnSumExp(background + ln);
  out.unknown = !(out.logLikelihoodRatio >= options.minLogLikelihoodRatio);
  out.membership = Membership::kKnown;
  if (out.unknown)
    out.membership = Membership::kUnknown;
  else if (!offset.trusted && out.knownFraction < options.minKnownFraction)
    out.membership = Membership::kNotKnownYet;
}

// A fixed offset is not changed by observations.
bool isFixed(const SessionOffset& before) { return before.gridMm.size() < 2; }

}  // namespace

std::string_view offsetSourceName(OffsetSource origin) noexcept {
  switch (origin) {
    case OffsetSource::kNone:
      return "none";
    case OffsetSource::kUnknown:
      return "unknown";
    case OffsetSource::kGiven:
      return "given";
    case OffsetSource::kBatch:
      return "batch";
    case OffsetSource::kReferences:
      return "references";
    default:
      return "empty_hand";
  }
}

void SessionOffsetOptions::validate() const {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw std::invalid_argument(std::string("SessionOffsetOptions: ") + what);
  };
  const auto positive = [](double value) { return value > 0.0 && std::isfinite(value); };
  require(positive(priorSdMm), "priorSdMm must be > 0");
  require(positive(gridHalfWidthMm) && gridHalfWidthMm <= 100.0,
          "gridHalfWidthMm must be above 0, up to 100");
  require(positive(stepMm) && stepMm <= gridHalfWidthMm && gridHalfWidthMm / stepMm <= 10000.0,
          "stepMm must be above 0, up to gridHalfWidthMm");
  require(unlabelledWeight >= 0.0 && unlabelledWeight <= 1.0, "unlabelledWeight must be 0..1");
  require(positive(logLikelihoodFloorNats), "logLikelihoodFloorNats must be > 0");
  require(positive(maxEffectiveReferences), "maxEffectiveReferences must be > 0");
  require(objectGapMm >= 0.0 && std::isfinite(objectGapMm), "objectGapMm must be >= 0");
  require(positive(minShapeDistance), "minShapeDistance must be > 0");
  require(objectProbability >= 0.0 && objectProbability <= 1.0, "objectProbability must be 0..1");
  require(positive(maxSdMm), "maxSdMm must be > 0");
}

std::string_view membershipName(Membership membership) noexcept {
  switch (membership) {
    case Membership::kKnown:
      return "known";
    case Membership::kUnknown:
      return "unknown";
    default:
      return "not_known_yet";
  }
}

void OpenSetOptions::validate() const {
  if (!std::isfinite(minLogLikelihoodRatio))
    throw std::invalid_argument("OpenSetOptions: minLogLikelihoodRatio must be a number");
  if (!(minKnownFraction >= 0.0 && minKnownFraction <= 1.0))
    throw std::invalid_argument("OpenSetOptions: minKnownFraction must be 0..1");
  if (!(sureProbability >= 0.5 && sureProbability <= 1.0))
    throw std::invalid_argument("OpenSetOptions: sureProbability must be 0.5..1");
}

std::string SessionOffset::text() const {
  if (origin == OffsetSource::kNone)
    return "no session offset: the hand is taken to read as it did in training";
  if (origin == OffsetSource::kUnknown)
    return "the session offset is not known (+- " + fixedText(sdMm, 1) + " mm)";
  constexpr double kMinSaidMm = 0.05;
  std::string out = "today the hand reads sizes as it did in training (";
  if (!(std::abs(mm) < kMinSaidMm))
    out = "today the hand reads " + fixedText(std::abs(mm), 1) + " mm " +
          (mm < 0.0 ? "small" : "large") + " (";
  if (sdMm > 0.0) out += "+- " + fixedText(sdMm, 1) + " mm, ";
  if (origin == OffsetSource::kGiven) return out + "given)";
  if (origin == OffsetSource::kEmptyHand && objects == 0) return out + "from the empty hand)";
  return out + "from " + std::to_string(objects) + (objects == 1 ? " object" : " objects") + ")" +
         (trusted ? "" : ", so no answer is called sure");
}

SessionOffset noOffset() { return oneValue(0.0, OffsetSource::kNone); }

SessionOffset unknownOffset(const SessionOffsetOptions& options) {
  options.validate();
  SessionOffset out = priorOffset(0.0, options.priorSdMm, options);
  out.origin = OffsetSource::kUnknown;
  return out;
}

SessionOffset givenOffset(double mm, double sdMm) {
  if (!std::isfinite(mm) || !(sdMm >= 0.0 && std::isfinite(sdMm)))
    throw std::invalid_argument("givenOffset: a value that is not a number, or an error below 0");
  if (sdMm == 0.0) {
    SessionOffset out = oneValue(mm, OffsetSource::kGiven);
    out.trusted = true;
    return out;
  }
  return measuredOffset(mm, sdMm, OffsetSource::kGiven);
}

SessionOffset measuredOffset(double mm,
                             double sdMm,
                             OffsetSource origin,
                             const SessionOffsetOptions& options) {
  options.validate();
  if (!std::isfinite(mm) || !(sdMm > 0.0 && std::isfinite(sdMm)))
    throw std::invalid_argument(
        "measuredOffset: a value that is not a number, or an error not above 0");
  // Widens or refines the grid where the value is far from 0 or its standard deviation is small.
  SessionOffsetOptions grid = options;
  grid.gridHalfWidthMm =
      std::max(options.gridHalfWidthMm, std::min(100.0, std::abs(mm) + 4.0 * sdMm));
  grid.stepMm = std::max(grid.gridHalfWidthMm / 10000.0, std::min(options.stepMm, sdMm / 2.0));
  SessionOffset out = priorOffset(mm, sdMm, grid);
  out.mm = mm;
  out.sdMm = sdMm;
  out.origin = origin;
  out.trusted = sdMm <= options.maxSdMm &&
                (origin == OffsetSource::kEmptyHand || origin == OffsetSource::kGiven);
  return out;
}

SessionOffset offsetFromBatch(const SessionAdaptiveClassifier& model,
                              const Eigen::MatrixXd& x,
                              const SessionOffset& before,
                              const SessionOffsetOptions& options) {
  options.validate();
  requireColumns(model, x);
  SessionOffset out = before;
  const Eigen::VectorXd known = lnOf(before);
  Eigen::VectorXd ln = known;
  std::vector<Eigen::MatrixXd> all;
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    all.push_back(overGrid(model, x.row(i).transpose(), before));
    Eigen::VectorXd speaks(known.size());
    for (Eigen::Index o = 0; o < known.size(); ++o)
      speaks[o] = lnSumExp(all.back().col(o)) - std::log(static_cast<double>(model.numClasses()));
    const double best = speaks.maxCoeff();
    ln += options.unlabelledWeight * speaks.cwiseMax(best - options.logLikelihoodFloorNats);
  }
  if (!isFixed(before)) {
    setDistribution(out, ln);
    if (out.origin != OffsetSource::kEmptyHand && out.origin != OffsetSource::kReferences)
      out.origin = OffsetSource::kBatch;
  }
  // Classifies the grasps with the offset as it is known now.
  const Eigen::VectorXd now = lnOf(out);
  std::vector<std::pair<std::size_t, double>> confident;
  for (const Eigen::MatrixXd& likelihoods : all) {
    Eigen::VectorXd scores(likelihoods.rows());
    for (Eigen::Index c = 0; c < scores.size(); ++c)
      scores[c] = lnSumExp(likelihoods.row(c).transpose() + now);
    Eigen::Index best = 0;
    const double largest = scores.maxCoeff(&best);
    confident.emplace_back(static_cast<std::size_t>(best), std::exp(largest - lnSumExp(scores)));
  }
  out.grasps = before.grasps + confident.size();
  out.objects = std::max(before.objects, objectsIn(model, confident, options));
  if (!isFixed(before)) setTrust(out, options);
  return out;
}

SessionOffset offsetFromReferences(const SessionAdaptiveClassifier& model,
                                   const Eigen::MatrixXd& x,
                                   const std::vector<int>& y,
                                   const SessionOffset& before,
                                   const SessionOffsetOptions& options) {
  options.validate();
  requireColumns(model, x);
  if (static_cast<std::size_t>(x.rows()) != y.size())
    throw std::invalid_argument("session offset: " + std::to_string(x.rows()) + " grasps with " +
                                std::to_string(y.size()) + " labels");
  SessionOffset out = before;
  Eigen::VectorXd ln = lnOf(before);
  std::vector<std::pair<std::size_t, double>> confident;
  for (std::size_t c = 0; c < model.numClasses(); ++c) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(ln.size());
    double count = 0.0;
    for (std::size_t i = 0; i < y.size(); ++i) {
      if (y[i] != static_cast<int>(c)) continue;
      const Eigen::MatrixXd likelihoods =
          overGrid(model, x.row(static_cast<Eigen::Index>(i)).transpose(), before);
      sum += likelihoods.row(static_cast<Eigen::Index>(c)).transpose();
      count += 1.0;
      confident.emplace_back(c, 1.0);
    }
    if (count > 0.0) ln += sum / count * std::min(count, options.maxEffectiveReferences);
  }
  if (confident.size() != y.size())
    throw std::invalid_argument("session offset: a label that is not a class of the model");
  if (confident.empty()) return out;
  if (!isFixed(before)) {
    setDistribution(out, ln);
    out.origin = OffsetSource::kReferences;
  }
  out.grasps = before.grasps + confident.size();
  // Labels are certain, so that a single grasp counts as an object.
  std::sort(confident.begin(), confident.end());
  confident.erase(std::unique(confident.begin(), confident.end()), confident.end());
  SessionOffsetOptions each = options;
  each.objectProbability = 0.0;
  std::vector<std::pair<std::size_t, double>> twice = confident;
  twice.insert(twice.end(), confident.begin(), confident.end());
  out.objects = std::max(before.objects, objectsIn(model, twice, each));
  if (!isFixed(before)) setTrust(out, options);
  return out;
}

std::optional<OffsetReference> bestReference(const SessionAdaptiveClassifier& model) {
  if (!model.data().sizeColumn) return std::nullopt;
  const auto size = static_cast<Eigen::Index>(*model.data().sizeColumn);
  const double freedom = model.data().degreesOfFreedom + static_cast<double>(model.numFeatures());
  std::optional<OffsetReference> best;
  for (std::size_t c = 0; c < model.numClasses(); ++c) {
    const StudentTComponent& component = model.data().classComponents[c];
    // Variance of the size feature when the other features are known.
    const Eigen::VectorXd unit = Eigen::VectorXd::Unit(component.mean.size(), size);
    const double variance = 1.0 / component.scatter.ldlt().solve(unit)[size];
    constexpr double kStepMm = 0.01;
    const double distanceMm = distanceOfSizeZ(component.mean[size]);
    const double slope =
        (sizeZ(distanceMm + kStepMm) - sizeZ(distanceMm - kStepMm)) / (2.0 * kStepMm);
    const double sdMm = std::sqrt(variance * (freedom + 2.0) / freedom) / slope;
    if (std::isfinite(sdMm) && (!best || sdMm < best->sdMm)) best = {c, sdMm};
  }
  return best;
}

OpenSetPrediction predict(const SessionAdaptiveClassifier& model,
                          const Eigen::VectorXd& x,
                          const SessionOffset& offset,
                          const OpenSetOptions& options) {
  options.validate();
  if (offset.gridMm.empty() || offset.gridMm.size() != offset.probability.size())
    throw std::invalid_argument("judge: an offset without a distribution");
  const Eigen::VectorXd ln = lnOf(offset);
  const Eigen::MatrixXd likelihoods = overGrid(model, x, offset);
  Eigen::VectorXd scores(likelihoods.rows());
  for (Eigen::Index c = 0; c < scores.size(); ++c)
    scores[c] = lnSumExp(likelihoods.row(c).transpose() + ln);
  OpenSetPrediction out;
  const bool fromUnknownObjects = offset.origin == OffsetSource::kBatch && !offset.trusted;
  if (fromUnknownObjects) {
    const SessionOffset prior = unknownOffset();
    setMembership(model, x, prior, overGrid(model, x, prior), options, out);
  } else {
    setMembership(model, x, offset, likelihoods, options, out);
  }
  const Eigen::VectorXd weighed = scores + model.logPrior();
  out.probability = (weighed.array() - lnSumExp(weighed)).exp();
  out.ranking.resize(static_cast<std::size_t>(scores.size()));
  std::iota(out.ranking.begin(), out.ranking.end(), std::size_t{0});
  std::stable_sort(out.ranking.begin(), out.ranking.end(), [&](std::size_t a, std::size_t b) {
    return weighed[static_cast<Eigen::Index>(a)] > weighed[static_cast<Eigen::Index>(b)];
  });
  out.sure =
      offset.trusted && !out.unknown && out.probability.maxCoeff() >= options.sureProbability;
  return out;
}

std::vector<OpenSetPrediction> predictAll(const SessionAdaptiveClassifier& model,
                                          const Eigen::MatrixXd& x,
                                          const SessionOffset& offset,
                                          const OpenSetOptions& options) {
  std::vector<OpenSetPrediction> out;
  for (Eigen::Index i = 0; i < x.rows(); ++i)
    out.push_back(predict(model, x.row(i).transpose(), offset, options));
  return out;
}

}  // namespace palpate
