// Contacts that move over one matrix in a known way, as a sensor would feel them: the truth that
// slip is measured against.
//
// Six shapes (counts over the place, before the sensor). Those with an edge are plateaus whose edge
// is an error function, as a soft cover of width `coverTaxels` makes it; blobs and Gaussians are
// smooth by themselves. A taxel feels the mean over its square (3 x 3 Gauss-Legendre). Then noise,
// 12 bit, the threshold (below it: 0), saturation. What lies outside of the matrix isn't felt. x =
// column (right), y = row (down), in taxels; angles from +x towards +y [deg].
#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <span>
#include <string_view>

#include <palpate/model/hand_description.h>
#include <palpate/model/matrix_layout.h>
#include <palpate/model/tactile_frame.h>

namespace palpate {

enum class SlipShape {
  kDisc,         // plateau of radius 2.2
  kBar,          // plateau 2.4 wide, 5.2 long, along y at 0 deg
  kFlatEllipse,  // plateau with half axes 1.5 and 2.9, long along y
  kTwoBlobs,     // two Gaussians of sd 0.9, 3.6 apart along y, the second with 0.8 of the height
  kGaussian,     // sd 1.5
  kEllipticGaussian,  // sd 1.1 and 2.2, long along y
};
std::span<const SlipShape> slipShapes() noexcept;
// "disc", "bar", "flat-ellipse", "two-blobs", "gaussian", "elliptic-gaussian"
std::string_view nameOf(SlipShape shape) noexcept;
std::optional<SlipShape> slipShapeNamed(std::string_view name) noexcept;
// Whether turning it changes anything.
bool hasOrientation(SlipShape shape) noexcept;
// Whether it has edges: a shape without can't tell a gradient of load from motion.
bool hasEdge(SlipShape shape) noexcept;

struct SyntheticContact {
  SlipShape shape = SlipShape::kDisc;
  double x = 2.5;  // centre [taxels]
  double y = 6.5;
  double angleDeg = 0.0;
  double peakCounts = 1500.0;
  // Weight shift without motion: load times 1 + tilt tanh(distance from the centre / 2) along an
  // axis of the matrix.
  double tiltX = 0.0;  // -1..1
  double tiltY = 0.0;
};

struct SyntheticSensor {
  MatrixLayout layout = MatrixLayout::full(14, 6, 3.4);
  double noiseSd = 5.0;                                               // [counts]
  double thresholdCounts = 150.0;                                     // a reading below is 0
  double saturationCounts = static_cast<double>(kSdh2LargestCounts);  // no reading is above
  double coverTaxels = 0.4;                                           // sd of an edge [taxels], > 0

  // Throws std::invalid_argument naming the field.
  void validate() const;
};

// What the sensor would read without noise, threshold, saturation and rounding. Places without an
// enabled taxel: 0. `counts` must have the size of the layout; throws std::invalid_argument.
void idealCounts(const SyntheticContact& contact, const SyntheticSensor& sensor, MatrixMap counts);

// Readings of one sensor, frame after frame: the same seed gives the same noise.
class SyntheticSlip {
 public:
  // Throws std::invalid_argument.
  explicit SyntheticSlip(const SyntheticSensor& sensor, std::uint64_t seed = 1);

  void read(const SyntheticContact& contact, MatrixMap counts);
  const SyntheticSensor& sensor() const noexcept { return sensor_; }

 private:
  double normal();

  SyntheticSensor sensor_;
  std::mt19937_64 random_;
  double kept_ = 0.0;  // Box and Muller make two at a time
  bool hasKept_ = false;
};

}  // namespace palpate
