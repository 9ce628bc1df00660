#include "gui/hand/hand_dock.h"

#include <QAbstractSpinBox>
#include <QAction>
#include <QLabel>
#include <QMouseEvent>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QTabBar>
#include <QTimer>
#include <algorithm>
#include <utility>

#include <palpate/capture/link_health.h>
#include <palpate/device/stream_device.h>

#include "gui/appearance/captions.h"
#include "gui/desktop/key_policy.h"
#include "gui/hand/grasp_panel.h"
#include "gui/hand/hand_feature.h"
#include "gui/hand/hand_sentence.h"
#include "gui/hand/joint_panel.h"
#include "gui/hand/sensitivity_modes.h"
#include "gui/hand/sequence_panel.h"
#include "gui/hand/stop_key.h"
#include "gui/hand/tactile_settings_panel.h"
#include "gui/hand/touch_store.h"
#include "gui/widgets/fitting_pages.h"
#include "gui/widgets/make.h"
#include "gui/widgets/number_field.h"
#include "gui/widgets/status_lines.h"
#include "gui/widgets/text_fit.h"

namespace palpate::gui {
namespace {

constexpr int kHandDockRefreshMs = 50;
constexpr int kHandDockMargin = 12;
constexpr const char* kPageKey = "hand/page";
constexpr int kStateLines = 4;   // lines reserved for the status text
constexpr int kAnswerMs = 6000;  // for which the answer to a press stays
constexpr const char* kStopTip =
    "Stop the hand now; the motors stay on and hold (Esc works everywhere)";
constexpr const char* kReadOnlyTip = "This hand is read, not moved";

CaptureQueueOptions smallFeed() {
  CaptureQueueOptions options;
  options.tactileItems = 256;
  options.motionItems = 256;
  options.eventItems = 64;
  return options;
}

}  // namespace

HandDock::HandDock(QSettings& settings, Ask& ask, const HandActions& actions, QWidget* parent)
    : QWidget(parent), actions_(actions) {
  calibrationOf = [](const std::string&) { return std::optional<Calibration>(); };
  calibrationBeingRead = [](const std::string&) { return false; };
  ownMotion = [] { return QString(); };
  otherTask = [] { return HandTask(); };
  stopKey_ = new StopKey(this);
  // As of the last refresh: nothing is asked, or waited for, before the stop.
  stopKey_->actsByItself = [this] { return !own_.isEmpty(); };
  // A click on a button takes the focus from whatever had it: Return, pressed after a click on
  // Grasp, must not press a button elsewhere in the window.
  setFocusPolicy(Qt::ClickFocus);
  setAccessibleName("Hand");
  // At the bottom, so that other parts don't move when it appears or disappears.
  heat_ = makeLines(this, "handHeat");
  heat_->setContentsMargins(kHandDockMargin, 6, kHandDockMargin, 8);
  setLayout(inColumn({makeHead(), {makeBody(settings, ask), 1}, heat_}, Space::kNone));
  body_->widget()->installEventFilter(this);
  fitToText(*this, [this] {
    textChanged_ = true;
    constexpr int kSettledMs = 500;  // [ms] until all parts have their new sizes
    QTimer::singleShot(kSettledMs, this, [this] {
      textChanged_ = false;
      if (isVisible()) fitWidth();
    });
  });
  answerTimer_.setSingleShot(true);
  answerTimer_.setInterval(kAnswerMs);
  connect(&answerTimer_, &QTimer::timeout, this, [this] {
    answer_.clear();
    refresh();
  });
  connect(stop_, &QPushButton::clicked, actions.stopHand, &QAction::trigger);
  connect(actions.stopHand, &QAction::triggered, this, [this] {
    clearAnswers();
    refusedNumber_.clear();
    if (control_) control_->stop();
    emit stopPressed();
    refresh();
  });
  connect(stopKey_, &StopKey::pressed, this, [this] {
    clearAnswers();
    emit stopPressed();
  });
  // A button doesn't take the focus: what was typed in a field counts without Enter, and what is
  // refused moves nothing.
  for (QPushButton* button : findChildren<QPushButton*>())
    if (button->property(kMovesHand).toBool()) {
      // A disabled button tells nobody that it was pressed.
      button->installEventFilter(this);
      connect(button, &QPushButton::pressed, this, [this, button] {
        if (!refusalIsNew_) refusedNumber_.clear();
        if (auto* field = qobject_cast<QAbstractSpinBox*>(focusWidget())) field->clearFocus();
        if (!refusalIsNew_ || button == grasp_->relaxButton()) return;
        // Who typed another number than that which stays doesn't want this motion. This takes back
        // a press by the mouse; that by a key is not heard.
        refusedNumber_ += ", and nothing was started";
        refresh();
        button->setDown(false);
        button->blockSignals(true);
        QTimer::singleShot(0, button, [button] { button->blockSignals(false); });
      });
    }
  const auto refused = [this](const QString& why) { said_ = why; };
  const auto asked = [this] { said_.clear(); };
  connectMotions();
  connect(tactile_, &TactileSettingsPanel::changedByHand, this, asked);
  connect(sensitivity_, &SensitivityModes::asked, this, asked);
  connect(tactile_, &TactileSettingsPanel::refused, this, refused);
  connect(sensitivity_, &SensitivityModes::refused, this, refused);
  connect(tactile_, &TactileSettingsPanel::changedByHand, sensitivity_, &SensitivityModes::endMode);
  // A mode changes the settings, too: undo goes back to those from before it.
  connect(sensitivity_, &SensitivityModes::changing, tactile_, &TactileSettingsPanel::keepForUndo);
  connect(sensitivity_, &SensitivityModes::refusalEnded, this, [this](const QString& why) {
    if (said_ == why) said_.clear();
  });
  grasp_->highestLimit = [this](const GraspRequest& request) {
    if (!session_) return kMaxGraspLimitCounts;
    const DeviceInfo info = session_->device().info();
    return highestMeasurableLimit(session_->device().hand(), info.matrices, request);
  };
  timer_.setInterval(kHandDockRefreshMs);
  connect(&timer_, &QTimer::timeout, this, &HandDock::refresh);
  setHand(nullptr, nullptr);
  fitToTheme(*this, [this] {
    heat_->setStyleSheet("color: " + colorsOf().warning.name() + "; font-weight: bold;");
    state_->label().setStyleSheet({});
    refresh();
  });
}

HandDock::~HandDock() = default;

QWidget* HandDock::makeHead() {
  auto* head = new QWidget(this);
  // The height is fixed, so that no button moves: users remember the buttons of a robot by their
  // position.
  state_ = new StatusLines(kStateLines, "handState", head);
  stop_ = makeButton(head, "stopHand", "Stop  (Esc)");
  stop_->setProperty("danger", true);
  stop_->setFocusPolicy(Qt::TabFocus);
  fitToText(*stop_, [stop = stop_] { stop->setMinimumHeight(3 * stop->fontMetrics().height()); });
  head->setLayout(inColumn({stop_, state_}, kPageEdges));
  return head;
}

void HandDock::makePages(QSettings& settings, Ask& ask, QWidget* content) {
  touches_ = new TouchStore(this);
  grasp_ = new GraspPanel(settings, *touches_, actions_, content);
  joint_ = new JointPanel(settings, ask, content);
  sequence_ = new SequencePanel(settings, ask, content);
  chooser_ = named(new QTabBar(content), "handPages");
  chooser_->setDrawBase(false);
  chooser_->setExpanding(false);
  chooser_->setUsesScrollButtons(false);
  chooser_->setFocusPolicy(Qt::TabFocus);
  pages_ = named(new FittingPages(content), kDockPages);
  const auto page = [this](QWidget* panel, const QString& name, const QString& tip) {
    // What is left of the height of a page stays below its panel.
    pages_->addWidget(panel);
    chooser_->setTabToolTip(chooser_->addTab(name), tip);
  };
  page(grasp_, "Grasp", "Close by a preshape: plain, reactive, slip-aware");
  page(joint_, "Joints", "Single joints and own poses");
  page(sequence_, "Sequence", "A table of motions, repeated");
  auto* sensors = new QWidget(content);
  sensitivity_ = new SensitivityModes(sensors);
  tactile_ = new TactileSettingsPanel(settings, ask, sensors);
  sensors->setLayout(inColumn({sensitivity_, tactile_, Stretch{}}));
  page(sensors, "Sensors", "Sensitivity and threshold of each matrix");
  connect(chooser_, &QTabBar::currentChanged, this, [this, &settings](int index) {
    pages_->setCurrentIndex(index);
    settings.setValue(kPageKey, index);
    if (isVisible()) fitWidth();
  });
  chooser_->setCurrentIndex(
      std::clamp(settings.value(kPageKey, 0).toInt(), 0, pages_->count() - 1));
}

QStringList HandDock::pageNames() const {
  QStringList names;
  for (int i = 0; i < chooser_->count(); ++i) names.append(chooser_->tabText(i));
  return names;
}

void HandDock::showPage(const QString& name) {
  if (const auto index = pageNames().indexOf(name); index >= 0)
    chooser_->setCurrentIndex(static_cast<int>(index));
}

// What all pages that move the hand have in common.
void HandDock::connectMotions() {
  const auto common = [this](auto* panel) {
    using Panel = std::remove_pointer_t<decltype(panel)>;
    connect(panel, &Panel::begins, this, &HandDock::clearAnswers);
    connect(panel, &Panel::refused, this, [this](const QString& why) {
      said_ = why;
      emit explained(why);
      // Do not report this end a second time.
      if (control_)
        if (const auto last = control_->status().last) explainedEndUs_ = last->endUs;
      // What the hand does hides said_.
      if (control_ && control_->status().phase != GraspPhase::kIdle)
        answer(why, [] { return false; });
    });
    connect(panel, &Panel::asked, this, &HandDock::refresh);
    connect(panel, &Panel::asked, this, &HandDock::asked);
  };
  common(grasp_);
  common(joint_);
  common(sequence_);
  joint_->reactiveLimits = [this] {
    GraspRequest request = grasp_->request(GraspMode::kReactive);
    // A motion of joints stops at its limit, and doesn't give way.
    request.keepsLimit = false;
    request.object.clear();
    request.touchRatio.reset();
    return request;
  };
  sequence_->graspRequest = [this](GraspMode mode) { return grasp_->request(mode); };
  sequence_->poseVelocity = [this] { return joint_->velocityDegPerS(); };
  sequence_->poses = [this] {
    std::vector<SavedPose> poses;
    for (const QString& name : joint_->saved().names())
      if (auto pose = joint_->saved().load(name)) poses.push_back(std::move(*pose));
    return poses;
  };
}

QWidget* HandDock::makeBody(QSettings& settings, Ask& ask) {
  auto* area = new QScrollArea(this);
  area->setWidgetResizable(true);
  area->setFrameShape(QFrame::NoFrame);
  area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  area->setFocusPolicy(Qt::NoFocus);
  auto* content = new QWidget(area);
  makePages(settings, ask, content);
  auto* settable = named(new QWidget(content), "handControls");
  const Edges sides{.left = Space::kUsual, .right = Space::kUsual};
  settable->setLayout(inColumn({chooser_, makeBox(inColumn({pages_}, sides), settable)}));
  controls_ = {settable, stop_};
  content->setLayout(
      inColumn({settable, Stretch{}}, {.top = Space::kNarrow, .bottom = Space::kWide}));
  area->setWidget(content);
  body_ = area;
  return area;
}

// The width is known only when the dock is shown.
void HandDock::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  fitWidth();
}

