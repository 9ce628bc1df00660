#include "gui/recognise/recognise_feature.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "gui/appearance/captions.h"
#include "gui/recognise/answer_view.h"
#include "gui/recognise/ask_page.h"
#include "gui/recognise/check_page.h"
#include "gui/recognise/grasps_page.h"
#include "gui/recognise/presentation_window.h"
#include "gui/recognise/recognise_panel.h"
#include "gui/recognise/today_page.h"
#include "gui/recognise/training_page.h"
#include "gui/widgets/content_scroll.h"
#include "gui/widgets/dock.h"

namespace palpate::gui {

RecogniseActions::RecogniseActions(ActionRegistry& book) {
  whatIsIt = book.make("whatIsIt", "Analysis", "&What is it?", {key("Q")});
  whatIsIt->setToolTip("Recognise the selected grasp, or what is held (Q)");
  presentationMode = book.make("showMode", "View", "&Show the answer full screen", {key("Ctrl+5")});
}

namespace {

constexpr int kRecogniseUsualWidth = 485;  // [px] with the buttons of all pages
constexpr int kHearingMs = 50;
constexpr int kAskAgainRounds = 10;  // timer calls: asks twice a second
constexpr double kSteadyS = 0.8;     // holding time before the first automatic question
constexpr std::size_t kWaitingItems = 2048;
constexpr double kAirS = 1.0;  // [s] margin around a shown grasp

}  // namespace

RecogniseFeature::RecogniseFeature(WindowState& windowState, QWidget* window)
    : Feature(windowState, window),
      actions_(windowState.actions),
      panel_(new RecognisePanel(
          windowState.settings, windowState.environment.dataFolder, windowState.ask, window)) {
  dock_ =
      new Dock("Recognise", new ContentScroll(panel_, kMinDockContent), &panel_->header(), window);
  connectAll();
}

RecogniseFeature::~RecogniseFeature() {
  state().handCommands.otherTask = {};
  liveTimer_.stop();
  queue_.reset();
  zeroRun_.reset();
  delete full_;
}

void RecogniseFeature::connectAll() {
  WindowState& windowState = state();
  connect(panel_, &RecognisePanel::said, &windowState.messages, &Messages::flash);
  connect(panel_, &RecognisePanel::failed, &windowState.messages, &Messages::fail);
  connect(&panel_->today(), &TodayPage::zeroRequested, this, &RecogniseFeature::beginZero);
  windowState.handCommands.otherTask = [this] {
    if (!zeroRun_ || !zeroRun_->active()) return HandTask();
    return HandTask{"measuring zero",
                    "The zero of the empty hand is measured: it closes until its pads touch, and "
                    "opens again"};
  };
  // After a stop or any other command to the hand, the zero measurement no longer moves it.
  connect(&windowState.handCommands, &HandCommands::asked, this, &RecogniseFeature::cancelZero);
  connect(&panel_->check(), &CheckPage::graspAsked, this, &RecogniseFeature::showGrasp);
  connect(&panel_->grasps(), &GraspsPage::graspAsked, this, &RecogniseFeature::showGrasp);
  panel_->teach().zeroNow = [this] { return zero_; };
  connect(&panel_->ask(), &AskPage::asked, this, &RecogniseFeature::ask);
  connect(&panel_->ask(), &AskPage::showRequested, this, &RecogniseFeature::showFull);
  on(actions_.whatIsIt, [this] {
    if (!dock_->isVisible() && !full_) emit dockRequested(dock_);
    panel_->showPage("Ask");
    ask();
  });
  windowState.actionEnabler.add({actions_.whatIsIt},
                                [&windowState] { return windowState.displayed.hand() != nullptr; });
  on(actions_.presentationMode, [this] { showFull(); });
  connect(&panel_->controller(), &RecognitionController::modelChanged, this, [this] {
    if (full_ && !panel_->controller().whyNoModel().isEmpty()) showWhyNoModel();
  });
  // Whatever makes the dock visible, the model is loaded.
  connect(dock_, &QDockWidget::visibilityChanged, this, [this](bool seen) {
    if (seen) renew();
  });
  connect(&windowState.displayed, &DisplayedSource::shown, this, [this, &windowState] {
    const DisplayedSource& displayed = windowState.displayed;
    const void* now = displayed.source();
    if (!now) now = displayed.recorded().get();
    if (std::exchange(answeredOf_, now) != now) panel_->controller().forgetAnswer();
    renew();
    showWanted();
  });
  connect(&windowState.live, &LiveController::sourceOpened, this, [this] { listen(true); });
  connect(&windowState.live, &LiveController::leaving, this, [this] {
    answeredOf_ = nullptr;  // the next source may have its address
    listen(false);
  });
  connect(&liveTimer_, &QTimer::timeout, this, &RecogniseFeature::readLiveGrasps);
  liveTimer_.setInterval(kHearingMs);
  connect(&windowState.currentFrame,
          &CurrentFrame::staleNoticeChanged,
          this,
          &RecogniseFeature::followSilence);
  windowState.escapeHandler.add(EscapeHandler::Order::kShow, [this] { return cancel(); });
}

void RecogniseFeature::renew() {
  if (!dock_->isVisible() && !full_) return;
  const LiveSource* source = state().live.source();
  const LiveSource* shown = state().displayed.source();
  if (full_) full_->setLive(shown != nullptr);
  if (full_) full_->setSilence(silence());
  panel_->controller().setEmulated(isOfEmulatedHand());
  panel_->ask().setLive(shown != nullptr, silence());
  panel_->teach().setLive(source != nullptr);
  if (!source || !source->control)
    panel_->today().setZeroPossible(!source                  ? "No hand is connected."
                                    : source->streamDevice() ? "This hand is read, not moved."
                                                             : "A replay can't be moved.",
                                    false);
}

bool RecogniseFeature::isOfEmulatedHand() const {
  if (const LiveSource* shown = state().displayed.source()) return shown->isEmulated;
  // What was named of a connected hand today belongs to its model.
  if (const LiveSource* connected = state().live.source(); connected && !connected->isEmulated)
    return false;
  const OpenedRecordingPtr recording = state().displayed.recorded();
  return recording && recording->meta.contains("emulated");
}

void RecogniseFeature::ask() {
  renew();
  if (state().displayed.source())
    askOfHand();
  else
    askOfRecording();
}

// Asks about the selection; else about the grasp at the cursor; else about the only grasp.
void RecogniseFeature::askOfRecording() {
  RecognitionController& controller = panel_->controller();
  const OpenedRecordingPtr recording = state().displayed.recorded();
  if (!recording) return controller.showProblem("Open a recording, or connect a hand.");
  if (const QString why = controller.whyNoModel(); !why.isEmpty())
    return controller.showProblem(why);
  if (recording->profile.numFrames() == 0)
    return controller.showProblem("This recording has no frames.");
  const QString name = QString::fromStdString(recording->path.filename().string());
  const auto question = [&](double fromS, double toS) {
    const auto frames = recording->framesWithin(fromS, toS);
    if (!frames) return controller.showProblem("No frame is selected.");
    controller.ask({recording->profile,
                    frames,
                    name + ", " + figure(fromS, 2) + " – " + figure(toS, 2) + " s"});
  };
  if (const auto& span = state().selection.span()) return question(span->fromS, span->toS);
  const auto frame = static_cast<std::size_t>(state().playback.frame());
  const std::vector<GraspSegment>& grasps = state().events.graspsOf(recording);
  const auto at = std::find_if(grasps.begin(), grasps.end(), [&](const GraspSegment& grasp) {
    return frame >= grasp.begin && frame <= grasp.end;
  });
  const auto* chosen = at != grasps.end() ? &*at : grasps.size() == 1 ? &grasps.front() : nullptr;
  if (!chosen)
    return controller.showProblem(
        grasps.empty() ? "There is no grasp in this recording."
                       : "No grasp is chosen: select one in the timeline (N), or put the "
                         "cursor into one.");
  question(recording->timeAt(chosen->begin), recording->timeAt(chosen->end));
}

// Asks about the held object; else about the last grasp.
void RecogniseFeature::askOfHand() {
  takeItems();
  RecognitionController& controller = panel_->controller();
  if (!collector_) return controller.showProblem("No hand is connected.");
  sinceAsked_ = 0;
  if (!silence().isEmpty())
    return controller.showProblem("No frames arrive: what is held isn't known.", kHeldNow);
  if (auto held = collector_->now())
    return controller.ask({std::move(*held), std::nullopt, kHeldNow});
  if (collector_->touched())
    return controller.showProblem("The object was not held long enough: try again in a second.",
                                  kHeldNow);
  if (lastGrasp_) return controller.ask({*lastGrasp_, std::nullopt, kLastGrasp});
  controller.showProblem("Nothing is held, and there is no last grasp.", kHeldNow);
}

QString RecogniseFeature::silence() const {
  const LiveSource* shown = state().displayed.source();
  if (!shown || shown->finished() || !state().live.stale()) return {};
  const StaleNotice& old = state().currentFrame.old();
  if (!old.held) return old.notice;
  // The picture is held, and below it nothing arrives.
  return QString(old.notice).remove(kHeldText).mid(2);
}

// What was held is not known to be held any more. When frames arrive again, nothing is named until
// it is asked or felt again.
void RecogniseFeature::followSilence() {
  const QString why = silence();
  const bool silent = !why.isEmpty();
  if (full_) full_->setSilence(why);
  if (silent != std::exchange(silent_, silent)) panel_->controller().contactEnded();
  panel_->ask().setLive(state().displayed.isLive(), why);
}

void RecogniseFeature::listen(bool on) {
  liveTimer_.stop();
  queue_.reset();
  collector_.reset();
  lastGrasp_.reset();
  zeroRun_.reset();
  zero_.reset();
  panel_->today().setMeasuredZero(std::nullopt);
  panel_->controller().contactEnded();
  if (!on) panel_->teach().setLive(false);
  LiveSource* source = state().live.source();
  if (!on || !source) return;
  CaptureQueueOptions options;
  options.tactileItems = options.motionItems = kWaitingItems;
  queue_ = source->session->subscribe("recognition", options);
  collector_ = std::make_unique<GraspCollector>(source->session->device().hand());
  if (source->control) zeroRun_ = std::make_unique<EmptyHandCycle>(*source->control);
  liveTimer_.start();
}

void RecogniseFeature::takeItems() {
  if (!queue_) return;
  const bool held = collector_->touched();
  items_.clear();
  queue_->take(items_);
  for (CaptureItem& item : items_) {
    if (auto* frame = std::get_if<SharedFrame>(&item))
      collector_->addFrame(std::move(*frame));
    else if (const Sample* angles = sampleOf(item, kAngleSeries))
      collector_->addAngles(*angles);
  }
  items_.clear();
  std::vector<Profile> ended = collector_->takeEnded();
  // Also when the next object is already held.
  if (held && (!collector_->touched() || !ended.empty())) panel_->controller().contactEnded();
  if (!held && collector_->touched()) panel_->controller().touchBegins();
  for (Profile& grasp : ended) takeEnded(std::move(grasp));
}

void RecogniseFeature::readLiveGrasps() {
  if (!queue_) return;
  takeItems();
  goOnWithZero();
  ++sinceAsked_;
  if (full_) full_->setLive(state().displayed.isLive());
  if (!state().displayed.isLive() || (!dock_->isVisible() && !full_)) return;
  if (silent_) return;
  if ((panel_->ask().byItself() || full_) && sinceAsked_ >= kAskAgainRounds &&
      collector_->touchedS() >= kSteadyS && !panel_->controller().busy())
    askOfHand();
}

void RecogniseFeature::showFull() {
  if (full_) {
    full_->close();
    return;
  }
  // The model is opened when it is first needed.
  panel_->controller().setEmulated(isOfEmulatedHand());
  if (!panel_->controller().whyNoModel().isEmpty()) return showWhyNoModel();
  full_ = new PresentationWindow(
      panel_->controller(), state().handCommands, state().displayed.source() != nullptr, window());
  if (makeScene) full_->setScene(makeScene(full_));
  connect(full_, &PresentationWindow::asked, this, &RecogniseFeature::ask);
  full_->showFullScreen();
  renew();
}

// The whole screen would only hide the dock in which a model is chosen.
void RecogniseFeature::showWhyNoModel() {
  if (full_) full_->close();
  if (!dock_->isVisible()) emit dockRequested(dock_);
  panel_->showPage("Ask");
  state().messages.flash(panel_->controller().whyNoModel());
}

void RecogniseFeature::takeEnded(Profile grasp) {
  if (!zeroRun_ || !zeroRun_->active()) {
    panel_->teach().take(grasp);
    lastGrasp_ = std::move(grasp);
    return;
  }
  if (const auto problem = zeroRun_->onPadsReleased()) return sayNoZero(*problem);
  EmptyHandZero zero = emptyHandZero(grasp);
  zero.origin = "the connected hand";
  if (!zero.problem.empty()) return sayNoZero(zero.problem);
  zero_ = zero;
  panel_->today().setMeasuredZero(zero);
  state().messages.flash("the empty hand reads " + figure(zero.mm, 1) + " ± " +
                         figure(zero.sdMm, 1) + " mm");
  RecognitionController& controller = panel_->controller();
  // The page says that a model without a zero of its own can't use one.
  if (const RecognitionSession* session = controller.session();
      session && session->model().trainingZero)
    controller.changeSession([&](RecognitionSession& changed) { changed.setZero(zero); });
}

void RecogniseFeature::beginZero() {
  LiveSource* source = state().live.source();
  if (!source || !zeroRun_) return;
  if (collector_->touched())
    return state().messages.flash("the hand isn't empty: something touches it");
  try {
    zeroRun_->begin(source->session->nowUs());
  } catch (const std::exception& error) {
    state().messages.flash(error.what());
  }
}

void RecogniseFeature::cancelZero() {
  if (!zeroRun_ || !zeroRun_->active()) return;
  zeroRun_->cancel();
  sayNoZero("cancelled");
}

void RecogniseFeature::sayNoZero(const std::string& why) {
  state().messages.flash("no zero: " + QString::fromStdString(why));
}

void RecogniseFeature::goOnWithZero() {
  LiveSource* source = state().live.source();
  if (!source || !zeroRun_) return;
  panel_->today().setZeroPossible(QString::fromStdString(source->control->status().cannotReact),
                                  zeroRun_->active());
  if (const auto problem = zeroRun_->takeProblem()) sayNoZero(*problem);
}

void RecogniseFeature::showGrasp(const std::filesystem::path& file,
                                 std::size_t begin,
                                 std::size_t end) {
  wanted_ = Wanted{file, begin, end};
  const OpenedRecordingPtr open = state().recordings.at(file);
  if (!open) return state().open({file});
  if (open == state().displayed.recorded()) return showWanted();
  state().displayed.show(open);
}

void RecogniseFeature::showWanted() {
  const OpenedRecordingPtr recording = state().displayed.recorded();
  // It may be open by another path.
  if (!wanted_ || !recording || state().recordings.at(wanted_->file) != recording) return;
  const Wanted wanted = *std::exchange(wanted_, std::nullopt);
  // The file has changed meanwhile.
  if (wanted.end >= recording->profile.numFrames()) return;
  const TimeSpan span{recording->timeAt(wanted.begin), recording->timeAt(wanted.end)};
  state().selection.showWithMargin({span.fromS - kAirS, span.toS + kAirS});
  state().selection.setSpan(span);
  state().playback.seekSeconds(span.fromS);
}

bool RecogniseFeature::cancel() {
  if (full_) {
    full_->close();
    return true;
  }
  // Escape also stops the hand.
  cancelZero();
  return panel_->cancel();
}

void RecogniseFeature::settle() { panel_->settle(); }

std::vector<DockSpec> RecogniseFeature::docks() {
  return {{.dock = dock_,
           .key = QKeySequence("Ctrl+Shift+I"),
           .menu = "Analysis",
           .tab = 5,
           .preferredWidthPx = kRecogniseUsualWidth}};
}

std::vector<ExportedView> RecogniseFeature::views() {
  ExportedView view;
  view.name = "Recognise";
  view.rank = 2;
  view.widget = panel_;
  view.minHeightShare = kChartHeight;
  view.isThere = [this] {
    return panel_->isVisible() && (panel_->check().shown() || panel_->grasps().shown() ||
                                   !panel_->controller().answer().name().isEmpty());
  };
  view.fileName = [] { return QString("recognised"); };
  view.tables = [this] {
    return panel_->grasps().shown() ? panel_->grasps().tables() : panel_->check().tables();
  };
  view.paint = [this](QPainter& painter, const PictureLook& look) {
    if (panel_->check().shown()) return panel_->check().paint(painter, look);
    if (panel_->grasps().shown()) return panel_->grasps().paint(painter, look);
    const RecognitionAnswer& answer = panel_->controller().answer();
    paintAnswer(painter,
                QRectF(QPointF(0, 0), look.size).adjusted(24, 24, -24, -24),
                answer,
                panel_->controller().photos().photo(answer.name()),
                look.forPrint ? Theme::kLight : shownTheme(),
                look.textUnits > 0 ? look.textUnits : 16);
  };
  return {view};
}

}  // namespace palpate::gui
