#include "gui/recognise_panel.h"

#include <QButtonGroup>
#include <QHBoxLayout>
#include <QStackedWidget>
#include <QToolButton>
#include <QVBoxLayout>

#include "gui/ask_page.h"
#include "gui/check_page.h"
#include "gui/opening_strip.h"
#include "gui/teach_page.h"
#include "gui/today_page.h"

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
  teaching_ = new TeachingDesk(settings, this);
  header_ = new QWidget(this);
  auto* row = new QHBoxLayout(header_);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(4);
  row->addStretch(1);
  chooser_ = new QButtonGroup(this);
  pages_ = new QStackedWidget(this);
  ask_ = new AskPage(*desk_, pages_);
  today_ = new TodayPage(*desk_, pages_);
  teach_ = new TeachPage(*teaching_, pages_);
  check_ = new CheckPage(*teaching_, pages_);
  strip_ = new OpeningStrip(this, "Working on", "recognise");
  add(ask_, "Ask", "What is in the hand");
  add(today_, "Today", "Adapts to how the hand is today");
  add(teach_, "Teach", "Captures grasps of objects, and learns from them");
  add(check_, "Check", "How well they are told apart");
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(strip_);
  column->addWidget(pages_, 1);
  BackgroundJob& job = teaching_->job();
  connect(&job, &BackgroundJob::started, strip_, &OpeningStrip::begin);
  connect(&job, &BackgroundJob::progressed, strip_, &OpeningStrip::setProgress);
  connect(&job, &BackgroundJob::finished, strip_, &OpeningStrip::end);
  connect(strip_, &OpeningStrip::cancelRequested, teaching_, &TeachingDesk::cancel);
  connect(desk_, &RecogniseDesk::said, this, &RecognisePanel::said);
  connect(teaching_, &TeachingDesk::said, this, &RecognisePanel::said);
  connect(teaching_, &TeachingDesk::failed, this, &RecognisePanel::failed);
  connect(teaching_, &TeachingDesk::folderChanged, this, [this] {
    desk_->setPhotoFolder(teaching_->folder());
  });
  connect(teaching_,
          &TeachingDesk::trained,
          this,
          [this](const TrainedModel& model, const QString& path) {
            desk_->takeModel(model, path.toStdString());
            emit said("trained with " + QString::number(model.classes.size()) +
                      " objects: " + path.section('/', -1));
          });
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
  today_->setTheme(theme);
  teach_->setTheme(theme);
  check_->setTheme(theme);
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

bool RecognisePanel::cancel() { return desk_->cancel() || teaching_->cancel(); }

void RecognisePanel::settle() {
  desk_->settle();
  teaching_->settle();
}

// The folder of the last time is looked into when it is needed.
void RecognisePanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  if (!teaching_->folder().empty() && !teaching_->table() && !teaching_->busy()) teaching_->look();
}

}  // namespace palpate::gui
