#include "gui/hand/grasp_panel.h"

#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <algorithm>
#include <cmath>
#include <utility>

#include <palpate/core/error.h>
#include <palpate/model/hand_file.h>

#include "gui/appearance/captions.h"
#include "gui/appearance/settings_table.h"
#include "gui/hand/grasp_options.h"
#include "gui/hand/hand_feature.h"
#include "gui/hand/motion_button.h"
#include "gui/hand/object_fields.h"
#include "gui/hand/touch_store.h"
#include "gui/widgets/make.h"
#include "gui/widgets/status_lines.h"
#include "gui/widgets/text_fit.h"
#include "gui/widgets/value_slider.h"

namespace palpate::gui {
namespace {

constexpr const char* kPreshape = "grasp/preshape";
constexpr const char* kClose = "grasp/close";
constexpr const char* kLimit = "grasp/limit_counts";
constexpr const char* kForceLimit = "grasp/limit_n";
constexpr double kUsualForceLimitN = 2.0;
constexpr double kSliderForceLimitN = 20.0;
constexpr const char* kKeepLimit = "grasp/keep_limit";
constexpr const char* kKeepTip =
    "Touch slowly where the object is expected, then ease until the reading is 0.8 .. 1.2 times "
    "the limit. Off: close at the set velocity, and stay where it stopped, above the limit";
constexpr const char* kLimitTip =
    "A reactive grasp stops at the first taxel above it, a slip-aware one starts with it; an "
    "SDH-2 saturates at 3500";
constexpr const char* kForceLimitTip =
    "The grasp stops when a finger exceeds this force (needs a calibration). A slip-aware grasp "
    "begins with its limit in counts, and closes no further while a finger is above this one";
constexpr const char* kNotInSightTip =
    "A recording is shown, not the hand. Live (F6) shows the hand; then it can be moved";
constexpr int kForecastLines = 3;
constexpr int kForecastMs = 250;
constexpr double kForecastDeg = 0.5;  // a joint that moves less changes no forecast

// As it is shown.
bool isWarned(const GraspForecast& forecast) {
  return std::round(10.0 * forecast.timesLimit) > 10.0 * kWarnedLimit;
}

}  // namespace

GraspPanel::GraspPanel(QSettings& settings,
                       TouchStore& touches,
                       const HandActions& actions,
                       QWidget* parent)
    : QWidget(parent), settings_(settings), touches_(touches) {
  highestLimit = [](const GraspRequest&) { return kMaxGraspLimitCounts; };
  const GraspRequest usual;
  preshape_ = named(new QComboBox(this), "preshape");
  preshape_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  preshape_->setMinimumContentsLength(8);
  for (const Preshape& each : movableHand().file->preshapes)
    preshape_->addItem(QString::fromStdString(each.title), QString::fromStdString(each.name));
  const int index = preshape_->findData(
      settings.value(kPreshape, QString::fromStdString(usual.preshape)).toString());
  preshape_->setCurrentIndex(std::max(0, index));
  close_ = named(new ValueSlider("Close ratio", {0.0, 1.0, 1.0, 0.01, 2, " "}, this), "closeRatio");
  close_->setToolTip("How far the hand closes: 0 open, 1 closed. A reactive grasp goes up to 1");
  close_->showValue(storedNumber(settings, kClose, 0.0, 1.0).value_or(usual.closeRatio));
  velocity_ = new ValueSlider(
      "Velocity", {kMinGraspDegPerS, kMaxGraspDegPerS, kMaxGraspDegPerS, 0.2, 1, "deg/s"}, this);
  velocity_->setObjectName("velocity");
  velocity_->field()->setSingleStep(1.0);
  velocity_->setToolTip("Velocity of the joints; slower joints move at their maximum");
  // A new session never begins with the fast motions of another one.
  velocity_->showValue(usual.velocityDegPerS);
  settings.remove("grasp/velocity_deg_per_s");
  limit_ = named(
      new ValueSlider(
          "Limit",
          {kMinGraspLimitCounts, kMaxGraspLimitCounts, kMaxGraspLimitCounts, 1.0, 0, "counts"},
          this),
      "limit");
  limit_->showValue(storedNumber(settings, kLimit, kMinGraspLimitCounts, kMaxGraspLimitCounts)
                        .value_or(usual.limitCounts));

  forceLimit_ =
      named(new ValueSlider("Force limit",
                            {kMinForceLimitN, kMaxForceLimitN, kSliderForceLimitN, 0.05, 2, "N"},
                            this),
            "forceLimit");
  forceLimit_->showValue(storedNumber(settings, kForceLimit, kMinForceLimitN, kMaxForceLimitN)
                             .value_or(kUsualForceLimitN));
  auto* limits = makeBox(inRow({limit_, forceLimit_}), this);

  auto* form = new QFormLayout;
  form->setContentsMargins(0, 0, 0, 0);
  form->setHorizontalSpacing(12);
  form->setVerticalSpacing(6);
  form->addRow("Preshape", preshape_);
  form->addRow("Close ratio", close_);
  form->addRow("Velocity", velocity_);
  limitLabel_ = new QLabel(this);
  form->addRow(limitLabel_, limits);
  makeForecast(*form);
  // Aligns the right edges of the fields.
  fitToText(*this, [this] {
    int widest = 0;
    for (const ValueSlider* each : {close_, velocity_, limit_, forceLimit_})
      widest = std::max(widest, each->field()->sizeHint().width());
    for (const ValueSlider* each : {close_, velocity_, limit_, forceLimit_})
      each->field()->setFixedWidth(widest);
  });

  // The order of creation is the tab order.
  const auto motion = [this](QAction* action, const char* text, const char* name, auto does) {
    auto* button = motionButton(text, name, {}, true, this);
    connect(action, &QAction::triggered, button, &QPushButton::click);
    connect(button, &QPushButton::clicked, this, does);
    return Motion{action, button};
  };
  const auto grasps = [this](GraspMode mode) { return [this, mode] { begin(request(mode)); }; };
  grasp_ = motion(actions.graspHand, "Grasp", "graspHand", grasps(GraspMode::kPlain));
  reactive_ =
      motion(actions.reactiveGrasp, "Reactive", "reactiveGrasp", grasps(GraspMode::kReactive));
  slipAware_ =
      motion(actions.slipAwareGrasp, "Slip-aware", "slipAwareGrasp", grasps(GraspMode::kSlip));
  open_ = motion(actions.openHand, "Open", "openHand", [this] {
    GraspRequest request = this->request(GraspMode::kPlain);
    request.closeRatio = 0.0;
    begin(request);
  });
  relax_ = motion(actions.relaxHand, "Relax", "relaxHand", [this] {
    emit begins();
    if (control_) control_->relax();
    emit asked();
  });
  options_ = new GraspOptions(settings, this);
  auto* buttons =
      inColumn({inRow({{grasp_.button, 1}, {reactive_.button, 1}, {slipAware_.button, 1}}),
                inRow({{open_.button, 1}, {relax_.button, 1}})});
  // Below the buttons, which don't move when it unfolds.
  setLayout(inColumn({form, buttons, options_, Stretch{}}, Space::kWide));

  connect(preshape_, &QComboBox::currentIndexChanged, this, [this] {
    options_->object().setPreshape(preshape_->currentData().toString().toStdString());
    remember();
  });
  options_->object().setPreshape(preshape_->currentData().toString().toStdString());
  connect(keep_, &QCheckBox::toggled, this, [this] {
    remember();
    showLimit();
  });
  connect(&options_->object(), &ObjectFields::forgets, &touches_, &TouchStore::forget);
  connect(&touches_, &TouchStore::changed, this, [this] {
    options_->object().setTouches(touches_.touches());
    renewForecast();
  });
  for (ValueSlider* each : {close_, velocity_, limit_, forceLimit_})
    connect(each, &ValueSlider::chosen, this, &GraspPanel::remember);
  connect(
      close_, &ValueSlider::chosen, this, [this] { settings_.setValue(kClose, close_->value()); });
  connect(options_, &GraspOptions::limitsChanged, this, &GraspPanel::showLimit);
  showLimit();
  showStatus({});
  fitToTheme(*this, [this] { showForecast(); });
}

void GraspPanel::makeForecast(QFormLayout& form) {
  keep_ = named(new QCheckBox("Keep the limit", this), "keepLimit", kKeepTip);
  keep_->setChecked(settings_.value(kKeepLimit, true).toBool());
  forecast_ = new StatusLines(kForecastLines, "graspForecast", this);
  forecast_->label().setTextFormat(Qt::PlainText);
  forecast_->label().setAccessibleDescription("What a reactive grasp is expected to reach");
  form.addRow(QString(), keep_);
  form.addRow(forecast_);
  forecastTimer_.setSingleShot(true);
  forecastTimer_.setInterval(kForecastMs);
  connect(&forecastTimer_, &QTimer::timeout, this, &GraspPanel::showForecast);
}

void GraspPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  showForecast();
}

