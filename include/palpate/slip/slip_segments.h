// Finds the spans of frames in which a matrix slips. The timeline, tables and exports show them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <optional>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/model/profile.h>
#include <palpate/slip/slip_detector.h>

namespace palpate {

struct SlipRunOptions {
  SlipDetectorOptions detector = {};
  // With SlipReference::kGiven: the frame that becomes the reference.
  std::size_t referenceFrame = 0;
  // Threads that detect, each the slip of a matrix; 0: as many as the machine runs at once. The
  // results are the same. With more than one, frames are read ahead (at most 1024, or 16 MB).
  std::size_t threads = 1;
};

// Runs the slip detectors of all matrices over a profile. Joint angles of the profile are used if
// it has any.
class SlipRun {
 public:
  // With `unreadable`, frames that can't be read because the recording is damaged are added to it
  // and left out, as in a gap. Throws std::invalid_argument (options, reference frame not in the
  // profile); Error (the reference frame can't be read).
  SlipRun(Profile profile, const SlipRunOptions& options, UnreadableSamples* unreadable = nullptr);

  // Takes the next frame; false after the last one. Throws Error for a frame that can't be read,
  // unless there is `unreadable`.
  bool next();
  // The frame that was taken, its time [us since 1970], and a result per matrix.
  std::size_t frame() const noexcept { return block_[at_ - 1].frame; }
  std::int64_t timeUs() const noexcept { return block_[at_ - 1].values.hostUs; }
  const std::vector<SlipDetection>& detections() const noexcept {
    return block_[at_ - 1].detections;
  }

 private:
  struct Step {
    std::size_t frame = 0;
    bool isAfterLoss = false;
    TactileFrame values;
    std::vector<double> jointsDeg;
    std::vector<SlipDetection> detections;
  };

  bool read(Step& step);
  void readBlock();
  void detect(std::size_t matrix);
  void takeAngles(std::int64_t timeUs);

  Profile profile_;
  std::optional<std::size_t> reference_;
  UnreadableSamples* unreadable_;
  std::vector<SlipDetector> detectors_;
  std::size_t threads_;
  std::size_t maxSteps_ = 1;
  std::vector<double> jointsDeg_;
  std::optional<std::size_t> sample_;
  std::size_t upcoming_ = 0;
  std::vector<Step> block_;  // the first `numSteps_` were read and detected
  std::size_t numSteps_ = 0;
  std::size_t at_ = 0;          // steps of the block that were taken
  std::exception_ptr failure_;  // thrown behind the block
};

// The same over all frames: `sink` receives each in order. Throws Cancelled, and as SlipRun.
using SlipSink = std::function<void(
    std::size_t frame, std::int64_t timeUs, const std::vector<SlipDetection>& detections)>;
void runSlipDetector(const Profile& profile,
                     const SlipRunOptions& options,
                     const SlipSink& sink,
                     const Progress& progress = {},
                     UnreadableSamples* unreadable = nullptr);

// One span of frames in which a matrix slips.
struct SlipSegment {
  // First and last frame, both inclusive.
  std::size_t begin = 0;
  std::size_t end = 0;
  std::int64_t beginUs = 0;
  std::int64_t endUs = 0;
  std::size_t matrix = 0;
  // Length of the path: sum of the lengths of the steps [taxels].
  double pathTaxels = 0.0;
  // Sum of the rotations, signed [deg].
  double rotationDeg = 0.0;
  // Largest confidence of its frames, 0..1.
  double confidence = 0.0;
  bool operator==(const SlipSegment&) const = default;
};

struct SlipSegmentOptions {
  SlipRunOptions pass;
  // Slipping spans of a matrix with at most this many frames between them are joined.
  std::size_t bridgedFrames = 5;
};

// Finds the slip segments of a profile, sorted by begin, then matrix. Throws as runSlipDetector().
std::vector<SlipSegment> findSlips(const Profile& profile,
                                   const SlipSegmentOptions& options = {},
                                   const Progress& progress = {});

// Makes slip segments from results that arrive frame by frame.
class SlipSegmenter {
 public:
  SlipSegmenter(std::size_t numMatrices, std::size_t bridgedFrames = 5);
  void add(std::size_t frame, std::int64_t timeUs, const std::vector<SlipDetection>& detections);
  // Returns all segments so far, including those that have not ended.
  std::vector<SlipSegment> segments() const;

 private:
  struct Open {
    std::optional<SlipSegment> segment;
    // Path and rotation after the end of the segment, in frames that may still be bridged.
    double pendingPath = 0.0, pendingTurn = 0.0;
  };
  std::vector<SlipSegment> closed_;
  std::vector<Open> open_;
  std::size_t bridgedFrames_;
};

}  // namespace palpate
