// The main window while it records: start, stop, marks, what is offered afterwards, what an earlier day left
// unfinished.
#include <QToolButton>

#include "gui/link/link_panel.h"
#include "gui/look/captions.h"
#include "gui/look/icons.h"
#include "gui/record/recording_dialog.h"
#include "gui/shell/main_window.h"
#include "gui/widgets/message_banner.h"
#include "gui/widgets/offer_strip.h"

namespace palpate::gui {
namespace {

// Messages that the next recording answers.
constexpr const char* kRecordingTopic = "recording";

// "01:16", "1:02:03"
QString clockText(double seconds) {
  constexpr int kSixty = 60;
  const auto whole = static_cast<int>(seconds);
  const auto two = [](int value) { return QString("%1").arg(value, 2, 10, QChar('0')); };
  const int hours = whole / kSixty / kSixty;
  const QString rest = two(whole / kSixty % kSixty) + ":" + two(whole % kSixty);
  return hours == 0 ? rest : QString::number(hours) + ":" + rest;
}

QString megabytes(std::int64_t bytes) {
  constexpr double kMega = 1e6;
  return figure(static_cast<double>(bytes) / kMega, 1) + " MB";
}

QString summaryOf(const RecordingReport& report) {
  QString text = QString::fromStdString(report.paths.front().filename().string());
  if (report.paths.size() > 1) text += " and " + QString::number(report.paths.size() - 1) + " more";
  text += ": " + QString::number(report.frames) + " frames in " + figure(report.durationS, 1) +
          " s, " + megabytes(report.bytes);
  text += report.lost > 0 ? ", " + QString::number(report.lost) + " lost" : ", nothing lost";
  if (report.gaps > 0)
    text += report.gaps == 1 ? ", 1 gap" : ", " + QString::number(report.gaps) + " gaps";
  return text;
}

}  // namespace

void MainWindow::connectRecording() {
  askForRecording = [this](const RecordingSettings& last,
                           const QString& button) -> std::optional<RecordingSettings> {
    RecordingDialog dialog(last, button, this);
    if (dialog.exec() != QDialog::Accepted) return std::nullopt;
    return dialog.settings();
  };
  recordingSettings_ = loadRecordingSettings(settings_);
  useRecordingSettings();
  const auto on = [this](QAction* action, auto what) {
    connect(action, &QAction::triggered, this, what);
  };
  on(actions_.record, [this] { toggleRecording(); });
  on(actions_.recordingSettings, [this] {
    if (const auto wanted = askForRecording(recordingSettings_, "Keep")) {
      recordingSettings_ = *wanted;
      useRecordingSettings();
    }
  });
  actions_.openRecorded->setEnabled(false);
  on(actions_.openRecorded, [this] { openFiles(lastRecorded_); });
  on(actions_.mark, [this] { markNow({}, std::nullopt); });
  for (qsizetype digit = 0; digit < actions_.labels.size(); ++digit)
    on(actions_.labels[digit], [this, digit] {
      const QString& label = recordingSettings_.markLabels.at(static_cast<std::size_t>(digit));
      const auto key = static_cast<int>(digit);
      markNow(label.isEmpty() ? "mark " + QString::number(key) : label, key);
    });
  connect(&live_, &LiveController::recordingStarted, this, [this] {
    banner_->withdraw(kRecordingTopic);
    link_->log("recording begins");
    showRecordingState();
  });
  connect(&live_, &LiveController::recordingFailed, this, [this](const QString& message) {
    banner_->showAbout(kRecordingTopic, "Not recording: " + message);
    link_->log("not recording: " + message);
    showRecordingState();
  });
  connect(&live_, &LiveController::recordingEnded, this, &MainWindow::recordingEnded);
  connectUnfinished();
}

void MainWindow::connectUnfinished() {
  connect(&unfinished_, &UnfinishedFinder::found, this, [this](const QStringList& paths) {
    // What was just recorded is more urgent.
    if (paths.isEmpty() || !offer_->isHidden()) return;
    constexpr qsizetype kMostNames = 3;
    QStringList names;
    for (const QString& path : paths.mid(0, kMostNames)) names.append(path.section('/', -1));
    if (paths.size() > kMostNames)
      names.append(QString::number(paths.size() - kMostNames) + " more");
    offer_->offer(
        (paths.size() == 1 ? QString("A recording was never finished: ")
                           : QString::number(paths.size()) + " recordings were never finished: ") +
            names.join(", ") + ". Recovering makes a new file beside it and changes nothing.",
        "Recover",
        [this, paths] {
          recovered_.clear();
          offer_->say("Recovering …");
          unfinished_.recover(paths);
        },
        [this, paths] { unfinished_.ignore(paths); });
  });
  connect(&unfinished_, &UnfinishedFinder::progressed, this, [this](double fraction) {
    offer_->say("Recovering … " + figure(100.0 * fraction, 0) + " %");
  });
  connect(&unfinished_,
          &UnfinishedFinder::recovered,
          this,
          [this](const QString& path, const QString& message, const QString& saved) {
            recovered_.emplace_back(saved.toStdString());
            link_->log("recovered " + path.section('/', -1) + ": " + message);
          });
  connect(&unfinished_,
          &UnfinishedFinder::failed,
          this,
          [this](const QString&, const QString& message) { banner_->showMessage(message); });
  connect(&unfinished_, &UnfinishedFinder::finished, this, [this] {
    offer_->dismiss();
    if (recovered_.empty()) return;
    const auto count = recovered_.size();
    offer_->offer(
        count == 1 ? "Recovered " + QString::fromStdString(recovered_.front().filename().string())
                   : QString("Recovered %1 recordings").arg(count),
        "Open",
        [this, paths = recovered_] { openFiles(paths); });
  });
}

void MainWindow::offerUnfinished() { unfinished_.look(recordingSettings_.folder); }

void MainWindow::useRecordingSettings() {
  saveRecordingSettings(recordingSettings_, settings_);
  live_.setFolder(recordingSettings_.folder.toStdString());
  for (qsizetype digit = 0; digit < actions_.labels.size(); ++digit) {
    const QString& label = recordingSettings_.markLabels.at(static_cast<std::size_t>(digit));
    actions_.labels[digit]->setText(
        "Mark " + QString::number(digit) +
        (label.isEmpty() ? "" : ": " + QString(label).replace('&', "&&")));
  }
}

void MainWindow::toggleRecording() {
  if (live_.recording()) return live_.stopRecording();
  if (recordingSettings_.askEachTime) {
    const auto wanted = askForRecording(recordingSettings_, "Start recording");
    if (!wanted) return;
    recordingSettings_ = *wanted;
    useRecordingSettings();
  }
  offer_->dismiss();
  live_.startRecording([settings = recordingSettings_] {
    return recordingOptions(settings, nextPath(settings, systemClock().wallUs()));
  });
  showRecordingState();
}

void MainWindow::markNow(const QString& label, std::optional<int> digit) {
  live_.mark(label, digit);
  flash((label.isEmpty() ? QString("marked") : "marked: " + label) +
        (live_.recording() ? "" : " (nothing is being recorded)"));
}

// What the button says: how long, and how much is on disk.
void MainWindow::showRecordingState() {
  const bool on = live_.recording();
  menus_->showRecording(on);
  const Theme theme = resolved(view_.theme);
  if (on != recordingShown_ || actions_.record->icon().isNull() || theme != recordingTheme_) {
    recordingShown_ = on;
    recordingTheme_ = theme;
    actions_.record->setIcon(makeIcon(on ? IconShape::kStopRecording : IconShape::kRecord, theme));
    actions_.record->setText(on ? "Stop &recording" : "&Record");
    actions_.record->setToolTip(on ? "Stop and finish the recording (Ctrl+R)"
                                   : "Record what comes, with the two seconds before (Ctrl+R)");
  }
  QString text = " Record";
  if (on) {
    const RecorderStatus& recorder = live_.health().recorder;
    text = recorder.state == RecorderStatus::State::kRecording
               ? " " + clockText(recorder.elapsedS) + " · " + megabytes(recorder.bytesOnDisk)
               : QString(" waiting for a frame");
  }
  if (actions_.record->iconText() != text) actions_.record->setIconText(text);
}

void MainWindow::recordingEnded(const RecordingReport& report) {
  showRecordingState();
  if (report.paths.empty()) {
    const QString why = report.message.empty() ? QString("no frame came while it ran")
                                               : QString::fromStdString(report.message);
    banner_->showAbout(kRecordingTopic, "Nothing was recorded: " + why);
    link_->log("nothing was recorded: " + why);
    return;
  }
  lastRecorded_ = report.paths;
  actions_.openRecorded->setEnabled(true);
  const QString summary = summaryOf(report);
  link_->log("recorded " + summary);
  if (!report.complete)
    banner_->showMessage(QString::fromStdString(report.paths.front().filename().string()) +
                         ": something is missing: " + QString::fromStdString(report.message));
  if (closing_) return;
  offer_->offer("Recorded " + summary, "Open", [this] { openFiles(lastRecorded_); });
}

}  // namespace palpate::gui
