#include "gui/recognise/ask_page.h"

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <algorithm>

#include <palpate/recognition/training_choice.h>

#include "gui/appearance/captions.h"
#include "gui/desktop/ask.h"
#include "gui/recognise/answer_view.h"
#include "gui/widgets/long_word_label.h"
#include "gui/widgets/make.h"
#include "gui/widgets/text_fit.h"

namespace palpate::gui {
namespace {

constexpr double kButtonScale = 1.25;

}  // namespace

AskPage::AskPage(RecognitionController& controller, Ask& ask, QWidget* parent)
    : QWidget(parent), controller_(controller) {
  setObjectName("askPage");
  model_ = named(new LongWordLabel(this), "recogniseModel");
  models_ = new QMenu(this);
  auto* choose = makeButton(this, "recogniseModelButton", "Model");
  choose->setMenu(models_);
  connect(models_->addAction("&Open a model…"), &QAction::triggered, this, [this, &ask] {
    const QString path = ask.file("Open a model",
                                  QString::fromStdString(controller_.modelPath().string()),
                                  "Models (*.json);;All files (*)");
    if (!path.isEmpty()) controller_.openModel(path.toStdString());
  });
  connect(models_->addAction("The &emulated objects"),
          &QAction::triggered,
          &controller_,
          &RecognitionController::useEmulatedModel);
  ask_ = makePrimary(this, "whatIsIt", "What is it?  (Q)");
  QFont large = ask_->font();
  large.setPointSizeF(kButtonScale * large.pointSizeF());
  ask_->setFont(large);
  fitToText(*ask_, [ask = ask_] {
    constexpr int kMinHeight = 44;  // [px]
    ask->setMinimumHeight(std::max(kMinHeight, ask->sizeHint().height()));
  });
  byItself_ = named(
      new QCheckBox("Automatic", this), "recogniseByItself", "Repeat while something is held");
  auto* show = makeButton(this, "showMode", "Show", "Full screen, for an audience (Ctrl+5)");
  view_ = named(new AnswerView(controller.photos(), 1.0, this), "answerView");
  classes_ = named(new QComboBox(this), "tellClass", {}, "What it is");
  classes_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  tell_ = makeButton(this, "tell", "Label");

  auto* asking = inRow({{ask_, 1}, inColumn({byItself_, show}, Space::kNarrow)});
  setLayout(inColumn(
      {inRow({choose, {model_, 1}}), asking, {view_, 1}, inRow({"It is", {classes_, 1}, tell_})},
      kPageEdges));

  connect(ask_, &QPushButton::clicked, this, &AskPage::asked);
  connect(show, &QPushButton::clicked, this, &AskPage::showRequested);
  connect(&controller_, &RecognitionController::modelChanged, this, &AskPage::showModel);
  connect(&controller_,
          &RecognitionController::answered,
          this,
          [this](const RecognitionAnswer& answer) {
            view_->setAnswer(answer);
            showTelling();
          });
  connect(tell_, &QPushButton::clicked, this, [this] {
    const auto grasp = controller_.answer().grasp;
    if (!grasp) return;
    const int chosen = classes_->currentIndex();
    controller_.changeSession(
        [&](RecognitionSession& session) { session.setLabel(*grasp, chosen); });
    emit controller_.said("labelled: " + classes_->currentText());
  });
  view_->setAnswer(controller_.answer());
  setLive(false);
  showModel();
}

void AskPage::setLive(bool live, const QString& silence) {
  byItself_->setVisible(live);
  ask_->setEnabled(silence.isEmpty());
  ask_->setToolTip(silence);
  view_->setStale(silence);
}

bool AskPage::byItself() const { return byItself_->isChecked(); }

void AskPage::showModel() {
  const TrainedModel* model = controller_.model();
  const auto count = model ? static_cast<int>(model->classes.size()) : 0;
  const QString file = QString::fromStdString(controller_.modelPath().filename().string());
  const QString with =
      model ? QString::fromStdString(madeWithText(model->set, model->pipeline)) : QString();
  model_->setText(model ? file + " · " + numberOf(static_cast<std::uint64_t>(count), "object") +
                              " · " + with
                  : controller_.modelProblem().isEmpty() ? QString("no model")
                                                         : file + " can't be used");
  model_->setToolTip(model ? QString::fromStdString(controller_.modelPath().string()) +
                                 "\nmade with " + with
                           : controller_.modelProblem());
  classes_->clear();
  if (model)
    for (const std::string& name : model->classes) classes_->addItem(QString::fromStdString(name));
  showTelling();
}

void AskPage::showTelling() {
  const RecognitionAnswer& answer = controller_.answer();
  const TrainedModel* model = controller_.model();
  const bool can = model && model->adaptsToSession() && answer.grasp &&
                   *answer.grasp < controller_.session()->grasps().size();
  classes_->setEnabled(can);
  tell_->setEnabled(can);
  const QString tip =
      can      ? "Label the last grasp with this class, even if the answer was wrong: the model is "
                 "adapted\nto today with it (undo: page Today)"
      : !model ? "No grasp can be labelled without a model"
      : !model->adaptsToSession()
          ? "This model can't be adapted to today: only models of the classifier gauss can (page "
            "Teach)"
          : "There is no grasp to label yet: ask first (Q)";
  tell_->setToolTip(tip);
  classes_->setToolTip(tip);
  if (!can || answer.best.empty()) return;
  const auto& labelledClass = controller_.session()->grasps()[*answer.grasp].labelledClass;
  classes_->setCurrentIndex(labelledClass ? *labelledClass
                                          : classes_->findText(answer.best.front().name));
}

}  // namespace palpate::gui
