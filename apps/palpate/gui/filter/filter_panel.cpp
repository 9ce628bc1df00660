#include "gui/filter/filter_panel.h"

#include <QCheckBox>
#include <QLabel>
#include <QMenu>
#include <QProgressBar>
#include <QPushButton>
#include <QScrollArea>
#include <QToolButton>
#include <numeric>

#include <palpate/core/error.h>

#include "gui/appearance/captions.h"
#include "gui/desktop/ask.h"
#include "gui/filter/filter_form.h"
#include "gui/filter/filter_list.h"
#include "gui/widgets/make.h"

namespace palpate::gui {
namespace {

constexpr double kFastestHz = 230.0;  // [Hz] frame rate of a hand whose matrices are read partially
constexpr const char* kRecipeFiles = "Recipes (*.json)";

QString quantity(int count, const QString& word) {
  return QString::number(count) + " " + word + (count == 1 ? "" : "s");
}

}  // namespace

FilterPanel::FilterPanel(RecipeEditor& editor, Ask& ask, QWidget* parent)
    : QWidget(parent), editor_(editor), ask_(ask) {
  list_ = new FilterList(this);
  form_ = new FilterForm(this);
  totals_ = makeLines(this, "filterTotals");
  progress_ = new QProgressBar(this);
  progress_->setRange(0, 100);
  progress_->setTextVisible(false);
  progress_->setFixedHeight(4);
  QSizePolicy keepsPlace = progress_->sizePolicy();
  keepsPlace.setRetainSizeWhenHidden(true);
  progress_->setSizePolicy(keepsPlace);
  progress_->hide();

  auto* content = new QWidget(this);
  heading_ = sectionHeading("OPTIONS", content);
  content->setLayout(inColumn({heading_, form_, Stretch{}}));
  auto* scroll = new QScrollArea(this);
  scroll->setAccessibleName("Filters");
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setWidget(content);

  setLayout(inColumn({makeTop(), {list_, 2}, makeButtons(), progress_, {scroll, 3}, totals_},
                     kPageEdges));

  connect(&editor_, &RecipeEditor::changed, this, &FilterPanel::renew);
  connect(list_, &FilterList::stepChosen, this, &FilterPanel::showForm);
  connect(list_, &FilterList::enabledChanged, &editor_, &RecipeEditor::setEnabled);
  connect(list_, &FilterList::moved, &editor_, &RecipeEditor::move);
  connect(list_, &FilterList::removeRequested, &editor_, &RecipeEditor::remove);
  connect(form_, &FilterForm::optionChosen, this, [this](const std::string& key, double value) {
    if (const auto at = list_->chosen()) editor_.setOption(*at, key, value);
  });
  connect(
      form_, &FilterForm::matricesChosen, this, [this](const std::vector<std::size_t>& matrices) {
        if (const auto at = list_->chosen()) editor_.setMatrices(*at, matrices);
      });
  renew();
}

QWidget* FilterPanel::makeTop() {
  auto* top = new QWidget(this);
  onBox_ = named(new QCheckBox("Filter the shown frames", top),
                 "filterOn",
                 "Show data after or before filtering: A");
  connect(onBox_, &QCheckBox::toggled, this, &FilterPanel::setOn);
  const auto button = [&](const QString& text, const QString& tip) {
    auto* made = new QToolButton(top);
    made->setText(text);
    made->setToolTip(tip);
    made->setAccessibleName(tip);
    return made;
  };
  undo_ = button("↶", "Undo a change of the filters");
  redo_ = button("↷", "Redo it");
  connect(undo_, &QToolButton::clicked, &editor_, &RecipeEditor::undo);
  connect(redo_, &QToolButton::clicked, &editor_, &RecipeEditor::redo);
  auto* presets = new QPushButton("Recipes", top);
  auto* menu = new QMenu(presets);
  fillMoreMenu(*menu);
  presets->setMenu(menu);
  top->setLayout(inRow({{onBox_, 1}, undo_, redo_, presets}));
  return top;
}

QWidget* FilterPanel::makeButtons() {
  auto* line = new QWidget(this);
  auto* add = makeButton(line, "filterAdd", "Add");
  auto* menu = new QMenu(add);
  fillAddMenu(*menu);
  add->setMenu(menu);
  up_ = makeButton(line, {}, "Up", "Earlier in the chain (Alt+Up)");
  down_ = makeButton(line, {}, "Down", "Later in the chain (Alt+Down)");
  remove_ = makeButton(line, {}, "Remove", "Remove it (Del)");
  const auto step = [this](int way) {
    const auto at = list_->chosen();
    if (!at) return;
    const std::size_t to = *at + static_cast<std::size_t>(way);
    if (to >= editor_.recipe().steps.size()) return;
    editor_.move(*at, to);
    list_->choose(to);
    showForm();
  };
  connect(up_, &QPushButton::clicked, this, [step] { step(-1); });
  connect(down_, &QPushButton::clicked, this, [step] { step(1); });
  connect(remove_, &QPushButton::clicked, this, [this] {
    if (const auto at = list_->chosen()) editor_.remove(*at);
  });
  line->setLayout(inRow({add, Stretch{}, up_, down_, remove_}));
  return line;
}

void FilterPanel::fillAddMenu(QMenu& menu) {
  const std::pair<FilterDomain, const char*> parts[] = {
      {FilterDomain::kSpatial, "Over space"},
      {FilterDomain::kTemporal, "Over time"},
      {FilterDomain::kSpatioTemporal, "Over both"}};
  for (const auto& [domain, title] : parts) {
    menu.addSection(title);
    for (const FilterKind& kind : filterKinds()) {
      if (kind.domain != domain) continue;
      QAction* entry = menu.addAction(QString::fromStdString(kind.title));
      entry->setToolTip(QString::fromStdString(kind.purpose));
      connect(entry, &QAction::triggered, this, [this, name = kind.name] { addStep(name); });
    }
  }
  menu.setToolTipsVisible(true);
}

void FilterPanel::fillMoreMenu(QMenu& menu) {
  for (const Recipe& preset : recipePresets()) {
    QAction* entry = menu.addAction(QString::fromStdString(preset.name));
    entry->setToolTip(QString::fromStdString(recipeText(preset)));
    connect(entry, &QAction::triggered, this, [this, preset] {
      editor_.setRecipe(preset);
      list_->choose(0);
      showForm();
      setOn(true);
    });
  }
  menu.addSeparator();
  connect(menu.addAction("Open a recipe…"), &QAction::triggered, this, &FilterPanel::openRecipe);
  connect(menu.addAction("Save the recipe…"), &QAction::triggered, this, &FilterPanel::saveRecipe);
  keep_ = menu.addAction("Add them to the recording");
  keep_->setToolTip("The filters are stored in the recording; the recorded frames don't change");
  connect(keep_, &QAction::triggered, this, &FilterPanel::keepRequested);
  menu.addSeparator();
  connect(menu.addAction("Remove all filters"), &QAction::triggered, this, [this] {
    editor_.setRecipe({});
  });
  menu.setToolTipsVisible(true);
}

void FilterPanel::addStep(const std::string& name) {
  const auto at = list_->chosen();
  const std::size_t index = at ? *at + 1 : editor_.recipe().steps.size();
  try {
    editor_.insert(index, {.name = name});
  } catch (const std::invalid_argument& error) {
    emit message(error.what());
    return;
  }
  list_->choose(index);
  showForm();
  setOn(true);
}

void FilterPanel::openRecipe() {
  const std::filesystem::path path = ask_.file("Open a recipe", {}, kRecipeFiles).toStdString();
  if (path.empty()) return;
  reading_.start(
      [this, path]() -> FileReading::Take {
        return [this, recipe = readRecipe(path)] {
          editor_.setRecipe(recipe);
          setOn(true);
        };
      },
      [this](const QString& why) { emit message(why); });
}

void FilterPanel::saveRecipe() {
  const std::filesystem::path path =
      ask_.newFile("Save the recipe", "recipe.json", kRecipeFiles, ".json").toStdString();
  if (path.empty()) return;
  try {
    Recipe recipe = editor_.recipe();
    recipe.name = path.stem().string();
    writeRecipe(path, recipe, true);
    emit message("saved " + QString::fromStdString(path.filename().string()));
  } catch (const Error& error) {
    emit message(error.what());
  }
}

void FilterPanel::setOn(bool on) {
  if (on == on_) return;
  on_ = on;
  onBox_->setChecked(on);
  showTotals();
  emit onChanged(on);
}

void FilterPanel::setSource(const QStringList& matrixNames, double rateHz, bool live) {
  if (reading_.busy()) {
    reading_.abandon();
    emit message("the recipe was not opened: another hand or recording is shown");
  }
  form_->setMatrixNames(matrixNames);
  form_->setRate(rateHz);
  rateHz_ = rateHz;
  live_ = live;
  renew();
}

void FilterPanel::setKeepable(bool keepable) { keep_->setEnabled(keepable); }

void FilterPanel::showFigures(const std::optional<FilterFigures>& figures) {
  figures_ = figures;
  failure_.clear();
  list_->showFigures(figures_);
  showTotals();
}

void FilterPanel::showProgress(const std::optional<double>& fraction) {
  progress_->setVisible(fraction.has_value());
  if (fraction) progress_->setValue(static_cast<int>(*fraction * 100.0));
}

void FilterPanel::showFailure(const QString& message) {
  failure_ = message;
  showProgress(std::nullopt);
  showTotals();
}

void FilterPanel::renew() {
  list_->showRecipe(editor_.recipe(), live_);
  if (!list_->chosen() && !editor_.recipe().steps.empty()) list_->choose(0);
  list_->showFigures(figures_);
  undo_->setEnabled(editor_.canUndo());
  redo_->setEnabled(editor_.canRedo());
  showForm();
  showTotals();
}

void FilterPanel::showForm() {
  const auto at = list_->chosen();
  const std::size_t count = editor_.recipe().steps.size();
  form_->showStep(at && *at < count ? &editor_.recipe().steps[*at] : nullptr);
  heading_->setVisible(at.has_value());
  up_->setEnabled(at && *at > 0);
  down_->setEnabled(at && *at + 1 < count);
  remove_->setEnabled(at.has_value());
}

void FilterPanel::showTotals() {
  const Recipe& recipe = editor_.recipe();
  if (!failure_.isEmpty()) return totals_->setText(failure_);
  if (recipe.empty()) return totals_->setText("Nothing is filtered.");
  if (!figures_) return totals_->setText(on_ ? "…" : "Filters are off: values as recorded.");
  const double costUs = std::accumulate(figures_->costsUs.begin(), figures_->costsUs.end(), 0.0);
  QString text = figure(costUs, 1) + " µs per frame, " + figure(costUs * kFastestHz / 1e4, 2) +
                 " % of a core at 230 frames/s. ";
  if (!recipe.causal() && !live_) {
    text += "Needs later frames: for recordings, not for a live hand.";
  } else if (!figures_->latency) {
    text += "A load step never reaches half its height.";
  } else {
    text += "A contact is seen " + quantity(*figures_->latency, "frame");
    if (rateHz_ > 0.0) text += " (" + figure(*figures_->latency * 1e3 / rateHz_, 0) + " ms)";
    text += " later.";
  }
  totals_->setText(text + " Taxels that were not active as recorded stay inactive.");
}

}  // namespace palpate::gui
