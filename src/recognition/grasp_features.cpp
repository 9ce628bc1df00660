#include "palpate/recognition/grasp_features.h"

#include <array>
#include <span>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/recognition/contact_statistics.h"
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
  for (const auto& [word, known] : kFeatureSetWords)
    if (known == set) return word;
  return {};
}

std::optional<FeatureSet> featureSetNamed(std::string_view name) noexcept {
  for (const auto& [word, set] : kFeatureSetWords)
    if (word == name) return set;
  return std::nullopt;
}

FeatureSet defaultFeatureSet(const HandDescription& hand) {
  return pinchHandOf(hand) ? FeatureSet::kBest : FeatureSet::kStatistics;
}

std::vector<std::string> featureNames(FeatureSet set, const HandDescription& description) {
  if (set == FeatureSet::kStatistics) return contactStatisticsNames(description);
  const auto pinch = pinchHandOf(description);
  if (!pinch) throw Error(withoutPinchText(description));
  const PinchHand& hand = *pinch;
  if (set == FeatureSet::kStudy) return studyFeatureNames(hand);
  std::vector<std::string> names = plateauFeatureNames();
  if (set == FeatureSet::kBest) return names;
  for (const std::size_t axis : hand.gripAxes) names.push_back("angle_" + std::to_string(axis));
  for (const std::size_t pad : hand.pads)
    for (const char* what : kSessionPadNames)
      names.push_back("m" + std::to_string(pad) + "_" + what);
  return names;
}

std::string_view featureUnit(FeatureSet set, std::string_view name) noexcept {
  if (set == FeatureSet::kStatistics) return {};
  if (set == FeatureSet::kStudy) {
    if (name == "diameter" || name == "compressibility") return "mm";
    return name.starts_with("std_") ? "full scale" : std::string_view();
  }
  if (name == "closing_mm") return "mm";
  if (set == FeatureSet::kBest) return {};
  if (name.starts_with("angle_")) return "deg";
  return name.ends_with("_row") || name.ends_with("_column") ? "taxels" : std::string_view();
}

std::string featureMeaning(FeatureSet set, std::string_view name) {
  using Meaning = std::pair<std::string_view, const char*>;
  static constexpr Meaning kOfPads[] = {
      {"size_z", "40 ln(1 + D / 40), D: distance of the pads on the plateau in mm"},
      {"ln_major", "ln(l + 0.15), l: larger principal second moment of the pressure in taxel^2"},
      {"ln_minor", "the same of the smaller moment"},
      {"share_1", "part of the pressure on the strongest taxel"},
      {"share_4", "part of the pressure on the 4 strongest taxels"},
      {"share_9", "part of the pressure on the 9 strongest taxels"},
      {"skew", "how far the contact lies across rows and columns"},
      {"entropy", "- sum p ln p, p: part of the pressure on a taxel"},
      {"ln_active", "ln(active taxels + 1)"},
      {"ln_sum", "ln(sum of the values)"},
      {"closing_mm", "how far the pads close while the load rises"}};
  static constexpr Meaning kOfSession[] = {
      {"row", "row of the centroid"},
      {"column", "column of the centroid"},
      {"ln_sum", "ln(sum of the values)"},
      {"ln_peak", "ln(largest value)"},
      {"ln_major", "ln(l + 0.15), l: larger principal second moment"},
      {"ln_minor", "the same of the smaller moment"}};
  static constexpr Meaning kOfHand[] = {
      {"ln_sum", "ln(s + 0.001), s: sum of all taxels as a part of full scale"},
      {"ln_peak", "ln(p + 0.001), p: largest value as a part of full scale"},
      {"ln_active", "ln(active taxels + 1)"},
      {"touched", "number of matrices with an active taxel"}};
  static constexpr Meaning kOfMatrix[] = {
      {"share", "part of the sum"},
      {"active", "part of its taxels that is active"},
      {"column", "centroid, -1 at the first column, 1 at the last one"},
      {"row", "centroid, -1 at the first row, 1 at the last one"},
      {"major", "ln((l + 0.15) / 0.15), l: larger second moment of the load in taxel^2"},
      {"minor", "the same of the smaller moment"}};
  static constexpr Meaning kOfStudy[] = {
      {"diameter", "smallest diameter of the sphere around the contact centroids"},
      {"compressibility", "how far the pads come nearer from initial_frame to end_frame"}};
  const auto found = [](std::span<const Meaning> meanings, std::string_view what) {
    for (const auto& [known, meaning] : meanings)
      if (known == what) return std::string(meaning);
    return std::string();
  };
  const auto underscore = name.find('_');
  const std::string_view head = name.substr(0, underscore);
  const std::string_view tail =
      underscore == std::string_view::npos ? std::string_view() : name.substr(underscore + 1);
  const bool isOfMatrix = head.size() > 1 && head.front() == 'm' &&
                          head.find_first_not_of("0123456789", 1) == std::string_view::npos;
  const auto ofMatrix = [&](std::span<const Meaning> meanings) {
    const std::string meaning = found(meanings, tail);
    return meaning.empty() ? meaning : meaning + ", matrix " + std::string(head.substr(1));
  };
  if (set == FeatureSet::kStatistics)
    return isOfMatrix ? ofMatrix(kOfMatrix) : found(kOfHand, name);
  if (set == FeatureSet::kStudy) {
    if (head == "std")
      return "standard deviation of the active taxels in end_frame, matrix " + std::string(tail);
    if (isOfMatrix && tail.size() == 3 && tail.front() == 'T')
      return "Chebyshev moment of order " + std::string(tail.substr(1, 1)) + " along x, " +
             std::string(tail.substr(2)) + " along y, matrix " + std::string(head.substr(1));
    return found(kOfStudy, name);
  }
  if (set == FeatureSet::kSession && head == "angle")
    return "angle of axis " + std::string(tail) + ", median over the plateau";
  if (set == FeatureSet::kSession && isOfMatrix) return ofMatrix(kOfSession);
  return found(kOfPads, name);
}

