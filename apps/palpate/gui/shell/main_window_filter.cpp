// The window's filters: what is shown is seen through them, a recording or a live hand. What is on disk stays as it is.
#include <QFileInfo>
#include <algorithm>
#include <cmath>

#include <palpate/core/error.h>
#include <palpate/live/filter_stage.h>

#include "gui/bench/event_marks.h"
#include "gui/filter/filter_panel.h"
#include "gui/inspect/inspect_panel.h"
#include "gui/matrices/matrices_panel.h"
#include "gui/matrices/matrices_view.h"
#include "gui/shell/main_window.h"
#include "gui/space/hand_panel.h"
#include "gui/timeline/timeline_chart.h"
#include "gui/widgets/dock.h"
#include "gui/widgets/message_banner.h"

namespace palpate::gui {
namespace {

constexpr const char* kRecipeKey = "filter/recipe";
constexpr const char* kOnKey = "filter/on";
constexpr const char* kRecipeKind = "recipe";  // of events

std::optional<Recipe> recipeFrom(const std::string& json) {
  try {
    return recipeFromJson(Json::parse(json));
  } catch (const Error&) {
    return std::nullopt;  // of a later version, or damaged: as if there were none
  }
}

// As short as buttons in a row are: "0d".
QStringList matrixNamesOf(const HandDescription& hand) {
  QStringList names;
  for (const MatrixDescription& matrix : hand.matrices)
    names.append(QString::fromStdString(matrix.shortName).section(' ', 0, 0) +
                 QString::fromStdString(matrix.shortName).section(' ', 1, 1).left(1));
  return names;
}

}  // namespace

void MainWindow::buildFilter() {
  filter_ = new FilterPanel(this);
  filterDock_ = new Dock("Filter", filter_, nullptr, this);
  filterDock_->toggleViewAction()->setShortcut(QKeySequence("Ctrl+Shift+F"));
  docks_.append(filterDock_);
}

void MainWindow::connectFilter(const std::optional<Recipe>& recipe) {
  const auto last =
      recipe ? recipe : recipeFrom(settings_.value(kRecipeKey).toString().toStdString());
  if (last) filter_->editor().restore(*last);
  filter_->setOn(recipe || settings_.value(kOnKey, false).toBool());
  actions_.filtered->setChecked(filter_->on());
  connect(actions_.filtered, &QAction::triggered, filter_, &FilterPanel::setOn);
  connect(filter_, &FilterPanel::onChanged, this, [this](bool on) {
    actions_.filtered->setChecked(on);
    settings_.setValue(kOnKey, on);
    showThroughFilter();
    flash(!on                                  ? "as it was recorded"
          : filter_->editor().recipe().empty() ? "no filter is in the chain: Ctrl+Shift+F"
                                               : "filtered: " + filterText());
  });
  connect(&filter_->editor(), &RecipeEditor::changed, this, [this] {
    settings_.setValue(kRecipeKey,
                       QString::fromStdString(recipeJson(filter_->editor().recipe()).text(-1)));
    filter_->showFigures(std::nullopt);
    showThroughFilter();
  });
  // What the operator saw belongs to what was recorded.
  const auto noteRecipe = [this] {
    LiveSource* source = live_.source();
    if (!source || !live_.recording() || !filteredShown()) return;
    const Recipe& seen = filter_->editor().recipe();
    const std::int64_t us = source->session->nowUs();
    source->session->note(
        {us, us, kRecipeKind, std::nullopt, recipeText(seen), recipeJson(seen).text(-1)});
  };
  connect(&live_, &LiveController::recordingStarted, this, noteRecipe);
  connect(filter_, &FilterPanel::onChanged, this, noteRecipe);
  connect(&filter_->editor(), &RecipeEditor::changed, this, noteRecipe);
  connect(filter_, &FilterPanel::told, this, &MainWindow::flash);
  connect(filter_, &FilterPanel::keepAsked, this, &MainWindow::keepRecipe);
  connect(&filterWorker_, &FilterWorker::progressed, filter_, [this](double fraction) {
    filter_->showProgress(fraction);
  });
  connect(&filterWorker_,
          &FilterWorker::made,
          this,
          [this](const OpenedRecordingPtr& source, const OpenedRecordingPtr& filtered) {
            filter_->showProgress(std::nullopt);
            filterResults_.of = source;
            filterResults_.filtered = filtered;
            filterResults_.by = filter_->editor().recipe();
            if (source == current_ && filter_->on() && !liveShown_) useShown(filtered);
          });
  connect(&filterWorker_, &FilterWorker::measured, filter_, &FilterPanel::showFigures);
  connect(&filterWorker_, &FilterWorker::failed, this, [this](const QString& message) {
    filter_->showFailure(message);
    if (current_ && !liveShown_) useShown(current_);
  });
}

QString MainWindow::filterText() const {
  Recipe seen = filter_->editor().recipe();
  std::erase_if(seen.steps, [](const FilterStep& step) { return !step.enabled; });
  return QString::fromStdString(recipeText(seen));
}

// A picture says what it is of.
QString MainWindow::filteredCaption() const {
  return filteredShown() ? " · filtered: " + filterText() : QString();
}

bool MainWindow::filteredShown() const {
  if (!filter_->on() || filter_->editor().recipe().empty()) return false;
  return liveShown_ || (shown_ && shown_ != current_);
}

// Of the frame as it was recorded, whatever the filters make of it.
std::ptrdiff_t MainWindow::saturatedNow() const {
  const float saturation = current_->profile.hand().saturationCounts;
  const auto count = [saturation](const TactileFrame& frame) {
    return std::count_if(frame.values.begin(), frame.values.end(), [saturation](float value) {
      return value >= saturation;
    });
  };
  if (!filteredShown()) return count(matrices_->frame());
  try {
    return count(current_->profile.frame(playback_.frame()));
  } catch (const Error&) {
    return 0;  // said where the frame would be
  }
}

// Brings what is shown in line with the chain and its switch.
void MainWindow::showThroughFilter() {
  const Recipe& recipe = filter_->editor().recipe();
  const Recipe now = filter_->on() ? recipe : Recipe{};
  if (LiveSource* source = live_.source()) {
    try {
      source->filters->setRecipe(now);
    } catch (const std::invalid_argument& error) {
      filter_->showFailure(error.what());
    }
  }
  filterWorker_.cancel();
  filter_->showProgress(std::nullopt);
  if (liveShown_ || !current_) return updateStatus();
  if (now.empty()) {
    useShown(current_);
  } else if (filterResults_.filtered && filterResults_.of == current_ &&
             filterResults_.by.sameSteps(now)) {
    useShown(filterResults_.filtered);
  } else {
    filterWorker_.start(current_, now);
  }
}

// A recording is shown now, or a hand.
void MainWindow::filterNewSource() {
  shown_ = current_;
  if (liveShown_) {
    const HandDescription hand = live_.source()->session->device().hand();
    filter_->setSource(matrixNamesOf(hand), live_.health().frames.rateHz, true);
  } else if (current_) {
    filter_->setSource(
        matrixNamesOf(current_->profile.hand()), current_->timingNow().rateHz, false);
    takeKeptRecipe();
  }
  filter_->setKeepable(current_ && !liveShown_);
  if (filterResults_.filtered && filterResults_.of != current_) {
    filterResults_.filtered.reset();
    filterResults_.of.reset();
  }
  showThroughFilter();
}

// The same moment, the same part of the timeline, other values.
void MainWindow::useShown(const OpenedRecordingPtr& recording) {
  if (recording == shown_) return updateStatus();
  noteWhereWeAre();
  shown_ = recording;
  const std::size_t frame = playback_.frame();
  timeline_->setRecording(recording);
  timeline_->setBefore(recording != current_ ? current_ : nullptr);
  matrices_->setRecording(recording);
  handPanel_->setRecording(recording);
  inspect_->setRecording(recording);
  goBackToWhereWeWere();
  if (playback_.hasFrames()) showFrame(frame);
  showCurves();
  showReading();
  showEvents();
  showSpectrum();
  updateStatus();
}

// The last one that was kept with it, if it isn't the one that is there.
void MainWindow::takeKeptRecipe() {
  const EventEditor* editor = events();
  if (editor == nullptr) return;
  const auto& all = editor->events();
  const auto kept = std::find_if(all.rbegin(), all.rend(), [](const RecordingEvent& event) {
    return event.kind == kRecipeKind;
  });
  if (kept == all.rend() || filterResults_.keptTaken == current_) return;
  filterResults_.keptTaken = current_;
  const auto recipe = recipeFrom(kept->json);
  if (!recipe || recipe->sameSteps(filter_->editor().recipe())) return;
  filter_->editor().setRecipe(*recipe);
  filter_->setOn(true);
  flash("filters kept with the recording: " + QString::fromStdString(recipeText(*recipe)));
}

void MainWindow::keepRecipe() {
  EventEditor* editor = events();
  if (editor == nullptr) return;
  const Recipe& recipe = filter_->editor().recipe();
  const std::int64_t us = current_->profile.numFrames() > 0 ? current_->profile.frameTimeUs(0) : 0;
  const RecordingEvent event{
      us, us, kRecipeKind, std::nullopt, recipeText(recipe), recipeJson(recipe).text(-1)};
  const QString name = "the recipe";
  editor->changeTogether(name, [&] {
    for (std::size_t i = editor->events().size(); i-- > 0;)
      if (editor->events()[i].kind == kRecipeKind) editor->remove(i, name);
    if (!recipe.steps.empty()) editor->add(event, name);
  });
  filterResults_.keptTaken = current_;
  flash(recipe.steps.empty() ? "no filters are kept with the recording: save with Ctrl+S"
                             : "the filters are kept with the recording: save with Ctrl+S");
}

// Four times a second.
void MainWindow::showLiveFilter() {
  const LiveSource* source = live_.source();
  if (source == nullptr || filterDock_->isHidden()) return;
  const Recipe& recipe = filter_->editor().recipe();
  if (filterResults_.live.costsUs.size() != recipe.steps.size() ||
      filterResults_.liveOf != recipe) {
    filterResults_.liveOf = recipe;
    filterResults_.live = {};
    filterResults_.live.latency = latencyFrames(recipe);
    for (const FilterStep& step : recipe.steps)
      filterResults_.live.latencies.push_back(latencyFrames(step));
  }
  filterResults_.live.costsUs = source->filters->costsUs();
  filterResults_.live.costsUs.resize(recipe.steps.size(), 0.0);
  filter_->showFigures(filter_->on() ? std::optional(filterResults_.live) : std::nullopt);
}

}  // namespace palpate::gui
