#include "palpate/recognition/study_features.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "palpate/core/number_text.h"
#include "palpate/kinematics/bounding_sphere.h"
#include "palpate/recognition/chebyshev_moments.h"

#include "recognition/pinch_frames.h"

namespace palpate {
namespace {

using Eigen::Vector3d;

// Number of frames at the end from which the end frame is chosen.
constexpr std::size_t kTail = 10;
// Number of frames at the beginning from which the initial frame is chosen.
constexpr std::size_t kHead = 10;
constexpr int kOrder = 4;

double impressionMm(const std::vector<PadLoad>& loads, const PinchHand& hand) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 2; ++i) sum += loads[hand.pads[i]].largest / hand.largestCounts[i];
  return sum;
}

// D_k of the frames of a grasp: the diameter of the smallest sphere around the centroids of all
// touching matrices.
class Diameters {
 public:
  Diameters(const PinchFrames& frames, const PinchHand& hand) : frames_(frames), hand_(hand) {}

  // Returns the exact value, or some value above `enough` if the exact value is certainly above it.
  double at(std::size_t k, double enough = std::numeric_limits<double>::infinity()) {
    const auto& loads = frames_.loads[k];
    hand_.studyGeometry->pose(frames_.anglesDeg[k], pose_);
    const auto pointOf = [&](std::size_t m) {
      return pose_.pointMm(m, loads[m].xMm, loads[m].yMm);
    };
    points_ = {pointOf(hand_.pads[0]), pointOf(hand_.pads[1])};
    const double apart = (points_[0] - points_[1]).norm();
    const double impression = impressionMm(loads, hand_);
    for (std::size_t m = 0; m < loads.size(); ++m)
      if (m != hand_.pads[0] && m != hand_.pads[1] && loads[m].sum > 0.0)
        points_.push_back(pointOf(m));
    // A sphere around two points is at least as large as their distance.
    if (points_.size() == 2 || apart + impression > enough) return apart + impression;
    return 2.0 * smallestEnclosingSphere(points_)->radiusMm + impression;
  }

 private:
  const PinchFrames& frames_;
  const PinchHand& hand_;
  HandPose pose_;
  std::vector<Vector3d> points_;
};

// Returns the two of the last frames whose diameters are nearest to the median (which is the mean
// of both), each minus one frame.
std::array<std::size_t, 2> endFrames(const std::array<double, kTail>& diameters,
                                     std::size_t count) {
  std::array<std::pair<double, std::size_t>, kTail> tail;
  for (std::size_t i = 0; i < kTail; ++i) tail[i] = {diameters[i], i};
  std::sort(tail.begin(), tail.end());
  const auto [first, last] = std::minmax(tail[kTail / 2 - 1].second, tail[kTail / 2].second);
  return {count - 1 - kTail + first, count - 1 - kTail + last};
}

// D'_k: the distance of two points that are fixed on the pads.
double distanceAt(const PinchFrames& frames,
                  const PinchHand& hand,
                  std::size_t k,
                  const std::vector<PadLoad>& at,
                  HandPose& pose) {
  hand.studyGeometry->pose(frames.anglesDeg[k], pose);
  std::array<Vector3d, 2> points;
  for (std::size_t i = 0; i < 2; ++i) {
    const PadLoad& load = at[hand.pads[i]];
    points[i] = pose.pointMm(hand.pads[i], load.xMm, load.yMm);
  }
  return (points[0] - points[1]).norm() + impressionMm(frames.loads[k], hand);
}

double standardDeviation(const Eigen::MatrixXd& picture) {
  double sum = 0.0, count = 0.0, squares = 0.0;
  for (const double value : picture.reshaped()) {
    if (!isTouched(value)) continue;
    sum += value;
    count += 1.0;
  }
  if (count == 0.0) return 0.0;
  const double mean = sum / count;
  for (const double value : picture.reshaped())
    if (isTouched(value)) squares += (value - mean) * (value - mean);
  return std::sqrt(squares / count);
}

