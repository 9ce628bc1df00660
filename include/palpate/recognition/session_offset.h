// Session offset: the systematic error of all measured sizes in one session (measured D = true D +
// offset) [mm], with its standard deviation and its source, and the classification under that
// uncertainty.
//
// After each reference run of the joints the distance of the fingers differs by a few millimetres
// from that before, and nothing in the recording shows it. The offset is therefore a probability
// distribution on a grid (-8..8 mm in steps of 0.25 mm, prior N(0, 3 mm)). It is estimated from
// labelled or unlabelled grasps of the session or from one contact of the empty hand; class
// probabilities are marginalised over it. One object alone never makes the offset trusted: an
// object of unknown size fits a class of another size equally well. RecognitionSession and
// TrainedModel keep an offset.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include <palpate/core/json.h>
#include <palpate/recognition/session_adaptive_classifier.h>

namespace palpate {

enum class OffsetSource {
  // The offset is assumed to be 0, as in the training session.
  kNone,
  // Nothing is known about this session: the prior distribution is used.
  kUnknown,
  // The user entered the value.
  kGiven,
  // Estimated from unlabelled grasps of this session.
  kBatch,
  // Estimated from labelled grasps of this session.
  kReferences,
  // Measured by a touch of the pads of the empty hand (empty_hand.h).
  kEmptyHand,
};
// Returns "none", "unknown", "given", "batch", "references" or "empty_hand".
std::string_view offsetSourceName(OffsetSource origin) noexcept;

struct SessionOffsetOptions {
  // Standard deviation of the prior distribution of the offset [mm], > 0.
  double priorSdMm = 3.0;
  // The grid reaches from minus this to plus this [mm], > 0.
  double gridHalfWidthMm = 8.0;
  double stepMm = 0.25;  // > 0
  // Weight of the log likelihood of an unlabelled grasp, 0..1: grasps of one object are not
  // independent observations.
  double unlabelledWeight = 0.3;
  // Lower bound of an unlabelled grasp's relative log likelihood [nat], > 0, so that one
  // outlier cannot exclude an offset.
  double logLikelihoodFloorNats = 12.0;
  // Labelled grasps of one object count as at most this many independent observations, > 0.
  double maxEffectiveReferences = 2.0;
  // An offset is trusted only if it was estimated from at least this many different objects.
  std::size_t minObjects = 2;
  // Two objects are different if their sizes differ by more than this [mm], >= 0,
  double objectGapMm = 3.0;
  // or if the Mahalanobis distance of their other features, with the within-class covariance
  // matrix, exceeds this, > 0.
  double minShapeDistance = 5.0;
  // Each object must have been classified with at least this probability, 0..1,
  double objectProbability = 0.8;
  // and the standard deviation of the offset must not exceed this [mm], > 0.
  double maxSdMm = 1.0;

  // Throws std::invalid_argument with the field's name.
  void validate() const;
};

struct SessionOffset {
  // Mean of measured D - true D [mm].
  double mm = 0.0;
  // Standard deviation [mm]; 0: the value is assumed, or was entered as exact.
  double sdMm = 0.0;
  OffsetSource origin = OffsetSource::kNone;
  // Number of grasps that it was estimated from.
  std::size_t grasps = 0;
  // Number of different objects among them.
  std::size_t objects = 0;
  // Whether a classification with this offset may be reported as sure. Never true for kNone and
  // kUnknown, nor if only one object was grasped.
  bool trusted = false;
  // The distribution on a grid; both vectors have the same size, the probabilities sum to 1.
  std::vector<double> gridMm, probability;

