#include "gui/record/recording_timing.h"

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QSpinBox>
#include <algorithm>

#include "gui/widgets/make.h"

namespace palpate::gui {
namespace {

// A field whose 0 means "none". A typed value below the least one becomes the least one: only 0 is
// none.
class TimingField : public QDoubleSpinBox {
 public:
  TimingField(double least, QWidget* parent) : QDoubleSpinBox(parent), least_(least) {}
  double valueFromText(const QString& text) const override {
    QString number = text;
    if (number.endsWith(suffix())) number.chop(suffix().size());
    bool isNumber = false;
    const double typed = locale().toDouble(number.trimmed(), &isNumber);
    if (isNumber && typed > 0.0 && typed < least_) return least_;
    return QDoubleSpinBox::valueFromText(text);
  }
  // More decimals may be typed than are shown.
  QValidator::State validate(QString& text, int& position) const override {
    QString number = text;
    if (number.endsWith(suffix())) number.chop(suffix().size());
    bool isNumber = false;
    const double typed = locale().toDouble(number.trimmed(), &isNumber);
    if (isNumber && typed >= 0.0 && typed <= maximum()) return QValidator::Acceptable;
    return QDoubleSpinBox::validate(text, position);
  }

 private:
  double least_;
};

QDoubleSpinBox* timingField(const char* name,
                            double least,
                            double most,
                            int decimals,
                            const QString& suffix,
                            const QString& none,
                            const QString& tip,
                            QWidget* parent) {
  auto* field = named(new TimingField(least, parent), name, tip, tip);
  field->setRange(0.0, most);
  field->setDecimals(decimals);
  field->setSuffix(suffix);
  field->setSpecialValueText(none);
  field->setButtonSymbols(QAbstractSpinBox::NoButtons);
  return field;
}

// The value of a field, at least `least`; nothing: none.
std::optional<double> timingValue(const QDoubleSpinBox& field, double least) {
  if (!(field.value() > 0.0)) return std::nullopt;
  return std::max(least, field.value());
}

QWidget* timingRow(std::initializer_list<QWidget*> fields, QWidget* parent) {
  auto* row = new QWidget(parent);
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(8);
  for (QWidget* field : fields) layout->addWidget(field, qobject_cast<QLabel*>(field) ? 0 : 1);
  row->setFocusProxy(*fields.begin());
  return row;
}

}  // namespace

RecordingTiming::RecordingTiming(QWidget* parent)
    : FoldingPart("timing",
                  "Start and &end",
                  "When recording starts and stops automatically, and when a new file is started",
                  parent) {
  using Limits = RecordingLimits;
  QWidget* made = body();
  auto* form = new QFormLayout(made);
  form->setContentsMargins(0, 2, 0, 0);
  form->setHorizontalSpacing(12);
  form->setVerticalSpacing(6);
  countdown_ = named(new QSpinBox(made),
                     "recordingCountdown",
                     "Seconds counted down before recording starts; Esc cancels");
  countdown_->setRange(0, RecordingSettings::kMaxCountdownS);
  countdown_->setSuffix(" s");
  countdown_->setSpecialValueText("none");
  countdown_->setButtonSymbols(QAbstractSpinBox::NoButtons);
  countdown_->setAccessibleName(countdown_->toolTip());
  form->addRow("Count&down", countdown_);
  onContact_ = named(new QCheckBox("When touc&hed", made), "recordingOnContact");
  onContact_->setToolTip(
      "Recording waits until 3 taxels are touched in 3 frames, and includes the two seconds "
      "before");
  threshold_ = timingField("recordingContactThreshold",
                           0.0,
                           kMaxContactThreshold,
                           2,
                           "",
                           "any active taxel",
                           "A taxel is touched above this value, in the unit of the hand (counts)",
                           made);
  form->addRow("Begin", timingRow({onContact_, new QLabel("above", made), threshold_}, made));
  stopAfter_ = timingField("recordingStopAfter",
                           Limits::kStopAfterS.minimum,
                           Limits::kStopAfterS.maximum,
                           2,
                           " s",
                           "not automatically",
                           "Time after the first frame when the recording stops automatically",
                           made);
  form->addRow("&Stop after", stopAfter_);
  released_ =
      timingField("recordingReleased",
                  kMinReleasedS,
                  kMaxReleasedS,
                  2,
                  " s",
                  "not by release",
                  "Recording stops when, after a touch, nothing has been touched for this long",
                  made);
  form->addRow("Stop &untouched for", released_);
  splitMinutes_ = timingField("recordingSplitMinutes",
                              Limits::kSplitMinutes.minimum,
                              Limits::kSplitMinutes.maximum,
                              2,
                              " min",
                              "never",
                              "After this many minutes the recording continues in a new file: "
                              "NAME_002.palpate, .. Nothing is lost in between",
                              made);
  splitMb_ = timingField("recordingSplitMb",
                         Limits::kSplitMb.minimum,
                         Limits::kSplitMb.maximum,
                         1,
                         " MB",
                         "never",
                         "At about this many megabytes the recording continues in a new file",
                         made);
  form->addRow("Ne&w file every",
               timingRow({splitMinutes_, new QLabel("or", made), splitMb_}, made));
  connect(countdown_, &QSpinBox::valueChanged, this, [this] { sumUp(); });
  connect(onContact_, &QCheckBox::toggled, this, [this] { sumUp(); });
  for (QDoubleSpinBox* field : {threshold_, stopAfter_, released_, splitMinutes_, splitMb_})
    connect(field, &QDoubleSpinBox::valueChanged, this, [this] { sumUp(); });
  sumUp();
}

void RecordingTiming::fill(const RecordingSettings& settings) {
  countdown_->setValue(settings.countdownS);
  onContact_->setChecked(settings.startOnContact);
  threshold_->setValue(settings.contactThreshold);
  released_->setValue(settings.stopWithoutContactS.value_or(0.0));
  stopAfter_->setValue(settings.limits.stopAfterS.value_or(0.0));
  splitMinutes_->setValue(settings.limits.splitMinutes.value_or(0.0));
  splitMb_->setValue(settings.limits.splitMb.value_or(0.0));
}

void RecordingTiming::readInto(RecordingSettings& settings) const {
  using Limits = RecordingLimits;
  settings.countdownS = countdown_->value();
  settings.startOnContact = onContact_->isChecked();
  settings.contactThreshold = threshold_->value();
  settings.stopWithoutContactS = timingValue(*released_, kMinReleasedS);
  settings.limits.stopAfterS = timingValue(*stopAfter_, Limits::kStopAfterS.minimum);
  settings.limits.splitMinutes = timingValue(*splitMinutes_, Limits::kSplitMinutes.minimum);
  settings.limits.splitMb = timingValue(*splitMb_, Limits::kSplitMb.minimum);
}

QString RecordingTiming::summary() const {
  RecordingSettings settings;
  readInto(settings);
  QStringList parts;
  if (settings.countdownS > 0) parts << QString("%1 s countdown").arg(settings.countdownS);
  if (settings.startOnContact) parts << "begins when touched";
  if (settings.stopWithoutContactS)
    parts << "stops untouched for " + QString::number(*settings.stopWithoutContactS) + " s";
  if (const std::string limits = textOf(settings.limits); !limits.empty())
    parts << QString::fromStdString(limits);
  return parts.isEmpty() ? "until it is stopped, in one file" : parts.join(", ");
}

}  // namespace palpate::gui
