#include "palpate/recognition/plateau_features.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <stdexcept>

#include "palpate/core/statistics.h"
#include "palpate/kinematics/object_size.h"

#include "recognition/pinch_frames.h"

namespace palpate {
namespace {

constexpr const char* kNotFacing = "the two pads don't face each other";
// Frames on either side in the moving average.
constexpr int kSmoothReach = 2;
constexpr double kSizeScaleMm = 40.0;
constexpr double kMinDistanceMm = -39.9;
// Added to second moments [taxel^2], because a single taxel has no extent.
constexpr double kMomentFloor = 0.15;
constexpr std::array<std::size_t, 3> kStrongest = {1, 4, 9};

// Moving average over five frames of the load of both pads [counts of the first pad]; the first and
// last frame are repeated at the ends.
std::vector<double> smoothLoads(const PinchFrames& frames, const PinchHand& hand) {
  const auto last = static_cast<int>(frames.loads.size()) - 1;
  std::vector<double> smooth(frames.loads.size(), 0.0);
  for (int i = 0; i <= last; ++i)
    for (int k = i - kSmoothReach; k <= i + kSmoothReach; ++k) {
      const auto& loads = frames.loads[static_cast<std::size_t>(std::clamp(k, 0, last))];
      smooth[static_cast<std::size_t>(i)] +=
          (loads[hand.pads[0]].sum + hand.secondPadGain * loads[hand.pads[1]].sum) /
          (2.0 * kSmoothReach + 1.0);
    }
  return smooth;
}

// Returns the frames of the plateau, at most maxPlateauFrames, evenly selected.
std::vector<std::size_t> plateauOf(const std::vector<double>& loads,
                                   const PlateauFeatureOptions& options) {
  const double enough = options.plateauFraction * *std::max_element(loads.begin(), loads.end());
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < loads.size(); ++i)
    if (loads[i] >= enough) all.push_back(i);
  if (all.size() <= options.maxPlateauFrames) return all;
  std::vector<std::size_t> taken;
  const auto most = static_cast<double>(options.maxPlateauFrames);
  for (std::size_t i = 0; i < options.maxPlateauFrames; ++i) {
    const double at =
        most > 1.0 ? static_cast<double>(i) * static_cast<double>(all.size() - 1) / (most - 1.0)
                   : 0.0;
    taken.push_back(all[static_cast<std::size_t>(std::lround(at))]);
  }
  return taken;
}

PlateauPad describe(const Eigen::MatrixXd& mean, const PlateauFeatureOptions& options) {
  PlateauPad out;
  const double threshold = options.activeFraction * mean.maxCoeff();
  std::vector<double> parts;
  double sum = 0.0;
  for (const double value : mean.reshaped())
    if (value > threshold) sum += value;
  double u = 0.0, v = 0.0, w = 0.0;
  for (Eigen::Index x = 0; x < mean.cols(); ++x)
    for (Eigen::Index y = 0; y < mean.rows(); ++y) {
      if (!(mean(y, x) > threshold)) continue;
      const double p = mean(y, x) / sum;
      parts.push_back(p);
      out.column += p * static_cast<double>(x);
      out.row += p * static_cast<double>(y);
      out.entropy -= p * std::log(p);
    }
  for (Eigen::Index x = 0; x < mean.cols(); ++x)
    for (Eigen::Index y = 0; y < mean.rows(); ++y) {
      if (!(mean(y, x) > threshold)) continue;
      const double p = mean(y, x) / sum;
      const double dx = static_cast<double>(x) - out.column, dy = static_cast<double>(y) - out.row;
      u += p * dx * dx;
      v += p * dy * dy;
      w += p * dx * dy;
    }
  const double half = std::hypot((u - v) / 2.0, w);
  out.lnMajor = std::log((u + v) / 2.0 + half + kMomentFloor);
  out.lnMinor = std::log(std::max(0.0, (u + v) / 2.0 - half) + kMomentFloor);
  out.slant = 2.0 * w / (u + v + 2.0 * kMomentFloor);
  std::sort(parts.begin(), parts.end(), std::greater<>());
  double share = 0.0;
  for (std::size_t i = 0, k = 0; k < kStrongest.size(); ++k) {
    for (; i < std::min(kStrongest[k], parts.size()); ++i) share += parts[i];
    out.shares[k] = share;
  }
  out.lnActive = std::log(static_cast<double>(parts.size()) + 1.0);
  out.lnSum = std::log(sum);
  out.lnPeak = std::log(mean.maxCoeff());
  return out;
}

// Mean of the values of a pad over frames.
Eigen::MatrixXd meanPicture(const Profile& profile,
                            std::size_t begin,
                            const std::vector<std::size_t>& frames,
                            std::size_t pad) {
  Eigen::MatrixXd mean;
  TactileFrame frame;
  for (const std::size_t i : frames) {
    profile.readFrame(begin + i, frame);
    const TactileFrame& values = frame;
    const Eigen::MatrixXd picture = values.matrix(pad).cast<double>();
    mean = mean.size() == 0 ? picture : Eigen::MatrixXd(mean + picture);
  }
  return mean / static_cast<double>(frames.size());
}

std::optional<double> distanceOf(const PinchHand& hand,
                                 const std::vector<double>& anglesDeg,
                                 const std::array<Eigen::Vector2d, 2>& atMm) {
  const HandPose pose = hand.effectiveGeometry->pose(anglesDeg);
  std::array<Eigen::Vector3d, 2> points, normals;
  for (std::size_t i = 0; i < 2; ++i) {
    points[i] = pose.pointMm(hand.pads[i], atMm[i].x(), atMm[i].y());
    normals[i] = pose.normalAt(hand.pads[i], atMm[i].x(), atMm[i].y());
  }
  return chordDistanceMm(points[0], normals[0], points[1], normals[1]);
}

// Computes the features with the first two pads of the hand.
PlateauFeatures featuresOfPads(const Profile& profile,
                               const GraspSegment& grasp,
                               const PinchHand& hand,
                               const PlateauFeatureOptions& options) {
  PlateauFeatures out;
  out.matrices = hand.pads;
  const PinchFrames frames = readPinch(profile, grasp, hand, false);
  out.problem = frames.problem;
  if (!out.problem.empty()) return out;

  const std::vector<double> loads = smoothLoads(frames, hand);
  const double largest = *std::max_element(loads.begin(), loads.end());
  const auto start = static_cast<std::size_t>(
      std::find_if(loads.begin(),
                   loads.end(),
                   [&](double load) { return load >= options.startFraction * largest; }) -
      loads.begin());
  const std::vector<std::size_t> plateau = plateauOf(loads, options);
  out.startFrame = grasp.begin + start;
  out.plateauFrame = grasp.begin + plateau.front();
  out.plateauEndFrame = grasp.begin + plateau.back();

  for (std::size_t axis = 0; axis < frames.anglesDeg.front().size(); ++axis) {
    std::vector<double> angles;
    for (const std::size_t i : plateau) angles.push_back(frames.anglesDeg[i][axis]);
    out.plateauAnglesDeg.push_back(median(std::move(angles)));
  }

  std::array<PlateauPad, 2>& pads = out.pads;
  std::array<Eigen::Vector2d, 2> atPlateauMm, atStartMm;
  for (std::size_t i = 0; i < 2; ++i) {
    const std::size_t pad = hand.pads[i];
    const Eigen::MatrixXd mean = meanPicture(profile, grasp.begin, plateau, pad);
    pads[i] = describe(mean, options);
    // The centroid used for D includes every taxel.
    const Eigen::VectorXd columns =
        Eigen::VectorXd::LinSpaced(mean.cols(), 0.0, static_cast<double>(mean.cols()) - 1.0);
    const Eigen::VectorXd rows =
        Eigen::VectorXd::LinSpaced(mean.rows(), 0.0, static_cast<double>(mean.rows()) - 1.0);
    const TaxelPitch& pitchMm = profile.layout().matrix(pad).pitchMm;
    atPlateauMm[i] =
        (Eigen::Vector2d(mean.colwise().sum().dot(columns), mean.rowwise().sum().dot(rows)) /
         mean.sum())
            .cwiseProduct(Eigen::Vector2d(pitchMm.x, pitchMm.y));
    const PadLoad& load = frames.loads[start][pad];
    atStartMm[i] = {load.xMm, load.yMm};
  }
  const auto distance = distanceOf(hand, out.plateauAnglesDeg, atPlateauMm);
  const auto atStart = distanceOf(hand, frames.anglesDeg[start], atStartMm);
  if (!distance || !atStart) {
    out.problem = kNotFacing;
    return out;
  }
  out.distanceMm = *distance;
  const auto mean = [&](auto of) { return (of(pads[0]) + of(pads[1])) / 2.0; };
  out.values = {sizeZ(*distance),
                mean([](const PlateauPad& pad) { return pad.lnMajor; }),
                mean([](const PlateauPad& pad) { return pad.lnMinor; }),
                mean([](const PlateauPad& pad) { return pad.shares[0]; }),
                mean([](const PlateauPad& pad) { return pad.shares[1]; }),
                mean([](const PlateauPad& pad) { return pad.shares[2]; }),
                mean([](const PlateauPad& pad) { return std::abs(pad.slant); }),
                mean([](const PlateauPad& pad) { return pad.entropy; }),
                mean([](const PlateauPad& pad) { return pad.lnActive; }),
                mean([](const PlateauPad& pad) { return pad.lnSum; }),
                *atStart - *distance};
  return out;
}

}  // namespace