  // Describes the offset in one line, for example "today the hand reads 3.4 mm small (+- 0.3 mm,
  // from 4 objects)".
  std::string text() const;
};

// noOffset(): the fixed value 0, which never allows a sure result. unknownOffset(): the prior
// distribution. givenOffset(): a value entered by the user, trusted, exact or with a standard
// deviation. All throw std::invalid_argument if a value is not finite or the standard deviation is
// negative.
SessionOffset noOffset();
SessionOffset unknownOffset(const SessionOffsetOptions& options = {});
SessionOffset givenOffset(double mm, double sdMm = 0.0);
// An offset that was measured (kEmptyHand), as a distribution that later observations can narrow.
// It is trusted if its standard deviation is small enough.
SessionOffset measuredOffset(double mm,
                             double sdMm,
                             OffsetSource origin,
                             const SessionOffsetOptions& options = {});

// Posterior distribution of the offset given grasps and the distribution `before`. x has one grasp
// per row. Both throw std::invalid_argument (sizes, y). offsetFromBatch(): all grasps of the
// session, without labels.
SessionOffset offsetFromBatch(const SessionAdaptiveClassifier& model,
                              const Eigen::MatrixXd& x,
                              const SessionOffset& before = unknownOffset(),
                              const SessionOffsetOptions& options = {});
// offsetFromReferences(): labelled grasps, y is the class index of each row. Rigid objects give
// more accurate offsets than soft ones.
SessionOffset offsetFromReferences(const SessionAdaptiveClassifier& model,
                                   const Eigen::MatrixXd& x,
                                   const std::vector<int>& y,
                                   const SessionOffset& before = unknownOffset(),
                                   const SessionOffsetOptions& options = {});

// A class of the model that a labelled grasp of this session can be of.
struct OffsetReference {
  std::size_t classIndex = 0;
  // Standard deviation of the offset after one labelled grasp of this class, by the Fisher
  // information of the t distribution (Lange, Little, Taylor 1989) [mm], > 0.
  double sdMm = 0.0;
};
// Returns the class whose labelled grasp would determine the offset best; nothing if no feature of
// the model depends on the offset.
std::optional<OffsetReference> bestReference(const SessionAdaptiveClassifier& model);

// Whether the object of a grasp is one of the known classes.
enum class Membership {
  kKnown,
  kUnknown,
  // The distribution of the offset is too wide: with a part of it the grasp would be unknown, with
  // the rest known.
  kNotKnownYet
};
// Returns "known", "unknown" or "not_known_yet".
std::string_view membershipName(Membership membership) noexcept;

// Classification of one grasp.
struct OpenSetPrediction {
  // Posterior probability of each known class; the values sum to 1.
  Eigen::VectorXd probability;
  // Class indices, best first.
  std::vector<std::size_t> ranking;
  // Log likelihood ratio [ln] of the best class against the background, marginalised over the
  // offset. Small values mean an unknown object; known objects are nearly always above
  // OpenSetOptions::minLogLikelihoodRatio.
  double logLikelihoodRatio = 0.0;
  // Whether the log likelihood ratio is below OpenSetOptions::minLogLikelihoodRatio.
  bool unknown = false;
  // Probability, over the offset's distribution, that the ratio at the true offset is at least
  // OpenSetOptions::minLogLikelihoodRatio.
  double knownFraction = 0.0;
  // kUnknown exactly when `unknown` is true. Of the others kNotKnownYet where the offset isn't
  // trusted and knownFraction is below OpenSetOptions::minKnownFraction.
  Membership membership = Membership::kKnown;
  // True if the best class is probable enough (sureProbability), the object is not unknown, and the
  // offset is trusted.
  bool sure = false;
};

struct OpenSetOptions {
  // Threshold [ln] of the ratio: 1 % of the known and 60 % of the unknown grasps are below it
  // (data: docs/notes/recognition.md).
  double minLogLikelihoodRatio = 1.0;
  // Part of the offset's distribution for which an object must be known to be called known while
  // the offset isn't trusted, 0..1.
  double minKnownFraction = 0.95;
  // Probability of the best class that a sure result needs, 0.5..1.
  double sureProbability = 0.97;

  void validate() const;
};

// Classifies one grasp, marginalised over the distribution of the offset. An offset that unlabelled
// grasps gave (kBatch) and that is not trusted may have made an unknown object similar to a class.
// Therefore the log likelihood ratio is then marginalised over unknownOffset(), the class
// probabilities over the offset as given.
OpenSetPrediction predict(const SessionAdaptiveClassifier& model,
                          const Eigen::VectorXd& x,
                          const SessionOffset& offset,
                          const OpenSetOptions& options = {});
// Classifies each row of x.
std::vector<OpenSetPrediction> predictAll(const SessionAdaptiveClassifier& model,
                                          const Eigen::MatrixXd& x,
                                          const SessionOffset& offset,
                                          const OpenSetOptions& options = {});

// JSON with mm, sd_mm, origin, grasps, objects, trusted, grid_mm, probability.
Json sessionOffsetJson(const SessionOffset& offset);
// Reads an offset from JSON. Throws Error naming what is missing or wrong.
SessionOffset sessionOffsetFrom(const Json& json);

}  // namespace palpate