bool HandDock::eventFilter(QObject* watched, QEvent* event) {
  if (watched == body_->widget() && event->type() == QEvent::LayoutRequest && textChanged_ &&
      isVisible())
    fitWidth();
  const auto* button = qobject_cast<QAbstractButton*>(watched);
  if (button && event->type() == QEvent::MouseButtonPress && !button->isEnabled() &&
      static_cast<QMouseEvent*>(event)->button() == Qt::LeftButton) {
    const QString name =
        button->accessibleName().isEmpty() ? button->text() : button->accessibleName();
    answer(name + ": " + button->toolTip(), [button] { return button->isEnabled(); });
  }
  return QWidget::eventFilter(watched, event);
}

void HandDock::answerKey(const QString& why, const QAction* action) {
  answer(why, [action] { return action->isEnabled(); });
}

void HandDock::answer(const QString& why, std::function<bool()> canBePressed) {
  answer_ = why.endsWith('.') || why.endsWith('!') || why.endsWith('?') ? why : why + ".";
  canBePressed_ = std::move(canBePressed);
  answerTimer_.start();
  showState(control_ ? control_->status() : GraspStatus{});
}

void HandDock::clearAnswers() {
  said_.clear();
  answer_.clear();
}

void HandDock::fitWidth() {
  // Layouts around a page that is another one learn of it one after the other, by events.
  for (QWidget* each = pages_; each != body_->widget(); each = each->parentWidget())
    each->updateGeometry();
  body_->setMinimumWidth(body_->widget()->minimumSizeHint().width() +
                         body_->verticalScrollBar()->sizeHint().width());
}