void GraspPanel::renewForecast() {
  if (isVisible() && !forecastTimer_.isActive()) forecastTimer_.start();
}

void GraspPanel::showForecast() {
  if (!isVisible()) return;
  forecastDeg_ = shown_.anglesDeg;
  QString text;
  QColor color = colorsOf().text;
  // Of the next grasp: while one runs, its state is told above.
  if (control_ && shown_.phase == GraspPhase::kIdle) {
    const GraspRequest request = this->request(GraspMode::kReactive);
    const GraspForecast forecast = control_->forecast(request);
    // A plain grasp watches no limit.
    text = "Reactive: " + QString::fromStdString(describe(forecast, request));
    if (isWarned(forecast)) color = colorsOf().warning;
  }
  forecast_->setText(text);
  const QString style = "color: " + color.name() + ";";
  if (forecast_->label().styleSheet() != style) forecast_->label().setStyleSheet(style);
}

void GraspPanel::setHand(const HandDescription& hand) {
  options_->object().setHand(hand);
  renewForecast();
}

void GraspPanel::setUsualClose(double ratio) {
  if (!settings_.contains(kClose)) close_->showValue(ratio);
}

void GraspPanel::showLimit() {
  const QString name = keep_->isChecked() ? "Limit" : "Stop at";
  limitLabel_->setText(name);
  for (QWidget* each : std::initializer_list<QWidget*>{limit_->field(), limit_->slider()})
    each->setAccessibleName(name);
  renewForecast();
  const bool inNewtons = options_->inNewtons();
  limit_->setVisible(!inNewtons);
  forceLimit_->setVisible(inNewtons);
  for (ValueSlider* each : {limit_, forceLimit_}) {
    each->setEnabled(!options_->eachFinger());
    each->setToolTip(options_->eachFinger() ? "Limits differ per finger; see More"
                     : inNewtons            ? kForceLimitTip
                                            : kLimitTip);
  }
}

