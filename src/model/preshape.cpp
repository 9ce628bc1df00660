#include "palpate/model/preshape.h"

#include <stdexcept>

#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"

namespace palpate {

std::vector<double> Preshape::anglesDeg(double closeRatio) const {
  if (!(closeRatio >= 0.0 && closeRatio <= 1.0))
    throw std::invalid_argument("close ratio " + numberText(closeRatio) + " is not in 0..1");
  std::vector<double> angles;
  for (const PreshapeJoint& joint : joints)
    angles.push_back(joint.openDeg + joint.slopeDeg * closeRatio);
  return angles;
}

const Preshape& findPreshape(const std::vector<Preshape>& preshapes, std::string_view name) {
  std::string known;
  for (const Preshape& preshape : preshapes) {
    if (preshape.name == name) return preshape;
    known += (known.empty() ? "" : ", ") + preshape.name;
  }
  throw std::invalid_argument("no preshape '" + shortened(name) +
                              "'; there are: " + (known.empty() ? "none" : known));
}

}  // namespace palpate