void HandDock::setHand(CaptureSession* session, GraspControl* control) {
  session_ = session;
  control_ = control;
  clearAnswers();
  refusedNumber_.clear();
  judged_.reset();
  layout_.reset();
  goneUs_ = 0;
  toldCondition_.reset();
  own_.clear();
  stopsAsked_ = control ? control->status().stopsAsked : 0;
  sceneStopped_ = false;
  queue_ = session ? session->subscribe("the dock Hand", smallFeed()) : nullptr;
  const QString whyNot = isReadOnly() ? kReadOnlyTip : "No hand is connected";
  touches_->setControl(control);
  grasp_->setControl(control, whyNot);
  joint_->setControl(control, whyNot);
  sequence_->setHand(session, control, whyNot);
  sensitivity_->setHand(session, control);
  tactile_->setHand(session, control);
  stopKey_->setControl(control);
  stop_->setEnabled(control != nullptr);
  stop_->setToolTip(control ? kStopTip : session ? kReadOnlyTip : "No hand is connected");
  actions_.stopHand->setEnabled(stop_->isEnabled());
  actions_.stopHand->setToolTip(stop_->toolTip());
  for (QWidget* each : controls_) each->setVisible(!isReadOnly());
  updateHand();
  heat_->hide();
  if (session)
    timer_.start();
  else
    timer_.stop();
  refresh();
}