void PlateauFeatureOptions::validate() const {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw std::invalid_argument(std::string("PlateauFeatureOptions: ") + what);
  };
  require(plateauFraction > 0.0 && plateauFraction <= 1.0,
          "plateauFraction must be above 0, up to 1");
  require(startFraction > 0.0 && startFraction <= 1.0, "startFraction must be above 0, up to 1");
  require(maxPlateauFrames >= 1, "maxPlateauFrames must be 1 or more");
  require(activeFraction >= 0.0 && activeFraction < 1.0, "activeFraction must be 0 up to below 1");
}

double sizeZ(double distanceMm) noexcept {
  return kSizeScaleMm * std::log1p(std::max(distanceMm, kMinDistanceMm) / kSizeScaleMm);
}

double distanceOfSizeZ(double z) noexcept { return kSizeScaleMm * std::expm1(z / kSizeScaleMm); }

const std::vector<std::string>& plateauFeatureNames() {
  static const std::vector<std::string> names = {"size_z",
                                                 "ln_major",
                                                 "ln_minor",
                                                 "share_1",
                                                 "share_4",
                                                 "share_9",
                                                 "skew",
                                                 "entropy",
                                                 "ln_active",
                                                 "ln_sum",
                                                 "closing_mm"};
  return names;
}

void useCurrentFeatureNames(std::vector<std::string>& names) {
  std::replace(
      names.begin(), names.end(), std::string("compression_mm"), std::string("closing_mm"));
}

PlateauFeatures plateauFeatures(const Profile& profile,
                                const GraspSegment& grasp,
                                const PinchHand& hand,
                                const PlateauFeatureOptions& options) {
  options.validate();
  PlateauFeatures out = featuresOfPads(profile, grasp, hand, options);
  for (std::size_t i = 0; i < hand.otherPads.size() && out.problem == kNotFacing; ++i) {
    PinchHand other = hand;
    other.pads = hand.otherPads[i];
    other.secondPadGain = 1.0;
    const auto touch = longestTouch(profile, grasp, other.pads);
    if (!touch) continue;
    PlateauFeatures found = featuresOfPads(profile, *touch, other, options);
    if (found.problem.empty()) out = std::move(found);
  }
  return out;
}

}  // namespace palpate
