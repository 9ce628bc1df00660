#include "gui/timeline/formula_dialog.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <array>

#include <palpate/signals/signal_name.h>

#include "gui/appearance/hand_unit.h"
#include "gui/appearance/plotted_signal.h"
#include "gui/chart/plotted_curve.h"
#include "gui/widgets/make.h"

namespace palpate::gui {
namespace {

// %1 is the signal, %2 the other one.
struct Operation {
  const char* caption;
  const char* formula;
  const char* name;
  // What is added to the unit.
  const char* unit;
  bool ofTwo = false;
};
constexpr std::array kOperations = {
    Operation{"itself", "%1", "%1", ""},
    Operation{"its derivative", "der(%1)", "%1 · slope", "/s"},
    Operation{"minus another", "%1 - %2", "%1 − %2", "", true},
    Operation{"divided by another", "%1 / %2", "%1 / %2", nullptr, true},
    Operation{"low-pass", "lowpass(%1, 5)", "%1 · low-pass 5 Hz", ""},
    Operation{"high-pass", "highpass(%1, 0.5)", "%1 · high-pass 0.5 Hz", ""},
    Operation{"band-pass", "bandpass(%1, 1, 5)", "%1 · band-pass 1–5 Hz", ""},
    Operation{"band-stop (notch)", "bandstop(%1, 4, 6)", "%1 · band-stop 4–6 Hz", ""},
    Operation{"running mean", "smooth(%1, 9)", "%1 · mean of 9", ""},
    Operation{"running median", "median(%1, 5)", "%1 · median of 5", ""}};

}  // namespace

std::vector<FormulaSignal> formulaSignals(const Profile& profile,
                                          SignalKind signal,
                                          const TaxelSelection& chosen) {
  std::vector<FormulaSignal> found;
  const HandDescription& hand = profile.hand();
  const SensorLayout& layout = *hand.layout;
  const auto add = [&](const QString& caption, const SeriesChoice& choice) {
    found.push_back(
        {caption, QString::fromStdString(palpate::nameOf(choice, layout)), unitOf(choice, hand)});
  };
  if (chosen.count() == 1 && TaxelSelection(layout).sameSensor(chosen))
    add("the chosen taxel", {.kind = SeriesChoice::Kind::kTaxels, .taxels = chosen});
  // The whole hand has no components.
  const std::size_t rows = layout.numMatrices() + (isComponent(signal) ? 0 : 1);
  for (std::size_t m = 0; m < rows; ++m)
    add((m < layout.numMatrices() ? QString::fromStdString(hand.matrixName(m))
                                  : QString("whole hand")) +
            " " + nameOf(signal),
        {.index = m, .signal = signal});
  for (std::size_t axis = 0; axis < hand.axes.size(); ++axis)
    add(QString::fromStdString(hand.axes[axis].name) + " joint",
        {.kind = SeriesChoice::Kind::kAngle, .index = axis});
  for (std::size_t sensor = 0; sensor < hand.temperatureSensors.size(); ++sensor)
    add(QString::fromStdString(hand.temperatureSensors[sensor].name),
        {.kind = SeriesChoice::Kind::kTemperature, .index = sensor});
  for (const SeriesDescription& series : furtherSeriesOf(profile)) {
    if (series.role == kComputedRole && !profile.seriesNamed(series.name)) continue;
    for (std::size_t column = 0; column < series.columns.size(); ++column) {
      const PlottedCurve curve = columnCurve(series, column, 0);
      add(curve.name, curve.choice);
      found.back().unit = curve.baseUnit;
    }
  }
  return found;
}

FormulaDialog::FormulaDialog(std::vector<FormulaSignal> from,
                             const Profile& profile,
                             const FormulaCurve& before,
                             QWidget* parent)
    : QDialog(parent), from_(std::move(from)), profile_(profile) {
  setObjectName("FormulaDialog");
  setWindowTitle(before.name.isEmpty() ? "Curve by a formula or filter" : "Change " + before.name);
  const auto box = [this](const char* name, const QString& tip) {
    auto* made = named(new QComboBox(this), name, tip, tip);
    made->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    made->setMinimumContentsLength(18);
    return made;
  };
  of_ = box("formulaOf", "The signal that the curve is made of");
  operation_ = box("formulaOperation", "What is made of it");
  other_ = box("formulaOther", "The other signal");
  for (const FormulaSignal& each : from_) {
    of_->addItem(each.caption);
    other_->addItem(each.caption);
  }
  for (const Operation& each : kOperations) operation_->addItem(each.caption);
  operation_->setPlaceholderText("own formula");
  for (QComboBox* each : {of_, operation_})
    connect(each, &QComboBox::activated, this, &FormulaDialog::proposeOther);
  for (QComboBox* each : {of_, operation_, other_})
    connect(each, &QComboBox::activated, this, &FormulaDialog::write);
  other_->setEnabled(false);
  const auto field = [this](const char* name, const QString& tip, const QString& text) {
    return named(new QLineEdit(text, this), name, tip, tip.section('\n', 0, 0));
  };
  formula_ =
      field("formulaText",
            "The formula\nSignals: m1_mean, hand_sum, m5_x2_y9 (matrix, column, row), angle3, "
            "temperature4, wrist_fz (series, column), t [s]\nOperators + - * / ^ ( ), comparisons, "
            "a ? b : c; functions "
            "abs sqrt min max exp ln sin ..\nder(x), smooth(x, samples), median(x, samples), "
            "lowpass(x, Hz), highpass(x, Hz), bandpass(x, low, high), "
            "bandstop(x, low, high)",
            before.formula);
  formula_->setMaxLength(1000);
  formula_->setMinimumWidth(formula_->fontMetrics().horizontalAdvance(QString(52, 'n')));
  name_ = field("formulaName", "Its name in the legend", before.name);
  name_->setMaxLength(FormulaCurves::kMaxNameLength);
  unit_ = field("formulaUnit", "Its unit; curves of one unit share an axis", before.unit);
  problem_ = makeLines(this, "formulaProblem");
  problem_->setMinimumHeight(2 * problem_->fontMetrics().lineSpacing());
  problem_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, this);
  good_ = buttons->button(QDialogButtonBox::Ok);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* made = inRow({{of_, 1}, operation_, {other_, 1}});
  auto* form = new QFormLayout;
  form->addRow("&Make of", made);
  static_cast<QLabel*>(form->labelForField(made))->setBuddy(of_);
  form->addRow("&Formula", formula_);
  form->addRow("&Name", name_);
  form->addRow("&Unit", unit_);
  setLayout(inColumn({form, problem_, Stretch{}, buttons}, kPageEdges));
  connect(formula_, &QLineEdit::textChanged, this, &FormulaDialog::check);
  connect(name_, &QLineEdit::textChanged, this, &FormulaDialog::check);
  connect(name_, &QLineEdit::textEdited, this, [this] { ownName_ = true; });
  connect(unit_, &QLineEdit::textEdited, this, [this] {
    ownUnit_ = true;
    check();
  });
  // A formula of one's own isn't what the lists above have named.
  connect(formula_, &QLineEdit::textEdited, this, [this](const QString& text) {
    if (!ownName_) name_->setText(text.simplified().left(FormulaCurves::kMaxNameLength));
    if (!ownUnit_) unit_->clear();
    operation_->setCurrentIndex(-1);
    other_->setEnabled(false);
    check();
  });
  ownName_ = ownUnit_ = !before.name.isEmpty();
  if (before.formula.isEmpty()) {
    write();
  } else {
    operation_->setCurrentIndex(-1);
    check();
  }
}

