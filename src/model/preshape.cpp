#include "palpate/model/preshape.h"

#include <stdexcept>
#include <utility>

#include "palpate/core/number_text.h"
#include "palpate/model/hand_file.h"

namespace palpate {
std::vector<double> Preshape::anglesDeg(double closeRatio) const {
  if (!(closeRatio >= 0.0 && closeRatio <= 1.0))
    throw std::invalid_argument("close ratio " + numberText(closeRatio) + " is not in 0..1");
  std::vector<double> angles;
  for (const PreshapeJoint& joint : joints)
    angles.push_back(joint.openDeg + joint.slopeDeg * closeRatio);
  return angles;
}

const std::vector<Preshape>& sdh2Preshapes() { return sdh2().file->preshapes; }

const Preshape& sdh2Preshape(std::string_view name) {
  std::string known;
  for (const Preshape& preshape : sdh2Preshapes()) {
    if (preshape.name == name) return preshape;
    known += (known.empty() ? "" : ", ") + preshape.name;
  }
  throw std::invalid_argument("no preshape '" + std::string(name) + "'; there are: " + known);
}

}  // namespace palpate
