#include "gui/shell/main_window_recognise.h"

#include <algorithm>
#include <variant>

#include "gui/hand/grasp_panel.h"
#include "gui/hand/hand_dock.h"
#include "gui/look/captions.h"
#include "gui/recognise/answer_view.h"
#include "gui/recognise/ask_page.h"
#include "gui/recognise/check_page.h"
#include "gui/recognise/recognise_panel.h"
#include "gui/recognise/show_window.h"
#include "gui/recognise/teach_page.h"
#include "gui/recognise/today_page.h"
#include "gui/timeline/timeline_chart.h"
#include "gui/timeline/timeline_panel.h"
#include "gui/widgets/dock.h"
#include "gui/widgets/message_banner.h"

namespace palpate::gui {
namespace {

constexpr int kMainWindowRecogniseUsualWidth = 430;  // [px]
constexpr int kHearingMs = 50;
constexpr int kAskAgainRounds = 10;  // by itself: twice a second
constexpr double kSteadyS = 0.8;     // held so long before it is asked by itself
constexpr std::size_t kWaitingItems = 2048;
constexpr double kAirS = 1.0;  // about a grasp that is shown

}  // namespace

MainWindow::RecogniseView::RecogniseView(MainWindow& window,
                                         const std::filesystem::path& dataFolder)
    : QObject(&window), window_(window) {
  panel_ = new RecognisePanel(window.settings_, dataFolder, &window);
  dock_ = new Dock("Recognise", panel_, &panel_->header(), &window);
  dock_->toggleViewAction()->setShortcut(QKeySequence("Ctrl+Shift+I"));
  window.docks_.append(dock_);
}

void MainWindow::RecogniseView::place() {
  window_.addDockWidget(Qt::RightDockWidgetArea, dock_);
  window_.tabifyDockWidget(window_.inspectDock_, dock_);
  dock_->hide();
}

void MainWindow::RecogniseView::connectAll() {
  MainWindow& window = window_;
  connect(panel_, &RecognisePanel::said, &window, &MainWindow::flash);
  connect(panel_, &RecognisePanel::failed, &window, [&window](const QString& message) {
    window.banner_->showMessage(message);
  });
  connect(&panel_->today(), &TodayPage::zeroAsked, this, &RecogniseView::beginZero);
  // After a stop, or anything else that is asked of the hand, nothing of a zero moves it any more.
  connect(window.hand_, &HandDock::stopPressed, this, &RecogniseView::giveUpZero);
  connect(
      window.hand_->findChild<GraspPanel*>(), &GraspPanel::asked, this, &RecogniseView::giveUpZero);
  connect(&panel_->check(), &CheckPage::graspAsked, this, &RecogniseView::showGrasp);
  connect(&window, &MainWindow::recordingShown, this, &RecogniseView::showWanted);
  panel_->teach().zeroNow = [this] { return zero_; };
  connect(&panel_->ask(), &AskPage::asked, this, &RecogniseView::ask);
  connect(&panel_->ask(), &AskPage::showAsked, this, &RecogniseView::showFull);
  connect(window.actions_.whatIsIt, &QAction::triggered, this, [this] {
    if (!dock_->isVisible() && !full_) {
      dock_->show();
      dock_->raise();
      makeRoom();
    }
    panel_->showPage("Ask");
    ask();
  });
  connect(window.actions_.showMode, &QAction::triggered, this, &RecogniseView::showFull);
  connect(dock_->toggleViewAction(), &QAction::triggered, this, [this](bool shown) {
    if (!shown) return;
    dock_->raise();
    makeRoom();
  });
  // However it is shown, its model is looked for.
  connect(dock_, &QDockWidget::visibilityChanged, this, [this](bool seen) {
    if (seen) show();
  });
  connect(&window.live_, &LiveController::came, this, [this] { listen(true); });
  connect(&window.live_, &LiveController::leaving, this, [this] { listen(false); });
  connect(&hearing_, &QTimer::timeout, this, &RecogniseView::hear);
  hearing_.setInterval(kHearingMs);
}

void MainWindow::RecogniseView::makeRoom() {
  QTimer::singleShot(0, this, [this] {
    if (dock_->isFloating() || dock_->width() >= kMainWindowRecogniseUsualWidth) return;
    window_.resizeDocks({dock_}, {kMainWindowRecogniseUsualWidth}, Qt::Horizontal);
  });
}

void MainWindow::RecogniseView::show() {
  panel_->setTheme(resolved(window_.view_.theme));
  if (!dock_->isVisible() && !full_) return;
  const LiveSource* source = window_.live_.source();
  if (full_) full_->setLive(window_.liveShown_ && source);
  panel_->desk().setEmulated(window_.liveShown_ && source && source->emulated);
  panel_->ask().setLive(window_.liveShown_ && source, collector_ && collector_->touched());
  panel_->teach().setLive(source != nullptr);
  if (!source || !source->control)
    panel_->today().setZeroPossible(source ? "A replay can't be moved." : "No hand is connected.",
                                    false);
}

void MainWindow::RecogniseView::ask() {
  show();
  if (window_.liveShown_ && window_.live_.source())
    askOfHand();
  else
    askOfRecording();
}

// The selection; else the grasp under the cursor; else the only one.
void MainWindow::RecogniseView::askOfRecording() {
  RecogniseDesk& desk = panel_->desk();
  const OpenedRecordingPtr& recording = window_.current_;
  if (!recording) return desk.sayTrouble("Open a recording, or connect a hand.");
  if (recording->profile.numFrames() == 0) return desk.sayTrouble("This recording holds no frame.");
  const QString name = QString::fromStdString(recording->path.filename().string());
  const auto question = [&](double fromS, double toS) {
    const auto frames = recording->framesWithin(fromS, toS);
    if (!frames) return desk.sayTrouble("No frame is selected.");
    desk.ask({recording->profile,
              frames,
              name + ", " + figure(fromS, 2) + " – " + figure(toS, 2) + " s"});
  };
  if (const auto& selection = window_.timeline_->selection())
    return question(selection->fromS, selection->toS);
  const auto frame = static_cast<std::size_t>(window_.playback_.frame());
  const std::vector<GraspSegment>& grasps = window_.graspsOf(recording);
  const auto at = std::find_if(grasps.begin(), grasps.end(), [&](const GraspSegment& grasp) {
    return frame >= grasp.begin && frame <= grasp.end;
  });
  const auto* chosen = at != grasps.end() ? &*at : grasps.size() == 1 ? &grasps.front() : nullptr;
  if (!chosen)
    return desk.sayTrouble(grasps.empty()
                               ? "There is no grasp in this recording."
                               : "No grasp is chosen: select one in the timeline (N), or put the "
                                 "cursor into one.");
  question(recording->timeAt(chosen->begin), recording->timeAt(chosen->end));
}

// What is held now; else the last grasp.
void MainWindow::RecogniseView::askOfHand() {
  takeItems();
  RecogniseDesk& desk = panel_->desk();
  if (!collector_) return desk.sayTrouble("No hand is connected.");
  sinceAsked_ = 0;
  if (auto held = collector_->now()) return desk.ask({std::move(*held), std::nullopt, kHeldNow});
  if (collector_->touched())
    return desk.sayTrouble("Held too short yet: ask again in a second.", kHeldNow);
  if (lastGrasp_) return desk.ask({*lastGrasp_, std::nullopt, kLastGrasp});
  desk.sayTrouble("Nothing is held, and nothing was.", kHeldNow);
}

void MainWindow::RecogniseView::listen(bool on) {
  hearing_.stop();
  feed_.reset();
  collector_.reset();
  lastGrasp_.reset();
  zeroRun_.reset();
  zero_.reset();
  panel_->desk().letGo();
  if (!on) panel_->teach().setLive(false);
  LiveSource* source = window_.live_.source();
  if (!on || !source) return;
  FeedOptions options;
  options.tactileItems = options.motionItems = kWaitingItems;
  feed_ = source->session->subscribe("recognition", options);
  collector_ = std::make_unique<GraspCollector>(source->session->device().hand());
  if (source->control) zeroRun_ = std::make_unique<EmptyHandRun>(*source->control);
  hearing_.start();
}

void MainWindow::RecogniseView::takeItems() {
  if (!feed_) return;
  const bool held = collector_->touched();
  items_.clear();
  feed_->take(items_);
  for (CaptureItem& item : items_) {
    if (auto* frame = std::get_if<SharedFrame>(&item))
      collector_->addFrame(std::move(*frame));
    else if (auto* angles = std::get_if<JointAngles>(&item))
      collector_->addAngles(std::move(*angles));
  }
  items_.clear();
  std::vector<Profile> ended = collector_->takeEnded();
  // Also when something else is held by now.
  if (held && (!collector_->touched() || !ended.empty())) panel_->desk().letGo();
  if (!held && collector_->touched()) panel_->desk().touchBegins();
  for (Profile& grasp : ended) takeEnded(std::move(grasp));
}

void MainWindow::RecogniseView::hear() {
  if (!feed_) return;
  takeItems();
  goOnWithZero();
  ++sinceAsked_;
  if (full_) full_->setLive(window_.liveShown_);
  if (!window_.liveShown_ || (!dock_->isVisible() && !full_)) return;
  panel_->ask().setLive(true, collector_->touched());
  if ((panel_->ask().byItself() || full_) && sinceAsked_ >= kAskAgainRounds &&
      collector_->touchedS() >= kSteadyS && !panel_->desk().busy())
    askOfHand();
}

void MainWindow::RecogniseView::showFull() {
  if (full_) {
    full_->close();
    return;
  }
  full_ = new ShowWindow(panel_->desk(),
                         window_.liveShown_ && window_.live_.source(),
                         resolved(window_.view_.theme),
                         &window_);
  connect(full_, &ShowWindow::asked, this, &RecogniseView::ask);
  full_->showFullScreen();
  show();
}

void MainWindow::RecogniseView::takeEnded(Profile grasp) {
  if (!zeroRun_ || !zeroRun_->active()) {
    panel_->teach().take(grasp);
    lastGrasp_ = std::move(grasp);
    return;
  }
  if (const auto trouble = zeroRun_->padsLetGo()) return sayNoZero(*trouble);
  EmptyHandZero zero = emptyHandZero(grasp);
  zero.origin = "the connected hand";
  if (!zero.trouble.empty()) return sayNoZero(zero.trouble);
  zero_ = zero;
  window_.flash("the empty hand reads " + figure(zero.mm, 1) + " ± " + figure(zero.sdMm, 1) +
                " mm");
  panel_->desk().changeDay([&](RecognitionDay& day) { day.setZero(zero); });
}

void MainWindow::RecogniseView::beginZero() {
  LiveSource* source = window_.live_.source();
  if (!source || !zeroRun_) return;
  if (collector_->touched()) return window_.flash("the hand isn't empty: something touches it");
  try {
    zeroRun_->begin(source->session->nowUs());
  } catch (const std::exception& error) {
    window_.flash(error.what());
  }
}

void MainWindow::RecogniseView::giveUpZero() {
  if (!zeroRun_ || !zeroRun_->active()) return;
  zeroRun_->giveUp();
  sayNoZero("given up");
}

void MainWindow::RecogniseView::sayNoZero(const std::string& why) {
  window_.flash("no zero: " + QString::fromStdString(why));
}

void MainWindow::RecogniseView::goOnWithZero() {
  LiveSource* source = window_.live_.source();
  if (!source || !zeroRun_) return;
  panel_->today().setZeroPossible(QString::fromStdString(source->control->status().cannotReact),
                                  zeroRun_->active());
  if (const auto trouble = zeroRun_->step(source->session->nowUs())) sayNoZero(*trouble);
}

void MainWindow::RecogniseView::showGrasp(const std::filesystem::path& file,
                                          std::size_t begin,
                                          std::size_t end) {
  wanted_ = Wanted{file, begin, end};
  const OpenedRecordingPtr open = window_.recordings_.at(file);
  if (!open) return window_.openFiles({file});
  if (open == window_.current_ && !window_.liveShown_) return showWanted();
  window_.showRecording(open);
}

void MainWindow::RecogniseView::showWanted() {
  const OpenedRecordingPtr& recording = window_.current_;
  if (!wanted_ || !recording || recording->path != wanted_->file) return;
  const Wanted wanted = *std::exchange(wanted_, std::nullopt);
  if (wanted.end >= recording->profile.numFrames()) return;  // another one by now
  const TimeSpan span{recording->timeAt(wanted.begin), recording->timeAt(wanted.end)};
  window_.timeline_->showSpan({span.fromS - kAirS, span.toS + kAirS});
  window_.timeline_->setSelection(span);
  window_.playback_.seekSeconds(span.fromS);
}

bool MainWindow::RecogniseView::cancel() {
  if (full_) {
    full_->close();
    return true;
  }
  // The key stops the hand, too.
  giveUpZero();
  return panel_->cancel();
}

void MainWindow::RecogniseView::leave() {
  hearing_.stop();
  feed_.reset();
  zeroRun_.reset();
  delete full_;
  delete dock_;
}

ExportedView MainWindow::RecogniseView::exported() {
  ExportedView view;
  view.name = "Recognise";
  view.widget = panel_;
  view.isThere = [this] {
    return panel_->isVisible() &&
           (panel_->check().shown() || !panel_->desk().answer().name().isEmpty());
  };
  view.fileName = [] { return QString("recognised"); };
  view.tables = [this] { return panel_->check().tables(); };
  view.paint = [this](QPainter& painter, const PictureLook& look) {
    if (panel_->check().shown()) return panel_->check().paint(painter, look);
    const RecognitionAnswer& answer = panel_->desk().answer();
    paintAnswer(painter,
                QRectF(QPointF(0, 0), look.size).adjusted(24, 24, -24, -24),
                answer,
                panel_->desk().photos().photo(answer.name()),
                look.forPrint ? Theme::kLight : resolved(window_.view_.theme),
                look.textUnits > 0 ? look.textUnits : 16);
  };
  return view;
}

}  // namespace palpate::gui
