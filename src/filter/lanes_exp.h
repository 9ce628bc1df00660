// exp() of eight values at or below 0 at once.
#pragma once

#include <cstring>

#include "filter/lanes.h"

namespace palpate::detail {

// Relative error below 3e-7 for x in -87..0; 1e-38 below that.
inline FourLanes expOf(FourLanes x) {
  typedef int FourWords __attribute__((vector_size(16)));  // NOLINT: as FourLanes
  constexpr float kLog2E = 1.44269504F;
  constexpr float kLowest = -126.0F;
  // 1.5 * 2^23: adding it leaves the whole part in the low bits
  constexpr float kRounder = 12582912.0F;
  constexpr int kMantissaBits = 23;
  const FourLanes t = most(x * kLog2E, FourLanes{} + kLowest);
  const FourLanes rounded = t + kRounder;
  const FourLanes part = t - (rounded - kRounder);  // -0.5..0.5
  // 2^part by its Taylor series; the seventh term is below 2e-7.
  FourLanes power = FourLanes{} + 1.54035304e-4F;
  power = power * part + 1.33335581e-3F;
  power = power * part + 9.61812911e-3F;
  power = power * part + 5.55041087e-2F;
  power = power * part + 2.40226507e-1F;
  power = power * part + 6.93147181e-1F;
  power = power * part + 1.0F;
  FourWords whole;
  FourWords bits;
  std::memcpy(&whole, &rounded, sizeof whole);
  std::memcpy(&bits, &power, sizeof bits);
  bits += whole << kMantissaBits;
  std::memcpy(&power, &bits, sizeof power);
  return power;
}
inline Lanes expOf(const Lanes& x) { return {expOf(x.a), expOf(x.b)}; }

}  // namespace palpate::detail