void HandDock::renewCalibration() {
  if (!control_) return;
  const std::string hand = session_->device().hand().name;
  control_->setCalibration(calibrationOf(hand));
  grasp_->setCalibrationBeingRead(calibrationBeingRead(hand));
}

void HandDock::updateHand() {
  renewCalibration();
  const HandDescription hand = session_ ? session_->device().hand() : movableHand();
  grasp_->setHand(hand);
  tactile_->setMatrices(hand);
  // Those of the matrices are new ones for another hand.
  for (RefusedNumber* each : findChildren<RefusedNumber*>())
    connect(
        each, &RefusedNumber::changed, this, &HandDock::showRefusedNumber, Qt::UniqueConnection);
  sensors_ = hand.temperatureSensors;
  shownTemperatures_.reset();
}

void HandDock::refresh() {
  if (control_) sequence_->refresh(control_->status());
  // Before the status, which is newer.
  const auto changes = control_ ? control_->takeChanges() : std::vector<GraspChange>();
  const GraspStatus status = control_ ? control_->status() : GraspStatus{};
  // While a step of a sequence rests, the hand is not free for another motion.
  GraspStatus offered = status;
  if (sequence_->running()) {
    offered.phase = GraspPhase::kHolding;
    offered.request.reset();
  }
  touches_->follow(status);
  grasp_->showStatus(offered);
  joint_->showStatus(offered, status.phase);
  sensitivity_->refresh();
  const DeviceInfo info = session_ ? session_->device().info() : DeviceInfo{};
  showUnmeasurable(info.matrices);
  followScene(status);
  followRefusal(status, info.matrices);
  tactile_->refresh(status, info);
  showSamples();
  const bool gone = control_ && !status.cannotMove.empty();
  if (gone) goneUs_ = session_->nowUs();
  emit reachedChanged(!gone);
  if (!answer_.isEmpty() && canBePressed_()) answer_.clear();
  showState(status);
  showCondition(status, changes);
}

void HandDock::acknowledge() {
  if (control_) control_->acknowledge();
  refresh();
}