FormulaCurve FormulaDialog::curve() const {
  return {name_->text().simplified(), formula_->text().simplified(), unit_->text().simplified()};
}

QString FormulaDialog::problem() const {
  const FormulaCurve now = curve();
  if (QString wrong = problemOf(now.formula, &profile_); !wrong.isEmpty()) return wrong;
  return now.name.isEmpty() ? "The curve needs a name." : QString();
}

// The other signal is not the signal itself: the next one of the same unit, else the next one.
void FormulaDialog::proposeOther() {
  const int count = static_cast<int>(from_.size());
  const int of = of_->currentIndex();
  if (count < 2 || other_->currentIndex() != of) return;
  const auto unitAt = [&](int at) { return from_.at(static_cast<std::size_t>(at)).unit; };
  int proposed = (of + 1) % count;
  for (int step = 1; step < count; ++step) {
    const int at = (of + step) % count;
    if (unitAt(at) != unitAt(of)) continue;
    proposed = at;
    break;
  }
  other_->setCurrentIndex(proposed);
}

void FormulaDialog::write() {
  // A choice in one of the lists replaces a formula of one's own.
  if (operation_->currentIndex() < 0) operation_->setCurrentIndex(0);
  const Operation& operation = kOperations.at(static_cast<std::size_t>(operation_->currentIndex()));
  other_->setEnabled(operation.ofTwo);
  if (from_.empty()) return check();
  const FormulaSignal& of = from_.at(static_cast<std::size_t>(of_->currentIndex()));
  const FormulaSignal& other = from_.at(static_cast<std::size_t>(other_->currentIndex()));
  const auto filled = [&](const char* text, const QString& first, const QString& second) {
    QString made = QString(text).replace("%1", first);
    return made.replace("%2", second);
  };
  formula_->setText(filled(operation.formula, of.name, other.name));
  unit_->setText(operation.unit ? of.unit + operation.unit : QString());
  if (!ownName_) name_->setText(filled(operation.name, of.caption, other.caption));
  check();
}

void FormulaDialog::check() {
  const QString wrong = problem();
  const bool withoutUnit = operation_->currentIndex() < 0 && unit_->text().simplified().isEmpty();
  problem_->setText(!wrong.isEmpty() ? wrong
                    : withoutUnit ? "Computed at every frame. Its unit isn't known: type it below "
                                    "its name, if it has one."
                                  : "Computed at every frame.");
  good_->setEnabled(wrong.isEmpty());
}

}  // namespace palpate::gui
