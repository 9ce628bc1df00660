#include "gui/shell/status_report.h"

#include <algorithm>

#include <palpate/capture/link_health.h>
#include <palpate/core/error.h>
#include <palpate/core/number_text.h>

#include "gui/appearance/captions.h"
#include "gui/appearance/hand_unit.h"
#include "gui/link/other_programs.h"
#include "gui/widgets/status_strip.h"

namespace palpate::gui {
namespace {

QString secondsText(double seconds) { return QString::fromStdString(fixedText(seconds, 2)) + " s"; }

}  // namespace

StatusReport::StatusReport(WindowState& windowState, StatusStrip& strip, WindowMenus& menus)
    : windowState_(windowState), strip_(strip), menus_(menus) {
  const auto report = [this] { this->report(); };
  connect(&windowState.messages, &Messages::changed, this, report);
  connect(&windowState.displayed, &DisplayedSource::shown, this, report);
  connect(&windowState.playback, &PlaybackController::positionChanged, this, report);
  connect(&windowState.playback, &PlaybackController::stateChanged, this, report);
  connect(&windowState.opener, &RecordingOpener::started, this, report);
  connect(&windowState.opener, &RecordingOpener::finished, this, report);
  connect(&windowState.selection, &Selection::taxelsChanged, this, report);
  connect(&windowState.currentFrame, &CurrentFrame::heldChanged, this, report);
  connect(&windowState.activeFilters, &ActiveFilters::onChanged, this, report);
  connect(&windowState.comparison, &ComparisonMode::changed, this, report);
  connect(&windowState.derivedResults, &DerivedResults::baselineChanged, this, report);
  connect(&windowState.live, &LiveController::stateChanged, this, [this] {
    reportLink();
    this->report();
  });
  connect(&windowState.live, &LiveController::ended, this, &StatusReport::reportLink);
  connect(&windowState.live, &LiveController::refreshed, this, [this] {
    reportLink();
    if (windowState_.displayed.isLive()) this->report();
  });
  connect(
      &windowState.handCommands, &HandCommands::conditionChanged, this, &StatusReport::reportHand);
}

void StatusReport::reportLink() {
  LiveController& live = windowState_.live;
  const LiveSource* source = live.source();
  if (!source) {
    const bool connecting = live.state() == LiveController::State::kConnecting;
    return menus_.showLink(connecting ? "connecting …" : "", false);
  }
  // The rate stands in the status line.
  const char* how = source->finished() ? " · ended" : live.stale() ? " · no data" : "";
  menus_.showLink(describe(source->connection) + how, !live.stale());
}

void StatusReport::reportHand() { menus_.showHand(windowState_.handCommands); }

void StatusReport::report() {
  if (windowState_.displayed.isLive()) return reportLive();
  const PlaybackController& playback = windowState_.playback;
  Status now;
  const bool opening = windowState_.opener.busy();
  const OpenedRecordingPtr recording = windowState_.displayed.recorded();
  if (!recording) {
    const QString& flashed = windowState_.messages.flashed();
    now.state = windowState_.live.state() == LiveController::State::kConnecting
                    ? "connecting: " + describe(windowState_.live.connection())
                : opening ? QString("opening a recording")
                          : QString("nothing open");
    now.notice =
        flashed.isEmpty() ? "Connect a hand (Ctrl+K) or open a recording (Ctrl+O)" : flashed;
    now.right = "F1 shows all keys";
    return strip_.setStatus(now);
  }
  const bool playing = playback.playing();
  const bool inGap = recording->gapAt(playback.positionS()) != nullptr;
  // Recordings are compared as they were recorded.
  const bool isFiltered = windowState_.activeFilters.applied() && !windowState_.comparison.on();
  now.lamp = inGap ? Status::Lamp::kWarning : playing ? Status::Lamp::kGood : Status::Lamp::kIdle;
  now.state = "playback · " + QString(playing ? "playing " : "paused ") +
              QString::number(playback.speed()) + "×" + (isFiltered ? " · filtered" : "") +
              (opening ? " · opening another" : "");
  if (playback.hasFrames()) {
    const OpenedRecordingPtr& seen =
        isFiltered ? windowState_.displayed.filteredRecording() : recording;
    try {
      const CharacteristicSignals all = seen->at(playback.frame(), seen->numMatrices());
      now.figures = {"active " + QString::number(all.active),
                     "max " + QString::number(all.maximum, 'f', decimalsOf(seen->profile.hand())),
                     "saturated " + QString::number(windowState_.currentFrame.saturated())};
    } catch (const Error&) {
      now.figures = {"active –", "max –", "saturated –"};  // the views say why
    }
    const QString frameTime = secondsText(playback.frameTimeS());
    const QString cursorTime = secondsText(playback.positionS());
    now.right = "frame " + QString::number(playback.frame()) + ", last " +
                QString::number(playback.numFrames() - 1) + "   " + frameTime;
    // While it plays, the cursor only runs from one frame to the next, except in a gap.
    if (cursorTime != frameTime && (!playing || inGap)) now.right += ", cursor " + cursorTime;
  }
  showBaseline(now);
  now.notice = notice();
  strip_.setStatus(now);
}

void StatusReport::reportLive() {
  LiveController& live = windowState_.live;
  const bool held = windowState_.currentFrame.held();
  const LinkHealth& health = live.health();
  const RecorderStatus& recorder = health.recorder;
  Status now;
  const bool diskFails =
      !recorder.writeError.empty() || !recorder.relocation.empty() || !recorder.mcapFailure.empty();
  const bool outOfRange = health.device.tactile.outOfRange > 0;
  now.lamp = live.stale() || held || diskFails || outOfRange ? Status::Lamp::kWarning
                                                             : Status::Lamp::kGood;
  if (live.source() && live.source()->finished())
    now.state = "the replay has ended";
  else if (live.stale())
    now.state = live.hasReceivedFrames() ? "no data" : "waiting for data";
  else if (recorder.state == RecorderStatus::State::kArmed)
    now.state = "recording waits for contact";
  else if (recorder.state != RecorderStatus::State::kIdle)
    now.state =
        recorder.framesOnDisk >= recorder.frames
            ? "all frames on disk"
            : "frames to write: " + QString::number(recorder.frames - recorder.framesOnDisk);
  else
    now.state = "live";
  // Why it can't be written stands in the alarm above the views.
  if (!recorder.writeError.empty())
    now.state +=
        " · " + QString::fromStdString(recorder.path.filename().string()) + " can't be written";
  else if (!recorder.relocation.empty())
    now.state += " · now in " + QString::fromStdString(recorder.path.filename().string());
  else if (!recorder.mcapFailure.empty())
    now.state += " · no MCAP file any more";
  if (outOfRange) now.state += " · values outside the range";
  if (windowState_.activeFilters.applied()) now.state += " · filtered";
  if (held) now.state = "on hold (P resumes) · " + now.state;
  now.figures = {"rate " + figure(health.frames.rateHz, 1) + " frames/s",
                 "age " + (live.stale() ? figure(live.silentS(), 1) + " s"
                                        : figure(health.device.tactile.ageMs, 0) + " ms"),
                 "lost " + QString::number(health.lost),
                 "bad " + QString::number(health.badChecksums + health.device.tactile.suspect),
                 "saturated " + QString::number(health.frames.saturatedFrames)};
  showBaseline(now);
  now.notice = notice();
  // Until something is sent, where it is awaited.
  if (const StreamDevice* stream = live.source() ? live.source()->streamDevice() : nullptr;
      stream && now.notice.isEmpty() && !live.hasReceivedFrames())
    now.notice = QString::fromStdString(stream->notice());
  now.right = describe(live.connection());
  if (const QString open = OtherPrograms::shortText(windowState_.actions); !open.isEmpty())
    now.right = open + " · " + now.right;
  strip_.setStatus(now);
}

void StatusReport::showBaseline(Status& now) const {
  const QString& baseline = windowState_.derivedResults.baseline();
  if (!baseline.isEmpty())
    now.figures.append(baseline == "none" ? QString("no baseline") : "baseline " + baseline);
}

QString StatusReport::notice() const {
  if (!windowState_.messages.flashed().isEmpty()) return windowState_.messages.flashed();
  if (!windowState_.messages.hovered().isEmpty()) return windowState_.messages.hovered();
  if (const QString chosen = chosenTaxels(); !chosen.isEmpty()) return chosen;
  const OpenedRecordingPtr recording = windowState_.displayed.recorded();
  if (!recording) return {};
  if (const Gap* gap = recording->gapAt(windowState_.playback.positionS()))
    return "gap of " + QString::number(gap->seconds, 'f', 1) + " s: " + recording->reasonOf(*gap);
  const auto gaps = recording->timingNow().gaps.size();
  if (gaps == 1) return "1 gap";
  return gaps == 0 ? QString() : QString::number(gaps) + " gaps";
}

QString StatusReport::chosenTaxels() const {
  const TaxelSelection& chosen = windowState_.selection.taxels();
  const std::size_t count = chosen.count();
  if (count == 0) return {};
  QString text = QString::number(count) + (count == 1 ? " taxel chosen" : " taxels chosen");
  const TactileFrame& frame = windowState_.currentFrame.frame();
  if (frame.values.empty() || frame.layout->numMatrices() != chosen.numMatrices()) return text;
  double sum = 0.0, largest = 0.0;
  for (std::size_t m = 0; m < chosen.numMatrices(); ++m) {
    const auto values = frame.allValues(m);
    for (int y = 0; y < values.rows(); ++y)
      for (int x = 0; x < values.cols(); ++x)
        if (chosen.contains(m, y, x)) {
          sum += static_cast<double>(values(y, x));
          largest = std::max(largest, static_cast<double>(values(y, x)));
        }
  }
  const HandDescription* hand = windowState_.displayed.hand();
  const int decimals = hand ? decimalsOf(*hand) : 0;
  return text + ": mean " + figure(sum / static_cast<double>(count), decimals) + ", max " +
         figure(largest, decimals) + " " + (hand ? unitOf(*hand) : QString());
}

}  // namespace palpate::gui
