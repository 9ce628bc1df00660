#include "gui/opened_recording.h"

#include <algorithm>

#include <palpate/core/error.h>

namespace palpate::gui {
namespace {

constexpr double kUsPerS = 1e6;
constexpr double kTableShare = 0.5;  // of the work; the other half is the whole hand's signals
constexpr std::size_t kFramesPerReport = 256;

}  // namespace

const CharacteristicSignals& OpenedRecording::at(std::size_t frame, std::size_t matrix) const {
  return matrix == numMatrices() ? whole.at(frame) : table.at(frame, matrix);
}

const Gap* OpenedRecording::gapAt(double seconds) const {
  for (const Gap& gap : timing.gaps) {
    const double begin = timeS[gap.frame];
    if (seconds > begin && seconds < begin + gap.seconds) return &gap;
  }
  return nullptr;
}

OpenedRecordingPtr makeOpenedRecording(std::filesystem::path path,
                                       Profile profile,
                                       const Progress& progress) {
  const std::size_t numFrames = profile.numFrames();
  auto opened = std::make_shared<OpenedRecording>(
      OpenedRecording{std::move(path), std::move(profile), {}, {}, {}, {}, {}, 0.0, 0, {}});
  opened->timing = timingOf(opened->profile);
  opened->table = SignalTable::of(opened->profile, [&](double fraction) {
    return !progress || progress(fraction * kTableShare);
  });
  opened->touched.assign(opened->numMatrices(), false);
  opened->whole.reserve(numFrames);
  opened->timeS.reserve(numFrames);
  const auto saturation = static_cast<double>(opened->profile.hand().saturationCounts);
  TactileFrame frame;
  for (std::size_t i = 0; i < numFrames; ++i) {
    if (progress && i % kFramesPerReport == 0) {
      const double done = static_cast<double>(i) / static_cast<double>(numFrames);
      if (!progress(kTableShare + (1.0 - kTableShare) * done)) throw Cancelled();
    }
    opened->profile.readFrame(i, frame);
    const CharacteristicSignals all = wholeFrameSignals(frame);
    opened->whole.push_back(all);
    opened->maximum = std::max(opened->maximum, all.maximum);
    if (all.maximum >= saturation) ++opened->saturatedFrames;
    opened->timeS.push_back(static_cast<double>(frame.hostUs - opened->profile.frameTimeUs(0)) /
                            kUsPerS);
    for (std::size_t m = 0; m < opened->numMatrices(); ++m)
      if (opened->table.at(i, m).active > 0) opened->touched[m] = true;
  }
  for (const Gap& gap : opened->timing.gaps) opened->gapFrames.push_back(gap.frame);
  return opened;
}

}  // namespace palpate::gui
