#include "palpate/model/profile.h"

#include <algorithm>
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

std::optional<std::size_t> ProfileStorage::sampleAt(std::size_t series, std::int64_t timeUs) const {
  return lastAtOrBefore(
      numSamples(series), timeUs, [&](std::size_t i) { return sampleTimeUs(series, i); });
}

Profile::Profile(ProfileInfo info,
                 HandDescription hand,
                 std::shared_ptr<const ProfileStorage> storage,
                 std::vector<SeriesDescription> further) {
  if (!hand.layout) throw std::invalid_argument("Profile: a hand without a sensor layout");
  if (!storage) throw std::invalid_argument("Profile: no storage");
  std::vector<SeriesDescription> series = seriesOf(hand);
  for (SeriesDescription& each : further) {
    validate(each);
    if (std::any_of(
            series.begin(), series.end(), [&](const auto& s) { return s.name == each.name; }))
      throw std::invalid_argument("two series have the name " + each.name);
    series.push_back(std::move(each));
  }
  data_ = std::make_shared<Data>(
      Data{std::move(info), std::move(hand), std::move(storage), std::move(series), {}});
}

Profile Profile::withBaselines(Baselines baselines) const {
  Profile other = *this;
  auto data = std::make_shared<Data>(*data_);
  data->baselines = std::move(baselines);
  other.data_ = std::move(data);
  return other;
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
  if (givesReadings())
    decideTouch(read, baselineAt(data_->baselines, read.hostUs));
  else
    read.readings.clear();
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

double Profile::meanSampleRateHz(std::size_t series) const {
  const std::size_t count = numSamples(series);
  if (count < 2) return 0.0;
  const double spanUs =
      static_cast<double>(sampleTimeUs(series, count - 1) - sampleTimeUs(series, 0));
  return spanUs > 0.0 ? static_cast<double>(count - 1) * 1e6 / spanUs : 0.0;
}

std::optional<std::size_t> Profile::seriesNamed(std::string_view name) const {
  for (std::size_t i = 0; i < series().size(); ++i)
    if (series()[i].name == name && numSamples(i) > 0) return i;
  return std::nullopt;
}

std::size_t Profile::numSamples(std::size_t series) const {
  check("series", series, data_->series.size());
  return data_->storage->numSamples(series);
}

std::int64_t Profile::sampleTimeUs(std::size_t series, std::size_t sample) const {
  check("sample", sample, numSamples(series));
  return data_->storage->sampleTimeUs(series, sample);
}

Sample Profile::sample(std::size_t series, std::size_t sample) const {
  check("sample", sample, numSamples(series));
  return data_->storage->sample(series, sample);
}

bool Profile::isReady(std::size_t series) const {
  check("series", series, data_->series.size());
  return data_->storage->isReady(series);
}

void Profile::prepare(std::size_t series, const Progress& progress) const {
  check("series", series, data_->series.size());
  data_->storage->prepare(series, progress);
}

std::optional<std::size_t> Profile::frameAt(std::int64_t timeUs) const {
  return data_->storage->frameAt(timeUs);
}

std::optional<std::size_t> Profile::sampleAt(std::size_t series, std::int64_t timeUs) const {
  check("series", series, data_->series.size());
  return data_->storage->sampleAt(series, timeUs);
}

std::optional<Sample> Profile::sampleAtFrame(std::size_t series, std::size_t frame) const {
  const auto found = sampleAt(series, frameTimeUs(frame));
  return found ? std::optional(sample(series, *found)) : std::nullopt;
}

std::int64_t Profile::durationUs() const {
  return numFrames() < 2 ? 0 : frameTimeUs(numFrames() - 1) - frameTimeUs(0);
}

}  // namespace palpate
