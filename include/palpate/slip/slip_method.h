// Methods that measure how a contact moves over a matrix, with the names that commands and settings
// use.
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace palpate {

enum class SlipMethod {
  // Centroid of all active taxels.
  kCentroid,
  // Centre of mass of the full convolution of both frames, which is the sum of their centroids.
  kAlcazar,
  // Normalised cross-correlation with a paraboloid around the peak.
  kNccParaboloid,
  // Normalised cross-correlation with three-point Gaussian formulas around the peak.
  kNccGauss3,
  // Cross-power spectrum, not normalised: peak of the upsampled inverse transform.
  kPhase,
  // The same with the normalised spectrum (phase only).
  kPhaseNormalized,
  // Rigid registration to a key frame.
  kRegister,
  // Registration, compared with the hypothesis that only the load changed (slip_hypotheses.h).
  kContest,
};

// All methods, in this order.
std::span<const SlipMethod> slipMethods() noexcept;
// "centroid", "alcazar", "ncc-paraboloid", "ncc-gauss3", "phase", "phase-normalized", "register",
// "contest"
std::string_view nameOf(SlipMethod method) noexcept;
// Empty if no method has this name.
std::optional<SlipMethod> slipMethodNamed(std::string_view name) noexcept;

}  // namespace palpate
