// The ways to measure how a contact moves over a matrix, under the names that commands and settings
// use.
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace palpate {

enum class SlipMethod {
  kCentroid,  // of all active taxels
  kAlcazar,   // centre of mass of the full convolution of both frames: the sum of their centroids
  kNccParaboloid,  // normalised cross-correlation, paraboloid around the peak
  kNccGauss3,      // the same, three-point Gaussian formulas around the peak
  kPhase,          // cross-power spectrum, not normalised, peak of the upsampled inverse transform
  kPhaseNormalized,  // the same of the normalised spectrum (phase alone)
  kRegister,         // rigid registration of a key frame
  kHypotheses,       // registration weighed against a load field that doesn't move
};

// All of them, in this order.
std::span<const SlipMethod> slipMethods() noexcept;
// "centroid", "alcazar", "ncc-paraboloid", "ncc-gauss3", "phase", "phase-normalized", "register",
// "contest"
std::string_view nameOf(SlipMethod method) noexcept;
// Nothing: no method is called so.
std::optional<SlipMethod> slipMethodNamed(std::string_view name) noexcept;

}  // namespace palpate