void GraspPanel::remember() {
  settings_.setValue(kPreshape, preshape_->currentData());
  settings_.setValue(kLimit, limit_->value());
  settings_.setValue(kForceLimit, forceLimit_->value());
  settings_.setValue(kKeepLimit, keep_->isChecked());
  renewForecast();
}

GraspRequest GraspPanel::request(GraspMode mode) const {
  GraspRequest request;
  request.mode = mode;
  request.preshape = preshape_->currentData().toString().toStdString();
  request.closeRatio = mode == GraspMode::kPlain ? close_->value() : 1.0;
  request.velocityDegPerS = velocity_->value();
  request.limitCounts = static_cast<int>(limit_->value());
  if (mode != GraspMode::kPlain && options_->inNewtons()) {
    request.forceLimitsN = {forceLimit_->value()};
    // A slip-aware grasp raises its limit in counts when the object slips.
    const int highest = mode == GraspMode::kReactive ? highestLimit(request) : 0;
    if (highest > 0) request.limitCounts = highest;
  }
  options_->apply(request);
  if (mode != GraspMode::kPlain && keep_->isChecked()) {
    request.keepsLimit = true;
    options_->object().apply(request);
  }
  return request;
}

void GraspPanel::begin(const GraspRequest& request) {
  if (!control_) return;
  emit begins();
  try {
    control_->grasp(request);
  } catch (const std::exception& error) {
    const auto last = control_->status().last;
    const bool refusedByHand = last && last->outcome == GraspOutcome::kRefused;
    emit refused(refusedByHand ? QString::fromStdString(last->text) : QString(error.what()));
  }
  emit asked();
}

