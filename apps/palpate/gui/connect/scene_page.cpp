#include "gui/connect/scene_page.h"

#include <QCheckBox>
#include <QFileInfo>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <algorithm>
#include <variant>

#include <palpate/core/error.h>
#include <palpate/emulator/scene.h>

#include "gui/desktop/ask.h"
#include "gui/source/connection.h"
#include "gui/source/file_reading.h"
#include "gui/widgets/make.h"
#include "gui/widgets/two_line_delegate.h"

namespace palpate::gui {
namespace {

constexpr int kSceneRole = Qt::UserRole + 2;    // in the form that loadScene() takes
constexpr int kProblemRole = Qt::UserRole + 3;  // why the scene cannot be used
constexpr int kScriptRole = Qt::UserRole + 4;   // whether the scene has a script
constexpr int kMovesRole = Qt::UserRole + 5;  // whether its script pulls, turns or moves an object

bool movesObjects(const Scene& scene) {
  return std::any_of(scene.script.begin(), scene.script.end(), [](const ScriptStep& step) {
    return std::holds_alternative<MoveObject>(step.action) ||
           std::holds_alternative<LoadObject>(step.action) ||
           std::holds_alternative<TurnObject>(step.action);
  });
}

}  // namespace

ScenePage::ScenePage(const std::filesystem::path& folder, Ask& ask, QWidget* parent)
    : QWidget(parent), folder_(folder) {
  list_ = named(new QListWidget(this), "scenes");
  list_->setItemDelegate(new TwoLineDelegate(list_));
  list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  list_->setStyleSheet(QString("#scenes { border: 1px solid %1; border-radius: 4px; }")
                           .arg(colorsOf().border.name()));
  none_ = makeLines(this, "noScenes");
  acts_ = named(new QCheckBox("The scene moves the hand &by itself", this), "sceneScriptRuns");
  note_ = makeLines(this,
                    "sceneNote",
                    "muted",
                    "Without this, nothing pulls or turns the object: the script does it.");
  auto* other = makeButton(this, "otherScene", "&Other scene…");
  setLayout(inColumn({makeTitle("What is around the &hand", list_),
                      none_,
                      {list_, 1},
                      Space::kNarrow,
                      inRow({{acts_, 1}, other}),
                      note_}));

  for (const std::string& name : sceneNames(folder_)) {
    const QString scene = QString::fromStdString(name);
    addScene(scene, sceneTitle(scene));
  }
  none_->setText("No scenes were found in " + QString::fromStdString(folder_.string()) +
                 ". Choose a scene file.");
  none_->setVisible(list_->count() == 0);
  connect(list_, &QListWidget::currentRowChanged, this, &ScenePage::showChosen);
  connect(acts_, &QCheckBox::clicked, this, &ScenePage::changed);
  connect(acts_, &QCheckBox::toggled, this, &ScenePage::showNote);
  connect(other, &QPushButton::clicked, this, [this, &ask] {
    const QString chosen =
        ask.file("Choose a scene", QString::fromStdString(folder_.string()), "Scenes (*.json)");
    if (!chosen.isEmpty()) setScene(chosen);
  });
  list_->setCurrentRow(0);
}

ScenePage::~ScenePage() { list_->disconnect(this); }

void ScenePage::addScene(const QString& scene, const QString& title) {
  auto* item = new QListWidgetItem(title, list_);
  item->setData(kSceneRole, scene);
  item->setData(TwoLineDelegate::kDetailRole, "is being read…");
  item->setData(kProblemRole, "The scene is being read.");
  item->setToolTip(scene);
  // The page never removes an item.
  auto* reading = new FileReading(this);
  const auto show = [this, item, scene](const QString& detail) {
    item->setData(TwoLineDelegate::kDetailRole, detail);
    item->setToolTip(scene + "\n" + detail);
    if (item == list_->currentItem()) showChosen();
  };
  connect(reading, &FileReading::finished, reading, &QObject::deleteLater);
  reading->start(
      [item, show, file = scene.toStdString(), folder = folder_]() -> FileReading::Take {
        return [item, show, loaded = loadScene(file, folder)] {
          item->setData(kScriptRole, !loaded.script.empty());
          item->setData(kMovesRole, movesObjects(loaded));
          item->setData(kProblemRole, {});
          show(QString::fromStdString(loaded.description));
        };
      },
      [item, show](const QString& problem) {
        item->setData(kProblemRole, "This scene can't be used: " + problem);
        show(problem);
      });
}

void ScenePage::setScene(const QString& scene) {
  if (scene.isEmpty()) return;
  for (int row = 0; row < list_->count(); ++row)
    if (list_->item(row)->data(kSceneRole) == scene) return list_->setCurrentRow(row);
  addScene(scene, QFileInfo(scene).fileName());
  none_->hide();
  list_->setCurrentRow(list_->count() - 1);
}

QString ScenePage::scene() const {
  const QListWidgetItem* item = list_->currentItem();
  return item ? item->data(kSceneRole).toString() : QString();
}

void ScenePage::setRunsScript(bool runsScript) { acts_->setChecked(runsScript); }
bool ScenePage::runsScript() const { return acts_->isChecked(); }

bool ScenePage::actsByItself() const {
  const QListWidgetItem* item = list_->currentItem();
  return item && item->data(kScriptRole).toBool() && acts_->isChecked();
}

void ScenePage::showChosen() {
  const QListWidgetItem* item = list_->currentItem();
  problem_ = item ? item->data(kProblemRole).toString() : QString();
  const bool canAct = item && item->data(kScriptRole).toBool();
  acts_->setEnabled(canAct);
  acts_->setToolTip(canAct
                        ? "The script of the scene closes and opens the hand; you watch and record"
                        : "This scene has no script");
  showNote();
  emit changed();
}

void ScenePage::showNote() {
  const QListWidgetItem* item = list_->currentItem();
  note_->setVisible(item && item->data(kMovesRole).toBool() && !acts_->isChecked());
}

}  // namespace palpate::gui
