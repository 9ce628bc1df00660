#include "gui/recognise/training_page.h"

#include <QComboBox>
#include <QCompleter>
#include <QDir>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalBlocker>
#include <QStandardItemModel>
#include <QStandardPaths>
#include <array>

#include "gui/appearance/captions.h"
#include "gui/desktop/ask.h"
#include "gui/widgets/figures_table.h"
#include "gui/widgets/make.h"

namespace palpate::gui {
namespace {

using TeachPageState = TrainingClip::State;
// With fewer grasps of an object, cross-validation in blocks is not possible.
constexpr int kFewGrasps = 5;

std::vector<FigureColumn> teachPageObjectColumns() {
  return {{"object", {}, 18, true},
          {"grasps", "In the folder", 7},
          {"", "What is still needed", 14, true}};
}

std::vector<FigureColumn> clipColumns() {
  return {{"captured as", {}, 13, true},
          {"s", "Length [s]", 5},
          {"quality", "Quality 0..1: held steadily, complete, not saturated", 7},
          {"", "State", 14, true}};
}

struct TaughtSet {
  FeatureSet set;
  const char* tip;
};
constexpr std::array kTaughtSets = {
    TaughtSet{
        FeatureSet::kBest,
        "Size and shape of the contact, force and compression on the load plateau: what holds "
        "in another session"},
    TaughtSet{FeatureSet::kStudy, "The 54 numbers of the study, to compare with it"},
    TaughtSet{
        FeatureSet::kSession,
        "best, with joint angles at rest: most accurate within one session, useless in another"},
    TaughtSet{FeatureSet::kStatistics,
              "Load, extent and position of the contact on every matrix, of any hand"}};

struct TaughtClassifier {
  ClassifierKind kind;
  const char* tip;
};
constexpr std::array kTaughtClassifiers = {
    TaughtClassifier{ClassifierKind::kGauss,
                     "A distribution for each object with an offset of the session: the only one "
                     "that can be adapted to another session"},
    TaughtClassifier{ClassifierKind::kLda, "Gaussian distributions with a common covariance"},
    TaughtClassifier{ClassifierKind::kQda, "A Gaussian distribution for each object"},
    TaughtClassifier{ClassifierKind::kSvm, "Linear support vector machines, one against one"}};

QString taughtName(std::string_view name) {
  return QString::fromUtf8(name.data(), static_cast<qsizetype>(name.size()));
}

// A choice that can't be made stays visible, and its tool tip says why.
void setItemPossible(QComboBox& box, int index, const QString& tip, const QString& whyNot) {
  box.setItemData(
      index, whyNot.isEmpty() ? tip : tip + "\nNot possible: " + whyNot, Qt::ToolTipRole);
  auto* items = qobject_cast<QStandardItemModel*>(box.model());
  if (items) items->item(index)->setEnabled(whyNot.isEmpty());
}

QString stateText(const TrainingClip& clip) {
  switch (clip.state) {
    case TeachPageState::kWaiting:
      return "waiting: " + clip.problem;
    case TeachPageState::kSaving:
      return "being written";
    case TeachPageState::kAccepted:
      return "accepted";
    case TeachPageState::kTakenOut:
      return "removed";
    case TeachPageState::kFailed:
      break;
  }
  return "not written: " + clip.problem;
}

}  // namespace

TrainingPage::TrainingPage(TrainingController& controller, Ask& ask, QWidget* parent)
    : QWidget(parent), controller_(controller), ask_(ask) {
  setObjectName("teachPage");
  auto* choose = makeButton(this,
                            "teachFolder",
                            "Folder…",
                            "A folder with a folder of recordings per object (\"golf_ball\")");
  folder_ = makeLabel(this, "teachFolderName");
  folder_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  const auto field = [this](const char* name, const char* accessible, const char* tip) {
    return named(new QComboBox(this), name, tip, accessible);
  };
  set_ =
      field("teachSet", "Features", "Features measured for each grasp; Train and Check use them");
  set_->addItem("automatic");
  set_->setItemData(0, "best where two pads pinch, else statistics", Qt::ToolTipRole);
  for (const TaughtSet& each : kTaughtSets) {
    set_->addItem(taughtName(featureSetName(each.set)));
    set_->setItemData(set_->count() - 1, each.tip, Qt::ToolTipRole);
  }
  classifier_ = field(
      "teachClassifier", "Classifier", "How the objects are distinguished; Train and Check use it");
  classifier_->addItem("automatic");
  classifier_->setItemData(
      0,
      "gauss with the features best; else the simplest of the most accurate in a cross-validation",
      Qt::ToolTipRole);
  for (const TaughtClassifier& each : kTaughtClassifiers) {
    classifier_->addItem(taughtName(classifierName(each.kind)));
    classifier_->setItemData(classifier_->count() - 1, each.tip, Qt::ToolTipRole);
  }
  bound_ = makeLines(this, "teachBound", "muted");
  objects_ = named(new FiguresTable(teachPageObjectColumns(), this), "teachObjects");
  objects_->setSingleLine();
  object_ = named(new QLineEdit(this), "teachObject");
  object_->setPlaceholderText("name of the object");
  object_->setMaxLength(60);
  capture_ = makeButton(
      this, "teachCapture", "Capture", "Save each finished grasp from now on as an example of it");
  capture_->setCheckable(true);
  state_ = makeLines(this, "teachState", "muted");
  clips_ = named(new FiguresTable(clipColumns(), this), "teachClips");
  clips_->setSingleLine();
  act_ = makeButton(this,
                    "teachAct",
                    "Undo",
                    "Move the chosen or newest grasp out of the folder; Put back restores it");
  train_ = makePrimary(this, "teachTrain", "Train", "Train a model with the grasps in the folder");

  setLayout(inColumn({inRow({choose, {folder_, 1}, train_}),
                      inRow({"Features", {set_, 1}, "Classifier", {classifier_, 1}}),
                      bound_,
                      {objects_, 3},
                      sectionHeading("Capture", this),
                      inRow({{object_, 1}, capture_}),
                      {clips_, 2},
                      inRow({{state_, 1}, act_})},
                     kPageEdges));

  connect(choose, &QPushButton::clicked, this, [this] {
    const QString folder = ask_.folder("A folder with a folder of recordings per object",
                                       QString::fromStdString(controller_.folder().string()));
    if (!folder.isEmpty()) controller_.setFolder(folder.toStdString());
  });
  for (QComboBox* box : {set_, classifier_})
    connect(box, &QComboBox::activated, this, &TrainingPage::choose);
  connect(&controller_, &TrainingController::choiceChanged, this, &TrainingPage::showChoice);
  connect(&controller_, &TrainingController::folderChanged, this, &TrainingPage::showChoice);
  connect(objects_, &FiguresTable::rowChosen, this, [this](int row) {
    if (!capturing()) object_->setText(objects_->item(row, 0)->text());
  });
  connect(object_, &QLineEdit::textChanged, this, &TrainingPage::showState);
  connect(capture_, &QPushButton::toggled, this, &TrainingPage::showState);
  connect(clips_, &QTableWidget::itemSelectionChanged, this, &TrainingPage::showState);
  connect(act_, &QPushButton::clicked, this, &TrainingPage::actOnClip);
  connect(train_, &QPushButton::clicked, this, &TrainingPage::train);
  connect(&controller_, &TrainingController::folderChanged, this, &TrainingPage::showFolder);
  connect(&controller_, &TrainingController::clipsChanged, this, &TrainingPage::showClips);
  connect(&controller_.job(), &BackgroundJob::started, this, &TrainingPage::showState);
  connect(&controller_.job(), &BackgroundJob::finished, this, &TrainingPage::showState);
  showFolder();
  showChoice();
  showClips();
}

void TrainingPage::choose() {
  TrainingChoice choice;
  if (const int at = set_->currentIndex(); at > 0)
    choice.set = kTaughtSets.at(static_cast<std::size_t>(at - 1)).set;
  if (const int at = classifier_->currentIndex(); at > 0)
    choice.classifier = kTaughtClassifiers.at(static_cast<std::size_t>(at - 1)).kind;
  controller_.setChoice(choice);
}

void TrainingPage::showChoice() {
  const TrainingChoice& choice = controller_.choice();
  const auto& table = controller_.table();
  const QSignalBlocker sets(set_), classifiers(classifier_);
  set_->setCurrentIndex(0);
  classifier_->setCurrentIndex(0);
  for (std::size_t i = 0; i < kTaughtSets.size(); ++i) {
    const int index = static_cast<int>(i) + 1;
    const TaughtSet& each = kTaughtSets.at(i);
    if (choice.set == each.set) set_->setCurrentIndex(index);
    const std::string whyNot = table ? whyNoFeatures(each.set, table->handPinches) : std::string();
    setItemPossible(*set_, index, each.tip, QString::fromStdString(whyNot));
  }
  for (std::size_t i = 0; i < kTaughtClassifiers.size(); ++i)
    if (choice.classifier == kTaughtClassifiers.at(i).kind)
      classifier_->setCurrentIndex(static_cast<int>(i) + 1);
  // What the cross-validation will choose isn't known yet; most often it isn't gauss.
  const FeatureSet set = controller_.set();
  const bool isGauss = searchOptions(set, choice.classifier).classifier == ClassifierKind::kGauss;
  const std::string bound =
      whyBoundToSession(set, isGauss ? ClassifierKind::kGauss : ClassifierKind::kSvm);
  bound_->setText(QString::fromStdString("For this training session only: " + bound + "."));
  bound_->setVisible(!bound.empty());
}

void TrainingPage::setLive(bool live) {
  if (live == live_) return;
  live_ = live;
  if (!live) capture_->setChecked(false);
  showState();
}

bool TrainingPage::capturing() const { return capture_->isChecked(); }

QString TrainingPage::object() const { return object_->text().simplified(); }

void TrainingPage::take(const Profile& clip) {
  if (capturing()) controller_.capture(object(), clip);
}

void TrainingPage::showFolder() {
  const auto& folder = controller_.folder();
  folder_->setText(folder.empty() ? QString("no folder is chosen")
                                  : QString::fromStdString(folder.filename().string()));
  folder_->setToolTip(QString::fromStdString(folder.string()));
  std::vector<std::vector<FigureCell>> rows;
  QStringList names;
  for (const auto& [name, count] : controller_.counts()) {
    names.append(name);
    rows.push_back({{.text = name},
                    {.text = QString::number(count)},
                    {.text = count < kFewGrasps ? QString("more would be better") : QString(),
                     .tip = "At least five grasps: some are used to test the model",
                     .warning = count < kFewGrasps}});
  }
  objects_->setRows(rows);
  auto* completer = new QCompleter(names, object_);
  completer->setCaseSensitivity(Qt::CaseInsensitive);
  object_->setCompleter(completer);
  showState();
}

void TrainingPage::showClips() {
  const int row = clips_->chosenRow();
  const int chosen =
      row >= 0 && row < static_cast<int>(shownClips_.size()) ? shownClips_.at(row) : 0;
  shownClips_.clear();
  std::vector<std::vector<FigureCell>> rows;
  const auto& clips = controller_.clips();
  for (auto clip = clips.rbegin(); clip != clips.rend(); ++clip) {
    const bool odd =
        clip->state == TeachPageState::kWaiting || clip->state == TeachPageState::kFailed;
    rows.push_back({{.text = clip->object},
                    {.text = figure(clip->seconds, 1)},
                    {.text = figure(clip->quality, 2), .warning = odd},
                    {.text = stateText(*clip),
                     .tip = QString::fromStdString(clip->path.string()),
                     .warning = odd}});
    shownClips_.append(clip->id);
  }
  clips_->setRows(rows);
  // The chosen clip stays chosen when others come above it.
  if (const auto now = shownClips_.indexOf(chosen); now >= 0)
    clips_->selectRow(static_cast<int>(now));
  showState();
}

// The clip of the chosen row; the newest clips are at the top. -1 when there are none.
int TrainingPage::chosenClip() const {
  const auto count = static_cast<int>(controller_.clips().size());
  const int row = clips_->chosenRow();
  if (row >= 0 && row < count) return count - 1 - row;
  return count - 1;
}

void TrainingPage::showState() {
  const bool folder = !controller_.folder().empty();
  capture_->setEnabled(folder && live_ && (!object().isEmpty() || capturing()));
  object_->setEnabled(!capturing());
  train_->setEnabled(folder && !controller_.busy());
  capture_->setText(capturing() ? "End capture" : "Capture");
  state_->setText(!folder       ? "Choose a folder first: captured grasps go there."
                  : capturing() ? "Capturing " + object() + ": grasp it several times."
                  : !controller_.problem().isEmpty() ? controller_.problem()
                  : !live_                           ? QString("Connect a hand to capture.")
                  : object().isEmpty()               ? QString("What will be grasped?")
                                                     : QString());
  const int clip = chosenClip();
  const TeachPageState state = clip < 0 ? TeachPageState::kSaving
                                        : controller_.clips()[static_cast<std::size_t>(clip)].state;
  act_->setEnabled(state != TeachPageState::kSaving);
  act_->setText(clip < 0 || state == TeachPageState::kAccepted || state == TeachPageState::kSaving
                    ? "Undo"
                : state == TeachPageState::kTakenOut ? "Put back"
                                                     : "Accept");
}

void TrainingPage::actOnClip() {
  const int clip = chosenClip();
  if (clip < 0) return;
  const auto index = static_cast<std::size_t>(clip);
  if (controller_.clips()[index].state == TeachPageState::kAccepted)
    controller_.takeOut(index);
  else
    controller_.accept(index);
}

void TrainingPage::train() {
  const auto& folder = controller_.folder();
  // Not beside the recordings: they may be shared, or read-only.
  const QString documents = QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation);
  const QString out = ask_.newFile("Save the model",
                                   (documents.isEmpty() ? QDir::homePath() : documents) + "/" +
                                       QString::fromStdString(folder.filename().string()) + ".json",
                                   "Models (*.json)",
                                   ".json");
  if (out.isEmpty()) {
    emit controller_.said("Nothing was trained: no file was chosen for the model");
    return;
  }
  controller_.train(out.toStdString(), zeroNow ? zeroNow() : std::nullopt);
}

}  // namespace palpate::gui
