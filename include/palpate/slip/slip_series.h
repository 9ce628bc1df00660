// Slip of a whole recording: what a detector says of every matrix that is touched, frame by frame,
// and the stretches in which it slips. Made once, then looked up.
//
// Taxels of the pitch, x right, y down; angles from x towards y [deg]. Frames in which a matrix
// isn't touched have no sample.
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
  SlipMethod method = SlipMethod::kHypotheses;
  SlipReference reference = SlipReference::kWhenAtRest;
  // The frame that becomes the reference of every matrix, whatever else is asked for; before it
  // nothing is known of where contacts are since the reference.
  std::optional<std::size_t> referenceFrame = std::nullopt;
  double stepTaxels = SlipRuleOptions{}.stepTaxels;            // thresholds, > 0
  double referenceTaxels = SlipRuleOptions{}.referenceTaxels;  // > 0
  double rotationDeg = SlipRuleOptions{}.rotationDeg;          // > 0
  bool operator==(const SlipSeriesOptions&) const = default;
};
// What a detector is to be told. The alarm of `contest` is its own, that of all other methods the
// plain thresholds.
SlipDetectorOptions detectorOptions(const SlipSeriesOptions& options);

// One matrix in one frame, in short.
struct SlipSample {
  std::uint32_t frame = 0;
  std::uint16_t active = 0;
  bool valid = false;             // dx, dy
  bool refValid = false;          // refDx, refDy
  bool rotationValid = false;     // rotationDeg
  bool refRotationValid = false;  // refRotationDeg
  bool reliable = false;          // the shape has a direction
  bool newReference = false;      // this frame became the reference
  bool slipping = false;
  SlipState state = SlipState::kInvalid;
  SlipIndicator lamp = SlipIndicator::kOff;
  float x = 0.0F;  // centroid [taxels]
  float y = 0.0F;
  float dx = 0.0F;
  float dy = 0.0F;
  float refDx = 0.0F;
  float refDy = 0.0F;
  float rotationDeg = 0.0F;
  float refRotationDeg = 0.0F;
  float orientationDeg = 0.0F;
  float majorSd = 0.0F;  // standard deviations along the axes [taxels]
  float minorSd = 0.0F;
  float skewX = 0.0F;
  float skewY = 0.0F;
  float eccentricity = 0.0F;
  float roundness = 0.0F;
  float residual = 0.0F;
  float confidence = 0.0F;
  float pMoved = -1.0F;                 // below 0: no contest was needed
  double shiftTaxels() const noexcept;  // |refDx, refDy|
};
SlipSample sampleOf(const SlipDetection& detection, std::size_t frame);

// What a contact did within a span of time.
struct RecentSlip {
  std::size_t steps = 0;  // that are known; 0: nothing is
  double dx = 0.0;        // their sum [taxels]
  double dy = 0.0;
  std::optional<double> turnDeg = std::nullopt;  // where the shape had a direction
};

// Where a contact is, on its matrix [taxels].
struct PathPoint {
  double x = 0.0;
  double y = 0.0;
};

struct SlipSeries {
  SlipSeriesOptions options;
  std::int64_t firstUs = 0;                       // stamp of the first frame [us]
  std::vector<double> timeS;                      // of every frame, from the first
  std::vector<std::vector<SlipSample>> matrices;  // by frame
  std::vector<SlipSegment> slips;                 // by begin, then matrix

  // Null: the matrix isn't touched in that frame. Throws std::out_of_range (matrix).
  const SlipSample* at(std::size_t matrix, std::size_t frame) const;
  // The samples of frames first..last. Throws std::out_of_range (matrix).
  std::span<const SlipSample> between(std::size_t matrix,
                                      std::size_t first,
                                      std::size_t last) const;
  // The way of a contact: from where it was when the reference was taken that holds in `frame`, to
  // where it is in that frame. Empty: no reference, or no contact. At most `most` points; of longer
  // ways each second, third, .. and the last.
  std::vector<PathPoint> pathUntil(std::size_t matrix,
                                   std::size_t frame,
                                   std::size_t most = 2000) const;
  // Of the last `spanS` seconds up to a frame. Throws std::out_of_range (matrix, frame).
  RecentSlip recent(std::size_t matrix, std::size_t frame, double spanS) const;
  // Forgets the first frames; those that stay are counted anew from 0. Their times stay as they
  // are.
  void dropFirst(std::size_t frames);
  // The last frame at or before a time; 0 where there is none.
  std::size_t frameAt(double seconds) const noexcept;
};

// Throws as runSlipDetector.
SlipSeries slipSeries(const Profile& profile,
                      const SlipSeriesOptions& options = {},
                      const Progress& progress = {});

}  // namespace palpate
