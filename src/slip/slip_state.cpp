#include "palpate/slip/slip_state.h"

#include <array>
#include <utility>

namespace palpate {
namespace {

constexpr std::array<std::pair<SlipState, std::string_view>, 6> kStates = {{
    {SlipState::kInvalid, "invalid"},
    {SlipState::kStill, "still"},
    {SlipState::kLoading, "loading"},
    {SlipState::kLoadShift, "load_shift"},
    {SlipState::kAmbiguous, "ambiguous"},
    {SlipState::kSlip, "slip"},
}};

}  // namespace

std::string_view nameOf(SlipState state) noexcept {
  for (const auto& [known, name] : kStates)
    if (known == state) return name;
  return "invalid";
}

std::string_view nameOf(SlipIndicator indicator) noexcept {
  switch (indicator) {
    case SlipIndicator::kOff:
      return "off";
    case SlipIndicator::kNotComputable:
      return "not computable";
    case SlipIndicator::kReady:
      return "ready";
    case SlipIndicator::kSlipping:
      return "slipping";
  }
  return "off";
}

}  // namespace palpate
