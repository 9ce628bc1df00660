// Cramer-Rao bound of a slip step: the smallest standard deviation with which an unbiased method
// can measure the motion between two frames. The slip benchmark (slip_accuracy.h) compares the
// methods with it.
//
// The Fisher information of the ideal counts of one frame with respect to (x, y, angle, gain) is
// computed by central differences. A taxel whose reading may be below the threshold or above
// saturation carries the information of a censored normal value (Tobit, type I): with z = (mean -
// threshold)/sd it is the fraction Phi(z) - z phi(z) + phi(z)^2 / (1 - Phi(z)) of the information
// of an uncensored value. Rounding to counts adds a variance of 1/12 counts^2. A step is the
// difference of two such frames: its standard deviation is sqrt(2) times that of one frame. The
// shape is assumed to be known, so the bound is optimistic.
#pragma once

#include <limits>

#include <palpate/laboratory/synthetic_slip.h>

namespace palpate {

// Unknown quantities that are estimated together with the motion.
struct SlipNuisances {
  // The load as a whole may change.
  bool gain = true;
  // The load may also change with a gradient along x and y.
  bool tilt = false;
};

struct CramerRaoBound {
  // Standard deviations of a step [taxels], [deg]. A value is infinite where the frames don't
  // determine the motion (with `tilt`, a Gaussian contact is close to this case).
  double x = std::numeric_limits<double>::infinity();
  double y = std::numeric_limits<double>::infinity();
  // Infinite for a shape without orientation.
  double angleDeg = std::numeric_limits<double>::infinity();
};

// The angle is treated as unknown where the shape has an orientation. Throws std::invalid_argument
// (sensor).
CramerRaoBound cramerRaoBound(const SyntheticContact& contact,
                              const SyntheticSensor& sensor,
                              const SlipNuisances& nuisances = {});

// Fraction, 0..1, of a normal value's information that remains when it is censored; z as above.
double censoredInformation(double z) noexcept;

}  // namespace palpate
