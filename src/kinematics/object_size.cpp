#include "palpate/kinematics/object_size.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/progress.h"
#include "palpate/core/statistics.h"
#include "palpate/kinematics/contact_geometry.h"
#include "palpate/kinematics/joint_range.h"

namespace palpate {
namespace {

constexpr double kCountsOfFoamMm = 1000.0;
constexpr double kLargestCosine = -0.1;  // N1 . N2 of two pads that face each other is at most this
constexpr int kSmoothReach = 2;          // frames on either side

// The values of one matrix in one frame.
struct PadFrame {
  double sum = 0.0, peak = 0.0;
  double xMm = 0.0, yMm = 0.0;
};

struct GraspFrame {
  std::size_t frame = 0;
  std::int64_t timeUs = 0;
  std::vector<double> anglesDeg;
  std::vector<PadFrame> pads;  // one per matrix
  double sphereMm = 0.0;
  double load = 0.0;
};

double peakOf(const TactileFrame& frame, std::size_t matrix) {
  double peak = 0.0;
  for (const float value : frame.matrix(matrix).reshaped())
    if (std::isfinite(value)) peak = std::max(peak, static_cast<double>(value));
  return peak;
}

std::vector<GraspFrame> readFrames(const Profile& profile,
                                   const HandGeometry& geometry,
                                   std::size_t begin,
                                   std::size_t end,
                                   const Progress& progress,
                                   ObjectSizeReport& report) {
  std::vector<GraspFrame> frames;
  TactileFrame frame;
  HandPose pose;
  HandContact contact;
  for (std::size_t i = begin; i <= end; ++i) {
    reportProgress(progress, i - begin, end - begin + 1);
    const auto angles = profile.anglesAtFrame(i);
    if (!angles ||
        checkAngles(angles->values, profile.hand().axes).state == AngleValidity::kUnusable) {
      ++report.unusableFrames;
      continue;
    }
    profile.readFrame(i, frame);
    geometry.pose(angles->values, pose);
    contactOf(frame, pose, {}, contact);
    GraspFrame& added = frames.emplace_back();
    added.frame = i;
    added.timeUs = frame.hostUs;
    added.anglesDeg = angles->values;
    if (contact.taxelSphere) added.sphereMm = 2.0 * contact.taxelSphere->radiusMm;
    for (std::size_t m = 0; m < contact.matrices.size(); ++m) {
      const MatrixContact& pad = contact.matrices[m];
      added.pads.push_back({pad.sum, peakOf(frame, m), pad.xMm, pad.yMm});
    }
  }
  return frames;
}

// Returns the strongest matrices of two different fingers that touch; of three, the two strongest.
std::optional<std::pair<std::size_t, std::size_t>> strongestPads(
    const std::vector<GraspFrame>& frames, const GeometryDescription& hand) {
  std::vector<std::pair<double, std::size_t>> strongest(hand.fingers.size(), {0.0, 0});
  for (std::size_t m = 0; m < hand.surfaces.size(); ++m) {
    double sum = 0.0;
    for (const GraspFrame& frame : frames) sum += frame.pads[m].sum;
    if (!hand.surfaces[m].place.link) continue;  // on the palm: no finger holds with it
    auto& best = strongest[hand.surfaces[m].place.finger];
    if (sum > best.first) best = {sum, m};
  }
  std::sort(strongest.begin(), strongest.end(), std::greater<>());
  if (strongest.size() < 2 || strongest[1].first <= 0.0) return std::nullopt;
  return std::minmax({strongest[0].second, strongest[1].second});
}

// Sets the load of both pads: each is divided by its own largest sum, since sensitivities may
// differ; the mean is smoothed and divided by its largest value.
void setLoads(std::vector<GraspFrame>& frames, std::pair<std::size_t, std::size_t> pads) {
  double largest1 = 0.0, largest2 = 0.0;
  for (const GraspFrame& frame : frames) {
    largest1 = std::max(largest1, frame.pads[pads.first].sum);
    largest2 = std::max(largest2, frame.pads[pads.second].sum);
  }
  std::vector<double> raw;
  for (const GraspFrame& frame : frames)
    raw.push_back(frame.pads[pads.first].sum / largest1 + frame.pads[pads.second].sum / largest2);
  const auto last = static_cast<int>(frames.size()) - 1;
  double largest = 0.0;
  for (int i = 0; i <= last; ++i) {
    double sum = 0.0;
    for (int k = i - kSmoothReach; k <= i + kSmoothReach; ++k)
      sum += raw[static_cast<std::size_t>(std::clamp(k, 0, last))];
    frames[static_cast<std::size_t>(i)].load = sum;
    largest = std::max(largest, sum);
  }
  for (GraspFrame& frame : frames) frame.load /= largest;
}

struct SurfacePoint {
  double xMm = 0.0, yMm = 0.0;
};

// Returns the value-weighted mean over the plateau.
SurfacePoint plateauCentroid(const std::vector<GraspFrame>& frames,
                             std::size_t matrix,
                             double plateauFraction) {
  double sum = 0.0, x = 0.0, y = 0.0;
  for (const GraspFrame& frame : frames) {
    if (frame.load < plateauFraction) continue;
    const PadFrame& pad = frame.pads[matrix];
    sum += pad.sum;
    x += pad.sum * pad.xMm;
    y += pad.sum * pad.yMm;
  }
  return sum > 0.0 ? SurfacePoint{x / sum, y / sum} : SurfacePoint{};
}

double foamOf(const GraspFrame& frame,
              std::pair<std::size_t, std::size_t> pads,
              const ObjectSizeOptions& options) {
  return options.foamMm * (std::sqrt(frame.pads[pads.first].peak / kCountsOfFoamMm) +
                           std::sqrt(frame.pads[pads.second].peak / kCountsOfFoamMm));
}

// Returns false when the pads do not face each other in a frame.
bool addSamples(const std::vector<GraspFrame>& frames,
                const HandGeometry& geometry,
                const ObjectSizeOptions& options,
                ObjectSizeReport& report) {
  const auto [pad1, pad2] = report.pads;
  const SurfacePoint at1 = plateauCentroid(frames, pad1, options.plateauFraction);
  const SurfacePoint at2 = plateauCentroid(frames, pad2, options.plateauFraction);
  HandPose pose;
  for (const GraspFrame& frame : frames) {
    geometry.pose(frame.anglesDeg, pose);
    const auto distanceMm = chordDistanceMm(pose.pointMm(pad1, at1.xMm, at1.yMm),
                                            pose.normalAt(pad1, at1.xMm, at1.yMm),
                                            pose.pointMm(pad2, at2.xMm, at2.yMm),
                                            pose.normalAt(pad2, at2.xMm, at2.yMm));
    if (!distanceMm) return false;
    report.samples.push_back(
        {.frame = frame.frame,
         .timeUs = frame.timeUs,
         .sphereMm = frame.sphereMm,
         .distanceMm = *distanceMm,
         .foamMm = foamOf(frame, report.pads, options),
         .load = frame.load,
         .bothTouch = frame.pads[pad1].sum > 0.0 && frame.pads[pad2].sum > 0.0});
  }
  return true;
}

void conclude(const ObjectSizeOptions& options, ObjectSizeReport& report) {
  const std::vector<SizeSample>& samples = report.samples;
  std::vector<double> distances, spheres, foams;
  for (const SizeSample& sample : samples) {
    if (sample.load < options.plateauFraction) continue;
    if (distances.empty()) report.plateauFrame = sample.frame;
    distances.push_back(sample.distanceMm);
    spheres.push_back(sample.sphereMm);
    foams.push_back(sample.foamMm);
  }
  const auto start = std::find_if(
      samples.begin(), samples.end(), [](const SizeSample& sample) { return sample.bothTouch; });
  const auto next = std::next(start) == samples.end() ? start : std::next(start);
  report.startFrame = start->frame;
  report.startMm = start->distanceMm;
  report.plateauFrames = distances.size();
  report.plateauMm = median(std::move(distances));
  report.spherePlateauMm = median(std::move(spheres));
  report.shrinkMm = report.startMm - report.plateauMm;
  const double plateauFoamMm = median(std::move(foams));
  report.foamMm = plateauFoamMm - start->foamMm;
  report.compressionMm = report.shrinkMm - report.foamMm;
  report.compressionSdMm = std::hypot(options.foamRelativeSd * report.foamMm,
                                      options.noiseSdMm,
                                      next->distanceMm - start->distanceMm);
  report.diameterMm = report.plateauMm + plateauFoamMm;
  report.diameterSdMm =
      std::hypot(options.foamRelativeSd * plateauFoamMm, options.noiseSdMm, options.sessionSdMm);
  report.valid = true;
}

void requireArguments(const Profile& profile,
                      const HandGeometry& geometry,
                      std::size_t begin,
                      std::size_t end,
                      const ObjectSizeOptions& options) {
  options.validate();
  const GeometryDescription& hand = geometry.description();
  if (begin > end || end >= profile.numFrames())
    throw std::out_of_range("objectSize: there are no frames " + std::to_string(begin) + ".." +
                            std::to_string(end));
  if (options.pads && std::max(options.pads->first, options.pads->second) >= hand.surfaces.size())
    throw std::invalid_argument("objectSize: there is no such pad");
  if (profile.numAngles() > 0 && profile.hand().axes.size() != hand.numAxes)
    throw std::invalid_argument("objectSize: the recording is of a hand with other axes");
}

}  // namespace

void ObjectSizeOptions::validate() const {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw std::invalid_argument(std::string("ObjectSizeOptions: ") + what);
  };
  require(!pads || pads->first != pads->second, "pads must be two");
  require(plateauFraction >= 0.5 && plateauFraction <= 1.0, "plateauFraction must be 0.5..1");
  require(foamMm >= 0.0 && std::isfinite(foamMm), "foamMm must be >= 0");
  require(foamRelativeSd >= 0.0 && std::isfinite(foamRelativeSd), "foamRelativeSd must be >= 0");
  require(noiseSdMm >= 0.0 && std::isfinite(noiseSdMm), "noiseSdMm must be >= 0");
  require(sessionSdMm >= 0.0 && std::isfinite(sessionSdMm), "sessionSdMm must be >= 0");
}

