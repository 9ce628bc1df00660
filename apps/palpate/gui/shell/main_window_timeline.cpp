// The main window's timeline: which curves it shows, the part of it that is selected, and what is cut from it.
#include <QFileDialog>
#include <QFileInfo>
#include <QInputDialog>
#include <QToolButton>

#include <palpate/recording/crop.h>
#include <palpate/recording/recording.h>

#include "gui/export/take_away.h"
#include "gui/inspect/inspect_panel.h"
#include "gui/look/captions.h"
#include "gui/matrices/matrices_panel.h"
#include "gui/shell/main_window_calibrate.h"
#include "gui/shell/main_window_recognise.h"
#include "gui/shell/main_window_slip.h"
#include "gui/timeline/timeline_header.h"
#include "gui/timeline/timeline_panel.h"
#include "gui/widgets/message_banner.h"
#include "gui/widgets/opening_strip.h"

namespace palpate::gui {
namespace {

constexpr const char* kCropFolder = "recent/crop_folder";

}  // namespace

void MainWindow::connectTimeline() {
  askForText = [this](const QString& title, const QString& text) -> std::optional<QString> {
    bool good = false;
    const QString answer =
        QInputDialog::getText(this, title, title + ":", QLineEdit::Normal, text, &good);
    return good ? std::optional(answer.simplified()) : std::nullopt;
  };
  askForCropped = [this](const QString& suggestion) {
    return QFileDialog::getSaveFileName(
        this,
        "Crop to a new recording",
        suggestion,
        "Palpate recording (*.palpate);;DSA recording (*.dsa);;CSV table (*.csv);;NumPy (*.npz)");
  };
  signalTree_->setExtras(extras_);
  const auto on = [this](QAction* action, auto what) {
    connect(action, &QAction::triggered, this, what);
  };
  const auto chooseCurves = [this] { signalTree_->openBelow(*timelineHeader_->curvesButton()); };
  on(actions_.chooseCurves, chooseCurves);
  connect(timelineHeader_, &TimelineHeader::curvesAsked, this, chooseCurves);
  connect(signalTree_, &SignalTree::extrasChanged, this, [this] {
    extras_ = signalTree_->extras();
    showCurves();
  });
  connect(signalTree_, &SignalTree::groupAsked, this, &MainWindow::nameChosenTaxels);
  connect(&groups_, &TaxelGroups::changed, this, &MainWindow::showCurves);
  connect(&matrices_->view(), &MatricesView::selectionChanged, this, [this] {
    signalTree_->setNumChosen(matrices_->view().selection().count());
    if (extras_.chosenTaxels) showCurves();
  });
  connect(timeline_, &TimelineChart::selectionChanged, this, &MainWindow::showSelection);
  connect(&timeline_->store(), &SeriesStore::changed, this, &MainWindow::showReading);
  on(actions_.nameTaxels, [this] { nameChosenTaxels(); });
  on(actions_.selectFrom, [this] { selectEnd(true); });
  on(actions_.selectTo, [this] { selectEnd(false); });
  on(actions_.selectAll, [this] {
    timeline_->setSelection(TimeSpan{0.0, timeline_->durationS()});
  });
  on(actions_.dropSelection, [this] { timeline_->setSelection(std::nullopt); });
  on(actions_.zoomSelection, [this] {
    if (timeline_->selection()) timeline_->showSpan(*timeline_->selection());
  });
  on(actions_.crop, [this] { cropSelection(); });
  connect(&job_, &BackgroundJob::started, working_, &OpeningStrip::begin);
  connect(&job_, &BackgroundJob::progressed, working_, &OpeningStrip::setProgress);
  connect(&job_, &BackgroundJob::finished, working_, &OpeningStrip::end);
  connect(working_, &OpeningStrip::cancelRequested, &job_, &BackgroundJob::cancel);
  connect(&job_, &BackgroundJob::failed, this, [this](const QString& message) {
    banner_->showMessage(message);
  });
  connect(&job_, &BackgroundJob::cancelled, this, [this](const QString& text) {
    flash(QFileInfo(text).fileName() + ": cancelled, nothing was written");
  });
  takeAway_->selectedFrames = [this]() -> std::optional<FrameSpan> {
    if (!current_ || !timeline_->selection()) return std::nullopt;
    const auto frames =
        current_->framesWithin(timeline_->selection()->fromS, timeline_->selection()->toS);
    if (!frames) return std::nullopt;
    return FrameSpan{frames->first, frames->second};
  };
}

std::vector<PlottedCurve> MainWindow::curvesNow() const {
  std::vector<PlottedCurve> curves;
  const MatrixTableModel& table = inspect_->table();
  if (table.numMatrices() == 0) return curves;
  const HandDescription& hand = table.hand();
  const Theme theme = resolved(view_.theme);
  for (std::size_t row = 0; row < table.plotted().size(); ++row)
    if (table.plotted()[row]) curves.push_back(matrixCurve(hand, row, view_.signal, theme));
  if (!current_ || liveShown_) return curves;
  const auto add = [&](PlottedCurve curve) {
    if (hasSeries(current_->profile, curve.choice)) curves.push_back(std::move(curve));
  };
  const TaxelSelection& chosen = matrices_->view().selection();
  if (extras_.chosenTaxels && !chosen.empty()) {
    const std::size_t count = chosen.count();
    add(taxelCurve(chosen,
                   count == 1 ? QString("chosen taxel") : QString::number(count) + " chosen taxels",
                   0,
                   theme));
  }
  std::size_t place = 1;
  for (const TaxelGroups::Group& group : groups_.of(current_->profile.layout()))
    if (extras_.groups.contains(group.name))
      add(taxelCurve(group.taxels, group.name, place++, theme));
  for (const int axis : extras_.angles)
    if (axis < static_cast<int>(hand.axes.size()))
      add(angleCurve(hand, static_cast<std::size_t>(axis), theme));
  for (const int sensor : extras_.temperatures)
    if (sensor < static_cast<int>(hand.temperatureSensors.size()))
      add(temperatureCurve(hand, static_cast<std::size_t>(sensor), theme));
  return curves;
}

void MainWindow::showCurves() {
  const std::vector<PlottedCurve> curves = curvesNow();
  timelineHeader_->setCurves(curves, resolved(view_.theme));
  timelineHeader_->setPlain(liveShown_);
  recognise_->show();
  showSpectrum();
  calibrate_->show();
  slip_->show();
  if (liveShown_) return;
  timeline_->setCurves(curves);
  showReading();
  showSelection();
}

void MainWindow::showReading() {
  if (liveShown_) return;
  const double done = timeline_->store().progress();
  timelineHeader_->setReading(
      done < 1.0 ? "reading " + QString::number(static_cast<int>(done * 100.0)) + " %" : QString());
  if (current_ && current_->isLong() && done >= 1.0) {
    inspect_->renewFacts();
    matrices_->renewRange();
    playback_.setGaps(current_->timingNow().gaps);
    showEvents();
  }
}

void MainWindow::showSelection() {
  if (liveShown_) return;
  QString words;
  const auto& selection = timeline_->selection();
  if (selection && current_) {
    const auto frames = current_->framesWithin(selection->fromS, selection->toS);
    const std::size_t count = frames ? frames->second - frames->first + 1 : 0;
    words = figure(selection->fromS, 2) + " – " + figure(selection->toS, 2) + " s · " +
            (count == 0   ? QString("no frame")
             : count == 1 ? QString("1 frame")
                          : QString::number(count) + " frames");
  }
  timelineHeader_->setSelection(words);
  enableEventActions();
}

void MainWindow::selectEnd(bool begin) {
  if (!current_ || !playback_.hasFrames()) return;
  const double now = playback_.positionS();
  const auto& selection = timeline_->selection();
  TimeSpan span =
      selection.value_or(begin ? TimeSpan{now, timeline_->durationS()} : TimeSpan{0.0, now});
  (begin ? span.fromS : span.toS) = now;
  // Begun behind its end: it ends at the end of the recording, and the other way round.
  if (span.fromS > span.toS) (begin ? span.toS : span.fromS) = begin ? timeline_->durationS() : 0.0;
  timeline_->setSelection(span);
}

void MainWindow::nameChosenTaxels() {
  const TaxelSelection chosen = matrices_->view().selection();
  if (chosen.empty()) return flash("no taxel is chosen: click or drag over some of the matrices");
  const auto name = askForText("Name of the taxels", "");
  if (!name) return;
  if (name->isEmpty()) return flash("a group of taxels needs a name");
  if (!groups_.keep(*name, chosen))
    return banner_->showMessage("There are too many groups of taxels: forget some (Curves, Del)");
  extras_.groups.insert(*name);
  signalTree_->setExtras(extras_);
  showCurves();
  flash("kept: " + *name + ", " + QString::number(chosen.count()) + " taxels");
}

void MainWindow::cropSelection() {
  const auto& selection = timeline_->selection();
  if (!current_ || !selection)
    return flash("nothing is selected: drag in the timeline, or press [ and ]");
  const auto frames = current_->framesWithin(selection->fromS, selection->toS);
  if (!frames)
    return banner_->showMessage("No frame lies in the selection: there is nothing to crop");
  const auto number = [](std::size_t frame) { return QString("%1").arg(frame, 6, 10, QChar('0')); };
  const QString here = QFileInfo(QString::fromStdString(current_->path.string())).absolutePath();
  const QString folder = settings_.value(kCropFolder, here).toString();
  const QString stem = QFileInfo(fileNameOf(*current_)).completeBaseName();
  QString path = askForCropped(folder + "/" + stem + "_" + number(frames->first) + "-" +
                               number(frames->second) + ".palpate");
  if (path.isEmpty()) return;
  if (QFileInfo(path).suffix().isEmpty()) path += ".palpate";
  settings_.setValue(kCropFolder, QFileInfo(path).absolutePath());
  EventEditor* editor = events();
  std::vector<RecordingEvent> noted = editor ? editor->events() : std::vector<RecordingEvent>();
  job_.start(
      path,
      [recording = current_, range = *frames, path, noted = std::move(noted)](
          const Progress& progress) {
        const std::filesystem::path out = path.toStdString();
        requireOther(recording->path, out);
        const auto half = [&](double from) {
          return [&progress, from](double fraction) { return progress(from + 0.5 * fraction); };
        };
        const Profile part = cropped(recording->profile, range.first, range.second, half(0.0));
        // The dialog has asked whether an existing file may be replaced.
        saveRecording(part, eventsWithin(noted, part), out, Overwrite::kReplace, half(0.5));
      },
      [this, path, frames = *frames] {
        flash("written: " + path + " (" + QString::number(frames.second - frames.first + 1) +
              " frames)");
        recent_.add(path);
        emit cropWritten(path);
        const QString ending = QFileInfo(path).suffix().toLower();
        if (ending == "csv" || ending == "npz") return;
        recordings_.open({{path.toStdString()}, OpenRequest::Then::kList});
      });
}

void MainWindow::waitForWork() {
  filterWorker_.wait();
  timeline_->store().waitUntilRead();
  timeline_->storeBefore().waitUntilRead();
  while (job_.busy()) QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
}

}  // namespace palpate::gui
