#include "gui/hand/grasp_options.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QToolButton>
#include <algorithm>

#include "gui/appearance/captions.h"
#include "gui/appearance/settings_table.h"
#include "gui/hand/object_fields.h"
#include "gui/widgets/make.h"
#include "gui/widgets/number_field.h"

namespace palpate::gui {
namespace {

constexpr const char* kOptionsOpen = "grasp/more";
constexpr const char* kInNewtons = "grasp/limit_in_newtons";
constexpr const char* kEachFinger = "grasp/each_finger";
constexpr const char* kMaximum = "grasp/most_counts";
constexpr const char* kHold = "grasp/hold_s";
constexpr const char* kCalm = "grasp/calm_s";
constexpr double kGravity = 9.81;  // [m/s^2]
constexpr double kUsualForceN = 2.0;
constexpr const char* kNoCalibrationTip =
    "Limits in newtons need a calibration of this hand: dock Calibrate, page Pressure, \"Apply to "
    "this hand\"";

constexpr const char* kWhyCounts = "newtons need a calibration of this hand";

QString fingerKey(const char* unit, std::size_t finger) {
  return QString("grasp/finger_%1_%2").arg(finger).arg(unit);
}

// The stored value, if it is one within the range of the field.
void recall(const QSettings& settings, const QString& key, QDoubleSpinBox& field, double usual) {
  field.setValue(storedNumber(settings, key, field.minimum(), field.maximum()).value_or(usual));
}

}  // namespace

GraspOptions::GraspOptions(QSettings& settings, QWidget* parent)
    : QWidget(parent), settings_(settings) {
  header_ = makeToolButton(this, "moreGraspOptions", "More");
  header_->setToolTip(
      "The object, limits of single fingers and in newtons; how a slip-aware grasp holds");
  header_->setCheckable(true);
  header_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  header_->setProperty("flat", true);
  summary_ = makeLabel(this, "graspOptionsSummary", "muted");
  summary_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  body_ = new QWidget(this);
  object_ = new ObjectFields(body_);
  connect(object_, &ObjectFields::changed, this, &GraspOptions::showChoice);
  // One pair in a row: the column of the hand is narrow.
  auto* form = new QFormLayout;
  body_->setLayout(inColumn({object_, form}, Space::kNarrow));
  form->setHorizontalSpacing(8);
  form->setVerticalSpacing(4);
  makeLimits(*form);
  makeHolding(*form);
  setLayout(inColumn({inRow({header_, {summary_, 1}}), body_}, Space::kNarrow));
  connect(header_, &QToolButton::toggled, this, &GraspOptions::open);
  header_->setChecked(settings.value(kOptionsOpen, false).toBool());
  open(header_->isChecked());
  setCalibrated(Calibrated::kNoHand);
}

QDoubleSpinBox* GraspOptions::field(
    const QString& name, const QString& title, double least, double most, int decimals) {
  auto* made = named(new SecondsField(body_), name, {}, title);
  made->setDecimals(decimals);
  made->setRange(least, most);
  made->setFocusPolicy(Qt::StrongFocus);
  connect(made, &QDoubleSpinBox::valueChanged, this, &GraspOptions::remember);
  return made;
}

void GraspOptions::makeLimits(QFormLayout& form) {
  unit_ = named(new QComboBox(body_), "limitUnit", {}, "Unit of the limit");
  unit_->addItems({"counts", "newtons"});
  form.addRow("Limit in", unit_);
  whyCounts_ = makeLines(body_, "whyCounts", "muted", kWhyCounts);
  whyCounts_->setToolTip(kNoCalibrationTip);
  form.addRow(whyCounts_);
  eachFinger_ = named(new QCheckBox("A limit for each finger: 0, 1, 2", body_), "eachFinger");
  eachFinger_->setToolTip(
      "Set a separate limit for each finger; in counts the largest taxel of the finger, in newtons "
      "its whole force");
  eachFinger_->setChecked(settings_.value(kEachFinger, false).toBool());
  auto* fingers = new QHBoxLayout;
  fingers->setSpacing(6);
  for (std::size_t finger = 0; finger < numMovableFingers(); ++finger) {
    const QString number = QString::number(finger);
    const QString title = "Limit of finger " + number;
    fingerCounts_.push_back(field("fingerLimit" + number,
                                  title + " in counts",
                                  kMinGraspLimitCounts,
                                  kMaxGraspLimitCounts,
                                  0));
    fingerNewtons_.push_back(
        field("fingerForce" + number, title + " in newtons", kMinForceLimitN, kMaxForceLimitN, 2));
    recall(settings_, fingerKey("counts", finger), *fingerCounts_.back(), 200.0);
    recall(settings_, fingerKey("n", finger), *fingerNewtons_.back(), kUsualForceN);
    for (QDoubleSpinBox* each : {fingerCounts_.back(), fingerNewtons_.back()}) {
      each->setToolTip("Limit of finger " + number);
      fingers->addWidget(each, 1);
    }
  }
  form.addRow(eachFinger_);
  form.addRow(fingers);
  connect(unit_, &QComboBox::currentIndexChanged, this, [this] {
    settings_.setValue(kInNewtons, inNewtons());
    showChoice();
  });
  connect(eachFinger_, &QCheckBox::toggled, this, [this] {
    remember();
    showChoice();
  });
}

void GraspOptions::makeHolding(QFormLayout& form) {
  const HoldingOptions usual;
  most_ = field("mostLimit", "Highest limit", kMinGraspLimitCounts, kMaxGraspLimitCounts, 0);
  most_->setToolTip("Slip-aware: slips raise the limit up to this");
  recall(settings_, kMaximum, *most_, usual.maxLimitCounts);
  calm_ = field("calmTime", "Ease after", 0.1, 86'400.0, 1);
  calm_->setToolTip("Slip-aware: after this time without slip the limit falls again");
  recall(settings_, kCalm, *calm_, usual.noSlipS);
  hold_ =
      field("holdTime", "Hold", HoldingOptions::kHoldS.minimum, HoldingOptions::kHoldS.maximum, 1);
  hold_->setToolTip("Slip-aware: ends after this time; the hand keeps holding. 0: until stopped");
  hold_->setSpecialValueText("until stopped");
  recall(settings_, kHold, *hold_, usual.holdS);
  loosen_ = named(new QCheckBox("Loosen", body_), "loosenHand");
  loosen_->setToolTip(
      "Slip-aware: the hand may open slowly to a limit that fell. Off in each new session");
  mass_ = field("objectMass",
                "Object mass",
                HoldingOptions::kMassKg.minimum,
                HoldingOptions::kMassKg.maximum,
                3);
  mass_->setToolTip(
      "Slip-aware: opens slowly once, until it slips, and measures the friction. Not kept for the "
      "next session");
  mass_->setSpecialValueText("not known");
  newtonsPerCount_ = field("newtonsPerCount", "Newtons per count", 0.0, 1.0, 6);
  newtonsPerCount_->setToolTip("From a calibration, for the friction; needs the object mass");
  newtonsPerCount_->setSpecialValueText("not known");
  form.addRow(makeLabel(body_, {}, "muted", "Slip-aware grasp"));
  form.addRow("Highest limit, counts", most_);
  form.addRow("Ease after, s", calm_);
  form.addRow("Hold, s", hold_);
  form.addRow(loosen_);
  form.addRow("Object, kg", mass_);
  form.addRow("N/count", newtonsPerCount_);
  connect(loosen_, &QCheckBox::toggled, this, &GraspOptions::remember);
}

void GraspOptions::open(bool on) {
  header_->setArrowType(on ? Qt::DownArrow : Qt::RightArrow);
  body_->setVisible(on);
  settings_.setValue(kOptionsOpen, on);
  showChoice();
}

bool GraspOptions::inNewtons() const { return unit_->currentIndex() == 1; }
bool GraspOptions::eachFinger() const { return eachFinger_->isChecked(); }

void GraspOptions::setCalibrated(Calibrated state) {
  const bool calibrated = state == Calibrated::kYes, beingRead = state == Calibrated::kBeingRead;
  const int unit = (calibrated || beingRead) && settings_.value(kInNewtons, false).toBool() ? 1 : 0;
  const bool missed = state == Calibrated::kNot;
  if (unit != unit_->currentIndex() || whyCounts_->isHidden() == missed) {
    const QSignalBlocker notChosen(unit_);
    unit_->setCurrentIndex(unit);
    whyCounts_->setVisible(missed);
    showChoice();
  }
  unit_->setEnabled(calibrated);
  const QString tip = calibrated  ? "In counts for one taxel, or in newtons for a whole finger, by "
                                    "the calibration applied to this hand"
                      : beingRead ? kCalibrationBeingRead
                                  : kNoCalibrationTip;
  if (unit_->toolTip() != tip) unit_->setToolTip(tip);
}

void GraspOptions::showChoice() {
  for (QDoubleSpinBox* each : fingerCounts_) {
    each->setVisible(!inNewtons());
    each->setEnabled(eachFinger());
  }
  for (QDoubleSpinBox* each : fingerNewtons_) {
    each->setVisible(inNewtons());
    each->setEnabled(eachFinger());
  }
  summary_->setText(header_->isChecked() ? QString() : summary());
  summary_->setToolTip(summary_->text());
  emit limitsChanged();
}

QString GraspOptions::summary() const {
  QStringList parts;
  if (const QString object = object_->text(); !object.isEmpty()) parts += object;
  if (inNewtons()) parts += "limit in newtons";
  if (!whyCounts_->isHidden() && settings_.value(kInNewtons, false).toBool())
    parts += QString("limit in counts: ") + kWhyCounts;
  if (eachFinger()) parts += "a limit for each finger";
  if (hold_->value() > 0.0) parts += "holds " + figure(hold_->value(), 1) + " s";
  if (loosen_->isChecked()) parts += "loosens";
  if (mass_->value() > 0.0) parts += "measures friction";
  return parts.join(", ");
}

void GraspOptions::remember() {
  // A field that is being made.
  if (!newtonsPerCount_) return;
  settings_.setValue(kEachFinger, eachFinger());
  settings_.setValue(kMaximum, most_->value());
  settings_.setValue(kHold, hold_->value());
  settings_.setValue(kCalm, calm_->value());
  for (std::size_t finger = 0; finger < fingerCounts_.size(); ++finger) {
    settings_.setValue(fingerKey("counts", finger), fingerCounts_[finger]->value());
    settings_.setValue(fingerKey("n", finger), fingerNewtons_[finger]->value());
  }
  if (eachFinger()) emit limitsChanged();
}

void GraspOptions::apply(GraspRequest& request) const {
  const bool feels = request.mode != GraspMode::kPlain;
  if (feels && eachFinger() && inNewtons()) {
    request.forceLimitsN.clear();
    for (const QDoubleSpinBox* each : fingerNewtons_) request.forceLimitsN.push_back(each->value());
  } else if (feels && eachFinger()) {
    for (const QDoubleSpinBox* each : fingerCounts_)
      request.fingerLimitCounts.push_back(static_cast<int>(each->value()));
    request.limitCounts =
        *std::max_element(request.fingerLimitCounts.begin(), request.fingerLimitCounts.end());
  }
  HoldingOptions& holding = request.holding;
  // A limit above the highest one is not reduced.
  holding.maxLimitCounts = std::max(static_cast<int>(most_->value()), request.limitCounts);
  holding.noSlipS = calm_->value();
  holding.holdS = hold_->value();
  holding.loosen = loosen_->isChecked();
  holding.weightN = kGravity * mass_->value();
  holding.newtonsPerCount = newtonsPerCount_->value();
}

}  // namespace palpate::gui
