#include "gui/recognise_panel.h"

#include <QButtonGroup>
#include <QHBoxLayout>
#include <QStackedWidget>
#include <QToolButton>
#include <QVBoxLayout>

#include "gui/ask_page.h"

namespace palpate::gui {
namespace {

constexpr const char* kPageKey = "recognise/page";

}  // namespace

RecognisePanel::RecognisePanel(QSettings& settings,
                               const std::filesystem::path& dataFolder,
                               QWidget* parent)
    : QWidget(parent), settings_(settings) {
  setObjectName("RecognisePanel");
  desk_ = new RecogniseDesk(settings, dataFolder, this);
  header_ = new QWidget(this);
  auto* row = new QHBoxLayout(header_);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(4);
  row->addStretch(1);
  chooser_ = new QButtonGroup(this);
  pages_ = new QStackedWidget(this);
  ask_ = new AskPage(*desk_, pages_);
  add(ask_, "Ask", "What is in the hand");
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(pages_);
  connect(chooser_, &QButtonGroup::idToggled, this, [this](int page, bool on) {
    if (!on) return;
    pages_->setCurrentIndex(page);
    settings_.setValue(kPageKey, pageName());
  });
  const QString last = settings.value(kPageKey).toString();
  showPage(pageNames().contains(last) ? last : pageNames().front());
}

void RecognisePanel::add(QWidget* page, const QString& name, const QString& tip) {
  auto* button = new QToolButton(header_);
  button->setText(name);
  button->setToolTip(tip);
  button->setObjectName("recognise" + name);
  button->setCheckable(true);
  button->setFocusPolicy(Qt::TabFocus);
  chooser_->addButton(button, pages_->addWidget(page));
  header_->layout()->addWidget(button);
}

void RecognisePanel::setTheme(Theme theme) {
  if (theme == theme_) return;
  theme_ = theme;
  ask_->setTheme(theme);
}

QStringList RecognisePanel::pageNames() const {
  QStringList names;
  for (const QAbstractButton* button : chooser_->buttons()) names.append(button->text());
  return names;
}

void RecognisePanel::showPage(const QString& name) {
  for (QAbstractButton* button : chooser_->buttons())
    if (button->text() == name) button->setChecked(true);
}

QString RecognisePanel::pageName() const {
  return chooser_->button(pages_->currentIndex())->text();
}

bool RecognisePanel::cancel() { return desk_->cancel(); }

void RecognisePanel::settle() { desk_->settle(); }

}  // namespace palpate::gui
