// The main window's comparison of two recordings: where the matrices are else, with the docks out of its way. A is the
// recording that is shown and played.
#include <QStackedWidget>
#include <algorithm>

#include "gui/compare/compare_chart.h"
#include "gui/compare/compare_panel.h"
#include "gui/export/take_away.h"
#include "gui/shell/main_window.h"
#include "gui/widgets/dock.h"

namespace palpate::gui {
namespace {

constexpr const char* kAlignmentKey = "compare/alignment";

std::string mainWindowCompareText(const QVariant& value) { return value.toString().toStdString(); }

}  // namespace

void MainWindow::connectCompare() {
  if (const auto known = alignmentFrom(mainWindowCompareText(settings_.value(kAlignmentKey))))
    if (*known != Alignment::kByHand) compare_->setAlignment(*known);
  connect(actions_.compare, &QAction::triggered, this, [this](bool on) { showCompare(on); });
  connect(&playback_, &PlaybackController::positionChanged, this, [this](double seconds) {
    if (!compareSeeks_) compare_->setTime(seconds);
  });
  connect(compare_, &ComparePanel::sought, this, &MainWindow::seekCompared);
  connect(compare_, &ComparePanel::aChosen, this, &MainWindow::showRecording);
  connect(compare_,
          &ComparePanel::swapAsked,
          this,
          [this](const OpenedRecordingPtr& recording, double seconds) {
            const bool playing = playback_.playing();
            showRecording(recording);
            seekCompared(seconds);
            if (playing) playback_.play();
          });
  connect(compare_, &ComparePanel::openAsked, this, [this] {
    // A stays: what is opened here is to be B.
    askAndOpen(current_ ? OpenRequest::Then::kList : OpenRequest::Then::kShowFirst);
  });
  connect(compare_, &ComparePanel::signalChosen, this, [this](PlottedSignal signal) {
    changeView([&](ViewSettings& view) { view.signal = signal; });
  });
  connect(compare_, &ComparePanel::alignmentChanged, this, [this] {
    if (compare_->alignment() != Alignment::kByHand)
      settings_.setValue(kAlignmentKey,
                         QString::fromStdString(std::string(nameOf(compare_->alignment()))));
  });
  connect(compare_, &ComparePanel::hovered, this, [this](const QString& hover) {
    hover_ = hover;
    updateStatus();
  });
  takeAway_->add(compareExport());
}

// Where A has no frame any more B may still have one: then the playback waits at A's end.
void MainWindow::seekCompared(double seconds) {
  const double within = std::clamp(seconds, 0.0, playback_.durationS());
  compareSeeks_ = within != seconds;
  if (compareSeeks_) playback_.pause();
  playback_.seekSeconds(within);
  compareSeeks_ = false;
  compare_->setTime(seconds);
}

void MainWindow::showCompare(bool on) {
  if (on && (!current_ || liveShown_)) {
    // Nothing to compare yet: what is opened now will be.
    actions_.compare->setChecked(false);
    return askAndOpen(OpenRequest::Then::kCompare);
  }
  actions_.compare->setChecked(on);
  if (on == compareShown()) return;
  if (on) {
    layoutBeforeCompare_ = saveState();
    for (Dock* dock : docks_) dock->hide();
    centre_->setCurrentWidget(compare_);
    compare_->setTime(playback_.positionS());
  } else {
    centre_->setCurrentIndex(0);
    restoreState(layoutBeforeCompare_);
  }
  compare_->setActive(on);
  updateStatus();
}

bool MainWindow::compareShown() const { return centre_->currentWidget() == compare_; }

ExportedView MainWindow::compareExport() {
  ExportedView view;
  view.name = "Compare";
  view.widget = compare_;
  view.isThere = [this] { return compareShown() && compare_->hasPair(); };
  view.fileName = [this] {
    return recordingStem() + "_and_" + QString::fromStdString(compare_->b()->path.stem().string());
  };
  view.paint = [this](QPainter& painter, const PictureLook& look) {
    compare_->paint(painter, look);
  };
  view.tables = [this] {
    return std::vector<ExportedTable>{
        {"differences of the frame", [table = compare_->differenceTable()] { return table; }},
        {"curves of both", [table = compare_->curveTable()] { return table; }}};
  };
  return view;
}

}  // namespace palpate::gui
