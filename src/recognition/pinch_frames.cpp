#include "recognition/pinch_frames.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "palpate/core/number_text.h"
#include "palpate/kinematics/joint_range.h"

namespace palpate {
namespace {

std::string inFrame(std::size_t frame) { return " in frame " + std::to_string(frame); }

}  // namespace

PadLoad padLoad(const ConstMatrixMap& values, const TaxelPitch& pitchMm) {
  PadLoad load;
  // The common case: most pads are not touched.
  if (!isTouched(values.maxCoeff())) return load;
  double x = 0.0, y = 0.0;
  const float* value = values.data();
  for (Eigen::Index row = 0; row < values.rows(); ++row) {
    double sum = 0.0;
    for (Eigen::Index column = 0; column < values.cols(); ++column, ++value) {
      if (!isTouched(*value)) continue;
      const auto counts = static_cast<double>(*value);
      sum += counts;
      x += counts * static_cast<double>(column);
      load.largest = std::max(load.largest, counts);
    }
    load.sum += sum;
    y += sum * static_cast<double>(row);
  }
  if (load.sum > 0.0) {
    load.xMm = x / load.sum * pitchMm.x;
    load.yMm = y / load.sum * pitchMm.y;
  }
  return load;
}

PinchFrames readPinch(const Profile& profile,
                      const GraspSegment& grasp,
                      const PinchHand& hand,
                      bool allMatrices) {
  if (grasp.begin > grasp.end || grasp.end >= profile.numFrames())
    throw std::out_of_range("features: there are no frames " + std::to_string(grasp.begin) + ".." +
                            std::to_string(grasp.end));
  PinchFrames out;
  out.begin = grasp.begin;
  const std::size_t count = grasp.end - grasp.begin + 1;
  out.problem = hand.mismatch(profile);
  if (out.problem.empty() && count < kMinPinchFrames)
    out.problem = "half a grasp: " + counted(count, "frame") + ", of at least " +
                  std::to_string(kMinPinchFrames);
  if (out.problem.empty() && profile.numAngles() == 0) out.problem = "no joint angles";
  if (!out.problem.empty()) return out;

  const SensorLayout& layout = profile.layout();
  out.anglesDeg.reserve(count);
  out.loads.reserve(count);
  TactileFrame frame;
  for (std::size_t i = grasp.begin; i <= grasp.end && out.problem.empty(); ++i) {
    profile.readFrame(i, frame);
    const TactileFrame& values = frame;
    auto& loads = out.loads.emplace_back(layout.numMatrices());
    for (std::size_t m = 0; m < layout.numMatrices(); ++m) {
      const bool isPad = m == hand.pads[0] || m == hand.pads[1];
      if (!isPad && !allMatrices) continue;
      const ConstMatrixMap matrix = values.matrix(m);
      if (!matrix.allFinite()) out.problem = "values that are not numbers" + inFrame(i);
      loads[m] = padLoad(matrix, layout.matrix(m).pitchMm);
      if (isPad && !(loads[m].sum > 0.0) && out.problem.empty())
        out.problem = "matrix " + std::to_string(m) + " doesn't touch" + inFrame(i);
    }
    const auto angles = profile.anglesAtFrame(i);
    out.anglesDeg.push_back(angles ? angles->values : std::vector<double>{});
    if (!out.problem.empty()) break;
    if (out.anglesDeg.back().size() != hand.effectiveGeometry->description().numAxes ||
        !std::all_of(out.anglesDeg.back().begin(), out.anglesDeg.back().end(), [](double deg) {
          return std::isfinite(deg);
        }))
      out.problem = "joint angles that are missing or not numbers" + inFrame(i);
  }
  return out;
}

std::optional<GraspSegment> longestTouch(const Profile& profile,
                                         const GraspSegment& grasp,
                                         const std::array<std::size_t, 2>& pads) {
  std::size_t longest = 0, run = 0, end = 0;
  TactileFrame frame;
  for (std::size_t i = grasp.begin; i <= grasp.end; ++i) {
    profile.readFrame(i, frame);
    const TactileFrame& values = frame;
    const bool both = areTouched(values.matrix(pads[0]).array()).any() &&
                      areTouched(values.matrix(pads[1]).array()).any();
    run = both ? run + 1 : 0;
    if (run > longest) {
      longest = run;
      end = i;
    }
  }
  if (longest < kMinPinchFrames) return std::nullopt;
  return GraspSegment{.begin = end + 1 - longest, .end = end, .fingers = {}};
}

}  // namespace palpate
