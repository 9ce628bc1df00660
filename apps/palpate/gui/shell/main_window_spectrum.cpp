// The main window's Spectrum dock: whose spectra it shows, on the timeline's axis of time.
#include "gui/export/take_away.h"
#include "gui/matrices/matrices_panel.h"
#include "gui/shell/main_window_recognise.h"
#include "gui/spectrum/spectrum_panel.h"
#include "gui/timeline/timeline_panel.h"
#include "gui/widgets/dock.h"

namespace palpate::gui {
namespace {

constexpr double kSpectrumShare = 0.31;  // of the window's height, when it is asked for
constexpr double kMainWindowSpectrumTimelineShare = 0.17;  // below it

constexpr int kLowWindow = 760;  // [px] of height

}  // namespace

void MainWindow::buildSpectrum() {
  spectrum_ = new SpectrumPanel(settings_, this);
  spectrumDock_ = new Dock("Spectrum", spectrum_, &spectrum_->header(), this);
  docks_ += spectrumDock_;
  spectrumDock_->toggleViewAction()->setShortcut(QKeySequence("Ctrl+U"));
}

// Above the timeline, whose cursor it shares.
void MainWindow::placeSpectrum() {
  splitDockWidget(timelineDock_, spectrumDock_, Qt::Vertical);
  splitDockWidget(spectrumDock_, timelineDock_, Qt::Vertical);
  spectrumDock_->hide();
  recognise_->place();
}

void MainWindow::connectSpectrum() {
  connect(&matrices_->view(), &MatricesView::selectionChanged, this, &MainWindow::showSpectrum);
  connect(timeline_, &TimelineChart::seenChanged, this, [this] {
    const QCPRange seen = timeline_->seen();
    spectrum_->setSeen(seen.lower, seen.upper);
  });
  connect(&playback_, &PlaybackController::positionChanged, spectrum_, &SpectrumPanel::setPosition);
  SpectrumChart& chart = spectrum_->chart();
  connect(&chart, &SpectrumChart::sought, &playback_, &PlaybackController::seekSeconds);
  connect(&chart, &SpectrumChart::fitAsked, timeline_, &TimelineChart::fit);
  connect(&chart, &SpectrumChart::zoomAsked, timeline_, &TimelineChart::zoomAbout);
  connect(&chart, &SpectrumChart::panAsked, this, [this](double seconds) {
    const QCPRange seen = timeline_->seen();
    timeline_->setSeen(seen.lower + seconds, seen.upper + seconds);
  });
  connect(spectrum_, &SpectrumPanel::said, this, &MainWindow::flash);
  connect(spectrumDock_->toggleViewAction(), &QAction::triggered, this, [this](bool shown) {
    if (shown) makeRoomForSpectrum();
  });
}

// Asked for, it is to be read: not as low as the timeline leaves it.
void MainWindow::makeRoomForSpectrum() {
  // Where there is no room for both, one is behind the other.
  if (height() < kLowWindow && !spectrumDock_->isFloating()) {
    tabifyDockWidget(timelineDock_, spectrumDock_);
    spectrumDock_->raise();
    return;
  }
  // Once it has a place.
  QTimer::singleShot(0, this, [this] {
    const int wanted = static_cast<int>(height() * kSpectrumShare);
    if (spectrumDock_->isFloating() || spectrumDock_->height() >= wanted) return;
    resizeDocks({spectrumDock_, timelineDock_},
                {wanted, static_cast<int>(height() * kMainWindowSpectrumTimelineShare)},
                Qt::Vertical);
  });
}

void MainWindow::showSpectrum() {
  spectrum_->setSource(shown_, liveShown_);
  if (!liveShown_) spectrum_->setTaxels(matrices_->view().selection());
  spectrum_->setMap(view_.map);
  spectrum_->setTheme(resolved(view_.theme));
  const QCPRange seen = timeline_->seen();
  spectrum_->setSeen(seen.lower, seen.upper);
  spectrum_->setPosition(playback_.positionS());
}

ExportedView MainWindow::spectrumExport() {
  ExportedView view;
  view.name = "Spectrum";
  view.widget = spectrum_;
  view.isThere = [this] { return spectrum_->shown(); };
  view.fileName = [this] { return recordingStem() + "_spectrum"; };
  view.size = [this] { return QSizeF(spectrum_->chart().size()); };
  view.paint = [this](QPainter& painter, const PictureLook& look) {
    spectrum_->chart().paint(painter, look, exportOptions().title, spectrum_->name());
  };
  view.tables = [this] { return spectrum_->tables(); };
  return view;
}

}  // namespace palpate::gui
