// The session offset: by how much the hand reads all sizes wrong today (measured D = true D + offset), with its error and
// where it comes from, and what classes are certain with it.
//
// Each time the hand is referenced anew its fingers stand a few millimetres closer or wider than before; nothing in the
// recording shows it. So the offset is carried as a distribution on a grid (-8..8 mm, steps of .25; before anything is
// known N(0, 3 mm)), learnt from labelled or unlabelled grasps of the day or from one touch of the empty hand, and classes
// are judged by summing over it. It is never certain on the word of a single object: one object of unknown size fits a
// neighbour of another size as well, with confidence.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include <palpate/core/json.h>
#include <palpate/recognition/day_model.h>

namespace palpate {

enum class OffsetOrigin {
  kNone,        // 0, as on the day of training: an assumption
  kUnknown,     // nothing is known of today
  kGiven,       // a person said so
  kBatch,       // from unlabelled grasps of today
  kReferences,  // from labelled grasps of today
  kEmptyHand,   // the pads of the empty hand touched (empty_hand.h)
};
std::string_view offsetOriginName(
    OffsetOrigin
        origin) noexcept;  // "none", "unknown", "given", "batch", "references", "empty_hand"

struct SessionOffsetOptions {
  double priorSdMm = 3.0;  // of the offset before anything is known, > 0
  double reachMm = 8.0;    // the grid goes from -reach to reach, > 0
  double stepMm = 0.25;    // > 0
  double batchWeight =
      0.3;  // of an unlabelled grasp: grasps of one object are no independent witnesses, 0..1
  double floorNats =
      12.0;  // an unlabelled grasp speaks no stronger than this against any offset, > 0
  double mostReferences =
      2.0;  // so many labelled grasps of one object count, however many there are, > 0
  // An offset makes classes certain when it rests on so many different objects,
  std::size_t fewestObjects = 2;
  double objectGapMm =
      3.0;  // which differ by more than this in size, >= 0, or, whatever their sizes,
  double objectDistance =
      5.0;  // by this in everything else (Mahalanobis, as grasps of one class scatter), > 0,
  double objectProbability = 0.8;  // and were told with this probability,
  double largestSdMm = 1.0;        // and its own error is no larger, > 0

  // Throws std::invalid_argument with the field's name.
  void validate() const;
};

struct SessionOffset {
  double mm = 0.0;    // mean: measured D - true D
  double sdMm = 0.0;  // 0: assumed or given as exact
  OffsetOrigin origin = OffsetOrigin::kNone;
  std::size_t grasps = 0;   // it rests on
  std::size_t objects = 0;  // different ones among them
  // Whether a verdict may be called sure with it. Never with kNone, kUnknown, or on one object.
  bool trusted = false;
  // The distribution on a grid.
  std::vector<double> gridMm, probability;  // same size, sum 1

  // "today the hand reads 3.4 mm small (+- 0.3 mm, from 4 objects)"; one line.
  std::string text() const;
};

// The one value 0 (never makes sure); nothing known; a value that a person gives (trusted: it is the person's word), exact or
// with an error. Throw std::invalid_argument: not finite, sd < 0.
SessionOffset noOffset();
SessionOffset unknownOffset(const SessionOffsetOptions& options = {});
SessionOffset givenOffset(double mm, double sdMm = 0.0);
// A value somebody measured, whose distribution others can narrow: kEmptyHand. Trusted when it is certain enough.
SessionOffset measuredOffset(double mm,
                             double sdMm,
                             OffsetOrigin origin,
                             const SessionOffsetOptions& options = {});

// What grasps say on top of what was known before. x: rows. Throw std::invalid_argument (sizes, y).
// Unlabelled: all grasps of a day together.
SessionOffset offsetFromBatch(const DayModel& model,
                              const Eigen::MatrixXd& x,
                              const SessionOffset& before = unknownOffset(),
                              const SessionOffsetOptions& options = {});
// Labelled, y: class of each. Rigid objects make the better references.
SessionOffset offsetFromReferences(const DayModel& model,
                                   const Eigen::MatrixXd& x,
                                   const std::vector<int>& y,
                                   const SessionOffset& before = unknownOffset(),
                                   const SessionOffsetOptions& options = {});

// What one grasp is.
struct DayVerdict {
  Eigen::VectorXd probability;       // per class, of the known ones: sums up to 1
  std::vector<std::size_t> ranking;  // classes, best first
  // ln of (best class over background), summed over the offset: the smaller the stranger. Known ones lie above
  // VerdictOptions::leastKnown nearly always.
  double knownness = 0.0;
  bool unknown = false;  // knownness is below
  // The best class is certain enough, it is known, and the offset can be trusted.
  bool sure = false;
};

struct VerdictOptions {
  double leastKnown = 1.0;        // [ln]; 1 % of known grasps lie below, 60 % of unknown ones
  double sureProbability = 0.97;  // of the best class, 0.5..1

  void validate() const;
};

DayVerdict judge(const DayModel& model,
                 const Eigen::VectorXd& x,
                 const SessionOffset& offset,
                 const VerdictOptions& options = {});
// The same of each row.
std::vector<DayVerdict> judgeAll(const DayModel& model,
                                 const Eigen::MatrixXd& x,
                                 const SessionOffset& offset,
                                 const VerdictOptions& options = {});

// {mm, sd_mm, origin, grasps, objects, trusted, grid_mm, probability}
Json sessionOffsetJson(const SessionOffset& offset);
// Throws Error naming what is missing or wrong.
SessionOffset sessionOffsetFrom(const Json& json);

}  // namespace palpate