void HandDock::showCondition(const GraspStatus& status, const std::vector<GraspChange>& changes) {
  emit unacknowledged(!status.unprotected.empty());
  if (!control_ || (!toldCondition_ && !status.cannotMove.empty()))
    return emit conditionShown(std::nullopt, {});
  ExplainedCondition now = conditionOf(status);
  if (sceneStopped_ && now.condition == HandCondition::kReady)
    now = {HandCondition::kStopped, sceneStoppedText().chopped(1).toStdString()};
  const auto tell = [this](const ExplainedCondition& condition) {
    if (toldCondition_ == condition.condition) return;
    toldCondition_ = condition.condition;
    emit conditionChanged(condition);
  };
  // A change that lasts shorter than a refresh is told, too.
  for (const GraspChange& change : changes) tell(change.condition);
  tell(now);
  HandTask task = otherTask();
  if (!own_.isEmpty())
    task = {"scripted", "The emulated hand follows the script of its scene: " + own_};
  if (sequence_->running()) task = {"sequence runs", "A sequence runs: " + sequence_->stateText()};
  emit conditionShown(now, task);
}

// Judges the matrices as the offered grasps would: by the reactive grasp; where that detects
// everything, by the slip-aware grasp.
void HandDock::showUnmeasurable(const std::vector<MatrixSettings>& settings) {
  const GraspRequest reactive = grasp_->request(GraspMode::kReactive);
  Judged now{settings,
             layout_,
             reactive.preshape,
             reactive.limitCounts,
             grasp_->request(GraspMode::kSlip).holding.maxLimitCounts,
             reactive.fingerLimitCounts};
  if (judged_ == now) return;
  judged_ = std::move(now);
  std::vector<QString> why;
  GraspRequest judged = reactive;
  if (session_ && control_ && !settings.empty()) {
    const HandDescription hand = session_->device().hand();
    std::vector<UnmeasurableLimit> unfelt = unmeasurableLimits(hand, settings, judged);
    if (unfelt.empty()) {
      judged = grasp_->request(GraspMode::kSlip);
      unfelt = unmeasurableLimits(hand, settings, judged);
    }
    for (const UnmeasurableLimit& each : unfelt) {
      why.resize(std::max(why.size(), each.matrix + 1));
      why[each.matrix] = QString::fromStdString(each.why);
    }
  }
  tactile_->showUnmeasurable(why, maxLimitOf(judged));
  if (why == unmeasurable_) return;
  unmeasurable_ = why;
  emit unmeasurableChanged(unmeasurable_);
}

// A stop of a hand that acts by itself ends no motion of ours: the status doesn't tell of it.
void HandDock::followScene(const GraspStatus& status) {
  const bool stopped = std::exchange(stopsAsked_, status.stopsAsked) != status.stopsAsked;
  const bool acted = !std::exchange(own_, ownMotion()).isEmpty();
  const std::int64_t lastUs = status.last ? status.last->endUs : 0;
  if (stopped && acted) {
    sceneStopped_ = true;
    sceneLastUs_ = lastUs;
  }
  if (status.phase != GraspPhase::kIdle || status.motorsOff || lastUs != sceneLastUs_)
    sceneStopped_ = false;
}

// Finds out when the reason of a refused grasp is gone: its limit can be measured now.
void HandDock::followRefusal(const GraspStatus& status,
                             const std::vector<MatrixSettings>& settings) {
  if (!session_ || !status.last || status.last->outcome != GraspOutcome::kRefused ||
      status.last->request.mode == GraspMode::kPlain || settings.empty())
    return;
  const GraspReport& refused = *status.last;
  const bool isNew = refusedUs_ != refused.endUs;
  if (!isNew && !limitRefused_) return;
  const auto unfelt = unmeasurableLimits(session_->device().hand(), settings, refused.request);
  if (isNew) {
    refusedUs_ = refused.endUs;
    limitMeasurable_ = false;
    limitRefused_ = !unfelt.empty() && refused.text.find(unfelt[0].why) != std::string::npos;
    return;
  }
  limitMeasurable_ = unfelt.empty();
  if (limitMeasurable_ && said_ == QString::fromStdString(refused.text)) said_.clear();
}

void HandDock::setUsualClose(double ratio) { grasp_->setUsualClose(ratio); }

