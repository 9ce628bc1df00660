#include "gui/shell/main_window.h"

#include <QApplication>
#include <QCloseEvent>
#include <QStatusBar>
#include <algorithm>

#include "gui/desktop/application.h"
#include "gui/export/export_feature.h"
#include "gui/shell/centre.h"
#include "gui/shell/features.h"
#include "gui/shell/status_report.h"
#include "gui/widgets/dock.h"
#include "gui/widgets/message_banner.h"
#include "gui/widgets/status_strip.h"

namespace palpate::gui {
namespace {

constexpr QSize kSmallestWindow(900, 600);
constexpr QSize kUsualWindow(1440, 900);
constexpr int kCompactBelow = 1340;  // [px] of width: buttons lose their text

}  // namespace

MainWindow::MainWindow(const WindowSurroundings& surroundings)
    : bench_(std::make_unique<Bench>(surroundings, this)),
      actions_(bench_->actions),
      menus_(std::make_unique<WindowMenus>(*this)),
      docks_(std::make_unique<DockYard>(*this, bench_->settings)),
      centre_(new Centre(bench_->settings, this)),
      banner_(new MessageBanner(centre_)) {
  setWindowTitle("Palpate");
  setMinimumSize(kSmallestWindow);
  setAcceptDrops(true);
  setDockOptions(AnimatedDocks | AllowNestedDocks | AllowTabbedDocks);
  setCentralWidget(centre_);
  bench_->menus = menus_->shared();
  bench_->filtering.restore(surroundings.recipe);
  auto* strip = new StatusStrip(this);
  strip->setObjectName("statusStrip");
  statusBar()->setSizeGripEnabled(false);
  statusBar()->setContentsMargins(0, 0, 0, 0);
  statusBar()->addWidget(strip, 1);
  status_ = std::make_unique<StatusReport>(*bench_, *strip, *menus_);
  connectPlace();
  connectActions();
  connectMessages();
  addFeatures();
  bench_->subject.follow();  // the dock Hand and its Stop know of a hand before the window changes
  resize(kUsualWindow);
  restoreGeometry(bench_->settings.value("window/geometry").toByteArray());
  centre_->begin();
  docks_->begin();
  emit bench_->look.themeChanged();
  emit bench_->look.changed();
  for (const auto& feature : features_) feature->start();
  emit bench_->subject.shown();
}

MainWindow::~MainWindow() {
  // What they show goes while all that it refers to is there.
  bench_->enabling.clear();
  bench_->escape.clear();
  bench_->events.forgetFound();
  while (!features_.empty()) features_.pop_back();
  status_.reset();
  for (Dock* dock : findChildren<Dock*>()) delete dock;
  delete takeCentralWidget();
}

void MainWindow::addFeatures() {
  features_ = allFeatures(*bench_, this);
  std::vector<StripOffer> strips{{StripOffer::Order::kMessage, banner_}};
  for (const auto& feature : features_) {
    for (const DockOffer& dock : feature->docks()) docks_->add(dock);
    for (const CentreOffer& part : feature->centre()) centre_->add(part);
    for (const StripOffer& strip : feature->strips()) strips.push_back(strip);
    connect(feature.get(), &Feature::dockAsked, docks_.get(), [this](const Dock* dock) {
      docks_->show(dock->objectName());
    });
  }
  centre_->add(std::move(strips));
  menus_->fill(bench_->actions, docks_->toggles());
  bench_->menus = menus_->shared();
  std::vector<ExportedView> views;
  for (const auto& feature : features_)
    for (ExportedView& view : feature->views()) views.push_back(std::move(view));
  std::stable_sort(views.begin(), views.end(), [](const ExportedView& a, const ExportedView& b) {
    return a.rank < b.rank;
  });
  for (ExportedView& view : views) feature<ExportFeature>().takeAway().add(std::move(view));
}

// Before the features hear of another source: their docks stand where they belong by then.
void MainWindow::connectPlace() {
  Subject& subject = bench_->subject;
  connect(&subject, &Subject::changed, this, [this, &subject] {
    if (!subject.isRecording()) bench_->comparing.set(false);
    centre_->setPlace(subject.kind());  // first: the docks get what it leaves
    docks_->setPlace(subject.kind());
    menus_->setPlaybackShown(!subject.isLive());
  });
  connect(&subject, &Subject::shown, this, &MainWindow::showTitle);
  connect(&bench_->events, &EventDesk::changed, this, &MainWindow::showTitle);
  connect(&bench_->comparing, &Comparing::changed, this, [this](bool on) {
    on ? docks_->hideAll() : docks_->bringBack();
    centre_->setComparing(on);
  });
}

void MainWindow::connectActions() {
  ShellActions& actions = actions_;
  ViewLook& look = bench_->look;
  connect(actions.quit, &QAction::triggered, this, &QWidget::close);
  connect(actions.resetLayout, &QAction::triggered, docks_.get(), &DockYard::reset);
  connect(actions.fullScreen, &QAction::triggered, this, &MainWindow::setFullScreen);
  connect(actions.nextTheme, &QAction::triggered, this, [&look] {
    look.setTheme(look.theme() == Theme::kDark ? ThemeChoice::kLight : ThemeChoice::kDark);
  });
  connect(actions.themes, &QActionGroup::triggered, this, [&look](const QAction* action) {
    look.setTheme(kAllThemeChoices.at(action->data().toUInt()));
  });
  connect(&look, &ViewLook::themeChanged, this, &MainWindow::showTheme);
  connect(&look, &ViewLook::changed, this, [&actions, &look] {
    checkChoice(actions.themes, kAllThemeChoices, look.view().theme);
  });
  Escape& escape = bench_->escape;
  connect(actions.dismiss, &QAction::triggered, this, [&escape] { escape.press(); });
  escape.add(Escape::Order::kAlarm, [this] {
    if (QWidget* field = focusWidget()) field->clearFocus();
    return false;
  });
  escape.add(Escape::Order::kFullScreen, [this] {
    if (!isFullScreen()) return false;
    setFullScreen(false);
    return true;
  });
}

void MainWindow::connectMessages() {
  Messages& messages = bench_->messages;
  connect(&messages, &Messages::failed, banner_, &MessageBanner::showAbout);
  connect(&messages, &Messages::withdrawn, banner_, &MessageBanner::withdraw);
  connect(&messages, &Messages::failuresDismissed, banner_, &MessageBanner::dismiss);
  if (const auto* application = qobject_cast<GuardedApplication*>(QCoreApplication::instance()))
    connect(application, &GuardedApplication::failed, &messages, &Messages::fail);
  bench_->escape.add(Escape::Order::kMessage, [this] {
    if (banner_->isHidden()) return false;
    banner_->dismiss();
    return true;
  });
}

void MainWindow::showTitle() {
  const Subject& subject = bench_->subject;
  if (const LiveSource* source = subject.source())
    return setWindowTitle(describe(source->connection) + " – Palpate");
  if (subject.isLive()) return;  // about to go
  const OpenedRecordingPtr recording = subject.recorded();
  if (!recording) return setWindowTitle("Palpate");
  const QString star = bench_->events.hasUnsaved(recording) ? "*" : "";
  setWindowTitle(fileNameOf(*recording) + star + " – Palpate");
}

void MainWindow::showTheme() {
  const Theme theme = bench_->look.theme();
  applyTheme(*qApp, theme);
  bench_->actions.setTheme(theme);
  banner_->setTheme(theme);
  docks_->setTheme(theme);
}

void MainWindow::setFullScreen(bool on) {
  setWindowState(on ? windowState() | Qt::WindowFullScreen : windowState() & ~Qt::WindowFullScreen);
  actions_.fullScreen->setChecked(on);
}

void MainWindow::remember() {
  bench_->comparing.set(false);  // its layout is not to be remembered
  for (const auto& feature : features_) feature->remember();
  centre_->remember();
  docks_->remember();
  bench_->settings.setValue("window/geometry", saveGeometry());
  bench_->settings.sync();
}

// What is connected is ended first, beside the window: a hand that moves is stopped, a recording
// finished. Then it closes.
void MainWindow::closeEvent(QCloseEvent* event) {
  LiveController& live = bench_->live;
  if (closing_) {
    if (live.state() != LiveController::State::kNone) return event->ignore();
  } else if ((live.recording() && !bench_->questions.endRecording()) ||
             !bench_->events.settle(bench_->recordings.all())) {
    return event->ignore();  // all is asked before anything is given up
  }
  if (!closing_) remember();
  bench_->events.discardAll();
  bench_->opener.cancel();
  if (live.state() == LiveController::State::kNone) return event->accept();
  event->ignore();
  // Nothing else is shown any more.
  disconnect(&live, &LiveController::ended, &bench_->subject, nullptr);
  closing_ = connect(&live, &LiveController::ended, this, &QWidget::close);
  bench_->messages.announce("Closing: the hand is let go, a recording is finished …");
  live.end();
}

void MainWindow::endNow() {
  bench_->questions.endRecording = [] { return true; };
  bench_->questions.unsaved = [](const QString&) { return Questions::Unsaved::kSave; };
  if (QWidget* dialog = QApplication::activeModalWidget()) dialog->close();
  close();
}

void MainWindow::settle() {
  for (const auto& feature : features_) feature->settle();
}

void MainWindow::showEvent(QShowEvent* event) {
  QMainWindow::showEvent(event);
  bench_->enabling.refresh();
}

void MainWindow::resizeEvent(QResizeEvent* event) {
  QMainWindow::resizeEvent(event);
  menus_->setCompact(event->size().width() < kCompactBelow);
}

}  // namespace palpate::gui
