#include "device/sdh_quantity.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "palpate/core/number_text.h"
#include "palpate/device/sdh2.h"
#include "palpate/model/hand_description.h"

namespace palpate {

bool SdhQuantity::plausible(std::span<const double> values, std::size_t count) const noexcept {
  return values.size() == count && std::all_of(values.begin(), values.end(), [this](double value) {
           return value >= least && value <= most && (!whole || std::floor(value) == value);
         });
}

void checkSdhAxis(std::size_t axis) {
  if (axis >= kSdhAxes)
    throw std::invalid_argument("axis " + std::to_string(axis) + ": the hand has axes 0..6");
}

void checkSdhValues(const SdhQuantity& quantity,
                    std::span<const double> values,
                    std::span<const double> least,
                    std::span<const double> most) {
  if (values.size() != kSdhAxes)
    throw std::invalid_argument(std::string(quantity.noun) + ": " + std::to_string(values.size()) +
                                " values for seven axes");
  for (std::size_t axis = 0; axis < kSdhAxes; ++axis) {
    const double value = values[axis];
    const bool allowed = value >= least[axis] && value <= most[axis] &&  // false for NaN
                         (!quantity.whole || std::floor(value) == value);
    if (!allowed)
      throw std::invalid_argument("axis " + std::to_string(axis) + " (" + sdh2().axes[axis].name +
                                  "): " + quantity.noun + " " + numberText(value) + quantity.unit +
                                  " is outside of " + numberText(least[axis]) + ".." +
                                  numberText(most[axis]) + quantity.unit + "; nothing was sent");
  }
}

void checkSdhValues(const SdhQuantity& quantity,
                    std::span<const double> values,
                    double least,
                    double most) {
  checkSdhValues(
      quantity, values, std::vector<double>(kSdhAxes, least), std::vector<double>(kSdhAxes, most));
}

}  // namespace palpate
