#include "gui/record/plan_limits.h"

#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>

#include "gui/appearance/captions.h"
#include "gui/widgets/make.h"

namespace palpate::gui {
namespace {

constexpr double kPlanPercent = 100.0;
constexpr double kMaxPlanS = 86'400.0;
constexpr int kMaxPlanLost = 1'000'000;
constexpr int kMaxPlanTaxels = 10'000;

template <class Field>
Field* planField(const char* name, const QString& tip, QWidget* parent) {
  auto* field = named(new Field(parent), name, tip, tip);
  field->setButtonSymbols(QAbstractSpinBox::NoButtons);
  return field;
}

}  // namespace

PlanLimits::PlanLimits(QWidget* parent)
    : FoldingPart("planLimits",
                  "&Limits",
                  "What makes a take bad, so that it should be repeated; kept with the plan",
                  parent) {
  QWidget* made = body();
  least_ = planField<QDoubleSpinBox>(
      "planLeastS",
      "Shortest take; one that stops automatically must be nearly as long as planned",
      made);
  least_->setRange(0.0, kMaxPlanS);
  least_->setDecimals(1);
  least_->setSuffix(" s");
  lost_ = planField<QSpinBox>("planMostLost", "Number of frames that may be lost", made);
  lost_->setRange(0, kMaxPlanLost);
  saturated_ = planField<QDoubleSpinBox>(
      "planMostSaturated", "Share of the frames that may have a saturated taxel", made);
  saturated_->setRange(0.0, kPlanPercent);
  saturated_->setDecimals(1);
  saturated_->setSuffix(" %");
  taxels_ = planField<QSpinBox>(
      "planTaxels",
      "Number of taxels that must be active in three frames to count as a touch",
      made);
  taxels_->setRange(1, kMaxPlanTaxels);
  quality_ = planField<QDoubleSpinBox>(
      "planLeastQuality",
      "Minimum quality of its best grasp, 0..1: held steadily, complete, not saturated",
      made);
  quality_->setRange(0.0, 1.0);
  quality_->setDecimals(2);
  quality_->setSingleStep(0.05);
  quality_->setSpecialValueText("any");
  usual_ = makeButton(made, "planUsualLimits", "Us&ual", "The limits of a new plan");
  auto* grid = new QGridLayout(made);
  grid->setContentsMargins(0, 2, 0, 0);
  grid->setHorizontalSpacing(10);
  grid->setVerticalSpacing(6);
  const auto add = [&](int row, int column, const QString& text, QWidget* field) {
    grid->addWidget(makeTitle(text, field), row, 2 * column);
    grid->addWidget(field, row, 2 * column + 1);
  };
  add(0, 0, "S&hortest", least_);
  add(0, 1, "L&ost frames", lost_);
  add(0, 2, "&Saturated frames", saturated_);
  add(1, 0, "&Touched taxels", taxels_);
  add(1, 1, "&Quality of a grasp", quality_);
  grid->addWidget(usual_, 1, 5, Qt::AlignRight);
  for (const int column : {1, 3, 5}) grid->setColumnStretch(column, 1);
  const auto changed = [this] {
    sumUp();
    emit edited();
  };
  for (QSpinBox* field : {lost_, taxels_}) connect(field, &QSpinBox::valueChanged, this, changed);
  for (QDoubleSpinBox* field : {least_, saturated_, quality_})
    connect(field, &QDoubleSpinBox::valueChanged, this, changed);
  connect(usual_, &QPushButton::clicked, this, [this] {
    fill({});
    emit edited();
  });
  fill({});
}

void PlanLimits::fill(const TakeCheckOptions& limits) {
  const QSignalBlocker quiet(this);
  least_->setValue(limits.leastS);
  lost_->setValue(static_cast<int>(limits.mostLost));
  saturated_->setValue(kPlanPercent * limits.mostSaturated);
  taxels_->setValue(limits.contact.taxels);
  quality_->setValue(limits.leastQuality);
  sumUp();
}

TakeCheckOptions PlanLimits::limits() const {
  TakeCheckOptions limits;
  limits.contact.taxels = taxels_->value();
  limits.leastS = least_->value();
  limits.mostLost = lost_->value();
  limits.mostSaturated = saturated_->value() / kPlanPercent;
  limits.leastQuality = quality_->value();
  return limits;
}

QString PlanLimits::summary() const {
  QString text = least_->text() + " at least, " + QString::number(lost_->value()) +
                 " lost, saturated in " + saturated_->text() + " at most, " +
                 QString::number(taxels_->value()) + " touched taxels";
  if (quality_->value() > 0.0) text += ", quality " + figure(quality_->value(), 2);
  return text;
}

}  // namespace palpate::gui
