#include "palpate/model/fitted_times.h"

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include "palpate/model/profile_over.h"

namespace palpate {
namespace {

constexpr std::size_t kFramesPerReport = 256;

// A source with other times.
class AtOtherTimes final : public ProfileOver {
 public:
  using Times = std::vector<std::int64_t>;
  AtOtherTimes(Profile source, Times frames, std::map<std::size_t, Times> series)
      : ProfileOver(std::move(source)), frames_(std::move(frames)), series_(std::move(series)) {}

  std::int64_t frameTimeUs(std::size_t frame) const override {
    return frames_.empty() ? source_.frameTimeUs(frame) : frames_[frame];
  }
  bool givesReadings() const override { return source_.givesReadings(); }
  void readFrame(std::size_t frame, TactileFrame& out) const override {
    source_.readFrame(frame, out);
    out.hostUs = frameTimeUs(frame);
  }
  std::int64_t sampleTimeUs(std::size_t series, std::size_t sample) const override {
    const auto times = series_.find(series);
    return times == series_.end() ? source_.sampleTimeUs(series, sample) : times->second[sample];
  }
  Sample sample(std::size_t series, std::size_t sample) const override {
    Sample read = source_.sample(series, sample);
    read.hostUs = sampleTimeUs(series, sample);
    return read;
  }
  // Searches over the times of this class, not over those of the source.
  std::optional<std::size_t> frameAt(std::int64_t timeUs) const override {
    return ProfileStorage::frameAt(timeUs);
  }
  std::optional<std::size_t> sampleAt(std::size_t series, std::int64_t timeUs) const override {
    return ProfileStorage::sampleAt(series, timeUs);
  }

 private:
  const Times frames_;  // empty: those of the source
  const std::map<std::size_t, Times> series_;
};

FittedClock clockOf(std::string name, const std::vector<ClockStamp>& stamps) {
  FittedClock clock;
  clock.name = std::move(name);
  clock.isWithoutTimes = std::none_of(
      stamps.begin(), stamps.end(), [](const ClockStamp& stamp) { return stamp.deviceUs; });
  clock.base = TimeBase::fit(stamps, &clock.why);
  return clock;
}

std::vector<ClockStamp> stampsOfFrames(const Profile& profile, const Progress& progress) {
  std::vector<ClockStamp> stamps(profile.numFrames());
  TactileFrame frame;
  UnreadableSamples unreadable;
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    reportProgress(progress, i, stamps.size(), kFramesPerReport);
    const bool isRead = profile.readFrame(i, frame, &unreadable);
    stamps[i] = {frame.hostUs, isRead ? frame.deviceUs : std::nullopt};
  }
  return stamps;
}

// By the series of the clocks, the frames as kMaxSeries.
std::map<std::size_t, FittedClock> clocksBySeries(const Profile& profile,
                                                  std::vector<ClockStamp> stamps) {
  std::map<std::size_t, FittedClock> clocks;
  clocks.emplace(kMaxSeries, clockOf("frames", stamps));
  for (std::size_t series = 0; series < profile.series().size(); ++series) {
    stamps.resize(profile.numSamples(series));
    for (std::size_t i = 0; i < stamps.size(); ++i) {
      const Sample sample = profile.sample(series, i);
      stamps[i] = {sample.hostUs, sample.deviceUs};
    }
    FittedClock clock = clockOf(profile.series()[series].name, stamps);
    if (!clock.isWithoutTimes) clocks.emplace(series, std::move(clock));
  }
  return clocks;
}

std::vector<FittedClock> inOrder(std::map<std::size_t, FittedClock> clocks) {
  std::vector<FittedClock> all;
  all.push_back(std::move(clocks.at(kMaxSeries)));
  clocks.erase(kMaxSeries);
  for (auto& [series, clock] : clocks) all.push_back(std::move(clock));
  return all;
}

}  // namespace

std::string FittedClock::text() const {
  return name + ": " + (base ? clockText(base->report()) : why + "; the times of arrival are used");
}

std::vector<FittedClock> clocksOf(const Profile& profile, const Progress& progress) {
  return inOrder(clocksBySeries(profile, stampsOfFrames(profile, progress)));
}

std::vector<FittedClock> clocksOf(const Profile& profile,
                                  std::span<const std::optional<std::int64_t>> framesDeviceUs) {
  std::vector<ClockStamp> stamps(framesDeviceUs.size());
  for (std::size_t i = 0; i < stamps.size(); ++i)
    stamps[i] = {profile.frameTimeUs(i), framesDeviceUs[i]};
  return inOrder(clocksBySeries(profile, std::move(stamps)));
}

FittedTimes fittedTimes(const Profile& profile, const Progress& progress) {
  auto clocks = clocksBySeries(profile, stampsOfFrames(profile, progress));
  std::vector<std::int64_t> frames;
  std::map<std::size_t, std::vector<std::int64_t>> series;
  bool any = false;
  for (const auto& [index, clock] : clocks) {
    if (!clock.base) continue;
    any = true;
    (index == kMaxSeries ? frames : series[index]) = clock.base->timesUs();
  }
  if (!any) return {profile, inOrder(std::move(clocks))};
  Profile fitted(profile.info(),
                 profile.hand(),
                 std::make_shared<AtOtherTimes>(profile, std::move(frames), std::move(series)),
                 profile.furtherSeries());
  return {fitted.withBaselines(profile.baselines()), inOrder(std::move(clocks))};
}

}  // namespace palpate
