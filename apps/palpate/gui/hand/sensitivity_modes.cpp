#include "gui/hand/sensitivity_modes.h"

#include <QButtonGroup>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>

#include "gui/appearance/captions.h"
#include "gui/widgets/make.h"

namespace palpate::gui {
namespace {

constexpr const char* kNoNoiseLines =
    "High sensitivity needs noise lines of this hand: dock Calibrate, page Noise, \"Apply to this "
    "hand\".";

}  // namespace

SensitivityModes::SensitivityModes(QWidget* parent) : QWidget(parent) {
  noiseLines = [](const std::string&) { return std::optional<NoiseFloor>(); };
  buttons_ = new QButtonGroup(this);
  auto* row = new QHBoxLayout;
  row->setSpacing(4);
  const auto add =
      [&](SensitivityMode mode, const char* name, const QString& text, const QString& tip) {
        auto* button = makeToolButton(this, name, text, tip);
        button->setCheckable(true);
        buttons_->addButton(button, static_cast<int>(mode));
        row->addWidget(button);
      };
  add(SensitivityMode::kManual, "sensitivityManual", "By hand", "Use the values set below");
  add(SensitivityMode::kHigh,
      "sensitivityHigh",
      "High sensitivity",
      "Sensitivity 1, thresholds just above the noise: they follow the temperatures, and rise when "
      "noise slows the stream; a filter removes false touches");
  add(SensitivityMode::kAdaptive,
      "sensitivityAdaptive",
      "Adaptive",
      "Find the highest sensitivity at which nothing saturates");
  row->addStretch(1);
  text_ = makeLines(this, "sensitivityStatus", "muted");
  // Fixed height, so that the parts below don't move.
  text_->setMinimumHeight(2 * fontMetrics().lineSpacing());
  setLayout(inColumn({row, text_}, Space::kNarrow));
  connect(buttons_, &QButtonGroup::idClicked, this, [this](int id) {
    choose(static_cast<SensitivityMode>(id));
  });
  setHand(nullptr, nullptr);
}

void SensitivityModes::setHand(CaptureSession* session, GraspControl* control) {
  session_ = session;
  control_ =
      session && control ? std::make_unique<SensitivityControl>(*session, *control) : nullptr;
  showMode(SensitivityMode::kManual);
  setEnabled(control_ != nullptr);
  text_->clear();
}

SensitivityMode SensitivityModes::mode() const {
  return control_ ? control_->status().mode : SensitivityMode::kManual;
}

QString SensitivityModes::statusText() const { return text_->text(); }

void SensitivityModes::showMode(SensitivityMode mode) {
  buttons_->button(static_cast<int>(mode))->setChecked(true);
  const bool was = shown_ == SensitivityMode::kHigh, is = mode == SensitivityMode::kHigh;
  shown_ = mode;
  if (was != is) emit highChanged(is);
}

void SensitivityModes::choose(SensitivityMode mode) {
  if (!control_) return;
  emit asked();
  if (mode == control_->status().mode) return;
  try {
    switch (mode) {
      case SensitivityMode::kManual:
        control_->endMode();
        break;
      case SensitivityMode::kAdaptive:
        control_->beginAdaptiveSensitivity();
        emit changing();
        break;
      case SensitivityMode::kHigh: {
        const auto lines = noiseLines(session_->device().hand().name);
        if (!lines) {
          emit refused(kNoNoiseLines);
          break;
        }
        control_->beginHighSensitivity(*lines);
        emit changing();
        break;
      }
    }
  } catch (const std::invalid_argument& error) {
    emit refused(error.what());
  }
  showMode(control_->status().mode);
}

void SensitivityModes::renewNoiseLines() {
  if (session_ && noiseLines(session_->device().hand().name)) emit refusalEnded(kNoNoiseLines);
}

void SensitivityModes::endMode() {
  if (!control_ || control_->status().mode == SensitivityMode::kManual) return;
  control_->endMode();
  showMode(SensitivityMode::kManual);
}

QString SensitivityModes::describe(const SensitivityStatus& status) const {
  if (status.mode == SensitivityMode::kManual) return {};
  if (!status.waiting.empty()) return "Waits: " + QString::fromStdString(status.waiting);
  if (!status.failure.empty()) return "Not set: " + QString::fromStdString(status.failure);
  if (status.setting) return "The settings are being changed: no frames for half a second.";
  if (status.measuring) return "Measuring the usual rate …";
  if (status.mode == SensitivityMode::kAdaptive) {
    const QString now = "Sensitivity " + figure(status.sensitivity, 2);
    if (status.saturated) return now + ": saturated at the lowest value.";
    if (!status.settled) return now + ": waiting for a contact.";
    return now + (status.highest ? ": not saturated at the highest value."
                                 : ": a higher one would saturate.");
  }
  QString text = "Thresholds follow the temperatures.";
  if (status.noise.guarding)
    text += " Raised by " + QString::number(status.noise.guardCounts) +
            " counts: noise slowed the stream" +
            (status.noise.guardAtLimit ? " (no more is possible)." : ".");
  if (!status.noise.unknown.empty())
    text += " " + QString::number(status.noise.unknown.size()) +
            (status.noise.unknown.size() == 1
                 ? " matrix without a temperature or line keeps the reset value."
                 : " matrices without a temperature or line keep the reset value.");
  else if (!status.noise.extrapolated.empty())
    text += " " + QString::number(status.noise.extrapolated.size()) +
            (status.noise.extrapolated.size() == 1 ? " matrix is" : " matrices are") +
            " outside the measured temperatures.";
  return text;
}

void SensitivityModes::refresh() {
  if (!control_) return;
  control_->step();
  const QString now = describe(control_->status());
  if (text_->text() != now) text_->setText(now);
}

}  // namespace palpate::gui