Eigen::MatrixXd reconstructImage(const TactileFrame& frame,
                                 std::size_t pad,
                                 const PinchHand& hand) {
  const ConstMatrixMap values = frame.matrix(pad);
  const int left = (hand.imageSize - static_cast<int>(values.cols())) / 2;
  return padToSquare(values.cast<double>() / hand.fullScaleCounts, hand.imageSize, 0, left);
}

}  // namespace

std::vector<std::string> studyFeatureNames(const PinchHand& hand) {
  std::vector<std::string> names = {"diameter", "compressibility"};
  for (const std::size_t pad : hand.pads) names.push_back("std_" + std::to_string(pad));
  for (const std::size_t pad : hand.pads)
    for (int p = 0; p <= kOrder; ++p)
      for (int q = 0; q <= kOrder; ++q)
        names.push_back("m" + std::to_string(pad) + "_T" + std::to_string(p) + std::to_string(q));
  return names;
}

bool isStudySet(const std::vector<std::string>& names) {
  // diameter, compressibility, two standard deviations, then the moments of the two pads.
  constexpr std::size_t kSingle = 4;
  constexpr std::size_t kMoments = (kOrder + 1) * (kOrder + 1);
  if (names.size() != kSingle + 2 * kMoments) return false;
  const auto padOf = [&](std::size_t i) { return names[i].substr(1, names[i].find('_') - 1); };
  PinchHand hand;
  for (std::size_t k = 0; k < 2; ++k) {
    const auto pad = parseInteger(padOf(kSingle + k * kMoments));
    if (!pad || *pad < 0) return false;
    hand.pads[k] = static_cast<std::size_t>(*pad);
  }
  return names == studyFeatureNames(hand);
}

StudyFeatures studyFeatures(const Profile& profile,
                            const GraspSegment& grasp,
                            const PinchHand& hand,
                            std::optional<std::size_t> endFrame) {
  if (endFrame && (*endFrame < grasp.begin || *endFrame > grasp.end))
    throw std::invalid_argument("studyFeatures: end frame " + std::to_string(*endFrame) +
                                " outside of the grasp");
  StudyFeatures out;
  const PinchFrames frames = readPinch(profile, grasp, hand, true);
  out.problem = frames.problem;
  if (!out.problem.empty()) return out;

  const std::size_t count = frames.loads.size();
  Diameters diameters(frames, hand);
  // Diameters of the last frames.
  std::array<double, kTail> last{};
  for (std::size_t i = 0; i < kTail; ++i) last[i] = diameters.at(count - kTail + i);
  const auto ends = endFrames(last, count);
  const std::size_t end = endFrame ? *endFrame - grasp.begin : ends[0];
  out.endFrame = grasp.begin + end;
  out.otherEndFrame = grasp.begin + ends[1];

  double diameter = *std::min_element(last.begin(), last.end());
  for (std::size_t k = 0; k < count - kTail; ++k)
    diameter = std::min(diameter, diameters.at(k, diameter));

  HandPose pose;
  std::size_t initial = 0;
  double widest = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < kHead; ++k) {
    const double distance = distanceAt(frames, hand, k, frames.loads[end], pose);
    if (distance > widest) initial = k;
    widest = std::max(widest, distance);
  }
  out.initialFrame = grasp.begin + initial;
  out.values = {diameter, widest - distanceAt(frames, hand, end, frames.loads[end], pose)};

  const TactileFrame frame = profile.frame(out.endFrame);
  const ChebyshevPolynomials polynomials(hand.imageSize, kOrder);
  std::vector<double> moments;
  for (const std::size_t pad : hand.pads) {
    const Eigen::MatrixXd picture = reconstructImage(frame, pad, hand);
    out.values.push_back(standardDeviation(picture));
    const auto found = chebyshevInvariants(picture, polynomials, ImageOrientation::kStudy);
    for (int p = 0; p <= kOrder; ++p)
      for (int q = 0; q <= kOrder; ++q) moments.push_back(found.moments(p, q));
  }
  out.values.insert(out.values.end(), moments.begin(), moments.end());
  return out;
}

}  // namespace palpate
