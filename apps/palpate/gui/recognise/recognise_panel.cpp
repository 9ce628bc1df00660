#include "gui/recognise/recognise_panel.h"

#include <QStackedWidget>

#include "gui/appearance/captions.h"
#include "gui/recognise/ask_page.h"
#include "gui/recognise/check_page.h"
#include "gui/recognise/grasps_page.h"
#include "gui/recognise/today_page.h"
#include "gui/recognise/training_page.h"
#include "gui/widgets/make.h"
#include "gui/widgets/opening_strip.h"

namespace palpate::gui {

RecognisePanel::RecognisePanel(QSettings& settings,
                               const std::filesystem::path& dataFolder,
                               Ask& ask,
                               QWidget* parent)
    : PagedPanel(settings, "recognise", parent) {
  setObjectName("RecognisePanel");
  controller_ = new RecognitionController(settings, dataFolder, this);
  teaching_ = new TrainingController(settings, this);
  ask_ = new AskPage(*controller_, ask, &pages());
  today_ = new TodayPage(*controller_, ask, &pages());
  teach_ = new TrainingPage(*teaching_, ask, &pages());
  grasps_ = new GraspsPage(*teaching_, settings, &pages());
  check_ = new CheckPage(*teaching_, &pages());
  strip_ = new OpeningStrip(this, "Working on", "recognise");
  addPage(ask_, "Ask", "What is in the hand");
  addPage(today_, "Today", "Adapts the model to the hand of today");
  addPage(teach_, "Teach", "Captures grasps of objects, and trains a model with them");
  addPage(grasps_, "Grasps", "The training grasps and their features");
  addPage(check_, "Check", "How well the objects are distinguished");
  setLayout(inColumn({strip_, {&pages(), 1}}, Space::kNone));
  BackgroundJob& job = teaching_->job();
  connect(&job, &BackgroundJob::started, strip_, &OpeningStrip::begin);
  connect(&job, &BackgroundJob::progressed, strip_, &OpeningStrip::setProgress);
  connect(&job, &BackgroundJob::finished, strip_, &OpeningStrip::end);
  connect(strip_, &OpeningStrip::cancelRequested, teaching_, &TrainingController::cancel);
  connect(controller_, &RecognitionController::said, this, &RecognisePanel::said);
  connect(teaching_, &TrainingController::said, this, &RecognisePanel::said);
  connect(teaching_, &TrainingController::failed, this, &RecognisePanel::failed);
  connect(teaching_, &TrainingController::folderChanged, this, [this] {
    controller_->setPhotoFolder(teaching_->folder());
  });
  connect(teaching_,
          &TrainingController::trained,
          this,
          [this](const TrainedModel& model, const QString& path) {
            controller_->takeModel(model, path.toStdString());
            emit said("trained with " + numberOf(model.classes.size(), "object") + " (" +
                      QString::fromStdString(madeWithText(model.set, model.pipeline)) +
                      "): " + path.section('/', -1));
          });
  showLastPage();
}

bool RecognisePanel::cancel() { return controller_->cancel() || teaching_->cancel(); }

void RecognisePanel::settle() {
  controller_->settle();
  teaching_->settle();
}

// Reads the last training folder only when the dock is visible.
void RecognisePanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  if (!teaching_->folder().empty() && !teaching_->table() && !teaching_->busy()) teaching_->look();
}

}  // namespace palpate::gui
