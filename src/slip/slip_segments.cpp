#include "palpate/slip/slip_segments.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <tuple>

#include "palpate/core/error.h"
#include "palpate/core/progress.h"

namespace palpate {

SlipRun::SlipRun(Profile profile, const SlipRunOptions& options, UnreadableSamples* unreadable)
    : profile_(std::move(profile)),
      unreadable_(unreadable),
      detector_(profile_.hand(), options.detector) {
  if (options.detector.reference != SlipReference::kGiven) return;
  reference_ = options.referenceFrame;
  if (*reference_ >= profile_.numFrames())
    throw std::invalid_argument("SlipRun: referenceFrame is " + std::to_string(*reference_) +
                                " of " + std::to_string(profile_.numFrames()));
  try {
    profile_.readFrame(*reference_, values_);
  } catch (const Error& error) {
    throw Error(std::string("the reference frame can't be read: ") + error.what());
  }
}

void SlipRun::takeAngles() {
  const auto sample = profile_.angleSampleAt(values_.hostUs);
  if (sample == sample_) return;
  sample_ = sample;
  try {
    jointsDeg_ = profile_.angles(*sample).values;
  } catch (const Error&) {
    if (!unreadable_) throw;
    jointsDeg_.clear();  // as in a recording without angles
  }
}

bool SlipRun::next() {
  for (; upcoming_ < profile_.numFrames(); ++upcoming_) {
    if (profile_.readFrame(upcoming_, values_, unreadable_)) break;
    detector_.setLoss();
  }
  if (upcoming_ == profile_.numFrames()) return false;
  frame_ = upcoming_++;
  takeAngles();
  detector_.update(values_, jointsDeg_);
  if (reference_ == frame_) detector_.setReference();
  return true;
}

void runSlipDetector(const Profile& profile,
                     const SlipRunOptions& options,
                     const SlipSink& sink,
                     const Progress& progress,
                     UnreadableSamples* unreadable) {
  SlipRun run(profile, options, unreadable);
  while (run.next()) {
    reportProgress(progress, run.frame(), profile.numFrames());
    sink(run.frame(), run.timeUs(), run.detections());
  }
}

SlipSegmenter::SlipSegmenter(std::size_t numMatrices, std::size_t bridgedFrames)
    : open_(numMatrices), bridgedFrames_(bridgedFrames) {}

void SlipSegmenter::add(std::size_t frame,
                        std::int64_t timeUs,
                        const std::vector<SlipDetection>& detections) {
  for (std::size_t m = 0; m < open_.size() && m < detections.size(); ++m) {
    const SlipDetection& detection = detections[m];
    Open& open = open_[m];
    if (open.segment && (frame > open.segment->end + bridgedFrames_ + 1 ||
                         detection.motion.afterGap || detection.motion.active == 0)) {
      closed_.push_back(*open.segment);
      open = {};
    }
    const double step =
        detection.motion.valid ? std::hypot(detection.motion.dx, detection.motion.dy) : 0.0;
    const double turn =
        detection.motion.rotation.valid ? detection.motion.rotation.rotationDeg : 0.0;
    if (!detection.slipping) {
      open.pendingPath += open.segment ? step : 0.0;
      open.pendingTurn += open.segment ? turn : 0.0;
      continue;
    }
    if (!open.segment)
      open.segment = SlipSegment{
          .begin = frame, .end = frame, .beginUs = timeUs, .endUs = timeUs, .matrix = m};
    SlipSegment& segment = *open.segment;
    segment.end = frame;
    segment.endUs = timeUs;
    segment.pathTaxels += open.pendingPath + step;
    segment.rotationDeg += open.pendingTurn + turn;
    segment.confidence = std::max(segment.confidence, detection.confidence);
    open.pendingPath = open.pendingTurn = 0.0;
  }
}

std::vector<SlipSegment> SlipSegmenter::segments() const {
  std::vector<SlipSegment> all = closed_;
  for (const Open& open : open_)
    if (open.segment) all.push_back(*open.segment);
  std::sort(all.begin(), all.end(), [](const SlipSegment& a, const SlipSegment& b) {
    return std::tie(a.begin, a.matrix) < std::tie(b.begin, b.matrix);
  });
  return all;
}

std::vector<SlipSegment> findSlips(const Profile& profile,
                                   const SlipSegmentOptions& options,
                                   const Progress& progress) {
  SlipSegmenter segmenter(profile.layout().numMatrices(), options.bridgedFrames);
  runSlipDetector(
      profile,
      options.pass,
      [&](std::size_t frame, std::int64_t timeUs, const std::vector<SlipDetection>& detections) {
        segmenter.add(frame, timeUs, detections);
      },
      progress);
  return segmenter.segments();
}

}  // namespace palpate
