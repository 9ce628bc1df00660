#include "gui/record/record_feature.h"

#include <QTimer>
#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

#include <palpate/core/number_text.h>
#include <palpate/recording/recording.h>

#include "gui/appearance/captions.h"
#include "gui/appearance/icons.h"
#include "gui/record/countdown_strip.h"
#include "gui/record/plan_dialog.h"
#include "gui/record/recording_dialog.h"
#include "gui/widgets/offer_strip.h"

namespace palpate::gui {
namespace {

constexpr int kDigits = 10;

}  // namespace

RecordActions::RecordActions(ActionRegistry& book) {
  record = book.make("record", "Hand", "&Record", {key("Ctrl+R")});
  recordingSettings =
      book.make("recordingSettings", "Hand", "Recording &names and marks…", {key("Ctrl+N")});
  openRecorded =
      book.make("openRecorded", "Hand", "&Open the last recording", {key("Ctrl+Shift+O")});
  recordingPlan = book.make("recordingPlan", "Hand", "Plan o&f recordings…", {key("Ctrl+Alt+P")});
  renameRecorded = book.make("renameRecorded", "Hand", "Rename the last recordin&g…");
  discardRecorded = book.make("discardRecorded", "Hand", "Discard the last recording…");
  mark = book.make("mark", "Hand", "&Mark the moment", {key("Space")});
  for (int digit = 0; digit < kDigits; ++digit)
    labels.append(book.add("labels",
                           "Hand",
                           "Mark " + QString::number(digit),
                           {QKeySequence(QString::number(digit))}));
  record->setIconText(" " + plainText(*record));
}

namespace {

// Topic of messages that the next recording removes.
constexpr const char* kRecordingTopic = "recording";

// Formats a duration: "01:16", "1:02:03".
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

QString countedText(std::int64_t count, std::string_view noun) {
  return QString::fromStdString(counted(static_cast<std::uint64_t>(count), noun));
}

// What tells hands apart for the plan: serial number and layout.
QString handKey(const Device& device) {
  const HandDescription hand = device.hand();
  QString text = QString::fromStdString(device.info().serial + "\n" + hand.name);
  for (std::size_t m = 0; m < hand.layout->numMatrices(); ++m)
    text += QString(" %1x%2").arg(hand.layout->matrix(m).rows).arg(hand.layout->matrix(m).columns);
  return text;
}

// A recording with the parts that follow it. Another recording may have the name of a part, so that
// each must say whose it is.
std::vector<std::filesystem::path> partsFrom(const std::filesystem::path& first) {
  std::vector<std::filesystem::path> parts{first};
  try {
    for (int part = 2;; ++part) {
      const std::filesystem::path next = partPath(first, part);
      if (!std::filesystem::exists(next)) break;
      const auto meta = readRecordingMeta(next);
      const auto whose = meta.find("part_of");
      if (whose == meta.end() || whose->second != first.filename().string()) break;
      parts.push_back(next);
    }
  } catch (const std::exception&) {
    // What can't be read stays.
  }
  return parts;
}

// What Record does by the plan that is followed; empty: none is.
QString plannedText(const PlanController& plan) {
  if (!plan.followed()) return {};
  return plan.nextTake().isEmpty() ? plan.nextText() : plan.nextTake();
}

bool missesSomething(const RecordingReport& report) {
  return !report.complete || report.lost > 0 || report.gaps > 0 || report.openGapS > 0.0 ||
         !textOf(report.losses()).empty() || !report.mcapFailure.empty();
}

QString summaryOf(const RecordingReport& report) {
  QString text = QString::fromStdString(report.paths.front().filename().string());
  if (report.paths.size() > 1) text += " and " + QString::number(report.paths.size() - 1) + " more";
  text += ": " + countedText(static_cast<std::int64_t>(report.frames), "frame");
  if (report.complete) text += " in " + figure(report.durationS, 1) + " s";
  text += ", " + megabytes(report.bytes);
  const std::string losses = textOf(report.losses());
  if (!losses.empty()) text += ", " + QString::fromStdString(losses);
  const std::int64_t badChecksums =
      report.counter("bad_checksums") + report.counter("motion_bad_checksums");
  if (badChecksums > 0) text += ", " + countedText(badChecksums, "bad checksum");
  if (report.lost > 0) text += ", " + QString::number(report.lost) + " lost by the recorder";
  if (report.gaps > 0)
    text += ", " + countedText(report.gaps, "gap") + " of " + figure(report.gapsS, 1) +
            " s in which no frame arrived";
  if (report.openGapS > 0.0) text += ", " + QString::fromStdString(report.openGapText());
  if (report.complete && report.lost == 0 && report.gaps == 0 && report.openGapS == 0.0 &&
      losses.empty())
    text += ", nothing lost";
  if (!report.mcapFailure.empty())
    text += "; the MCAP file is not whole: " + QString::fromStdString(report.mcapFailure);
  else if (!report.mcapPaths.empty())
    text += "; MCAP too";
  return text;
}

}  // namespace

RecordFeature::RecordFeature(WindowState& windowState, QWidget* window)
    : Feature(windowState, window),
      actions_(windowState.actions),
      offer_(new OfferStrip(window)),
      plan_(windowState.settings, this),
      take_(windowState),
      countdownStrip_(new CountdownStrip(window)),
      unfinished_(windowState.settings) {
  windowState.prompts.recording = [&windowState, window](
                                      const RecordingSettings& last,
                                      const QString& button) -> std::optional<RecordingSettings> {
    RecordingDialog dialog(last, button, windowState.ask, window);
    if (dialog.exec() != QDialog::Accepted) return std::nullopt;
    return dialog.settings();
  };
  connectActions();
  connectTake();
  connectCountdown();
  connectPlan();
  connectRecorder();
  connectUnfinished();
  use(loadRecordingSettings(windowState.settings));
  connect(&windowState.messages, &Messages::announced, this, [this](const QString& text) {
    offering_ = false;
    offer_->say(text);
  });
  showState();
}

RecordFeature::~RecordFeature() {
  // The dialog refers to the plan.
  delete std::exchange(planDialog_, nullptr);
}

void RecordFeature::connectActions() {
  RecordActions& actions = actions_;
  on(actions.record, [this] { toggle(); });
  on(actions.recordingSettings, [this] {
    takeFolder();
    const auto planned = plan_.nextSettings(settings_);
    auto wanted = state().prompts.recording(planned.value_or(settings_), "Keep");
    if (!wanted) return;
    if (planned) {
      // What the plan gives to its next recording is not for the others.
      wanted->object = settings_.object;
      wanted->run = settings_.run;
      wanted->repetition = settings_.repetition;
      if (wanted->notes == planned->notes) wanted->notes = settings_.notes;
    }
    use(*wanted);
  });
  for (QAction* action : {actions.openRecorded, actions.renameRecorded, actions.discardRecorded})
    action->setEnabled(false);
  on(actions.openRecorded, [this] { state().open(take_.paths()); });
  on(actions.renameRecorded, [this] { take_.rename(); });
  on(actions.discardRecorded, [this] { take_.discard(); });
  on(actions.mark, [this] { mark({}, std::nullopt); });
  for (qsizetype digit = 0; digit < actions.labels.size(); ++digit)
    on(actions.labels[digit], [this, digit] {
      const QString& label = settings_.markLabels.at(static_cast<std::size_t>(digit));
      const auto key = static_cast<int>(digit);
      mark(label.isEmpty() ? "mark " + QString::number(key) : label, key);
    });
  state().actionEnabler.add(
      {actions.record},
      [this] { return state().live.source() != nullptr; },
      "No hand is connected: connect one first (Ctrl+K)");
  // Space bar and digits set marks while a live source is shown; otherwise they control the
  // playback.
  state().actionEnabler.add(actions.labels + QList<QAction*>{actions.mark},
                            [this] { return state().displayed.isLive(); });
}

void RecordFeature::connectTake() {
  connect(&take_, &RecordedTake::changed, this, [this] {
    const bool some = !take_.paths().empty();
    for (QAction* action :
         {actions_.openRecorded, actions_.renameRecorded, actions_.discardRecorded})
      action->setEnabled(some);
  });
  connect(&take_,
          &RecordedTake::renamed,
          this,
          [this](const std::filesystem::path& from, const std::filesystem::path& to) {
            plan_.rename(from, to);
            offerTake("Renamed: " + QString::fromStdString(to.filename().string()));
          });
  connect(&take_,
          &RecordedTake::beginsWith,
          this,
          [this](const std::filesystem::path& part, const std::filesystem::path& gone) {
            const bool asked = doubted_ == gone;
            plan_.rename(gone, part);
            if (!asked) return;
            doubted_ = part;
            askAbout(part, *offer_);
          });
  connect(&take_, &RecordedTake::discarded, this, [this](const std::filesystem::path& path) {
    plan_.forget(path);
    offer_->dismiss();
  });
}

void RecordFeature::connectPlan() {
  on(actions_.recordingPlan, [this] { showPlan(); });
  connect(&plan_, &PlanController::changed, this, [this] {
    showState();
    tellPlan();
    askInPlan();
    // It was decided, discarded or forgotten somewhere else.
    if (!doubted_) return;
    const PlannedTake* take = plan_.plan().find(*doubted_);
    if (take && take->undecided()) return;
    doubted_.reset();
    offer_->dismiss();
  });
  connect(&plan_,
          &PlanController::checked,
          this,
          [this](const std::filesystem::path& file, const QString& problem) {
            if (problem.isEmpty() || !offering_) return;
            state().messages.logLink(pathText(file.filename()) + ": " + problem);
            doubted_ = file;
            askAbout(file, *offer_);
          });
}

void RecordFeature::askAbout(const std::filesystem::path& file, OfferStrip& line) {
  const PlannedTake* take = plan_.plan().find(file);
  if (!take) return;
  line.offer(
      pathText(file.filename()) + ": " + QString::fromStdString(take->problem) + ". Repeat it?",
      "Repeat",
      [this, file] {
        plan_.reject(file);
        state().messages.flash(plan_.nextText());
      });
  line.warn(true);
  line.offerAlso("Keep", "Keep it as it is", [this, file] { plan_.keep(file); });
  line.offerAlso("Discard…", "Move it to the trash, after a question, and repeat it", [this, file] {
    // After a restart, or once another one was recorded: all its parts are found again.
    if (take_.paths().empty() || take_.paths().front() != file) take_.set(partsFrom(file));
    take_.discard();
  });
}

void RecordFeature::askInPlan() {
  if (!planDialog_) return;
  const auto file = plan_.undecided();
  if (file == askedInPlan_) return;
  askedInPlan_ = file;
  if (file)
    askAbout(*file, planDialog_->question());
  else
    planDialog_->question().dismiss();
}

void RecordFeature::showPlan() {
  if (!planDialog_) {
    planDialog_ = new PlanDialog(state(), plan_, actions_.record, window());
    planDialog_->escape = [this] { return escape(); };
    addKeysToPlan();
  }
  // Asked again where the user has closed the line.
  askedInPlan_.reset();
  askInPlan();
  planDialog_->show();
  planDialog_->raise();
  planDialog_->activateWindow();
}

// Keys of the window work in the plan, too, except those of its table and fields.
void RecordFeature::addKeysToPlan() {
  constexpr int kNavigation[] = {
      Qt::Key_Home, Qt::Key_End, Qt::Key_Left, Qt::Key_Right, Qt::Key_Up, Qt::Key_Down};
  // What is closed or copied would be behind the plan.
  const QKeySequence copy = key("Ctrl+C");
  const QKeySequence close = key("Ctrl+W");
  for (QAction* action : window()->actions()) {
    const QString section = sectionOf(*action);
    const bool ofHand = section == "Hand";
    if (!ofHand && section != "View" && section != "File" && section != "Help") continue;
    const QList<QKeySequence> keys = action->shortcuts();
    const bool fits = std::all_of(keys.begin(), keys.end(), [&](const QKeySequence& each) {
      const QKeyCombination pressed = each[0];
      const int code = pressed.key();
      const bool function = code >= Qt::Key_F1 && code <= Qt::Key_F12;
      const bool plain = !pressed.keyboardModifiers().testFlag(Qt::ControlModifier) &&
                         !pressed.keyboardModifiers().testFlag(Qt::AltModifier) && !function;
      if (std::ranges::find(kNavigation, code) != std::end(kNavigation)) return false;
      return code != Qt::Key_Escape && each != copy && each != close && (!plain || ofHand);
    });
    if (fits && !keys.isEmpty()) planDialog_->addAction(action);
  }
}

void RecordFeature::remember() {
  if (planDialog_) planDialog_->hide();
}

void RecordFeature::tellPlan() {
  if (!state().showPlanLeft) return;
  const QString next = plan_.nextTake();
  state().showPlanLeft(next.isEmpty() ? QString()
                                      : plan_.progressText() + " takes · next: " + next);
}

void RecordFeature::settle() { plan_.settle(); }

void RecordFeature::connectCountdown() {
  connect(&countdown_, &RecordingCountdown::changed, this, &RecordFeature::showCountdown);
  connect(&countdown_, &RecordingCountdown::cancelled, &plan_, &PlanController::release);
  connect(&plan_, &PlanController::changed, this, [this] {
    if (countdown_.running()) showCountdown();
  });
  connect(
      countdownStrip_, &CountdownStrip::cancelRequested, &countdown_, &RecordingCountdown::cancel);
  // One press of Escape stops the hand and cancels the countdown, whatever the hand does.
  connect(&state().handCommands, &HandCommands::stopped, this, [this] {
    if (countdown_.cancel()) escaped_.start();
  });
  state().escapeHandler.add(EscapeHandler::Order::kShow, [this] { return escape(); });
  // Something else started a recording, or the hand was disconnected.
  connect(&state().live, &LiveController::stateChanged, this, [this] {
    if (!state().live.source() || state().live.recording()) countdown_.cancel();
  });
}

// True if this press of Escape ended the countdown.
bool RecordFeature::escape() {
  if (countdown_.cancel()) return true;
  constexpr qint64 kSamePressMs = 200;
  const bool same = escaped_.isValid() && escaped_.elapsed() < kSamePressMs;
  escaped_.invalidate();
  return same;
}

void RecordFeature::connectRecorder() {
  LiveController& live = state().live;
  connect(&live, &LiveController::recordingStarted, this, [this] {
    state().messages.withdraw(kRecordingTopic);
    state().messages.logLink("recording begins");
    // Other programs begin recordings, too.
    dismissTake();
    showState();
  });
  connect(&live, &LiveController::recordingFailed, this, [this](const QString& message) {
    state().messages.failAbout(kRecordingTopic, "Not recording: " + message);
    state().messages.logLink("not recording: " + message);
    plan_.end({});
    isPlanned_ = false;
    showState();
  });
  connect(&live, &LiveController::recordingEnded, this, &RecordFeature::offer);
  connect(&live, &LiveController::sourceOpened, this, &RecordFeature::dismissTake);
  connect(
      &live, &LiveController::ended, this, [this] { state().messages.withdraw(kRecordingTopic); });
  connect(&live, &LiveController::refreshed, this, &RecordFeature::showState);
  connect(&live, &LiveController::refreshed, this, &RecordFeature::offerAnotherFolder);
  connect(&live, &LiveController::stateChanged, this, &RecordFeature::showState);
}

void RecordFeature::connectUnfinished() {
  connect(&unfinished_, &RecoveryFinder::found, this, [this](const QStringList& paths) {
    // An offer about a new recording is more urgent.
    if (paths.isEmpty() || !offer_->isHidden()) return;
    constexpr qsizetype kMaxNames = 3;
    QStringList names;
    for (const QString& path : paths.mid(0, kMaxNames)) names.append(path.section('/', -1));
    if (paths.size() > kMaxNames) names.append(QString::number(paths.size() - kMaxNames) + " more");
    offer_->offer(
        (paths.size() == 1 ? QString("A recording was never finished: ")
                           : QString::number(paths.size()) + " recordings were never finished: ") +
            names.join(", ") + ". Recovering writes a new file next to it and leaves it unchanged.",
        "Recover",
        [this, paths] {
          recovered_.clear();
          offer_->say("Recovering …");
          unfinished_.recover(paths);
        },
        [this, paths] {
          unfinished_.ignore(paths);
          state().messages.flash(
              QString("This will not be offered again; later, use File > Recover… to finish ") +
              (paths.size() == 1 ? "it" : "them"));
        });
  });
  connect(&unfinished_, &RecoveryFinder::progressed, this, [this](double fraction) {
    offer_->say("Recovering … " + figure(100.0 * fraction, 0) + " %");
  });
  connect(&unfinished_,
          &RecoveryFinder::recovered,
          this,
          [this](const QString& path, const QString& message, const QString& saved) {
            recovered_.emplace_back(saved.toStdString());
            recoveredText_ = message;
            state().messages.logLink("recovered " + path.section('/', -1) + ": " + message);
          });
  connect(
      &unfinished_, &RecoveryFinder::failed, this, [this](const QString&, const QString& message) {
        state().messages.fail(message);
      });
  connect(&unfinished_, &RecoveryFinder::finished, this, [this] {
    offer_->dismiss();
    if (recovered_.empty()) return;
    const auto count = recovered_.size();
    offer_->offer(count == 1 ? "Recovered " +
                                   QString::fromStdString(recovered_.front().filename().string()) +
                                   ": " + recoveredText_
                             : QString("Recovered %1 recordings").arg(count),
                  "Open",
                  [this, paths = recovered_] { state().open(paths); });
  });
}

void RecordFeature::offerUnfinished() { unfinished_.look(settings_.folder); }

// Searches only after the window is shown.
void RecordFeature::start() {
  if (state().environment.offerUnfinished)
    QTimer::singleShot(0, this, &RecordFeature::offerUnfinished);
  tellPlan();
}

void RecordFeature::use(const RecordingSettings& settings) {
  settings_ = settings;
  saveRecordingSettings(settings_, state().settings);
  state().live.setFolder(settings_.folder.toStdString());
  const QList<QAction*>& labels = actions_.labels;
  for (qsizetype digit = 0; digit < labels.size(); ++digit) {
    const QString& label = settings_.markLabels.at(static_cast<std::size_t>(digit));
    labels[digit]->setText("Mark " + QString::number(digit) +
                           (label.isEmpty() ? "" : ": " + QString(label).replace('&', "&&")));
  }
}

// The dialog Settings changes the folder, too.
void RecordFeature::takeFolder() {
  settings_.folder = loadRecordingSettings(state().settings).folder;
}

void RecordFeature::toggle() {
  LiveController& live = state().live;
  if (live.recording()) {
    // What can't be written now would be lost: another folder is offered first.
    if (!live.health().recorder.writeError.empty() &&
        !state().prompts.endRecording(UserPrompts::Ending::kStop))
      return;
    return live.stopRecording();
  }
  if (countdown_.cancel()) return;
  if (!isPlanSure()) return;
  takeFolder();
  const auto planned = plan_.nextSettings(settings_);
  const bool isBesidePlan = plan_.followed() && !planned && !plan_.plan().rows().empty();
  if (!planned && settings_.askEachTime) {
    const auto wanted = state().prompts.recording(
        settings_, isBesidePlan ? "Record outside of the plan" : "Start recording");
    if (!wanted) return;
    use(*wanted);
  }
  if (isBesidePlan)
    state().messages.flash("This recording is outside of the plan: " + plan_.nextText());
  const RecordingSettings next = planned.value_or(settings_);
  const bool isPlanned = planned.has_value();
  if (isPlanned) plan_.hold();
  countedTake_ = isPlanned ? plan_.nextTake() : QString();
  if (next.countdownS > 0)
    countdown_.start(next.countdownS, [this, next, isPlanned] { begin(next, isPlanned); });
  else
    begin(next, isPlanned);
}

bool RecordFeature::isPlanSure() {
  const LiveSource* source = state().live.source();
  if (!source || plan_.nextTake().isEmpty() || !plan_.followed()) return true;
  const QString hand = handKey(source->session->device());
  if (const QString doubt = plan_.doubt(hand); !doubt.isEmpty()) {
    const int answer =
        state().ask.choice("The plan of recordings was followed " + doubt +
                               ". Next in it: " + plan_.nextTake() + ". Is it still followed?",
                           {"Follow the plan", "Don't follow it"});
    if (answer < 0) return false;
    if (answer == 1) {
      plan_.setFollowed(false);
      state().messages.flash("The plan is no longer followed");
      return true;
    }
  }
  plan_.followWith(hand);
  return true;
}

// A recording that has ended by itself waits while the disk fails.
void RecordFeature::offerAnotherFolder() {
  const LiveController& live = state().live;
  const bool waits = live.recording() && live.health().recorder.waitsForDisk;
  if (waits == waitsForDisk_) return;
  waitsForDisk_ = waits;
  if (!waits || !offering_) return;
  doubted_.reset();
  offer_->offer(
      "The recording has reached its end, but can't be written: what is missing on the disk waits "
      "in memory.",
      "Another folder…",
      [this] {
        // Asked once more if the answer is to keep it.
        waitsForDisk_ = false;
        if (state().live.recording()) toggle();
      });
}

void RecordFeature::begin(const RecordingSettings& counted, bool planned) {
  LiveController& live = state().live;
  if (!live.source() || live.recording()) {
    if (planned) plan_.release();
    return;
  }
  // The row of the plan may have been edited during the countdown, and still be.
  if (planDialog_) planDialog_->takeTyped();
  const auto held = plan_.holds() ? plan_.nextSettings(settings_) : std::nullopt;
  if (!held) plan_.release();
  const RecordingSettings settings = held.value_or(counted);
  isPlanned_ = planned;
  offer_->dismiss();
  doubted_.reset();
  // A take may be a little shorter than it was to be: by the interval of two frames.
  constexpr double kNearlyWhole = 0.95;
  std::optional<double> leastS;
  if (settings.limits.stopAfterS) leastS = kNearlyWhole * *settings.limits.stopAfterS;
  if (held) plan_.begin(leastS);
  live.startRecording([settings] {
    RecordingOptions options =
        recordingOptions(settings, nextPath(settings, systemClock().wallUs()));
    // Another folder is offered then; see offerAnotherFolder().
    options.waitForDisk = true;
    return options;
  });
  // Notes are about one recording.
  if (!settings_.notes.isEmpty()) {
    RecordingSettings next = settings_;
    next.notes.clear();
    use(next);
  }
  showState();
}

void RecordFeature::mark(const QString& label, std::optional<int> digit) {
  LiveController& live = state().live;
  live.mark(label, digit);
  state().messages.flash((label.isEmpty() ? QString("marked") : "marked: " + label) +
                         (live.recording() ? "" : " (nothing is being recorded)"));
}

void RecordFeature::showCountdown() {
  if (plan_.holds()) countedTake_ = plan_.nextTake();
  countdownStrip_->setLeft(countdown_.leftS(), countedTake_);
  if (countdown_.running()) offer_->dismiss();
  showState();
}

// Shows the duration of the recording and the amount on disk on the button.
void RecordFeature::showState() {
  QAction* action = actions_.record;
  const bool counting = countdown_.running();
  const bool on = counting || (state().live.source() && state().live.recording());
  if (on != action->property(kRecordingProperty).toBool() || action->icon().isNull()) {
    action->setProperty(kRecordingProperty, on);
    action->setIcon(makeIcon(on ? IconShape::kStopRecording : IconShape::kRecord));
    action->setText(on ? "Stop &recording" : "&Record");
  }
  const QString planned = on ? QString() : plannedText(plan_);
  // That takes are to be decided has no room on the button.
  const bool isOnButton = !planned.isEmpty() && (!plan_.nextTake().isEmpty() || !plan_.undecided());
  if (action->property(kPlannedProperty).toBool() != isOnButton)
    action->setProperty(kPlannedProperty, isOnButton);
  const QString tip = on ? "Stop and finish the recording (Ctrl+R)"
                         : "Start recording, with the last two seconds (Ctrl+R)" +
                               (planned.isEmpty() ? QString() : "\n" + planned);
  if (action->toolTip() != tip) action->setToolTip(tip);
  QString text = " Record";
  if (isOnButton) text += ": " + planned;
  if (counting) {
    text = " in " + QString::number(countdown_.leftS()) + " s";
  } else if (on) {
    const RecorderStatus& recorder = state().live.health().recorder;
    const QString end = recorder.stopAfterS ? " of " + clockText(*recorder.stopAfterS) : QString();
    text = recorder.waitsForDisk ? QString(" waiting for the disk")
           : recorder.state == RecorderStatus::State::kRecording
               ? " " + clockText(recorder.elapsedS) + end + " · " + megabytes(recorder.bytesOnDisk)
           : recorder.state == RecorderStatus::State::kArmed ? QString(" waiting for contact")
                                                             : QString(" waiting for a frame");
  }
  if (action->iconText() != text) action->setIconText(text);
}

void RecordFeature::offer(const RecordingReport& report) {
  Messages& messages = state().messages;
  plan_.end(report);
  const bool isPlanned = std::exchange(isPlanned_, false);
  showState();
  // It may have been continued in another folder than that of the next one.
  takeFolder();
  state().live.setFolder(settings_.folder.toStdString());
  if (std::exchange(waitsForDisk_, false) && offering_) offer_->dismiss();
  if (report.paths.empty()) {
    if (report.nothingTouched) {
      // Stopped by the user's own wish: that is no alarm.
      messages.flash("The recording waited for contact and was stopped: nothing was recorded");
      messages.logLink("nothing was recorded: nothing was touched");
      return;
    }
    const QString why = report.message.empty() ? QString("no frame arrived while it was recording")
                                               : QString::fromStdString(report.message);
    messages.failAbout(kRecordingTopic, "Nothing was recorded: " + why);
    messages.logLink("nothing was recorded: " + why);
    return;
  }
  take_.set(report.paths);
  const QString summary = summaryOf(report);
  messages.logLink("recorded " + summary);
  if (!report.complete) {
    const QString name = QString::fromStdString(report.paths.front().filename().string());
    const QString why = QString::fromStdString(report.message);
    // The message may begin with the name.
    messages.fail((why.startsWith(name) ? "" : name + ": ") +
                  (report.lost > 0 ? "something is missing: " : "") + why);
  }
  const bool counts = plan_.plan().find(report.paths.front()) != nullptr;
  const QString plan =
      counts && plan_.followed() ? " · " + plan_.progressText() + ", " + plan_.nextText()
      : !counts && isPlanned     ? QString(
                                   " · not counted in the plan: its row was removed, or the plan "
                                       "is no longer followed")
                             : QString();
  offerTake("Recorded " + summary + plan);
  if (offering_ && missesSomething(report)) offer_->warn(true);
}

// The line about the last recording goes when something new begins.
void RecordFeature::dismissTake() {
  // Another line may have taken its place.
  if (offering_ && !takeText_.isEmpty() && offer_->text() == takeText_) offer_->dismiss();
  takeText_.clear();
}

void RecordFeature::offerTake(const QString& text) {
  if (!offering_) return;
  doubted_.reset();
  takeText_ = text;
  offer_->offer(text, "Open", [this] { state().open(take_.paths()); });
  offer_->offerAlso("Rename…", "Rename it, with what belongs to it", [this] { take_.rename(); });
  offer_->offerAlso(
      "Discard…", "Move it to the trash, after a question", [this] { take_.discard(); });
}

std::vector<BannerSpec> RecordFeature::strips() {
  return {{BannerSpec::Order::kOffer, countdownStrip_}, {BannerSpec::Order::kOffer, offer_}};
}

}  // namespace palpate::gui
