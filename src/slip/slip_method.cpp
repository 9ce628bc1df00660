#include "palpate/slip/slip_method.h"

#include <array>

namespace palpate {
namespace {

constexpr std::array kMethods{SlipMethod::kCentroid,
                              SlipMethod::kAlcazar,
                              SlipMethod::kNccParaboloid,
                              SlipMethod::kNccGauss3,
                              SlipMethod::kPhase,
                              SlipMethod::kPhaseNormalized,
                              SlipMethod::kRegister,
                              SlipMethod::kContest};

}  // namespace

std::span<const SlipMethod> slipMethods() noexcept { return kMethods; }

std::string_view nameOf(SlipMethod method) noexcept {
  switch (method) {
    case SlipMethod::kCentroid:
      return "centroid";
    case SlipMethod::kAlcazar:
      return "alcazar";
    case SlipMethod::kNccParaboloid:
      return "ncc-paraboloid";
    case SlipMethod::kNccGauss3:
      return "ncc-gauss3";
    case SlipMethod::kPhase:
      return "phase";
    case SlipMethod::kPhaseNormalized:
      return "phase-normalized";
    case SlipMethod::kRegister:
      return "register";
    case SlipMethod::kContest:
      return "contest";
  }
  return "unknown";
}

std::optional<SlipMethod> slipMethodNamed(std::string_view name) noexcept {
  for (const SlipMethod method : kMethods)
    if (nameOf(method) == name) return method;
  return std::nullopt;
}

}  // namespace palpate
