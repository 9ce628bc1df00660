// Where in a recording it slips: spans of frames per matrix, for a row of the timeline, a table, an
// export.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/model/profile.h>
#include <palpate/slip/sensor_slip_detector.h>

namespace palpate {

struct SlipRunOptions {
  SlipDetectorOptions detector;
  // With SlipReference::kGiven: the frame that becomes the reference.
  std::size_t referenceFrame = 0;
};

// Runs the slip detector over a profile: `sink` receives every frame in order with one result per
// matrix. Joint angles of the profile are used if it has any. Throws Cancelled;
// std::invalid_argument (options, reference frame not in the profile).
using SlipSink = std::function<void(
    std::size_t frame, std::int64_t timeUs, const std::vector<SlipDetection>& detections)>;
void runSlipDetector(const Profile& profile,
                     const SlipRunOptions& options,
                     const SlipSink& sink,
                     const Progress& progress = {});

struct SlipSegment {
  std::size_t begin = 0;  // frames, both inclusive
  std::size_t end = 0;
  std::int64_t beginUs = 0;
  std::int64_t endUs = 0;
  std::size_t matrix = 0;
  double pathTaxels = 0.0;   // length of the way: the sum of the steps' lengths
  double rotationDeg = 0.0;  // the sum of the turns, signed
  double confidence = 0.0;   // largest of its frames
  bool operator==(const SlipSegment&) const = default;
};

struct SlipSegmentOptions {
  SlipRunOptions pass;
  // slipping spans of a matrix with at most so many frames between are one
  std::size_t bridgedFrames = 5;
};

// By begin, then matrix. Throws as runSlipDetector.
std::vector<SlipSegment> findSlips(const Profile& profile,
                                   const SlipSegmentOptions& options = {},
                                   const Progress& progress = {});

// The same of verdicts as they come.
class SlipSegmenter {
 public:
  SlipSegmenter(std::size_t numMatrices, std::size_t bridgedFrames = 5);
  void add(std::size_t frame, std::int64_t timeUs, const std::vector<SlipDetection>& detections);
  // All so far, those that still run among them.
  std::vector<SlipSegment> segments() const;

 private:
  struct Open {
    std::optional<SlipSegment> segment;
    double pendingPath = 0.0, pendingTurn = 0.0;  // since its end, in frames that may be bridged
  };
  std::vector<SlipSegment> closed_;
  std::vector<Open> open_;
  std::size_t bridgedFrames_;
};

}  // namespace palpate
