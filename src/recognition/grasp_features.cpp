#include "palpate/recognition/grasp_features.h"

#include <array>

#include "palpate/recognition/plateau_features.h"
#include "palpate/recognition/study_features.h"

namespace palpate {
namespace {

constexpr std::array<const char*, 6> kSessionPadNames = {
    "row", "column", "ln_sum", "ln_peak", "ln_major", "ln_minor"};

std::array<double, kSessionPadNames.size()> sessionOf(const PlateauPad& pad) {
  return {pad.row, pad.column, pad.lnSum, pad.lnPeak, pad.lnMajor, pad.lnMinor};
}

void appendSession(const PlateauFeatures& plateau,
                   const PinchHand& hand,
                   std::vector<double>& values) {
  for (const std::size_t axis : hand.gripAxes) values.push_back(plateau.plateauAnglesDeg[axis]);
  for (const PlateauPad& pad : plateau.pads)
    for (const double value : sessionOf(pad)) values.push_back(value);
}

}  // namespace

std::string_view featureSetName(FeatureSet set) noexcept {
  switch (set) {
    case FeatureSet::kStudy:
      return "study";
    case FeatureSet::kBest:
      return "best";
    default:
      return "session";
  }
}

std::optional<FeatureSet> featureSetNamed(std::string_view name) noexcept {
  for (const FeatureSet set : {FeatureSet::kStudy, FeatureSet::kBest, FeatureSet::kSession})
    if (featureSetName(set) == name) return set;
  return std::nullopt;
}

std::vector<std::string> featureNames(FeatureSet set, const PinchHand& hand) {
  if (set == FeatureSet::kStudy) return studyFeatureNames(hand);
  std::vector<std::string> names = plateauFeatureNames();
  if (set == FeatureSet::kBest) return names;
  for (const std::size_t axis : hand.gripAxes) names.push_back("angle_" + std::to_string(axis));
  for (const std::size_t pad : hand.pads)
    for (const char* what : kSessionPadNames)
      names.push_back("m" + std::to_string(pad) + "_" + what);
  return names;
}

std::string_view sessionSetWarning() noexcept {
  return "the set 'session' holds joint angles at rest: it remembers the pose in which each object "
         "was presented, is best within one session, and fails in another session (use 'best')";
}

GraspFeatures graspFeatures(const Profile& profile,
                            const GraspSegment& grasp,
                            FeatureSet set,
                            const PinchHand& hand) {
  GraspFeatures out;
  out.begin = grasp.begin;
  out.end = grasp.end;
  if (set == FeatureSet::kStudy) {
    StudyFeatures study = studyFeatures(profile, grasp, hand);
    out.problem = std::move(study.problem);
    out.initialFrame = study.initialFrame;
    out.endFrame = study.endFrame;
    out.values = std::move(study.values);
    return out;
  }
  PlateauFeatures plateau = plateauFeatures(profile, grasp, hand);
  out.problem = std::move(plateau.problem);
  out.initialFrame = plateau.startFrame;
  out.endFrame = plateau.plateauEndFrame;
  if (!out.problem.empty()) return out;
  out.values = std::move(plateau.values);
  if (set == FeatureSet::kSession) appendSession(plateau, hand, out.values);
  return out;
}

std::vector<GraspSegment> findPinches(const Profile& profile,
                                      const PinchHand& hand,
                                      const Progress& progress) {
  GraspSegmentOptions options;
  options.rule = GraspRule::kStudy;
  options.studyMatrices = {hand.pads[0], hand.pads[1]};
  return findGrasps(profile, options, progress);
}

RecordingFeatures recordingFeatures(const Profile& profile,
                                    FeatureSet set,
                                    const PinchHand& hand,
                                    const Progress& progress) {
  RecordingFeatures out;
  out.problem = hand.mismatch(profile);
  if (!out.problem.empty()) return out;
  for (const GraspSegment& grasp : findPinches(profile, hand, progress))
    out.grasps.push_back(graspFeatures(profile, grasp, set, hand));
  if (out.grasps.empty())
    out.problem = "no grasp: matrices " + std::to_string(hand.pads[0]) + " and " +
                  std::to_string(hand.pads[1]) +
                  " never touch together for more than 20 frames in a row";
  return out;
}

}  // namespace palpate
