#include "palpate/model/preshape.h"

#include <stdexcept>
#include <utility>

#include "palpate/core/number_text.h"

namespace palpate {
namespace {

using Joint = PreshapeJoint;

// Makes a preshape in which fingers 0 and 2 have the same angles; finger 1 (the thumb) may differ.
Preshape make(const char* name,
              const char* title,
              double baseDeg,
              Joint proximal,
              Joint distal,
              Joint thumbProximal,
              Joint thumbDistal) {
  return {name,
          title,
          {{baseDeg, 0.0}, proximal, distal, thumbProximal, thumbDistal, proximal, distal}};
}

std::vector<Preshape> makeAll() {
  const Joint folded = {-90.0, 0.0}, straight = {0.0, 0.0};
  std::vector<Preshape> all;
  const auto alike = [&](const char* name, const char* title, double base, Joint p, Joint d) {
    all.push_back(make(name, title, base, p, d, p, d));
  };
  alike("parallel", "Parallel, fingertips parallel", 0.0, {-75.0, 82.0}, {75.0, -82.0});
  alike("cylindrical", "Cylindrical, fingertips tilted", 0.0, {-30.0, 30.0}, {30.0, 35.0});
  alike("centrical", "Centrical, fingertips parallel", 60.0, {-75.0, 82.0}, {75.0, -82.0});
  alike("spherical", "Spherical, fingertips tilted", 60.0, {-40.0, 25.0}, {40.0, 15.0});
  all.push_back(make("pinch-parallel",
                     "Pinch, fingertips parallel",
                     90.0,
                     {-72.0, 83.0},
                     {72.0, -83.0},
                     folded,
                     straight));
  all.push_back(make("pinch-tilted",
                     "Pinch, fingertips tilted",
                     90.0,
                     {-40.0, 40.0},
                     {10.0, 13.0},
                     folded,
                     straight));
  all.push_back(make("pinch-empty",
                     "Pinch, until the pads touch",
                     90.0,
                     {-72.0, 87.0},
                     {72.0, -87.0},
                     folded,
                     straight));
  all.push_back({"calibration",
                 "Calibration pose",
                 {{90.0, 0.0}, straight, straight, folded, folded, folded, folded}});
  return all;
}

}  // namespace

std::vector<double> Preshape::anglesDeg(double closeRatio) const {
  if (!(closeRatio >= 0.0 && closeRatio <= 1.0))
    throw std::invalid_argument("close ratio " + numberText(closeRatio) + " is not in 0..1");
  std::vector<double> angles;
  for (const PreshapeJoint& joint : joints)
    angles.push_back(joint.openDeg + joint.slopeDeg * closeRatio);
  return angles;
}

const std::vector<Preshape>& sdh2Preshapes() {
  static const std::vector<Preshape> all = makeAll();
  return all;
}

const Preshape& sdh2Preshape(std::string_view name) {
  std::string known;
  for (const Preshape& preshape : sdh2Preshapes()) {
    if (preshape.name == name) return preshape;
    known += (known.empty() ? "" : ", ") + preshape.name;
  }
  throw std::invalid_argument("no preshape '" + std::string(name) + "'; there are: " + known);
}

}  // namespace palpate
