#include "gui/slip/slip_controls.h"

#include <QComboBox>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>

#include "gui/appearance/settings_table.h"
#include "gui/widgets/make.h"
#include "gui/widgets/number_field.h"
#include "gui/widgets/text_fit.h"

namespace palpate::gui {
namespace {

constexpr const char* kMethod = "slip/method";
constexpr const char* kLiveMethod = "slip/live_method";
constexpr const char* kReference = "slip/reference";
constexpr const char* kStep = "slip/step_taxels";
constexpr const char* kWhole = "slip/reference_taxels";
constexpr const char* kRotation = "slip/rotation_deg";
constexpr SlipMethod kUsualMethod = SlipMethod::kContest;
constexpr SlipMethod kUsualLiveMethod = SlipMethod::kCentroid;
enum ReferenceRow { kRestRow, kFirstRow, kFrameRow };

QString tipOf(SlipMethod method) {
  switch (method) {
    case SlipMethod::kCentroid:
      return "Centroid of all active taxels: fast, but a load shift looks like motion";
    case SlipMethod::kAlcazar:
      return "Centre of mass of the full convolution: the same as the centroid";
    case SlipMethod::kNccParaboloid:
      return "Normalised cross-correlation, paraboloid around its peak";
    case SlipMethod::kNccGauss3:
      return "Normalised cross-correlation, three-point Gaussians around its peak";
    case SlipMethod::kPhase:
      return "Cross-power spectrum, not normalised";
    case SlipMethod::kPhaseNormalized:
      return "Phase of the cross-power spectrum alone";
    case SlipMethod::kRegister:
      return "Rigid registration of a key frame: no drift";
    case SlipMethod::kContest:
      return "Registration, compared with a load shift without motion";
  }
  return {};
}

}  // namespace

SlipControls::SlipControls(QSettings& settings, QWidget* parent)
    : QWidget(parent), settings_(settings) {
  const auto box = [this](const char* name, const QString& label) {
    auto* made = named(new QComboBox(this), name, {}, label);
    made->setFocusPolicy(Qt::StrongFocus);
    made->setSizeAdjustPolicy(QComboBox::AdjustToContents);
    return made;
  };
  method_ = box("slipMethod", "Method");
  for (const SlipMethod each : slipMethods()) {
    method_->addItem(QString::fromUtf8(nameOf(each)));
    method_->setItemData(method_->count() - 1, tipOf(each), Qt::ToolTipRole);
  }
  reference_ = box("slipReference", "Motion is measured from");
  reference_->addItems({"rest", "first contact"});
  reference_->setItemData(
      kRestRow, "Each contact, from when it is at rest; again after a slip", Qt::ToolTipRole);
  reference_->setItemData(kFirstRow, "The first frame with an active taxel, kept", Qt::ToolTipRole);
  reference_->setToolTip("Where motion is measured from");
  reference_->setCurrentIndex(settings.value(kReference).toString() == "first" ? kFirstRow
                                                                               : kRestRow);
  set_ =
      makeButton(this, "slipSetReference", "Set reference", "Measure motion from the frame shown");
  set_->setFocusPolicy(Qt::TabFocus);
  const SlipSeriesOptions usual;
  step_ = field("slipStep", "Step, in taxels per frame", kStep, 2.0, 0.01, 2, usual.stepTaxels);
  whole_ = field(
      "slipWhole", "Since the reference, in taxels", kWhole, 25.0, 0.25, 2, usual.referenceTaxels);
  rotation_ = field("slipRotation",
                    "Rotation since the reference, in degrees",
                    kRotation,
                    90.0,
                    1.0,
                    1,
                    usual.rotationDeg);

  const auto muted = [this](const QString& text) { return makeLabel(this, {}, "muted", text); };
  auto* how =
      inRow({muted("Method"), method_, Space::kUsual, muted("from"), reference_, Stretch{}, set_});
  auto* limits = inRow({muted("Slip: step over"),
                        step_,
                        muted("in all"),
                        whole_,
                        muted("taxels, turned"),
                        rotation_,
                        muted("deg"),
                        Stretch{}});
  setLayout(inColumn({how, limits}));

  setLive(false);
  connect(method_, &QComboBox::activated, this, [this] {
    showLimits();
    remember();
    emit changed();
  });
  connect(reference_, &QComboBox::activated, this, [this](int row) {
    if (row == kFrameRow) return;
    frame_.reset();
    showReference();
    remember();
    emit changed();
  });
  connect(set_, &QPushButton::clicked, this, &SlipControls::referenceRequested);
  for (QDoubleSpinBox* each : {step_, whole_, rotation_})
    connect(each, &QDoubleSpinBox::valueChanged, this, [this] {
      remember();
      emit changed();
    });
}

QDoubleSpinBox* SlipControls::field(const char* name,
                                    const QString& label,
                                    const char* key,
                                    double most,
                                    double step,
                                    int decimals,
                                    double usual) {
  auto* made = named(new SecondsField(this), name, label, label);
  made->setDecimals(decimals);
  made->setRange(step, most);
  made->setSingleStep(step);
  made->setFocusPolicy(Qt::StrongFocus);
  made->setKeyboardTracking(false);
  fitToText(*made,
            [made] { made->setFixedWidth(made->fontMetrics().horizontalAdvance("00.00") + 18); });
  made->setValue(storedNumber(settings_, key, step, most).value_or(usual));
  return made;
}

void SlipControls::remember() {
  settings_.setValue(live_ ? kLiveMethod : kMethod, method_->currentText());
  if (!frame_)
    settings_.setValue(kReference, reference_->currentIndex() == kFirstRow ? "first" : "rest");
  settings_.setValue(kStep, step_->value());
  settings_.setValue(kWhole, whole_->value());
  settings_.setValue(kRotation, rotation_->value());
}

void SlipControls::setLive(bool live) {
  live_ = live;
  const QString kept = settings_.value(live ? kLiveMethod : kMethod).toString();
  const auto method =
      slipMethodNamed(kept.toStdString()).value_or(live ? kUsualLiveMethod : kUsualMethod);
  method_->setCurrentText(QString::fromUtf8(nameOf(method)));
  showLimits();
  setReferenceFrame(std::nullopt);
}

// With the method contest the figures of a frame are no plain limits.
void SlipControls::showLimits() {
  const SlipMethod method = options().method;
  method_->setToolTip(tipOf(method));
  const bool contest = method == SlipMethod::kContest;
  for (QDoubleSpinBox* each : {step_, whole_, rotation_})
    each->setToolTip(each->accessibleName() +
                     (contest ? "\nWith contest (load shift) it only scales which motions of "
                                "several frames are compared with a load shift;\nthe comparison "
                                "decides, and a slip lasts until the contact is at rest"
                              : ""));
}

void SlipControls::setReferenceFrame(std::optional<std::size_t> frame) {
  frame_ = frame;
  showReference();
}

void SlipControls::showReference() {
  const QSignalBlocker blocker(reference_);
  if (!frame_) {
    if (reference_->count() <= kFrameRow) return;
    const bool wasFrame = reference_->currentIndex() == kFrameRow;
    reference_->removeItem(kFrameRow);
    if (wasFrame)
      reference_->setCurrentIndex(settings_.value(kReference).toString() == "first" ? kFirstRow
                                                                                    : kRestRow);
    return;
  }
  const QString text = "frame " + QString::number(*frame_);
  if (reference_->count() <= kFrameRow)
    reference_->addItem(text);
  else
    reference_->setItemText(kFrameRow, text);
  reference_->setCurrentIndex(kFrameRow);
}

void SlipControls::setReferenceEnabled(bool enabled) { set_->setEnabled(enabled); }

SlipSeriesOptions SlipControls::options() const {
  SlipSeriesOptions options;
  options.method = slipMethodNamed(method_->currentText().toStdString()).value_or(kUsualMethod);
  options.reference =
      reference_->currentIndex() == kFirstRow ? SlipReference::kFirst : SlipReference::kWhenAtRest;
  options.referenceFrame = frame_;
  options.stepTaxels = step_->value();
  options.referenceTaxels = whole_->value();
  options.rotationDeg = rotation_->value();
  return options;
}

}  // namespace palpate::gui
