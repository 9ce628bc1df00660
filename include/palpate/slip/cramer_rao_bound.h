// The Cramer-Rao bound of a slip step: no unbiased method measures it better from two frames.
//
// Fisher information of the ideal counts of one frame towards (x, y, angle, gain), by central
// differences. A taxel whose reading may fall below the threshold or above saturation carries that
// of a censored normal value (Tobit, type I): with z = (mean - threshold)/sd it is Phi(z) - z
// phi(z) + phi(z)^2 / (1 - Phi(z)) of the whole. Rounding to counts adds a variance of 1/12
// counts^2. A step is the difference of two such frames: its standard deviation is sqrt(2) times
// that of one. The shape is assumed to be known, so the bound is optimistic.
#pragma once

#include <limits>

#include <palpate/slip/synthetic_slip.h>

namespace palpate {

struct SlipNuisances {
  bool gain = true;   // the load as a whole may change
  bool tilt = false;  // and with a gradient along x and y
};

struct CramerRaoBound {
  // sd of a step [taxels], [deg]; infinite where the frames can't tell (with tilt, a Gaussian
  // nearly so).
  double x = std::numeric_limits<double>::infinity();
  double y = std::numeric_limits<double>::infinity();
  double angleDeg = std::numeric_limits<double>::infinity();  // also: a shape without orientation
};

// The angle is unknown, too, where the shape has one. Throws std::invalid_argument (sensor).
CramerRaoBound cramerRaoBound(const SyntheticContact& contact,
                              const SyntheticSensor& sensor,
                              const SlipNuisances& nuisances = {});

// How much of a censored normal value's information is left; z as above.
double censoredInformation(double z) noexcept;

}  // namespace palpate
