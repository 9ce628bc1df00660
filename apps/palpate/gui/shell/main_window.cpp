#include "gui/shell/main_window.h"

#include <QApplication>
#include <QCloseEvent>
#include <QComboBox>
#include <QStatusBar>
#include <QTimer>
#include <algorithm>

#include "gui/appearance/condition_color.h"
#include "gui/appearance/settings_file.h"
#include "gui/desktop/application.h"
#include "gui/desktop/greyed_keys.h"
#include "gui/desktop/key_policy.h"
#include "gui/export/export_feature.h"
#include "gui/matrices/matrices_feature.h"
#include "gui/matrices/matrices_panel.h"
#include "gui/open/start_page.h"
#include "gui/recognise/recognise_feature.h"
#include "gui/settings/settings_feature.h"
#include "gui/shell/central_widget.h"
#include "gui/shell/features.h"
#include "gui/shell/screen_room.h"
#include "gui/shell/show_scene.h"
#include "gui/shell/start_scene.h"
#include "gui/shell/status_report.h"
#include "gui/source/file_reading.h"
#include "gui/widgets/dock.h"
#include "gui/widgets/message_banner.h"
#include "gui/widgets/status_strip.h"

namespace palpate::gui {

ShellActions::ShellActions(ActionRegistry& book) {
  quit = book.make("quit", "File", "&Quit", {key("Ctrl+Q")});
  nextTheme =
      book.make("nextTheme", "View", "Switch between dark and light theme", {key("Ctrl+T")});
  hideInMenus(*nextTheme);  // Theme has both
  fullScreen = book.make("fullScreen", "View", "F&ull screen", {key("F11")}, true);
  dismiss = book.make(
      "dismiss",
      "Help",
      "Stop the hand; close the message, clear the selection, stop opening, leave full screen",
      {key("Esc")});
  hideInMenus(*dismiss);
  themes = book.choices("themes", {"as the desktop", "dark", "light"});
}

namespace {

constexpr QSize kUsualWindow(1440, 900);

QSize firstSize() {
  const QSize room = roomOnScreen(nullptr);
  return room.isValid() ? kUsualWindow.boundedTo(room) : kUsualWindow;
}

}  // namespace

MainWindow::MainWindow(const WindowEnvironment& environment)
    : windowState_(std::make_unique<WindowState>(environment, this)),
      actions_(windowState_->actions),
      menus_(std::make_unique<WindowMenus>(*this)),
      centre_(new CentralWidget(windowState_->settings, this)),
      docks_(std::make_unique<DockArrangement>(*this, *centre_, windowState_->settings)),
      layoutMenu_(std::make_unique<LayoutMenu>(*windowState_, *docks_, *menus_->shared().layout)),
      banner_(new MessageBanner(centre_)) {
  setWindowTitle("Palpate");
  setAcceptDrops(true);
  setDockOptions(AnimatedDocks | AllowNestedDocks | AllowTabbedDocks);
  setCentralWidget(centre_);
  windowState_->menus = menus_->shared();
  windowState_->activeFilters.restore(environment.recipe);
  auto* strip = new StatusStrip(this);
  strip->setObjectName("statusStrip");
  strip->setAccessibleName("Status");
  statusBar()->setSizeGripEnabled(false);
  statusBar()->setContentsMargins(0, 0, 0, 0);
  statusBar()->addWidget(strip, 1);
  status_ = std::make_unique<StatusReport>(*windowState_, *strip, *menus_);
  connectPlace();
  connectActions();
  connectMessages();
  connect(
      &windowState_->handCommands, &HandCommands::conditionChanged, this, &MainWindow::showBorder);
  addFeatures();
  const auto* greyed = new GreyedKeys(windowState_->actions.all(), &whyGreyed, this, this);
  connect(greyed, &GreyedKeys::refused, &windowState_->messages, &Messages::flash);
  connect(greyed, &GreyedKeys::refused, &windowState_->handCommands, &HandCommands::refuseKey);
  resize(firstSize());
  restorePlace(*this, windowState_->settings, "window/geometry");
  centre_->begin();
  docks_->begin();
  emit windowState_->appearance.themeChanged();
  emit windowState_->appearance.changed();
  for (const auto& feature : features_) feature->start();
  emit windowState_->displayed.shown();
  if (const QString& problem = windowState_->settingsPlace.problem; !problem.isEmpty())
    windowState_->messages.fail(problem);
}

MainWindow::~MainWindow() {
  // Features are destroyed while everything that they refer to still exists.
  windowState_->actionEnabler.clear();
  windowState_->escapeHandler.clear();
  windowState_->events.forgetFound();
  while (!features_.empty()) features_.pop_back();
  status_.reset();
  for (Dock* dock : findChildren<Dock*>()) delete dock;
  delete takeCentralWidget();
}

void MainWindow::addFeatures() {
  features_ = allFeatures(*windowState_, this);
  std::vector<BannerSpec> strips{{BannerSpec::Order::kMessage, banner_}};
  for (const auto& feature : features_) {
    // What it reads is below the window then, where settle() looks for it.
    feature->setParent(this);
    for (const DockSpec& dock : feature->docks()) docks_->add(dock);
    for (const CentralViewSpec& part : feature->centre()) centre_->add(part);
    for (const BannerSpec& strip : feature->strips()) strips.push_back(strip);
    connect(feature.get(), &Feature::dockRequested, docks_.get(), [this](const Dock* dock) {
      docks_->show(dock->objectName());
    });
  }
  centre_->add(std::move(strips));
  feature<RecogniseFeature>().makeScene = [this](QWidget* parent) {
    return new ShowScene(*windowState_, feature<MatricesFeature>().panel(), parent);
  };
  if (windowState_->environment.playsOnStart) {
    auto* page = findChild<StartPage*>();
    auto* scene = new StartScene(windowState_->demoRecording(), page);
    page->setScene(scene);
    connect(
        scene, &StartScene::clicked, windowState_->actions.at("tryEmulated"), &QAction::trigger);
  }
  layoutMenu_->begin();
  menus_->fill(windowState_->actions, docks_->toggles());
  ActionEnabler& enabler = windowState_->actionEnabler;
  const LiveController& live = windowState_->live;
  enabler.show(menus_->ofHand(), [&live] { return live.state() != LiveController::State::kNone; });
  const auto& recordings = windowState_->recordings;
  enabler.show(menus_->ofRecordings(), [&recordings] { return !recordings.all().empty(); });
  windowState_->menus = menus_->shared();
  std::vector<ExportedView> views;
  for (const auto& feature : features_)
    for (ExportedView& view : feature->views()) views.push_back(std::move(view));
  std::stable_sort(views.begin(), views.end(), [](const ExportedView& a, const ExportedView& b) {
    return a.rank < b.rank;
  });
  ExportController& exports = feature<ExportFeature>().exportController();
  for (ExportedView& view : views) exports.add(std::move(view));
  exports.addTogether();
}

// Connected before the features, so that their docks are placed before they take another source.
void MainWindow::connectPlace() {
  DisplayedSource& displayed = windowState_->displayed;
  connect(&displayed, &DisplayedSource::changed, this, [this, &displayed] {
    if (!displayed.isRecording()) windowState_->comparison.set(false);
    // The centre comes first: the docks get the remaining room.
    centre_->setPlace(displayed.kind());
    docks_->setPlace(displayed.kind());
    menus_->setPlaybackShown(displayed.isRecording());
  });
  connect(&displayed, &DisplayedSource::shown, this, &MainWindow::showTitle);
  connect(&windowState_->events, &EventController::changed, this, &MainWindow::showTitle);
  connect(&windowState_->comparison, &ComparisonMode::changed, this, [this](bool on) {
    // The comparison is shown only while the docks are hidden: it needs more width than the views
    // that it replaces, and would take it from them.
    if (on) docks_->hideAll();
    centre_->setComparing(on);
    if (!on) docks_->bringBack();
  });
}

void MainWindow::connectActions() {
  ShellActions& actions = actions_;
  ViewAppearance& look = windowState_->appearance;
  connect(actions.quit, &QAction::triggered, this, &QWidget::close);
  connect(actions.fullScreen, &QAction::triggered, this, &MainWindow::setFullScreen);
  connect(actions.nextTheme, &QAction::triggered, this, [&look] {
    look.setTheme(look.theme() == Theme::kDark ? ThemeChoice::kLight : ThemeChoice::kDark);
  });
  connect(actions.themes, &QActionGroup::triggered, this, [&look](const QAction* action) {
    look.setTheme(kAllThemeChoices.at(action->data().toUInt()));
  });
  connect(&look, &ViewAppearance::themeChanged, this, &MainWindow::showTheme);
  connect(&look, &ViewAppearance::changed, this, [&actions, &look] {
    checkChoice(actions.themes, kAllThemeChoices, look.view().theme);
  });
  EscapeHandler& escapeHandler = windowState_->escapeHandler;
  connect(actions.dismiss, &QAction::triggered, this, [&escapeHandler] {
    // The list of a box that is open is closed, and nothing else.
    QWidget* popup = QApplication::activePopupWidget();
    if (!popup && KeyPolicy::ofApplication().escapeInPopup()) return;
    if (!popup) return escapeHandler.press();
    if (auto* box = qobject_cast<QComboBox*>(popup->parentWidget()))
      box->hidePopup();
    else
      popup->close();
  });
  escapeHandler.add(EscapeHandler::Order::kAlarm, [this] {
    if (QWidget* field = focusWidget()) field->clearFocus();
    return false;
  });
  escapeHandler.add(EscapeHandler::Order::kFullScreen, [this] {
    if (!isFullScreen()) return false;
    setFullScreen(false);
    return true;
  });
}

void MainWindow::connectMessages() {
  Messages& messages = windowState_->messages;
  connect(&messages, &Messages::failed, banner_, &MessageBanner::showAbout);
  connect(&messages, &Messages::withdrawn, banner_, &MessageBanner::withdraw);
  connect(&messages, &Messages::failuresDismissed, banner_, &MessageBanner::dismiss);
  if (const auto* application = qobject_cast<GuardedApplication*>(QCoreApplication::instance()))
    connect(application, &GuardedApplication::failed, &messages, &Messages::fail);
  windowState_->escapeHandler.add(EscapeHandler::Order::kMessage, [this] {
    if (banner_->isHidden()) return false;
    banner_->dismiss();
    return true;
  });
}

void MainWindow::showTitle() {
  const DisplayedSource& displayed = windowState_->displayed;
  if (const LiveSource* source = displayed.source())
    return setWindowTitle(describe(source->connection) + " – Palpate");
  // The live source is about to be closed: the title stays until then.
  if (displayed.isLive()) return;
  const OpenedRecordingPtr recording = displayed.recorded();
  if (!recording) return setWindowTitle("Palpate");
  const QString star = windowState_->events.hasUnsaved(recording) ? "*" : "";
  setWindowTitle(fileNameOf(*recording) + star + " – Palpate");
}

void MainWindow::showTheme() {
  applyTheme(*qApp, windowState_->appearance.theme());
  showBorder();
}

void MainWindow::showBorder() {
  const auto& condition = windowState_->handCommands.condition();
  centre_->setBorder(condition ? conditionColor(condition->condition) : QColor());
}

void MainWindow::setFullScreen(bool on) {
  setWindowState(on ? windowState() | Qt::WindowFullScreen : windowState() & ~Qt::WindowFullScreen);
  actions_.fullScreen->setChecked(on);
}

void MainWindow::remember() {
  // The layout of the comparison isn't stored.
  windowState_->comparison.set(false);
  for (const auto& feature : features_) feature->remember();
  centre_->remember();
  docks_->remember();
  storePlace(*this, windowState_->settings, "window/geometry");
  forgetChosen(windowState_->settings);
  windowState_->settings.sync();
}

// Ends the connection first, in the background: a moving hand is stopped, a recording finished.
// Then the window closes.
void MainWindow::closeEvent(QCloseEvent* event) {
  LiveController& live = windowState_->live;
  if (closing_) {
    if (live.state() != LiveController::State::kNone) return event->ignore();
  } else if ((!unasked_ &&
              ((live.recording() &&
                !windowState_->prompts.endRecording(UserPrompts::Ending::kQuit)) ||
               (windowState_->batchRunning() &&
                !windowState_->ask.confirmed("A batch is running. Finished files stay; the rest "
                                             "are not made. End the batch?",
                                             "&Yes")))) ||
             !windowState_->events.settle(windowState_->recordings.all(), !unasked_)) {
    // All questions come before anything is discarded.
    return event->ignore();
  }
  if (!closing_) remember();
  windowState_->events.discardAll();
  windowState_->opener.cancel();
  if (live.state() == LiveController::State::kNone) return event->accept();
  event->ignore();
  // When the connection ends, no other source is shown.
  disconnect(&live, &LiveController::ended, &windowState_->displayed, nullptr);
  closing_ = connect(&live, &LiveController::ended, this, &QWidget::close);
  windowState_->messages.announce("Closing: the hand is disconnected, a recording is finished …");
  live.end();
}

void MainWindow::endNow() {
  // Whatever keeps the window open, the hand doesn't go on moving.
  windowState_->live.stopMotion();
  if (QWidget* dialog = QApplication::activeModalWidget()) dialog->close();
  // The question of a window that is being closed has to be answered first: it asks no other way.
  QTimer::singleShot(0, this, &MainWindow::closeUnasked);
}

void MainWindow::closeUnasked() {
  unasked_ = true;
  // What can't be saved keeps the window open: it asks again when the user closes it.
  unasked_ = close() || closing_;
}

void MainWindow::settle() {
  FileReading::settleAll(*this);
  for (const auto& feature : features_) feature->settle();
}

void MainWindow::showEvent(QShowEvent* event) {
  QMainWindow::showEvent(event);
  windowState_->actionEnabler.refresh();
}

}  // namespace palpate::gui