void HandDock::setInSight(bool on) { grasp_->setInSight(on); }

void HandDock::showRefusedNumber(const QString& what) {
  // A field whose mark goes later doesn't take away the text about another one.
  if (what.isEmpty() && sender() != refusedBy_) return;
  refusedBy_ = what.isEmpty() ? nullptr : sender();
  refusedNumber_ = what;
  refusalIsNew_ = !what.isEmpty();
  QTimer::singleShot(0, this, [this] { refusalIsNew_ = false; });
  showState(control_ ? control_->status() : GraspStatus{});
}

void HandDock::say(const QString& what, bool bad, const QString& more) {
  // A long text must not hide a refused number, nor the answer to a press; a danger comes before
  // them.
  QStringList lines;
  for (const QString& line : {answer_, refusedNumber_})
    if (!line.isEmpty()) lines.append(line);
  lines.insert(bad ? 0 : lines.size(), what);
  const QString text = lines.join('\n');
  state_->setText(text, more.isEmpty() ? QString() : text + "\n" + more);
  const QColor color = bad ? colorsOf().danger : colorsOf().text;
  const QString style = "color: " + color.name() + ";";
  if (state_->label().styleSheet() != style) state_->label().setStyleSheet(style);
  emit stateShown(text, bad);
}

void HandDock::showState(const GraspStatus& status) {
  using Hand = HandFacts::Hand;
  HandFacts facts{.status = status, .goneUs = goneUs_};
  if (control_) {
    const auto motion = session_->device().status().motion;
    const bool unanswered = status.phase == GraspPhase::kStopping && !status.cannotMove.empty();
    if (sequence_->running())
      facts.sequence = sequence_->stateText();
    else if (status.phase != GraspPhase::kIdle && status.request && !unanswered)
      said_.clear();
    facts.hand = Hand::kMovable;
    facts.nowUs = session_->nowUs();
    facts.foundMovingUs = motion ? motion->foundMovingUs : 0;
    facts.refusal = said_;
    facts.ownMotion = own_;
    facts.sceneStopped = sceneStopped_;
    if (status.phase == GraspPhase::kClosing && status.request && keepsLimit(*status.request))
      facts.touchUnknown = !control_->forecast(*status.request).touchKnown;
    facts.limitMeasurable = limitMeasurable_ && status.last && status.last->endUs == refusedUs_;
  } else if (session_) {
    const bool streamed = dynamic_cast<const StreamDevice*>(&session_->device()) != nullptr;
    facts.hand = streamed ? Hand::kStreamed : Hand::kReplayed;
  }
  const HandSentence now = handSentence(facts);
  if (now.endUs > 0 && std::exchange(explainedEndUs_, now.endUs) != now.endUs)
    emit explained(now.why);
  say(now.text, now.bad, now.more);
}

void HandDock::showSamples() {
  if (!queue_) return;
  items_.clear();
  queue_->take(items_);
  const Sample* temperatures = nullptr;
  for (const CaptureItem& item : items_) {
    if (const Sample* sample = sampleOf(item, kTemperatureSeries)) temperatures = sample;
    if (const auto* frame = std::get_if<SharedFrame>(&item)) layout_ = (*frame)->layout;
  }
  tactile_->showScanned(layout_);
  if (temperatures) showHeat(*temperatures);
  items_.clear();
}

void HandDock::showHeat(const Sample& temperatures) {
  shownTemperatures_ = temperatures;
  const ShownUnit unit = shownUnit(units_.temperature);
  const double hottest = HealthOptions{}.maxTemperatureDegC;
  QStringList hot;
  for (std::size_t i = 0; i < std::min(temperatures.values.size(), sensors_.size()); ++i)
    if (temperatures.values[i] > hottest)
      hot.append(QString::fromStdString(sensors_[i].name) + " " +
                 unit.text(temperatures.values[i], 1));
  heat_->setVisible(!hot.isEmpty());
  heat_->setText("Too hot: " + hot.join(", ") + ". Relax the hand and let it cool below " +
                 unit.text(hottest, 0) + ".");
}

void HandDock::setUnits(const DisplayUnits& units) {
  units_ = units;
  if (shownTemperatures_) showHeat(Sample(*shownTemperatures_));
}

}  // namespace palpate::gui