void GraspPanel::setControl(GraspControl* control, const QString& whyNot) {
  control_ = control;
  whyNot_ = whyNot;
  showStatus(control ? control->status() : GraspStatus{});
  renewForecast();
}

void GraspPanel::setCalibrationBeingRead(bool beingRead) {
  calibrationBeingRead_ = beingRead;
  GraspStatus now = shown_;
  now.calibrated = control_ && control_->status().calibrated;
  showStatus(now);
}

void GraspPanel::setInSight(bool on) {
  inSight_ = on;
  showStatus(shown_);
}

void GraspPanel::offer(const Motion& motion, bool can, const QString& tip) {
  enableMotionButton(*motion.button, can);
  if (motion.button->toolTip() != tip) motion.button->setToolTip(tip);
  // Motion keys work only while this dock is in sight; Stop always works.
  motion.action->setEnabled(can && inSight_);
  motion.action->setToolTip(inSight_ ? tip : kNotInSightTip);
  setWhyGreyed(*motion.action, motion.action->isEnabled() ? QString() : motion.action->toolTip());
}

void GraspPanel::showStatus(const GraspStatus& status) {
  const bool wasIdle = std::exchange(shown_, status).phase == GraspPhase::kIdle;
  if (wasIdle != (status.phase == GraspPhase::kIdle) ||
      !std::equal(status.anglesDeg.begin(),
                  status.anglesDeg.end(),
                  forecastDeg_.begin(),
                  forecastDeg_.end(),
                  [](double a, double b) { return std::abs(a - b) < kForecastDeg; }))
    renewForecast();
  using Calibrated = GraspOptions::Calibrated;
  options_->setCalibrated(!control_               ? Calibrated::kNoHand
                          : status.calibrated     ? Calibrated::kYes
                          : calibrationBeingRead_ ? Calibrated::kBeingRead
                                                  : Calibrated::kNot);
  const bool idle = status.phase == GraspPhase::kIdle;
  options_->object().setIdle(idle);
  const bool canMove = control_ && status.cannotMove.empty();
  const bool waits = calibrationBeingRead_ && !status.calibrated && options_->inNewtons();
  const std::string cannotReact = waits ? kCalibrationBeingRead : status.cannotReact;
  const bool canReact = control_ && cannotReact.empty();
  const QString busy = busyText(status);
  const auto why = [&](const std::string& problem) {
    return !control_ ? whyNot_ : QString::fromStdString(problem);
  };
  offer(open_,
        canMove && idle,
        !canMove ? why(status.cannotMove)
        : idle   ? "Open to this preshape"
                 : busy);
  offer(relax_,
        canMove,
        canMove
            ? "Switch the motors off: the fingers can be moved by hand, and a held object may fall"
            : why(status.cannotMove));
  offer(grasp_,
        canMove && idle,
        !idle     ? busy
        : canMove ? "Close to the close ratio, regardless of contact"
                  : why(status.cannotMove));
  offer(reactive_,
        canReact && idle,
        !idle      ? busy
        : canReact ? "Close until the first taxel exceeds the limit"
                   : why(cannotReact));
  offer(slipAware_,
        canReact && idle,
        !idle      ? busy
        : canReact ? "Close to the limit and hold; when the object slips, close to a higher limit. "
                     "Stop ends it; the hand keeps holding"
                   : why(cannotReact));
}

}  // namespace palpate::gui
