#include "gui/shell/main_window.h"

#include <QComboBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QMenu>
#include <QStatusBar>
#include <QVBoxLayout>

#include <palpate/core/time.h>
#include <palpate/recording/recording.h>

#include "gui/compare/compare_panel.h"
#include "gui/desktop/application.h"
#include "gui/export/take_away.h"
#include "gui/hand/hand_dock.h"
#include "gui/inspect/inspect_panel.h"
#include "gui/library/library_panel.h"
#include "gui/link/link_panel.h"
#include "gui/matrices/matrices_panel.h"
#include "gui/open/start_page.h"
#include "gui/playback/playback_bar.h"
#include "gui/shell/main_window_calibrate.h"
#include "gui/shell/main_window_recognise.h"
#include "gui/shell/main_window_slip.h"
#include "gui/space/hand_panel.h"
#include "gui/timeline/live_chart.h"
#include "gui/timeline/timeline_chart.h"
#include "gui/timeline/timeline_header.h"
#include "gui/timeline/timeline_panel.h"
#include "gui/widgets/dock.h"
#include "gui/widgets/message_banner.h"
#include "gui/widgets/offer_strip.h"
#include "gui/widgets/opening_strip.h"
#include "gui/widgets/status_strip.h"

namespace palpate::gui {
namespace {

constexpr const char* kDemoFile = "demo_grasps.dsa";
constexpr QSize kSmallestWindow(900, 600);
constexpr QSize kUsualWindow(1440, 900);

}  // namespace

MainWindow::MainWindow(const WindowSurroundings& surroundings)
    : settings_(surroundings.settingsPath, QSettings::IniFormat),
      recent_(settings_),
      view_(loadViewSettings(settings_)),
      actions_(this),
      playback_(surroundings.clock ? *surroundings.clock : systemClock()),
      opener_(surroundings.read ? surroundings.read
                                : RecordingOpener::Read([](const std::filesystem::path& path,
                                                           const Progress& progress) {
                                    return openRecording(path, progress);
                                  })),
      recordings_(opener_),
      live_(surroundings.dataFolder),
      activity_(surroundings.clock ? *surroundings.clock : systemClock()),
      groups_(settings_),
      extras_(loadPlottedExtras(settings_)),
      unfinished_(settings_) {
  setWindowTitle("Palpate");
  setMinimumSize(kSmallestWindow);
  setAcceptDrops(true);
  setDockOptions(AnimatedDocks | AllowNestedDocks | AllowTabbedDocks);
  buildParts(surroundings);
  buildDocks(surroundings);
  connectOpening();
  connectFileActions();
  connectPlayback();
  connectViewActions();
  connectChoices();
  connectLive();
  connectRecording();
  connectLibrary();
  connectTakeAway();
  connectTimeline();
  connectEvents();
  connectCompare();
  connectHandView();
  connectFilter(surroundings.recipe);
  connectSpectrum();
  calibrate_->connectAll();
  slip_->connectAll();

  askForRecordings = [this] {
    return QFileDialog::getOpenFileNames(this,
                                         "Open recordings",
                                         recent_.lastFolder(),
                                         "Recordings (*.dsa *.palpate *.xml);;All files (*)");
  };
  resize(kUsualWindow);
  restoreGeometry(settings_.value("window/geometry").toByteArray());
  layouts_[Place::kRecording] = settings_.value("window/layout").toByteArray();
  layouts_[Place::kLive] = settings_.value("window/live_layout").toByteArray();
  playback_.setSpeed(view_.speed);
  playback_.setLoop(view_.loop);
  playback_.setSkipGaps(view_.skipGaps);
  recognise_->connectAll();
  applyTheme();
  applyView();
  setPlace(Place::kStart);
  showLibraryAgain();
  listRecordings();
  // The window comes first.
  if (surroundings.offerUnfinished) QTimer::singleShot(0, this, &MainWindow::offerUnfinished);
  if (const auto* application = qobject_cast<GuardedApplication*>(QCoreApplication::instance()))
    connect(application, &GuardedApplication::failed, banner_, &MessageBanner::showMessage);
}

MainWindow::~MainWindow() {
  recognise_->leave();
  hand_->setHand(nullptr, nullptr);
  liveChart_->setHistory(nullptr, 0);
  calibrate_->leave();
  slip_->leave();
  delete libraryDock_;  // they hold on to settings and log, which go before other children
  delete logDock_;
}

void MainWindow::buildParts(const WindowSurroundings& surroundings) {
  std::error_code ignored;
  demoPath_ = surroundings.dataFolder / kDemoFile;
  const bool withDemo = std::filesystem::exists(demoPath_, ignored);
  actions_.openDemo->setVisible(withDemo);
  actions_.openDemo->setEnabled(withDemo);

  auto* page = new QWidget(this);
  alarmStrip_ = new MessageBanner(page, "AlarmStrip", "alarm");
  banner_ = new MessageBanner(page);
  offer_ = new OfferStrip(page);
  opening_ = new OpeningStrip(page);
  working_ = new OpeningStrip(page, "Cropping", "working");
  exporting_ = new OpeningStrip(page, "Exporting", "exporting");
  startPage_ = new StartPage(recent_, withDemo, page);
  matrices_ = new MatricesPanel(actions_.interpolated, actions_.values, page);
  handPanel_ = new HandPanel({actions_.normals,
                              actions_.contacts,
                              actions_.slipArrows,
                              actions_.sphereOfCentroids,
                              actions_.wire,
                              actions_.axes},
                             page);
  handPanel_->view().setAssumedAngles(surroundings.assumedAnglesDeg);
  views_ = new QSplitter(Qt::Horizontal, page);
  views_->setObjectName("views");
  views_->setChildrenCollapsible(false);
  views_->addWidget(matrices_);
  views_->addWidget(handPanel_);
  for (int i = 0; i < views_->count(); ++i) views_->setStretchFactor(i, 1);
  playbackBar_ = new PlaybackBar(playback_, page);
  auto* work = new QWidget(page);
  auto* column = new QVBoxLayout(work);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  compare_ = new ComparePanel(actions_.compare, actions_.interpolated, actions_.values, work);
  centre_ = new QStackedWidget(work);
  centre_->addWidget(views_);
  centre_->addWidget(compare_);
  column->addWidget(centre_, 1);
  column->addWidget(playbackBar_);
  stack_ = new QStackedWidget(page);
  stack_->addWidget(startPage_);
  stack_->addWidget(work);
  auto* layout = new QVBoxLayout(page);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  layout->addWidget(alarmStrip_);
  layout->addWidget(banner_);
  layout->addWidget(offer_);
  layout->addWidget(opening_);
  layout->addWidget(exporting_);
  layout->addWidget(working_);
  layout->addWidget(stack_, 1);
  setCentralWidget(page);

  status_ = new StatusStrip(this);
  status_->setObjectName("statusStrip");
  statusBar()->setSizeGripEnabled(false);
  statusBar()->setContentsMargins(0, 0, 0, 0);
  statusBar()->addWidget(status_, 1);
}

void MainWindow::buildDocks(const WindowSurroundings& surroundings) {
  inspect_ = new InspectPanel(this);
  timelineHeader_ = new TimelineHeader(
      {actions_.zoomSelection, actions_.addLabel, actions_.crop, actions_.dropSelection}, this);
  signalTree_ = new SignalTree(groups_, this);
  charts_ = new QStackedWidget(this);
  timelinePanel_ = new TimelinePanel(charts_);
  timeline_ = &timelinePanel_->chart();
  liveChart_ = new LiveChart(charts_);
  charts_->addWidget(timelinePanel_);
  charts_->addWidget(liveChart_);
  inspectDock_ = new Dock("Inspect", inspect_, nullptr, this);
  timelineDock_ = new Dock("Timeline", charts_, timelineHeader_, this);
  hand_ = new HandDock(settings_, this);
  handDock_ = new Dock("Hand", hand_, nullptr, this);
  link_ = new LinkPanel(this);
  linkDock_ = new Dock("Link", link_, nullptr, this);
  docks_ = {inspectDock_, timelineDock_, handDock_, linkDock_};
  buildFilter();
  buildSpectrum();
  calibrate_ = new CalibrateView(*this);
  slip_ = new SlipView(*this);
  buildLibrary();
  recognise_ = new RecogniseView(*this, surroundings.dataFolder);
  setCorner(Qt::BottomRightCorner, Qt::BottomDockWidgetArea);
  setCorner(Qt::BottomLeftCorner, Qt::BottomDockWidgetArea);
  setTabPosition(Qt::AllDockWidgetAreas, QTabWidget::North);
  placeDocks(Place::kRecording);
  QList<QAction*> toggles;
  for (Dock* dock : docks_) {
    QAction* toggle = dock->toggleViewAction();
    setSection(*toggle, "View");
    addAction(toggle);
    toggles.append(toggle);
  }
  inspectDock_->toggleViewAction()->setShortcut(QKeySequence("Ctrl+I"));
  timelineDock_->toggleViewAction()->setShortcut(QKeySequence("Ctrl+L"));
  handDock_->toggleViewAction()->setShortcut(QKeySequence("Ctrl+H"));
  linkDock_->toggleViewAction()->setShortcut(QKeySequence("Ctrl+J"));
  menus_ = std::make_unique<WindowMenus>(*this, actions_, toggles);
}

void MainWindow::connectOpening() {
  connect(&opener_, &RecordingOpener::started, opening_, &OpeningStrip::begin);
  connect(&opener_, &RecordingOpener::started, this, &MainWindow::updateStatus);
  connect(&opener_, &RecordingOpener::progressed, opening_, &OpeningStrip::setProgress);
  connect(&opener_, &RecordingOpener::finished, opening_, &OpeningStrip::end);
  connect(&opener_, &RecordingOpener::finished, this, &MainWindow::updateStatus);
  connect(&recordings_, &OpenRecordings::arrived, this, &MainWindow::addRecording);
  recordings_.mayReadAnew = [this](const OpenedRecordingPtr& recording) {
    if (!settleUnsaved({recording})) return false;
    if (hasUnsaved(recording)) discarded_.insert(recording.get());
    return true;
  };
  recordings_.mayReplace = [this](const OpenedRecordingPtr& recording) {
    if (!hasUnsaved(recording) || discarded_.contains(recording.get())) return true;
    flash(fileNameOf(*recording) + " stays as it is: not everything in it is saved");
    return false;
  };
  connect(&opener_, &RecordingOpener::finished, this, [this] {
    if (!opener_.busy()) discarded_.clear();
  });
  connect(&opener_, &RecordingOpener::failed, this, [this](const QString&, const QString& message) {
    banner_->showMessage(message);
  });
  connect(&opener_, &RecordingOpener::cancelled, this, [this](const QString& path) {
    flash("opening " + QFileInfo(path).fileName() + " was cancelled");
  });
  connect(opening_, &OpeningStrip::cancelRequested, &opener_, &RecordingOpener::cancel);
  connect(startPage_, &StartPage::openAsked, this, [this] { askAndOpen(); });
  connect(startPage_, &StartPage::demoAsked, this, &MainWindow::openDemoRecording);
  connect(startPage_, &StartPage::connectAsked, this, &MainWindow::askAndConnect);
  connect(startPage_, &StartPage::emulatedAsked, this, &MainWindow::tryEmulatedHand);
  connect(startPage_, &StartPage::fileChosen, this, [this](const QString& path) {
    openFiles({path.toStdString()});
  });
}

void MainWindow::connectFileActions() {
  connect(actions_.open, &QAction::triggered, this, [this] { askAndOpen(); });
  connect(actions_.openDemo, &QAction::triggered, this, &MainWindow::openDemoRecording);
  connect(actions_.nextRecording, &QAction::triggered, this, [this] { showNeighbour(1); });
  connect(actions_.previousRecording, &QAction::triggered, this, [this] { showNeighbour(-1); });
  connect(actions_.closeRecording, &QAction::triggered, this, &MainWindow::closeCurrent);
  connect(actions_.quit, &QAction::triggered, this, &QWidget::close);
  connect(menus_->recent, &QMenu::aboutToShow, this, &MainWindow::fillRecentMenu);
  connect(menus_->recordings, &QComboBox::activated, this, [this](int index) {
    showRecording(recordings_.all().at(static_cast<std::size_t>(index)));
  });
  fillRecentMenu();
}

}  // namespace palpate::gui
