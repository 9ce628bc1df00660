#include "palpate/slip/slip_segments.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <tuple>

#include "palpate/core/error.h"
#include "palpate/core/progress.h"

namespace palpate {

void runSlipDetector(const Profile& profile,
                     const SlipRunOptions& options,
                     const SlipSink& sink,
                     const Progress& progress,
                     UnreadableSamples* unreadable) {
  const bool given = options.detector.reference == SlipReference::kGiven;
  if (given && options.referenceFrame >= profile.numFrames())
    throw std::invalid_argument("runSlipDetector: referenceFrame is " +
                                std::to_string(options.referenceFrame) + " of " +
                                std::to_string(profile.numFrames()));
  SensorSlipDetector detector(profile.hand(), options.detector);
  TactileFrame frame;
  if (given) {
    try {
      profile.readFrame(options.referenceFrame, frame);
    } catch (const Error& error) {
      throw Error(std::string("the reference frame can't be read: ") + error.what());
    }
  }
  std::vector<double> jointsDeg;
  std::optional<std::size_t> sample;
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    reportProgress(progress, i, profile.numFrames());
    if (!profile.readFrame(i, frame, unreadable)) {
      detector.setLoss();
      continue;
    }
    if (const auto angles = profile.angleSampleAt(frame.hostUs); angles != sample) {
      sample = angles;
      try {
        jointsDeg = profile.angles(*angles).values;
      } catch (const Error&) {
        if (!unreadable) throw;
        jointsDeg.clear();  // as in a recording without angles
      }
    }
    detector.update(frame, jointsDeg);
    if (given && i == options.referenceFrame) detector.setReference();
    sink(i, frame.hostUs, detector.last());
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
