#include "gui/window_state/active_filters.h"

#include <QSignalBlocker>
#include <algorithm>
#include <string>
#include <utility>

#include <palpate/core/error.h>
#include <palpate/live/filter_stage.h>

namespace palpate::gui {
namespace {

constexpr const char* kRecipeKey = "filter/recipe";
constexpr const char* kOnKey = "filter/on";
// Kind of the events that hold a recipe.
constexpr const char* kRecipeKind = "recipe";

std::optional<Recipe> recipeFrom(const std::string& json) {
  try {
    return recipeFromJson(Json::parse(json));
  } catch (const Error&) {
    // The recipe is damaged or of a later version: it is ignored.
    return std::nullopt;
  }
}

}  // namespace

ActiveFilters::ActiveFilters(DisplayedSource& displayed,
                             EventController& events,
                             LiveController& live,
                             Messages& messages,
                             QSettings& settings,
                             QObject* parent)
    : QObject(parent),
      displayed_(displayed),
      events_(events),
      live_(live),
      messages_(messages),
      settings_(settings) {
  displayed_.filtered = [this](const OpenedRecordingPtr& recording) -> OpenedRecordingPtr {
    const auto over = newBaselines(recording);
    const bool made =
        made_ && madeOf_ == recording && madeBy_.sameSteps(recipeOn()) && madeOver_ == over;
    return made && !(recipeOn().empty() && !over) ? made_ : nullptr;
  };
  connect(&displayed_, &DisplayedSource::changed, this, [this] {
    if (made_ && madeOf_ != displayed_.unfilteredRecording()) made_ = madeOf_ = nullptr;
    sourceIsNew_ = true;
    emit sourceChanged();
  });
  connect(&displayed_, &DisplayedSource::shown, this, [this] {
    if (!std::exchange(sourceIsNew_, false)) return;
    // Said once, and not of what the user has chosen in this session.
    const bool ofLastSession = displayed_.isRecording() && std::exchange(ofLastSession_, false);
    if (ofLastSession && on_ && !recipe().empty())
      messages_.flash("filtered as in the last session: " + text() +
                      "; A switches the filters off");
    takeKeptRecipe();
    apply();
  });
  connect(&editor_, &RecipeEditor::changed, this, [this] {
    if (!isLent()) {
      settings_.setValue(kRecipeKey, QString::fromStdString(recipeJson(recipe()).text(-1)));
      settings_.setValue(kOnKey, on_);
    }
    ofLastSession_ = false;
    emit measured(std::nullopt);
    apply();
    noteInLiveRecording();
  });
  connect(&live_, &LiveController::recordingStarted, this, &ActiveFilters::noteInLiveRecording);
  connect(&worker_, &FilterWorker::progressed, this, [this](double fraction) {
    emit progressed(fraction);
  });
  connect(&worker_, &FilterWorker::measured, this, [this](const FilterFigures& figures) {
    emit measured(figures);
  });
  connect(&worker_,
          &FilterWorker::made,
          this,
          [this](const OpenedRecordingPtr& source, const OpenedRecordingPtr& filtered) {
            emit progressed(std::nullopt);
            madeOf_ = source;
            made_ = filtered;
            madeBy_ = recipeOn();
            madeOver_ = over_;
            if (source == displayed_.recorded()) displayed_.setFilteredRecording(filtered);
          });
  connect(&events_, &EventController::changed, this, [this] {
    const OpenedRecordingPtr recording = displayed_.recorded();
    if (recording && !sourceIsNew_ && newBaselines(recording) != over_) apply();
  });
  connect(&worker_, &FilterWorker::failed, this, [this](const QString& message) {
    emit failed(message);
    displayed_.setFilteredRecording(displayed_.recorded());
  });
}

void ActiveFilters::restore(const std::optional<Recipe>& recipe) {
  const auto last =
      recipe ? recipe : recipeFrom(settings_.value(kRecipeKey).toString().toStdString());
  // A recipe given on the command line isn't written to the settings.
  const QSignalBlocker quiet(editor_);
  if (last) editor_.restore(*last);
  on_ = recipe || settings_.value(kOnKey, false).toBool();
  ofLastSession_ = !recipe;
}

bool ActiveFilters::isLent() const { return lent_ && recipe().sameSteps(lent_->recipe); }

void ActiveFilters::lend(const Recipe& recipe) {
  if (isLent()) return;
  lent_ = Lent{recipe, this->recipe(), on_};
  editor_.setRecipe(recipe);
  setOn(true);
}

void ActiveFilters::giveBack() {
  const bool unchanged = isLent();
  if (unchanged) {
    // What the settings remember stays: the user's filters may be those of the command line.
    lent_->recipe = lent_->own;
    editor_.setRecipe(lent_->own);
    setOn(lent_->ownOn);
  }
  lent_.reset();
}

void ActiveFilters::setOn(bool on) {
  if (on == on_) return;
  on_ = on;
  ofLastSession_ = false;
  if (!isLent()) settings_.setValue(kOnKey, on);
  apply();
  emit onChanged(on);
  messages_.flash(!on ? QString("filters are off: values as recorded")
                  : recipe().empty()
                      ? QString("no filter is chosen: add one in the dock Filter (Ctrl+Shift+F)")
                      : "filtered: " + text());
  LiveSource* source = live_.source();
  if (!on && source && live_.recording() && !recipe().empty()) {
    const std::int64_t us = source->session->nowUs();
    source->session->note({us, us, "note", std::nullopt, "filters were switched off", {}});
  }
  noteInLiveRecording();
}

// Notes the recipe in the running recording, so that the recording tells what the operator saw.
void ActiveFilters::noteInLiveRecording() {
  LiveSource* source = live_.source();
  if (!source || !live_.recording() || !applied()) return;
  const std::int64_t us = source->session->nowUs();
  source->session->note(
      {us, us, kRecipeKind, std::nullopt, fullRecipeText(recipe()), recipeJson(recipe()).text(-1)});
}

bool ActiveFilters::applied() const {
  if (!on_ || recipe().empty()) return false;
  return displayed_.isLive() || (displayed_.isRecording() && displayed_.filteredRecording() !=
                                                                 displayed_.unfilteredRecording());
}

QString ActiveFilters::text() const {
  Recipe seen = recipe();
  std::erase_if(seen.steps, [](const FilterStep& step) { return !step.enabled; });
  return QString::fromStdString(shownRecipeText(seen));
}

// Appears in the captions of pictures.
QString ActiveFilters::caption() const { return applied() ? " · filtered: " + text() : QString(); }

// Applies the chain, or no filter when it is off, to the displayed source.
void ActiveFilters::apply() {
  const Recipe now = recipeOn();
  if (LiveSource* source = live_.source()) {
    try {
      source->filters->setRecipe(now);
      const std::size_t numPlaces = source->session->device().hand().layout->numCells();
      for (const FilterStep& step : now.steps)
        if (step.enabled && step.rest && step.rest->rest.size() != numPlaces)
          emit failed(
              "The baseline is from another hand and is ignored: Baseline (Ctrl+Alt+L) takes a new "
              "one");
    } catch (const std::invalid_argument& error) {
      emit failed(error.what());
    }
  }
  worker_.abandon();
  emit progressed(std::nullopt);
  const OpenedRecordingPtr recording = displayed_.recorded();
  if (!recording) return;
  over_ = newBaselines(recording);
  if (now.empty() && !over_)
    displayed_.setFilteredRecording(recording);
  else if (made_ && madeOf_ == recording && madeBy_.sameSteps(now) && madeOver_ == over_)
    displayed_.setFilteredRecording(made_);
  else if (!over_)
    worker_.ask({recording, now});
  else
    worker_.ask(
        {recording, now, baselinesOf(events_.eventsOf(recording), recording->profile.layout())});
}

std::optional<std::vector<Event>> ActiveFilters::newBaselines(
    const OpenedRecordingPtr& recording) const {
  if (!recording->profile.givesReadings()) return std::nullopt;
  const auto baselines = [](std::vector<Event> events) {
    std::erase_if(events, [](const Event& event) {
      return event.kind != kBaselineKind && event.kind != kNewBaselineKind;
    });
    return events;
  };
  std::vector<Event> now = baselines(events_.eventsOf(recording));
  if (now == baselines(recording->events.events)) return std::nullopt;
  return now;
}

// Takes the last recipe that is stored with the recording, unless it equals the present one.
void ActiveFilters::takeKeptRecipe() {
  const EventEditor* editor = events_.editor();
  if (editor == nullptr || keptTaken_ == displayed_.recorded()) return;
  const auto& all = editor->events();
  const auto kept = std::find_if(
      all.rbegin(), all.rend(), [](const Event& event) { return event.kind == kRecipeKind; });
  if (kept == all.rend()) return;
  keptTaken_ = displayed_.recorded();
  const auto now = recipeFrom(kept->json);
  if (!now || now->sameSteps(recipe())) return;
  editor_.setRecipe(*now);
  setOn(true);
  messages_.flash("filters of the recording: " + QString::fromStdString(shownRecipeText(*now)));
}

void ActiveFilters::keepWithRecording() {
  const OpenedRecordingPtr recording = displayed_.recorded();
  if (!recording) return;
  const bool none = recipe().steps.empty();
  const std::int64_t us =
      recording->profile.numFrames() > 0 ? recording->profile.frameTimeUs(0) : 0;
  const Event event{
      us, us, kRecipeKind, std::nullopt, fullRecipeText(recipe()), recipeJson(recipe()).text(-1)};
  events_.keep(kRecipeKind, none ? std::nullopt : std::optional(event), "the recipe");
  keptTaken_ = recording;
  messages_.flash(none ? "the recording's filters are removed: save it with Ctrl+S"
                       : "the filters are added to the recording: save it with Ctrl+S");
}

std::optional<FilterFigures> ActiveFilters::liveFigures() {
  const LiveSource* source = live_.source();
  if (source == nullptr) return std::nullopt;
  if (liveFigures_.costsUs.size() != recipe().steps.size() || liveRecipe_ != recipe()) {
    liveRecipe_ = recipe();
    liveFigures_ = {};
    // The rate at the time of the change: delays of filters with a frequency are counted in frames.
    const double measuredHz = live_.health().frames.rateHz;
    const double rateHz = measuredHz > 0.0 ? measuredHz : kUsualRateHz;
    liveFigures_.latency = latencyFrames(recipe(), rateHz);
    for (const FilterStep& step : recipe().steps)
      liveFigures_.latencies.push_back(latencyFrames(step, rateHz));
  }
  liveFigures_.costsUs = source->filters->costsUs();
  liveFigures_.costsUs.resize(recipe().steps.size(), 0.0);
  return on_ ? std::optional(liveFigures_) : std::nullopt;
}

}  // namespace palpate::gui