std::optional<double> chordDistanceMm(const Eigen::Vector3d& point1Mm,
                                      const Eigen::Vector3d& normal1,
                                      const Eigen::Vector3d& point2Mm,
                                      const Eigen::Vector3d& normal2) {
  const double cosine = normal1.dot(normal2);
  if (!(cosine <= kLargestCosine)) return std::nullopt;
  const Eigen::Vector3d across = (normal1 - normal2).normalized();
  return (point2Mm - point1Mm).dot(across) / std::sqrt((1.0 - cosine) / 2.0);
}

ObjectSizeReport objectSize(const Profile& profile,
                            const HandGeometry& geometry,
                            std::size_t begin,
                            std::size_t end,
                            const ObjectSizeOptions& options,
                            const Progress& progress) {
  requireArguments(profile, geometry, begin, end, options);
  ObjectSizeReport report;
  std::vector<GraspFrame> frames = readFrames(profile, geometry, begin, end, progress, report);
  if (frames.empty()) {
    report.problem = "no joint angles";
    return report;
  }
  const auto pads = options.pads ? options.pads : strongestPads(frames, geometry.description());
  const bool bothTouch =
      pads && std::any_of(frames.begin(), frames.end(), [&](const GraspFrame& frame) {
        return frame.pads[pads->first].sum > 0.0 && frame.pads[pads->second].sum > 0.0;
      });
  if (!bothTouch) {
    report.problem = "no two fingers touch";
    return report;
  }
  report.pads = *pads;
  setLoads(frames, report.pads);
  if (addSamples(frames, geometry, options, report))
    conclude(options, report);
  else
    report.problem = "the two pads don't face each other";
  return report;
}

}  // namespace palpate
