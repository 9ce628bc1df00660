#include "gui/source/opened_recording.h"

#include <QJsonDocument>
#include <QJsonObject>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <palpate/core/error.h>
#include <palpate/core/progress.h>
#include <palpate/core/statistics.h>
#include <palpate/core/time.h>
#include <palpate/model/gap_detector.h>
#include <palpate/recording/gap_events.h>
#include <palpate/recording/recording.h>
#include <palpate/recording/second_summary.h>

namespace palpate::gui {
namespace {

constexpr std::int64_t kWholeS = 1'000'000;  // one second [us]
constexpr std::size_t kFramesPerReport = 256;
// Name of the native format in ProfileInfo, and the begin of the warning of an unfinished one.
constexpr const char* kNativeFormat = "palpate";
constexpr const char* kUnfinishedWarning = "unfinished:";

// Fills in what the per-second summary tells before any frame is read. It doesn't show gaps shorter
// than two seconds.
void takeSummary(OpenedRecording& opened, const std::vector<SecondSummary>& seconds) {
  const Profile& profile = opened.profile;
  opened.timing.durationS = static_cast<double>(profile.durationUs()) / kUsPerS;
  opened.timing.meanRateHz =
      static_cast<double>(profile.numFrames() - 1) / std::max(opened.timing.durationS, 1e-6);
  std::vector<std::int64_t> counts;
  std::vector<Gap> emptySeconds;
  const SecondSummary* before = nullptr;
  for (const SecondSummary& row : seconds) {
    if (row.matrix < 0 || static_cast<std::size_t>(row.matrix) >= opened.numMatrices()) continue;
    opened.maximum = std::max(opened.maximum, row.maximum);
    if (row.activeMax > 0) opened.touched[static_cast<std::size_t>(row.matrix)] = true;
    if (row.matrix != 0) continue;
    counts.push_back(row.frames);
    if (before && row.tS > before->tS + 1) {
      const std::size_t last = profile.frameAt(row.tS * kWholeS - 1).value_or(0);
      if (last + 1 < profile.numFrames())
        emptySeconds.push_back(
            {last,
             static_cast<double>(profile.frameTimeUs(last + 1) - profile.frameTimeUs(last)) /
                 kUsPerS});
    }
    before = &row;
  }
  if (counts.empty()) return;
  opened.timing.rateHz = static_cast<double>(upperMedian(std::move(counts)));
  // Seconds without a frame are not in the summary, so that a rate below 1 Hz would look like 1 Hz.
  if (opened.timing.rateHz <= 1.0)
    opened.timing.rateHz = std::min(opened.timing.rateHz, opened.timing.meanRateHz);
  const double thresholdS = gapThresholdS(1.0 / opened.timing.rateHz);
  std::copy_if(emptySeconds.begin(),
               emptySeconds.end(),
               std::back_inserter(opened.timing.gaps),
               [&](const Gap& gap) { return gap.seconds > thresholdS; });
}

// Opens a long recording. A native recording contains a summary; for all other forms, which are
// read completely when they are opened, the summary is made here. Without a summary (damaged), only
// the duration is known, and all matrices count as touched until the overview is complete.
void openBySummary(OpenedRecording& opened, const Progress& progress) {
  std::vector<SecondSummary> seconds;
  try {
    // The summary of a damaged recording counts the frames that are lost, too.
    const bool stored = opened.profile.info().format == kNativeFormat && opened.damage.empty();
    seconds = stored ? readSeconds(opened.path) : secondsOf(opened.profile, progress);
  } catch (const Cancelled&) {
    throw;
  } catch (const Error&) {
    seconds.clear();
  }
  takeSummary(opened, seconds);
  if (!seconds.empty()) return;
  opened.maximumKnown = false;
  opened.timing.rateHz = opened.timing.meanRateHz;
  opened.touched.assign(opened.numMatrices(), true);
}

bool isLongRecording(const Profile& profile, std::size_t longFrom) {
  const std::size_t frames = profile.numFrames();
  return frames > 0 &&
         (frames >= longFrom ||
          frames * (profile.layout().numMatrices() + 1) >= OpenedRecording::kLongFromRows ||
          frames * profile.layout().numCells() >= OpenedRecording::kLongFromPlaces);
}

void readThrough(OpenedRecording& opened, const Progress& progress) {
  const std::size_t numFrames = opened.profile.numFrames();
  opened.timing = timingOf(opened.profile);
  opened.whole.reserve(numFrames);
  opened.timeS.reserve(numFrames);
  std::vector<CharacteristicSignals> rows;
  std::vector<CharacteristicSignals> all;
  all.reserve(numFrames * opened.numMatrices());
  TactileFrame frame;
  for (std::size_t i = 0; i < numFrames; ++i) {
    reportProgress(progress, i, numFrames, kFramesPerReport);
    opened.profile.readFrame(i, frame);
    allSignals(frame, rows);
    opened.whole.push_back(rows.back());
    opened.maximum = std::max(opened.maximum, rows.back().maximum);
    if (isSaturated(rows, opened.profile.hand())) ++opened.saturatedFrames;
    opened.timeS.push_back(static_cast<double>(frame.hostUs - opened.profile.frameTimeUs(0)) /
                           kUsPerS);
    for (std::size_t m = 0; m < opened.numMatrices(); ++m)
      if (rows[m].active > 0) opened.touched[m] = true;
    all.insert(all.end(), rows.begin(), rows.end() - 1);
  }
  opened.table = SignalTable(opened.numMatrices(), std::move(all));
}

// Spans of lost frames that are too short for the rule of gaps (gap_detector.h), but that the
// recording itself tells of, are gaps as well.
void addGapsOfEvents(OpenedRecording& opened) {
  const Profile& profile = opened.profile;
  std::vector<Gap>& gaps = opened.timing.gaps;
  for (const Event& event : opened.events.events) {
    if (event.kind != "gap" || event.t1Us <= event.tUs) continue;
    const QJsonValue stream =
        QJsonDocument::fromJson(QByteArray::fromStdString(event.json)).object()["stream"];
    if (stream.toString("tactile") != "tactile") continue;
    const std::optional<std::size_t> before = profile.frameAt(event.tUs);
    if (!before || *before + 1 >= profile.numFrames()) continue;
    const std::int64_t beginUs = profile.frameTimeUs(*before);
    const std::int64_t endUs = profile.frameTimeUs(*before + 1);
    constexpr double kLostIntervals = 1.5;
    const double seconds = static_cast<double>(endUs - beginUs) / kUsPerS;
    if (opened.timing.rateHz > 0.0 && seconds < kLostIntervals / opened.timing.rateHz) continue;
    const bool known =
        std::any_of(gaps.begin(), gaps.end(), [&](const Gap& gap) { return gap.frame == *before; });
    if (!known) gaps.push_back({*before, seconds});
  }
  std::sort(gaps.begin(), gaps.end(), [](const Gap& a, const Gap& b) { return a.frame < b.frame; });
}

}  // namespace

QString fileNameOf(const OpenedRecording& recording) {
  return QString::fromStdString(recording.path.filename().string());
}

const TimingReport& OpenedRecording::timingNow() const {
  return overview && overview->complete() ? overview->timing() : timing;
}

std::optional<double> OpenedRecording::maximumNow() const {
  if (overview && overview->complete()) return overview->maximum();
  return maximumKnown ? std::optional(maximum) : std::nullopt;
}

std::optional<std::size_t> OpenedRecording::saturatedFramesNow() const {
  if (!overview) return saturatedFrames;
  if (!overview->complete()) return std::nullopt;
  return overview->saturatedFrames();
}

const UnreadableSamples& OpenedRecording::unreadableNow() const {
  static const UnreadableSamples none;
  return overview && overview->complete() ? overview->unreadable() : none;
}

bool OpenedRecording::unreadableAt(double seconds) const {
  const auto& runs = unreadableNow().runs;
  if (runs.empty() || !std::isfinite(seconds)) return false;
  const auto frame =
      profile.frameAt(profile.frameTimeUs(0) + std::llround(seconds * kUsPerS)).value_or(0);
  return std::any_of(runs.begin(), runs.end(), [frame](const UnreadableSamples::Run& run) {
    return run.first <= frame && frame <= run.last;
  });
}

CharacteristicSignals OpenedRecording::at(std::size_t frame, std::size_t matrix) const {
  if (!isLong()) return matrix == numMatrices() ? whole.at(frame) : table.at(frame, matrix);
  const TactileFrame values = profile.frame(frame);
  return matrix == numMatrices() ? wholeFrameSignals(values)
                                 : characteristicSignals(values, matrix);
}

double OpenedRecording::timeAt(std::size_t frame) const {
  if (!isLong()) return timeS.at(frame);
  return static_cast<double>(profile.frameTimeUs(frame) - profile.frameTimeUs(0)) / kUsPerS;
}

double OpenedRecording::durationS() const {
  return static_cast<double>(profile.durationUs()) / kUsPerS;
}

std::optional<std::pair<std::size_t, std::size_t>> OpenedRecording::framesWithin(double fromS,
                                                                                 double toS) const {
  if (profile.numFrames() == 0 || !(fromS <= toS)) return std::nullopt;
  const auto atOrBefore = [&](double seconds) {
    constexpr double kFurthestS = 1e12;
    const double clamped = std::clamp(seconds, -kFurthestS, kFurthestS);
    // Half a microsecond is added so that a time computed from a stamp finds the same frame again.
    return *profile.frameAt(profile.frameTimeUs(0) + std::llround(clamped * kUsPerS + 0.5));
  };
  std::size_t first = atOrBefore(fromS);
  const std::size_t last = atOrBefore(toS);
  if (timeAt(first) < fromS - 1e-6) ++first;
  if (first > last || timeAt(last) > toS + 1e-6) return std::nullopt;
  return std::pair(first, last);
}

QString OpenedRecording::reasonOf(const Gap& gap) const {
  QStringList reasons;
  for (const Event& event : events.events) {
    if (event.kind != "gap" || event.text.empty() || !touchesGap(event, gap, profile)) continue;
    const QString reason = QString::fromStdString(event.text);
    if (!reasons.contains(reason)) reasons.append(reason);
  }
  if (!reasons.isEmpty()) return reasons.join("; ");
  return damage.empty() ? QString("nothing was recorded") : "lost, or nothing was recorded";
}

const Gap* OpenedRecording::gapAt(double seconds) const {
  for (const Gap& gap : timingNow().gaps) {
    // Half a microsecond is left out so that the time of the frame after the gap isn't in it.
    constexpr double kHalfUs = 0.5e-6;
    const double begin = timeAt(gap.frame);
    if (seconds > begin && seconds < begin + gap.seconds - kHalfUs) return &gap;
  }
  return nullptr;
}

namespace {

// In a damaged recording also the short spans without frames count as gaps, for what was lost may
// be short: those of more than kLostIntervals usual intervals.
std::vector<Gap> lostSpans(const OpenedRecording& opened) {
  constexpr double kLostIntervals = 2.5;
  if (opened.timing.rateHz <= 0.0) return opened.timing.gaps;
  const double longestS = kLostIntervals / opened.timing.rateHz;
  std::vector<Gap> gaps;
  for (std::size_t i = 1; i < opened.timeS.size(); ++i)
    if (const double seconds = opened.timeS[i] - opened.timeS[i - 1]; seconds > longestS)
      gaps.push_back({i - 1, seconds});
  return gaps;
}

std::shared_ptr<OpenedRecording> computed(std::filesystem::path path,
                                          Profile profile,
                                          std::string damage,
                                          const Progress& progress,
                                          std::size_t longFrom) {
  auto opened = std::make_shared<OpenedRecording>(OpenedRecording{.path = std::move(path),
                                                                  .profile = std::move(profile),
                                                                  .timing = {},
                                                                  .table = {},
                                                                  .whole = {},
                                                                  .timeS = {},
                                                                  .touched = {},
                                                                  .events = {},
                                                                  .eventsFailure = {},
                                                                  .damage = std::move(damage),
                                                                  .overview = {}});
  opened->touched.assign(opened->numMatrices(), false);
  if (isLongRecording(opened->profile, longFrom)) {
    openBySummary(*opened, progress);
    opened->overview = std::make_shared<SignalOverview>(opened->profile);
  } else {
    readThrough(*opened, progress);
    if (!opened->damage.empty()) opened->timing.gaps = lostSpans(*opened);
  }
  return opened;
}

}  // namespace

OpenedRecordingPtr makeOpenedRecording(std::filesystem::path path,
                                       Recording recording,
                                       const Progress& progress,
                                       std::size_t longFrom) {
  Damage& damage = recording.damage;
  const auto opened = computed(
      std::move(path), std::move(recording.profile), std::move(damage.text), progress, longFrom);
  // Of a damaged recording, too, unless this is all of its damage.
  if (std::string why = damage.eventsFault(); why != opened->damage)
    opened->eventsFailure = std::move(why);
  opened->events = {std::move(recording.events), damage.events};
  opened->notInFile = std::move(damage.notInFile);
  opened->meta = std::move(recording.meta);
  addGapsOfEvents(*opened);
  return opened;
}

bool isUnfinished(const OpenedRecording& recording) {
  const auto& warnings = recording.profile.info().warnings;
  return std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
    return warning.starts_with(kUnfinishedWarning);
  });
}

}  // namespace palpate::gui
