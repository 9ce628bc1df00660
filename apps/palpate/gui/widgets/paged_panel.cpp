#include "gui/widgets/paged_panel.h"

#include <QButtonGroup>
#include <QHBoxLayout>
#include <QStackedWidget>
#include <QToolButton>
#include <utility>

namespace palpate::gui {

PagedPanel::PagedPanel(QSettings& settings, QString key, QWidget* parent)
    : QWidget(parent), settings_(settings), key_(std::move(key)) {
  header_ = new QWidget(this);
  auto* row = new QHBoxLayout(header_);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(4);
  row->addStretch(1);
  chooser_ = new QButtonGroup(this);
  pages_ = new QStackedWidget(this);
}

void PagedPanel::addPage(QWidget* page, const QString& name, const QString& tip) {
  auto* button = new QToolButton(header_);
  button->setText(name);
  button->setToolTip(tip);
  button->setObjectName(key_ + name);
  button->setCheckable(true);
  button->setFocusPolicy(Qt::TabFocus);
  chooser_->addButton(button, pages_->addWidget(page));
  header_->layout()->addWidget(button);
}

void PagedPanel::showLastPage() {
  const QString setting = key_ + "/page";
  connect(chooser_, &QButtonGroup::idToggled, this, [this, setting](int page, bool on) {
    if (!on) return;
    pages_->setCurrentIndex(page);
    settings_.setValue(setting, pageName());
  });
  const QString last = settings_.value(setting).toString();
  showPage(pageNames().contains(last) ? last : pageNames().front());
}

QStringList PagedPanel::pageNames() const {
  QStringList names;
  for (const QAbstractButton* button : chooser_->buttons()) names.append(button->text());
  return names;
}

void PagedPanel::showPage(const QString& name) {
  for (QAbstractButton* button : chooser_->buttons())
    if (button->text() == name) button->setChecked(true);
}

QString PagedPanel::pageName() const { return chooser_->button(pages_->currentIndex())->text(); }

}  // namespace palpate::gui
