#include "gui/export/export_forms.h"

#include <QButtonGroup>
#include <QHBoxLayout>
#include <QToolButton>

namespace palpate::gui {
namespace {

constexpr int kHeight = 28;  // [px]

// Why the view can't be made into one; empty: it can.
QString whyNot(ExportForm form, const ExportedView& view) {
  if (form == ExportForm::kMovie) return whyNoMovie(view);
  if (form == ExportForm::kCsv)
    return view.tablesNow().empty() ? "This view has no numbers" : QString();
  return view.paint ? QString() : "This view has no picture";
}

}  // namespace

ExportForms::ExportForms(QWidget* parent) : QWidget(parent), buttons_(new QButtonGroup(this)) {
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(4);
  for (const ExportForm each : kAllExportForms) {
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
  buttons_->button(static_cast<int>(ExportForm::kPng))->setChecked(true);
  connect(buttons_, &QButtonGroup::idToggled, this, [this](int, bool on) {
    if (on) emit changed();
  });
}

ExportForm ExportForms::chosen() const { return static_cast<ExportForm>(buttons_->checkedId()); }

void ExportForms::choose(ExportForm form) {
  buttons_->button(static_cast<int>(form))->setChecked(true);
}

void ExportForms::use(const ExportedView& view) {
  for (const ExportForm each : kAllExportForms) {
    QAbstractButton* button = buttons_->button(static_cast<int>(each));
    const QString reason = whyNot(each, view);
    button->setEnabled(reason.isEmpty());
    button->setToolTip(reason.isEmpty() ? descriptionOf(each) : reason);
  }
  if (!buttons_->checkedButton()->isEnabled())
    choose(view.paint ? ExportForm::kPng : ExportForm::kCsv);
}

}  // namespace palpate::gui
