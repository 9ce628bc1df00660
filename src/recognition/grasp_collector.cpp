#include "palpate/recognition/grasp_collector.h"

#include <algorithm>
#include <bitset>
#include <stdexcept>
#include <utility>

#include "palpate/core/time.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/crop.h"

namespace palpate {
namespace {

constexpr std::size_t kMaxFingers = 8;
constexpr std::size_t kAnglesWithoutFrames = 2000;

}  // namespace

void GraspCollectorOptions::validate() const {
  if (minFingers < 1 || minFingers > kMaxFingers)
    throw std::invalid_argument("minFingers must be 1..8");
  if (framesAfter < bridgedFrames)
    throw std::invalid_argument("framesAfter must be bridgedFrames or more");
  if (maxFrames <= moreThanFrames)
    throw std::invalid_argument("maxFrames must be more than moreThanFrames");
}

GraspCollector::GraspCollector(HandDescription hand, GraspCollectorOptions options)
    : hand_(std::move(hand)), options_(options) {
  options_.validate();
}

void GraspCollector::reset() {
  gaps_.reset();
  frames_.clear();
  angles_.clear();
  contactFrames_ = without_ = 0;
}

double GraspCollector::touchedS() const noexcept {
  return contactFrames_ == 0 ? 0.0 : static_cast<double>(lastTouchUs_ - contactUs_) / kUsPerS;
}

bool GraspCollector::contactIn(const TactileFrame& frame) const {
  std::bitset<kMaxFingers> fingers;
  for (std::size_t m = 0; m < hand_.layout->numMatrices(); ++m) {
    const auto finger = m < hand_.matrices.size()
                            ? static_cast<std::size_t>(std::max(0, hand_.matrices[m].finger))
                            : m;
    if (fingers[finger % kMaxFingers]) continue;
    if (areTouched(frame.matrix(m).array()).any()) fingers.set(finger % kMaxFingers);
  }
  return fingers.count() >= options_.minFingers;
}

void GraspCollector::addFrame(std::shared_ptr<const TactileFrame> frame) {
  if (!frame || frame->values.size() != static_cast<std::size_t>(hand_.layout->numCells())) return;
  if (!frames_.empty() && frame->hostUs <= frames_.back()->hostUs) return;
  if (gaps_.afterGap(frame->hostUs)) {
    finish();
    frames_.clear();
  }
  const bool contact = contactIn(*frame);
  if (contactFrames_ == 0) {
    frames_.push_back(frame);
    if (contact) {
      contactFrames_ = 1;
      without_ = 0;
      contactUs_ = lastTouchUs_ = frame->hostUs;
    } else if (frames_.size() > options_.framesBefore) {
      frames_.pop_front();
      trimAngles();
    }
    return;
  }
  // A new contact begins before the frames after the previous one are complete.
  if (contact && without_ > options_.bridgedFrames) {
    finish();
    frames_.push_back(frame);
    contactFrames_ = 1;
    without_ = 0;
    contactUs_ = lastTouchUs_ = frame->hostUs;
    return;
  }
  without_ = contact ? 0 : without_ + 1;
  if (contact) lastTouchUs_ = frame->hostUs;
  ++contactFrames_;
  if (contactFrames_ <= options_.maxFrames) frames_.push_back(frame);
  if (without_ >= options_.framesAfter) finish();
}

void GraspCollector::addAngles(Sample angles) {
  if (!angles_.empty() && (angles.hostUs <= angles_.back().hostUs ||
                           angles.values.size() != angles_.back().values.size()))
    return;
  // After the last kept frame only the newest sample is needed, for the frames that are kept next.
  const bool beyond = contactFrames_ > options_.maxFrames && angles_.size() > 1 &&
                      angles_.back().hostUs > frames_.back()->hostUs;
  if (beyond) angles_.pop_back();
  angles_.push_back(std::move(angles));
  if (frames_.empty() && angles_.size() > kAnglesWithoutFrames) angles_.pop_front();
}

// The last sample at or before the first frame is kept, because it belongs to this frame.
void GraspCollector::trimAngles() {
  if (frames_.empty()) return;
  while (angles_.size() > 1 && angles_[1].hostUs <= frames_.front()->hostUs) angles_.pop_front();
}

Profile GraspCollector::clip() const {
  ProfileBuilder builder(hand_);
  for (const auto& frame : frames_) builder.addFrame(frame->hostUs, frame->values, frame->deviceUs);
  for (const Sample& sample : angles_)
    if (sample.hostUs <= frames_.back()->hostUs) builder.addAngles(sample.hostUs, sample.values);
  ProfileInfo info;
  info.format = "palpate";
  return builder.finish(info);
}

std::optional<Profile> GraspCollector::now() const {
  if (contactFrames_ <= options_.moreThanFrames || without_ > options_.bridgedFrames)
    return std::nullopt;
  return clip();
}

void GraspCollector::finish() {
  if (contactFrames_ == 0) return;
  if (contactFrames_ > options_.moreThanFrames + without_) ended_.push_back(clip());
  contactFrames_ = without_ = 0;
  while (frames_.size() > options_.framesBefore) frames_.pop_front();
  trimAngles();
}

std::vector<Profile> GraspCollector::takeEnded() { return std::exchange(ended_, {}); }

ChosenGrasp graspWithin(const Profile& profile,
                        std::size_t first,
                        std::size_t last,
                        FeatureSet set,
                        const Progress& progress) {
  if (first > last || last >= profile.numFrames())
    throw std::out_of_range("frames " + std::to_string(first) + " to " + std::to_string(last) +
                            " of " + std::to_string(profile.numFrames()));
  ChosenGrasp out;
  out.timeUs = profile.frameTimeUs(first);
  if (set != FeatureSet::kStatistics)
    if (const auto hand = pinchHandOf(profile.hand()))
      out.features.problem = hand->mismatch(profile);
  if (!out.features.problem.empty()) return out;
  const bool part = first > 0 || last + 1 < profile.numFrames();
  const Profile seen = part ? cropped(profile, first, last, progress) : profile;
  const auto length = [](const GraspSegment& grasp) { return grasp.end - grasp.begin; };
  const std::vector<GraspSegment> found = findPinches(seen, set, progress);
  const auto longest = std::max_element(
      found.begin(), found.end(), [&](auto& a, auto& b) { return length(a) < length(b); });
  if (longest == found.end()) {
    out.features.problem = noPinchText(profile.hand(), set);
    return out;
  }
  out.features = graspFeatures(seen, *longest, set);
  out.quality = longest->quality;
  out.timeUs = seen.frameTimeUs(longest->begin);
  for (std::size_t* frame :
       {&out.features.begin, &out.features.end, &out.features.initialFrame, &out.features.endFrame})
    *frame += first;
  return out;
}

ChosenGrasp graspOf(const Profile& profile, FeatureSet set, const Progress& progress) {
  if (profile.numFrames() > 0)
    return graspWithin(profile, 0, profile.numFrames() - 1, set, progress);
  ChosenGrasp out;
  out.features.problem = "no frame";
  return out;
}

}  // namespace palpate