std::string_view sessionSetWarning() noexcept {
  return "the set 'session' holds joint angles at rest: it remembers the pose in which each object "
         "was presented, is best within one session, and fails in another session (use 'best')";
}

GraspFeatures graspFeatures(const Profile& profile, const GraspSegment& grasp, FeatureSet set) {
  GraspFeatures out;
  out.begin = grasp.begin;
  out.end = grasp.end;
  out.quality = grasp.quality;
  if (set == FeatureSet::kStatistics) {
    ContactStatistics found = contactStatistics(profile, grasp);
    out.problem = std::move(found.problem);
    out.initialFrame = found.startFrame;
    out.endFrame = found.plateauEndFrame;
    out.values = std::move(found.values);
    return out;
  }
  const auto hand = pinchHandOf(profile.hand());
  if (!hand) {
    out.problem = withoutPinchText(profile.hand());
    return out;
  }
  if (set == FeatureSet::kStudy) {
    StudyFeatures study = studyFeatures(profile, grasp, *hand);
    out.problem = std::move(study.problem);
    out.initialFrame = study.initialFrame;
    out.endFrame = study.endFrame;
    out.values = std::move(study.values);
    return out;
  }
  PlateauFeatures plateau = plateauFeatures(profile, grasp, *hand);
  out.problem = std::move(plateau.problem);
  out.initialFrame = plateau.startFrame;
  out.endFrame = plateau.plateauEndFrame;
  if (!out.problem.empty()) return out;
  out.values = std::move(plateau.values);
  if (set == FeatureSet::kSession) appendSession(plateau, *hand, out.values);
  return out;
}

std::vector<GraspSegment> findPinches(const Profile& profile,
                                      FeatureSet set,
                                      const Progress& progress) {
  if (set == FeatureSet::kStatistics) return findGrasps(profile, {}, progress);
  if (!pinchHandOf(profile.hand())) return {};
  GraspSegmentOptions options;
  options.rule = GraspRule::kStudy;
  return findGrasps(profile, options, progress);
}

std::string noPinchText(const HandDescription& hand, FeatureSet set) {
  if (set == FeatureSet::kStatistics)
    return "no grasp: nothing touches for more than 20 frames and 0.6 s";
  const auto pinch = pinchHandOf(hand);
  if (!pinch) return withoutPinchText(hand);
  return "no grasp: matrices " + std::to_string(pinch->pads[0]) + " and " +
         std::to_string(pinch->pads[1]) + " never touch together for more than 20 frames in a row";
}

RecordingFeatures recordingFeatures(const Profile& profile,
                                    FeatureSet set,
                                    const Progress& progress) {
  RecordingFeatures out;
  if (set != FeatureSet::kStatistics)
    if (const auto hand = pinchHandOf(profile.hand())) out.problem = hand->mismatch(profile);
  if (!out.problem.empty()) return out;
  for (const GraspSegment& grasp : findPinches(profile, set, progress))
    out.grasps.push_back(graspFeatures(profile, grasp, set));
  if (out.grasps.empty()) out.problem = noPinchText(profile.hand(), set);
  return out;
}

}  // namespace palpate
