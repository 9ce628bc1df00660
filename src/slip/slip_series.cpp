#include "palpate/slip/slip_series.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "palpate/core/time.h"

namespace palpate {
namespace {

bool before(const SlipSample& sample, std::size_t frame) { return sample.frame < frame; }

}  // namespace

double SlipSample::shiftTaxels() const noexcept {
  return std::hypot(static_cast<double>(refDx), static_cast<double>(refDy));
}

SlipDetectorOptions detectorOptions(const SlipSeriesOptions& options) {
  SlipDetectorOptions detector;
  detector.method = options.method;
  detector.reference = options.referenceFrame ? SlipReference::kGiven : options.reference;
  detector.hypothesisAlarm = options.method == SlipMethod::kContest;
  detector.rule.stepTaxels = options.stepTaxels;
  detector.rule.referenceTaxels = options.referenceTaxels;
  detector.rule.rotationDeg = options.rotationDeg;
  return detector;
}

SlipSample sampleOf(const SlipDetection& detection, std::size_t frame) {
  const SlipMotion& motion = detection.motion;
  const SlipRotation& rotation = motion.rotation;
  const auto f = [](double value) { return static_cast<float>(value); };
  return {.frame = static_cast<std::uint32_t>(frame),
          .active = static_cast<std::uint16_t>(
              std::clamp<int>(motion.active, 0, std::numeric_limits<std::uint16_t>::max())),
          .valid = motion.valid,
          .refValid = motion.refValid,
          .rotationValid = rotation.valid,
          .refRotationValid = rotation.refValid,
          .reliable = rotation.reliable,
          .newReference = detection.newReference,
          .slipping = detection.slipping,
          .state = detection.state,
          .indicator = detection.indicator,
          .x = f(motion.x),
          .y = f(motion.y),
          .dx = f(motion.dx),
          .dy = f(motion.dy),
          .refDx = f(motion.refDx),
          .refDy = f(motion.refDy),
          .rotationDeg = f(rotation.rotationDeg),
          .refRotationDeg = f(rotation.refRotationDeg),
          .orientationDeg = f(rotation.axis.orientationDeg),
          .majorSd = f(std::sqrt(std::max(0.0, rotation.axis.lambda1))),
          .minorSd = f(std::sqrt(std::max(0.0, rotation.axis.lambda2))),
          .skewX = f(rotation.axis.skewX),
          .skewY = f(rotation.axis.skewY),
          .eccentricity = f(rotation.axis.eccentricity),
          .roundness = f(rotation.roundness),
          .residual = f(detection.residual),
          .confidence = f(detection.confidence),
          .pMoved = detection.pMoved ? f(*detection.pMoved) : -1.0F};
}

const SlipSample* SlipSeries::at(std::size_t matrix, std::size_t frame) const {
  const std::vector<SlipSample>& samples = matrices.at(matrix);
  const auto found = std::lower_bound(samples.begin(), samples.end(), frame, before);
  return found != samples.end() && found->frame == frame ? &*found : nullptr;
}

std::span<const SlipSample> SlipSeries::between(std::size_t matrix,
                                                std::size_t first,
                                                std::size_t last) const {
  const std::vector<SlipSample>& samples = matrices.at(matrix);
  if (last < first) return {};
  const auto begin = std::lower_bound(samples.begin(), samples.end(), first, before);
  const auto end = std::lower_bound(begin, samples.end(), last + 1, before);
  return {begin, end};
}

std::vector<PathPoint> SlipSeries::pathUntil(std::size_t matrix,
                                             std::size_t frame,
                                             std::size_t most) const {
  const SlipSample* now = at(matrix, frame);
  if (now == nullptr || !now->refValid || most == 0) return {};
  // Goes back to the frame in which the reference was taken, or to the first one with a known
  // reference.
  const std::vector<SlipSample>& samples = matrices[matrix];
  const SlipSample* first = now;
  while (first != samples.data() && !first->newReference &&
         first->frame != options.referenceFrame && (first - 1)->refValid)
    --first;
  const double x = static_cast<double>(first->x - first->refDx);
  const double y = static_cast<double>(first->y - first->refDy);
  const auto count = static_cast<std::size_t>(now - first) + 1;
  const std::size_t stride = (count + most - 1) / most;
  std::vector<PathPoint> path;
  const auto add = [&](const SlipSample& sample) {
    path.push_back({x + static_cast<double>(sample.refDx), y + static_cast<double>(sample.refDy)});
  };
  // The frame that became the reference may have no sample with refValid.
  if (first->shiftTaxels() > 0.0) path.push_back({x, y});
  for (std::size_t i = 0; i < count; i += stride) add(first[i]);
  if ((count - 1) % stride != 0) add(*now);
  return path;
}

RecentSlip SlipSeries::recent(std::size_t matrix, std::size_t frame, double spanS) const {
  const double fromS = timeS.at(frame) - spanS;
  const auto after = std::upper_bound(timeS.begin(), timeS.end(), fromS);
  RecentSlip sum;
  const auto first = static_cast<std::size_t>(after - timeS.begin());
  for (const SlipSample& sample : between(matrix, first, frame)) {
    if (sample.rotationValid)
      sum.turnDeg = sum.turnDeg.value_or(0.0) + static_cast<double>(sample.rotationDeg);
    if (!sample.valid) continue;
    ++sum.steps;
    sum.dx += static_cast<double>(sample.dx);
    sum.dy += static_cast<double>(sample.dy);
  }
  return sum;
}

void SlipSeries::dropFirst(std::size_t frames) {
  const std::size_t gone = std::min(frames, timeS.size());
  timeS.erase(timeS.begin(), timeS.begin() + static_cast<std::ptrdiff_t>(gone));
  for (std::vector<SlipSample>& samples : matrices) {
    samples.erase(samples.begin(), std::lower_bound(samples.begin(), samples.end(), gone, before));
    for (SlipSample& sample : samples) sample.frame -= static_cast<std::uint32_t>(gone);
  }
  std::erase_if(slips, [gone](const SlipSegment& slip) { return slip.end < gone; });
  for (SlipSegment& slip : slips) {
    slip.begin = slip.begin > gone ? slip.begin - gone : 0;
    slip.end -= gone;
  }
}

std::size_t SlipSeries::frameAt(double seconds) const noexcept {
  const auto after = std::upper_bound(timeS.begin(), timeS.end(), seconds);
  return after == timeS.begin() ? 0 : static_cast<std::size_t>(after - timeS.begin()) - 1;
}

SlipSeries slipSeries(const Profile& profile,
                      const SlipSeriesOptions& options,
                      const Progress& progress) {
  SlipSeries series;
  series.options = options;
  series.matrices.resize(profile.layout().numMatrices());
  series.timeS.reserve(profile.numFrames());
  const SlipRunOptions pass{.detector = detectorOptions(options),
                            .referenceFrame = options.referenceFrame.value_or(0)};
  SlipSegmenter segmenter(series.matrices.size());
  series.firstUs = profile.numFrames() > 0 ? profile.frameTimeUs(0) : 0;
  const auto addTimesUntil = [&](std::size_t end) {
    for (std::size_t i = series.timeS.size(); i < end; ++i)
      series.timeS.push_back(static_cast<double>(profile.frameTimeUs(i) - series.firstUs) /
                             kUsPerS);
  };
  const auto take = [&](std::size_t frame, std::int64_t timeUs, const auto& detections) {
    addTimesUntil(frame + 1);  // also of frames before it that can't be read
    for (std::size_t m = 0; m < detections.size(); ++m)
      if (detections[m].motion.active > 0)
        series.matrices[m].push_back(sampleOf(detections[m], frame));
    segmenter.add(frame, timeUs, detections);
  };
  runSlipDetector(
      profile,
      pass,
      take,
      [&](double done) { return !progress || progress(done); },
      &series.unreadable);
  addTimesUntil(profile.numFrames());
  series.slips = segmenter.segments();
  return series;
}

}  // namespace palpate
