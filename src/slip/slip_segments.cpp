#include "palpate/slip/slip_segments.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <tuple>

#include "palpate/core/error.h"
#include "palpate/core/parallel.h"
#include "palpate/core/progress.h"

namespace palpate {
namespace {

constexpr std::size_t kMaxBlockFrames = 1024;
constexpr std::size_t kMaxBlockBytes = 16u << 20;

}  // namespace

SlipRun::SlipRun(Profile profile, const SlipRunOptions& options, UnreadableSamples* unreadable)
    : profile_(std::move(profile)),
      unreadable_(unreadable),
      detectors_(slipDetectors(profile_.hand(), options.detector)),
      threads_(options.threads) {
  if (threads_ != 1)
    maxSteps_ = std::clamp<std::size_t>(
        kMaxBlockBytes / (profile_.layout().numCells() * sizeof(float) + 1), 1, kMaxBlockFrames);
  block_.resize(maxSteps_);
  if (options.detector.reference != SlipReference::kGiven) return;
  reference_ = options.referenceFrame;
  if (*reference_ >= profile_.numFrames())
    throw std::invalid_argument("SlipRun: referenceFrame is " + std::to_string(*reference_) +
                                " of " + std::to_string(profile_.numFrames()));
  try {
    profile_.readFrame(*reference_, block_[0].values);
  } catch (const Error& error) {
    throw Error(std::string("the reference frame can't be read: ") + error.what());
  }
}

void SlipRun::takeAngles(std::int64_t timeUs) {
  const auto sample = profile_.angleSampleAt(timeUs);
  if (sample == sample_) return;
  sample_ = sample;
  try {
    jointsDeg_ = profile_.angles(*sample).values;
  } catch (const Error&) {
    if (!unreadable_) throw;
    jointsDeg_.clear();  // as in a recording without angles
  }
}

// Reads the next frame; false after the last one.
bool SlipRun::read(Step& step) {
  step.isAfterLoss = false;
  for (; upcoming_ < profile_.numFrames(); ++upcoming_) {
    if (profile_.readFrame(upcoming_, step.values, unreadable_)) break;
    step.isAfterLoss = true;
  }
  if (upcoming_ == profile_.numFrames()) return false;
  step.frame = upcoming_++;
  takeAngles(step.values.hostUs);
  step.jointsDeg = jointsDeg_;
  step.detections.resize(profile_.layout().numMatrices());
  return true;
}

// The matrices don't depend on each other: this is the same for any number of threads.
void SlipRun::detect(std::size_t matrix) {
  SlipDetector& detector = detectors_[matrix];
  for (std::size_t i = 0; i < numSteps_; ++i) {
    Step& step = block_[i];
    if (step.isAfterLoss) detector.setLoss();
    const TactileFrame& values = step.values;
    detector.update(values.matrix(matrix), values.hostUs, step.jointsDeg);
    if (reference_ == step.frame) detector.setReference();
    step.detections[matrix] = detector.last();
  }
}

void SlipRun::readBlock() {
  if (failure_) std::rethrow_exception(failure_);
  numSteps_ = at_ = 0;
  try {
    while (numSteps_ < maxSteps_ && read(block_[numSteps_])) ++numSteps_;
  } catch (...) {
    failure_ = std::current_exception();
    if (numSteps_ == 0) throw;
  }
  const std::size_t numMatrices = profile_.layout().numMatrices();
  if (threads_ == 1)
    for (std::size_t m = 0; m < numMatrices; ++m) detect(m);
  else
    forEachInParallel(
        numMatrices, [this](std::size_t m) { detect(m); }, {}, threads_);
}

bool SlipRun::next() {
  if (at_ == numSteps_) readBlock();
  if (at_ == numSteps_) return false;
  ++at_;
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
