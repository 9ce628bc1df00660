// Synthetic contacts that move over one matrix in a known way, as a sensor would measure them.
// Accuracy of slip methods is measured against this known motion.
//
// There are six shapes (counts as a function of position, before the sensor). Shapes with an edge
// are plateaus whose edge is an error function, as under a soft cover of width `coverTaxels`; blobs
// and Gaussians are smooth by themselves. A taxel measures the mean over its square (3 x 3
// Gauss-Legendre). Then noise, saturation, rounding to counts and the threshold (smaller readings
// become 0) are applied. Parts of a contact outside of the matrix are not measured. x = column
// (right), y = row (down), in taxels; angles from +x towards +y [deg].
#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <span>
#include <string_view>

#include <palpate/core/option_check.h>
#include <palpate/model/hand_description.h>
#include <palpate/model/matrix_layout.h>
#include <palpate/model/tactile_frame.h>

namespace palpate {

// Shapes of contacts; lengths in taxels.
enum class SlipShape {
  // Plateau of radius 2.2.
  kDisc,
  // Plateau 2.4 wide and 5.2 long, along y at 0 deg.
  kBar,
  // Plateau with half axes 1.5 and 2.9, long along y.
  kFlatEllipse,
  // Two Gaussians of sd 0.9 at a distance of 3.6 along y; the second has 0.8 of the height.
  kTwoBlobs,
  // Gaussian of sd 1.5.
  kGaussian,
  // Gaussian of sd 1.1 and 2.2, long along y.
  kEllipticGaussian,
};
std::span<const SlipShape> slipShapes() noexcept;
// "disc", "bar", "flat-ellipse", "two-blobs", "gaussian", "elliptic-gaussian"
std::string_view nameOf(SlipShape shape) noexcept;
std::optional<SlipShape> slipShapeNamed(std::string_view name) noexcept;
// Whether a rotation changes the shape.
bool hasOrientation(SlipShape shape) noexcept;
// Whether the shape has edges: for a shape without edges a load gradient cannot be distinguished
// from motion.
bool hasEdge(SlipShape shape) noexcept;

struct SyntheticContact {
  SlipShape shape = SlipShape::kDisc;
  // Centre [taxels].
  double x = 2.5;
  double y = 6.5;
  double angleDeg = 0.0;
  double peakCounts = 1500.0;
  // Load shift without motion: the load is multiplied by 1 + tilt tanh(distance from the centre /
  // 2) along an axis of the matrix. Range -1..1.
  double tiltX = 0.0;
  double tiltY = 0.0;
};

struct SyntheticSensor {
  MatrixLayout layout = MatrixLayout::full(14, 6, 3.4);
  double noiseSd = 5.0;  // [counts]
  // Smaller readings become 0 [counts].
  double thresholdCounts = 150.0;
  // Largest reading [counts].
  double saturationCounts = 4095.0;
  // Standard deviation of an edge [taxels].
  static constexpr OptionRange kCoverTaxels{0.05, 10.0, "taxels"};
  double coverTaxels = 0.4;

  // Throws std::invalid_argument naming the field.
  void validate() const;
};

// Computes what the sensor would read without noise, threshold, saturation and rounding. Places
// without an enabled taxel become 0. `counts` must have the size of the layout; throws
// std::invalid_argument otherwise.
void idealCounts(const SyntheticContact& contact, const SyntheticSensor& sensor, MatrixMap counts);

// Makes the readings of one sensor, frame after frame. The same seed gives the same noise.
class SyntheticSlip {
 public:
  // Throws std::invalid_argument.
  explicit SyntheticSlip(const SyntheticSensor& sensor, std::uint64_t seed = 1);

  // Reads one frame of the contact into `counts`. Throws as idealCounts().
  void read(const SyntheticContact& contact, MatrixMap counts);
  const SyntheticSensor& sensor() const noexcept { return sensor_; }

 private:
  double normal();

  SyntheticSensor sensor_;
  std::mt19937_64 random_;
  // The Box-Muller method makes two values at a time; the second one is kept here.
  double kept_ = 0.0;
  bool hasKept_ = false;
};

}  // namespace palpate
