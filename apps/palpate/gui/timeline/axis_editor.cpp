#include "gui/timeline/axis_editor.h"

#include <QCheckBox>
#include <QGridLayout>
#include <QLabel>
#include <QScreen>
#include <algorithm>

#include "gui/chart/plot.h"
#include "gui/widgets/make.h"
#include "gui/widgets/number_field.h"

namespace palpate::gui {
namespace {

constexpr double kFurthest = 1e9;

SecondsField* endField(QWidget* parent, double value, int decimals, const QString& name) {
  auto* field = new SecondsField(parent);
  field->setSuffix({});
  field->setRange(-kFurthest, kFurthest);
  field->setDecimals(decimals);
  field->setValue(value);
  field->setAccessibleName(name);
  field->setToolTip(name);
  field->setKeyboardTracking(false);
  // Tab comes to it, between the two boxes of its line.
  field->setFocusPolicy(Qt::StrongFocus);
  constexpr int kFieldWidth = 110;  // [px]
  field->setMinimumWidth(kFieldWidth);
  return field;
}

}  // namespace

AxisEditor::AxisEditor(QWidget* parent) : QFrame(parent, Qt::Popup) {
  setObjectName("AxisEditor");
  setFrameShape(QFrame::StyledPanel);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(10, 10, 10, 10);
}

void AxisEditor::rebuild() {
  delete rows_;
  rows_ = new QWidget(this);
  auto* grid = new QGridLayout(rows_);
  grid->setContentsMargins(0, 0, 0, 0);
  layout()->addWidget(rows_);
  if (axes_->units().empty())
    grid->addWidget(new QLabel("no curve is shown: choose some with Curves", rows_), 0, 0);
  int row = 0;
  for (const QString& unit : axes_->units()) {
    const QString name = axes_->nameOf(unit);
    const bool byHand = axes_->byHand().contains(unit);
    const QCPRange range = axes_->of(unit)->range();
    auto* automatic = named(new QCheckBox("automatic", rows_),
                            "automaticAxis",
                            "The axis follows the visible values",
                            name + ": automatic");
    automatic->setChecked(!byHand);
    constexpr int kUsualDecimals = 2;
    const int decimals = kUsualDecimals + axes_->conversionOf(unit).moreDecimals;
    auto* from = endField(rows_, range.lower, decimals, name + ": start of the axis");
    from->setObjectName("axisFrom");
    auto* to = endField(rows_, range.upper, decimals, name + ": end of the axis");
    to->setObjectName("axisTo");
    grid->addWidget(new QLabel(name, rows_), row, 0);
    grid->addWidget(automatic, row, 1);
    grid->addWidget(from, row, 2);
    grid->addWidget(new QLabel("to", rows_), row, 3);
    grid->addWidget(to, row, 4);
    auto* log = named(new QCheckBox("log", rows_),
                      "logAxis",
                      "A logarithmic axis: it shows only values above 0",
                      name + ": logarithmic");
    log->setChecked(axes_->logarithmic().contains(unit));
    connect(log, &QCheckBox::toggled, this, [this, unit](bool on) {
      if (axes_) axes_->setLogarithmic(unit, on);
    });
    grid->addWidget(log, row, 5);
    ++row;
    const auto use = [this, unit, name, automatic, from, to] {
      if (!axes_) return;
      const bool good = from->value() < to->value();
      from->refused().showMark(!good);
      to->refused().showMark(!good);
      say(good ? QString()
               : name + ": the start " + from->text() + " isn't below the end " + to->text() +
                     ". The axis stays as it was: give a smaller start or a larger end.");
      if (!good) {
        const QSignalBlocker quiet(automatic);
        return automatic->setChecked(!axes_->byHand().contains(unit));
      }
      automatic->setChecked(false);
      axes_->setByHand(unit, AxisRange{from->value(), to->value()});
    };
    connect(from, &QDoubleSpinBox::valueChanged, this, use);
    connect(to, &QDoubleSpinBox::valueChanged, this, use);
    connect(automatic, &QCheckBox::toggled, this, [this, unit, use, from, to](bool on) {
      if (!axes_) return;
      if (!on) return use();
      axes_->setByHand(unit, std::nullopt);
      const QCPRange now = axes_->of(unit)->range();
      const QSignalBlocker quietFrom(from);
      const QSignalBlocker quietTo(to);
      from->setValue(now.lower);
      to->setValue(now.upper);
      from->refused().showMark(false);
      to->refused().showMark(false);
      say({});
    });
  }
  problem_ = makeLines(rows_, "axisProblem");
  problem_->hide();
  constexpr int kColumns = 6;
  grid->addWidget(problem_, row, 0, 1, kColumns);
}

void AxisEditor::say(const QString& problem) {
  if (problem_->text() == problem) return;
  problem_->setText(problem);
  problem_->setVisible(!problem.isEmpty());
  rows_->layout()->activate();
  layout()->activate();
  adjustSize();
}

void AxisEditor::openBeside(const QWidget& widget, UnitAxes& axes) {
  axes_ = &axes;
  rebuild();
  adjustSize();
  const QRect screen = widget.screen()->availableGeometry();
  QPoint at = widget.mapToGlobal(QPoint(0, widget.height() + 2));
  if (at.y() + height() > screen.bottom())
    at.setY(widget.mapToGlobal(QPoint(0, -height() - 2)).y());
  at.setX(std::clamp(at.x(), screen.left(), std::max(screen.left(), screen.right() - width())));
  move(at);
  show();
  if (auto* first = findChild<QCheckBox*>()) first->setFocus();
}

}  // namespace palpate::gui
