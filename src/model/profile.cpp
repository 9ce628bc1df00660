#include "palpate/model/profile.h"

#include <stdexcept>
#include <utility>

#include "palpate/core/error.h"

namespace palpate {
namespace {

void check(const char* what, std::size_t index, std::size_t count) {
  if (index >= count)
    throw std::out_of_range("Profile: no " + std::string(what) + " " + std::to_string(index) +
                            ", there are " + std::to_string(count));
}

// Index of the last of `count` increasing stamps at or before `timeUs`; 0 before the first.
template <typename TimeOf>
std::optional<std::size_t> lastAtOrBefore(std::size_t count, std::int64_t timeUs, TimeOf timeOf) {
  if (count == 0) return std::nullopt;
  std::size_t low = 0;  // invariant: the answer is in [low, high)
  std::size_t high = count;
  while (high - low > 1) {
    const std::size_t middle = low + (high - low) / 2;
    (timeOf(middle) <= timeUs ? low : high) = middle;
  }
  return low;
}

}  // namespace

void UnreadableSamples::add(std::size_t index, const char* fault) {
  if (count++ == 0) firstFault = fault;
  if (!runs.empty() && runs.back().last + 1 == index)
    runs.back().last = index;
  else
    runs.push_back({index, index});
}

std::optional<std::size_t> ProfileStorage::frameAt(std::int64_t timeUs) const {
  return lastAtOrBefore(numFrames(), timeUs, [&](std::size_t i) { return frameTimeUs(i); });
}

std::optional<std::size_t> ProfileStorage::angleSampleAt(std::int64_t timeUs) const {
  return lastAtOrBefore(numAngles(), timeUs, [&](std::size_t i) { return angleTimeUs(i); });
}

std::optional<std::size_t> ProfileStorage::temperatureSampleAt(std::int64_t timeUs) const {
  return lastAtOrBefore(
      numTemperatures(), timeUs, [&](std::size_t i) { return temperatureTimeUs(i); });
}

Profile::Profile(ProfileInfo info,
                 HandDescription hand,
                 std::shared_ptr<const ProfileStorage> storage) {
  if (!hand.layout) throw std::invalid_argument("Profile: a hand without a sensor layout");
  if (!storage) throw std::invalid_argument("Profile: no storage");
  data_ = std::make_shared<Data>(Data{std::move(info), std::move(hand), std::move(storage)});
}

std::int64_t Profile::frameTimeUs(std::size_t frame) const {
  check("frame", frame, numFrames());
  return data_->storage->frameTimeUs(frame);
}

TactileFrame Profile::frame(std::size_t frame) const {
  TactileFrame out;
  readFrame(frame, out);
  return out;
}

void Profile::readFrame(std::size_t frame, TactileFrame& out) const {
  check("frame", frame, numFrames());
  TactileFrame read(data_->hand.layout);
  read.hostUs = data_->storage->frameTimeUs(frame);
  data_->storage->readFrame(frame, read);
  out = std::move(read);
}

bool Profile::readFrame(std::size_t frame, TactileFrame& out, UnreadableSamples* unreadable) const {
  try {
    readFrame(frame, out);
    return true;
  } catch (const Error& error) {
    if (!unreadable) throw;
    unreadable->add(frame, error.what());
    out.hostUs = frameTimeUs(frame);
    return false;
  }
}

std::int64_t Profile::angleTimeUs(std::size_t sample) const {
  check("angle sample", sample, numAngles());
  return data_->storage->angleTimeUs(sample);
}

JointAngles Profile::angles(std::size_t sample) const {
  check("angle sample", sample, numAngles());
  return data_->storage->angles(sample);
}

std::int64_t Profile::temperatureTimeUs(std::size_t sample) const {
  check("temperature sample", sample, numTemperatures());
  return data_->storage->temperatureTimeUs(sample);
}

Temperatures Profile::temperatures(std::size_t sample) const {
  check("temperature sample", sample, numTemperatures());
  return data_->storage->temperatures(sample);
}

std::optional<std::size_t> Profile::frameAt(std::int64_t timeUs) const {
  return data_->storage->frameAt(timeUs);
}

std::optional<std::size_t> Profile::angleSampleAt(std::int64_t timeUs) const {
  return data_->storage->angleSampleAt(timeUs);
}

std::optional<std::size_t> Profile::temperatureSampleAt(std::int64_t timeUs) const {
  return data_->storage->temperatureSampleAt(timeUs);
}

std::optional<JointAngles> Profile::anglesAtFrame(std::size_t frame) const {
  const auto sample = angleSampleAt(frameTimeUs(frame));
  return sample ? std::optional(angles(*sample)) : std::nullopt;
}

std::optional<Temperatures> Profile::temperaturesAtFrame(std::size_t frame) const {
  const auto sample = temperatureSampleAt(frameTimeUs(frame));
  return sample ? std::optional(temperatures(*sample)) : std::nullopt;
}

std::int64_t Profile::durationUs() const {
  return numFrames() < 2 ? 0 : frameTimeUs(numFrames() - 1) - frameTimeUs(0);
}

}  // namespace palpate
