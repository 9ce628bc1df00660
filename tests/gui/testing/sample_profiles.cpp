#include "gui/testing/sample_profiles.h"

#include <utility>

#include "palpate/device/sdh2.h"
#include <palpate/core/error.h>
#include <palpate/model/hand_description.h>
#include <palpate/model/profile_builder.h>
#include <palpate/recording/recording.h>

namespace palpate::gui {
namespace {

constexpr std::int64_t kStartUs = 1'400'000'000'000'000;

}  // namespace

TactileFrame emptyFrame() { return TactileFrame(sdh2().layout); }

Profile profileWithStamps(const std::vector<std::int64_t>& stampsMs) {
  ProfileBuilder builder(sdh2().layout);
  for (std::size_t i = 0; i < stampsMs.size(); ++i) {
    TactileFrame frame = emptyFrame();
    frame.matrix(1)(7, 2) = 10.0F * static_cast<float>(i + 1);
    builder.addFrame(kStartUs + stampsMs[i] * 1000, frame.values);
  }
  ProfileInfo info;
  info.format = "test";
  info.serial = "1D9B0057";
  return builder.finish(std::move(info));
}

Profile undatedFrames() {
  ProfileBuilder builder(sdh2().layout);
  for (std::int64_t i = 0; i < 3; ++i) builder.addFrame(i * 10'000, emptyFrame().values);
  return builder.finish({});
}

Profile twentyFrames() {
  std::vector<std::int64_t> stamps;
  for (std::int64_t i = 0; i < 20; ++i) stamps.push_back(50 * i);
  return profileWithStamps(stamps);
}

std::function<Recording(const std::filesystem::path&, const Progress&)> asRecording(
    std::function<Profile(const std::filesystem::path&, const Progress&)> read) {
  return [read = std::move(read)](const std::filesystem::path& path, const Progress& progress) {
    Recording recording{.profile = read(path, progress)};
    if (!std::filesystem::exists(path)) return recording;
    try {
      const EventsReport report = readEvents(path);
      recording.events = report.events;
      recording.damage.events = report.damaged;
      recording.meta = readRecordingMeta(path);
    } catch (const Error&) {
      recording.damage.eventsError = std::current_exception();
    }
    return recording;
  };
}

}  // namespace palpate::gui
