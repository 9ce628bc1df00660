// Slip of a whole recording: the result of the slip detector for every touched matrix, frame by
// frame, and the segments in which it slips. It is computed once and then looked up by the views.
//
// Lengths are in taxels of the pitch (x right, y down), angles from x towards y [deg]. Frames in
// which a matrix is not touched have no sample.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/model/profile.h>
#include <palpate/slip/slip_segments.h>

namespace palpate {

struct SlipSeriesOptions {
  SlipMethod method = SlipMethod::kContest;
  SlipReference reference = SlipReference::kWhenAtRest;
  // If given, this frame becomes the reference of every matrix, whatever `reference` is; before it
  // there is no motion since the reference.
  std::optional<std::size_t> referenceFrame = std::nullopt;
  // Thresholds, see SlipRuleOptions; > 0.
  double stepTaxels = SlipRuleOptions{}.stepTaxels;
  double referenceTaxels = SlipRuleOptions{}.referenceTaxels;
  double rotationDeg = SlipRuleOptions{}.rotationDeg;
  bool operator==(const SlipSeriesOptions&) const = default;
};
// Returns the options of a detector. For `contest` the alarm compares the hypotheses, for all other
// methods it uses the plain thresholds.
SlipDetectorOptions detectorOptions(const SlipSeriesOptions& options);

// Slip of one matrix in one frame: the values of a SlipDetection that the views show.
struct SlipSample {
  std::uint32_t frame = 0;
  // Number of active taxels.
  std::uint16_t active = 0;
  // Whether dx and dy are known.
  bool valid = false;
  // Whether refDx and refDy are known.
  bool refValid = false;
  // Whether rotationDeg is known.
  bool rotationValid = false;
  // Whether refRotationDeg is known.
  bool refRotationValid = false;
  // Whether the shape has a direction.
  bool reliable = false;
  // Whether this frame became the reference.
  bool newReference = false;
  bool slipping = false;
  SlipState state = SlipState::kInvalid;
  SlipIndicator indicator = SlipIndicator::kOff;
  // Centroid [taxels].
  float x = 0.0F;
  float y = 0.0F;
  // Motion since the previous frame and since the reference [taxels].
  float dx = 0.0F;
  float dy = 0.0F;
  float refDx = 0.0F;
  float refDy = 0.0F;
  // Rotation since the previous frame and since the reference, and direction of the axis [deg].
  float rotationDeg = 0.0F;
  float refRotationDeg = 0.0F;
  float orientationDeg = 0.0F;
  // Standard deviations along the axes of the contact [taxels].
  float majorSd = 0.0F;
  float minorSd = 0.0F;
  // Shape of the contact, see PrincipalAxis and OutlineShape.
  float skewX = 0.0F;
  float skewY = 0.0F;
  float eccentricity = 0.0F;
  float roundness = 0.0F;
  // See SlipDetection.
  float residual = 0.0F;
  float confidence = 0.0F;
  // Motion score P(moved); below 0 if the hypotheses were not compared.
  float pMoved = -1.0F;
  // Length of (refDx, refDy) [taxels].
  double shiftTaxels() const noexcept;
};
// Makes the sample of one matrix from the result of its detector.
SlipSample sampleOf(const SlipDetection& detection, std::size_t frame);

// Motion of a contact within a span of time.
struct RecentSlip {
  // Number of known steps; 0: the motion is not known.
  std::size_t steps = 0;
  // Sum of the steps [taxels].
  double dx = 0.0;
  double dy = 0.0;
  // Sum of the rotations [deg]; empty if the shape never had a direction.
  std::optional<double> turnDeg = std::nullopt;
};

// Position of a contact on its matrix [taxels].
struct PathPoint {
  double x = 0.0;
  double y = 0.0;
};

struct SlipSeries {
  SlipSeriesOptions options;
  // Time stamp of the first frame [us].
  std::int64_t firstUs = 0;
  // Time of every frame since the first [s].
  std::vector<double> timeS;
  // Samples of each matrix, by frame.
  std::vector<std::vector<SlipSample>> matrices;
  // Slip segments, sorted by begin, then matrix.
  std::vector<SlipSegment> slips;
  // Frames without samples because they can't be read.
  UnreadableSamples unreadable = {};

  // Returns the sample of a matrix in a frame, or null if the matrix is not touched in it. Throws
  // std::out_of_range (matrix).
  const SlipSample* at(std::size_t matrix, std::size_t frame) const;
  // Returns the samples of frames first..last. Throws std::out_of_range (matrix).
  std::span<const SlipSample> between(std::size_t matrix,
                                      std::size_t first,
                                      std::size_t last) const;
  // Returns the path of a contact, from its position when the reference of `frame` was taken to its
  // position in `frame`. Empty without a reference or contact. A path of more than `most` points is
  // thinned to every second, third, .. point and the last one.
  std::vector<PathPoint> pathUntil(std::size_t matrix,
                                   std::size_t frame,
                                   std::size_t most = 2000) const;
  // Returns the motion in the last `spanS` seconds up to a frame. Throws std::out_of_range (matrix,
  // frame).
  RecentSlip recent(std::size_t matrix, std::size_t frame, double spanS) const;
  // Drops the first frames and renumbers the others from 0. Their times do not change.
  void dropFirst(std::size_t frames);
  // Returns the last frame at or before a time, or 0 if there is none.
  std::size_t frameAt(double seconds) const noexcept;
};

// Runs the slip detector over a profile and keeps its results. Frames that can't be read because
// the recording is damaged are left out and counted. Throws Cancelled, std::invalid_argument.
SlipSeries slipSeries(const Profile& profile,
                      const SlipSeriesOptions& options = {},
                      const Progress& progress = {});

}  // namespace palpate
