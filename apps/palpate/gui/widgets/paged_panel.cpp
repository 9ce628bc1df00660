#include "gui/widgets/paged_panel.h"

#include <QButtonGroup>
#include <QEvent>
#include <QMenu>
#include <QStackedWidget>
#include <QToolButton>
#include <algorithm>
#include <utility>

#include "gui/widgets/fitting_pages.h"
#include "gui/widgets/make.h"
#include "gui/widgets/text_fit.h"

namespace palpate::gui {

PagedPanel::PagedPanel(QSettings& settings, QString key, QWidget* parent)
    : QWidget(parent), settings_(settings), key_(std::move(key)) {
  header_ = new QWidget(this);
  list_ = named(new QToolButton(header_), key_ + "Pages", "Another page of this dock");
  list_->setPopupMode(QToolButton::InstantPopup);
  list_->setMenu(new QMenu(list_));
  list_->hide();
  header_->setLayout(inRow({Stretch{}, list_}, Space::kNarrow));
  header_->installEventFilter(this);
  chooser_ = new QButtonGroup(this);
  pages_ = named(new FittingPages(this), kDockPages);
  fitToText(*list_, [this] {
    if (!chooser_->buttons().isEmpty()) fitHeader();
  });
}

void PagedPanel::addPage(QWidget* page, const QString& name, const QString& tip) {
  auto* button = makeToolButton(header_, key_ + name, name, tip);
  button->setCheckable(true);
  chooser_->addButton(button, pages_->addWidget(page));
  header_->layout()->addWidget(button);
  connect(list_->menu()->addAction(name), &QAction::triggered, button, &QToolButton::click);
  list_->setText(name);
  fitHeader();
}

void PagedPanel::fitHeader() {
  const QFontMetrics metrics = list_->fontMetrics();
  int widest = 0;
  for (const QString& name : pageNames())
    widest = std::max(widest, metrics.horizontalAdvance(name));
  // Without a least width of its own, the layout would ask for the width of all buttons.
  header_->setMinimumWidth(list_->sizeHint().width() - metrics.horizontalAdvance(list_->text()) +
                           widest);
  chooseButtons();
}

void PagedPanel::chooseButtons() {
  int needed = -header_->layout()->spacing();
  for (const QAbstractButton* button : chooser_->buttons())
    needed += button->sizeHint().width() + header_->layout()->spacing();
  const bool narrow = header_->width() < needed;
  list_->setVisible(narrow);
  for (QAbstractButton* button : chooser_->buttons()) button->setVisible(!narrow);
}

bool PagedPanel::eventFilter(QObject* watched, QEvent* event) {
  if (watched == header_ && event->type() == QEvent::Resize) chooseButtons();
  return QWidget::eventFilter(watched, event);
}

void PagedPanel::showLastPage() {
  const QString setting = key_ + "/page";
  connect(chooser_, &QButtonGroup::idToggled, this, [this, setting](int page, bool on) {
    if (!on) return;
    pages_->setCurrentIndex(page);
    list_->setText(pageName());
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
