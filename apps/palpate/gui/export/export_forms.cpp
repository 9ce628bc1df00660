#include "gui/export/export_forms.h"

#include <QButtonGroup>
#include <QHBoxLayout>
#include <QToolButton>

namespace palpate::gui {
namespace {

constexpr int kHeight = 28;  // [px]

// Why the view cannot be exported in this form; empty when it can.
QString emptyReason(ExportFormat form, const ExportedView& view) {
  if (form == ExportFormat::kMovie) return movieProblem(view);
  if (form == ExportFormat::kCsv)
    return view.tablesNow().empty() ? "This view has no numbers" : QString();
  return view.paint ? QString() : "This view has no picture";
}

}  // namespace

ExportForms::ExportForms(QWidget* parent) : QWidget(parent), buttons_(new QButtonGroup(this)) {
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(4);
  for (const ExportFormat each : kAllExportForms) {
    auto* button = new QToolButton(this);
    button->setObjectName("exportForm" + nameOf(each));
    button->setText(nameOf(each));
    button->setCheckable(true);
    button->setMinimumHeight(kHeight);
    button->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    button->setFocusPolicy(Qt::StrongFocus);
    buttons_->addButton(button, static_cast<int>(each));
    layout->addWidget(button);
  }
  buttons_->button(static_cast<int>(ExportFormat::kPng))->setChecked(true);
  connect(buttons_, &QButtonGroup::idToggled, this, [this](int, bool on) {
    if (on) emit changed();
  });
}

ExportFormat ExportForms::chosen() const {
  return static_cast<ExportFormat>(buttons_->checkedId());
}

void ExportForms::choose(ExportFormat form) {
  buttons_->button(static_cast<int>(form))->setChecked(true);
}

void ExportForms::use(const ExportedView& view) {
  for (const ExportFormat each : kAllExportForms) {
    QAbstractButton* button = buttons_->button(static_cast<int>(each));
    const QString reason = emptyReason(each, view);
    button->setEnabled(reason.isEmpty());
    button->setToolTip(reason.isEmpty() ? descriptionOf(each) : reason);
  }
  if (!buttons_->checkedButton()->isEnabled())
    choose(view.paint ? ExportFormat::kPng : ExportFormat::kCsv);
}

}  // namespace palpate::gui
