#include "gui/timeline/baseline_controls.h"

#include <QDateTime>
#include <algorithm>
#include <cmath>
#include <iterator>

#include <palpate/core/error.h>
#include <palpate/core/time.h>
#include <palpate/model/rest_span.h>

#include "gui/window_state/event_marks.h"

namespace palpate::gui {
namespace {

constexpr const char* kRefusedTopic = "baseline";

// Whether readings are seen as they are.
bool isNone(const std::shared_ptr<const Baseline>& baseline) {
  return !baseline || *baseline == Baseline{std::vector<float>(baseline->rest.size()), {}};
}

// "taken 14:03:12", "the previous one, since 14:05:40", "none".
QString takenText(const Event& event, const SensorLayout& layout) {
  if (isNone(baselineAt(baselinesOf({&event, 1}, layout), event.tUs))) return "none";
  const bool isPrevious = event.text == kPreviousBaselineText;
  return (isPrevious ? "the previous one, since " : "taken ") +
         QDateTime::fromMSecsSinceEpoch(event.tUs / kUsPerMs).toString("HH:mm:ss");
}

}  // namespace

BaselineControls::BaselineControls(WindowState& windowState, const TimelineActions& actions)
    : windowState_(windowState),
      takeBaseline_(*actions.takeBaseline),
      tip_(actions.takeBaseline->toolTip()) {
  connect(actions.takeBaseline, &QAction::triggered, this, &BaselineControls::take);
  connect(actions.undoBaseline, &QAction::triggered, this, &BaselineControls::undo);
  connect(
      actions.baselineOfSelection, &QAction::triggered, this, &BaselineControls::takeOfSelection);
  connect(&reading_, &BackgroundJob::failed, this, [this](const QString& why) { refuse(why); });
  connect(&windowState.live, &LiveController::leaving, this, [this] {
    live_.clear();
    liveByEvent_ = false;
  });
  connect(&windowState.displayed, &DisplayedSource::shown, this, &BaselineControls::showInForce);
  connect(&windowState.live,
          &LiveController::eventsReceived,
          this,
          [this](const std::vector<Event>& events) {
            const LiveSource* source = windowState_.live.source();
            for (const Event& event : events) {
              if (event.kind != kBaselineKind || !source) continue;
              // A replay also passes on the events of its recording.
              if (source->connection.kind == Connection::Kind::kReplay &&
                  !source->session->canUndoBaseline())
                continue;
              live_ = takenText(event, *source->session->device().hand().layout);
              liveByEvent_ = true;
            }
            showInForce();
          });
  connect(&windowState.events, &EventController::changed, this, &BaselineControls::showInForce);
  connect(&windowState.currentFrame, &CurrentFrame::frameChanged, this, [this] {
    const bool isFirst = windowState_.displayed.isLive() && live_.isEmpty();
    if (isFirst || windowState_.currentFrame.frame().baseline != seen_) showInForce();
  });
  ActionEnabler& enabler = windowState_.actionEnabler;
  enabler.add(
      {actions.takeBaseline},
      [this] { return windowState_.displayed.source() != nullptr; },
      "No connected hand is shown; Edit > Selection has Baseline from the selection");
  enabler.add({actions.undoBaseline}, [this] { return canUndo(); });
  enabler.add({actions.baselineOfSelection}, [this] {
    return windowState_.displayed.hasFrames() && windowState_.selection.span().has_value();
  });
}

void BaselineControls::showInForce() {
  const QString text = inForce();
  seen_ = windowState_.currentFrame.frame().baseline;
  windowState_.derivedResults.setBaseline(text);
  takeBaseline_.setToolTip(text.isEmpty() ? tip_ : tip_ + "\nBaseline in force: " + text);
}

// Filtered frames have no readings and no baseline.
QString BaselineControls::inForce() {
  const DisplayedSource& displayed = windowState_.displayed;
  const TactileFrame& frame = windowState_.currentFrame.frame();
  if (displayed.isLive()) {
    if (!displayed.givesReadings()) return {};
    if (!liveByEvent_ && !frame.readings.empty())
      live_ = isNone(frame.baseline) ? "none" : "of the recording";
    return live_;
  }
  const OpenedRecordingPtr recording = displayed.recorded();
  if (!recording || !recording->profile.givesReadings()) return {};
  const std::vector<Event> events = windowState_.events.eventsOf(recording);
  const Baselines all = baselinesOf(events, recording->profile.layout());
  if (isNone(baselineAt(all, frame.hostUs))) return "none";
  const auto isNew = [](const Event& event) { return event.kind == kNewBaselineKind; };
  return std::ranges::any_of(events, isNew) ? "taken from a selection" : "of the recording";
}

void BaselineControls::refuse(const QString& why) {
  windowState_.messages.failAbout(kRefusedTopic, why);
}

void BaselineControls::tell(const QString& taken) {
  windowState_.messages.withdraw(kRefusedTopic);
  windowState_.messages.flash("baseline of " + taken);
  windowState_.actionEnabler.refresh();
}

void BaselineControls::take() {
  LiveSource* source = windowState_.displayed.source();
  if (source == nullptr) return;
  CaptureSession& session = *source->session;
  try {
    if (session.device().hand().layout->decidesTouch())
      return tell(QString::fromStdString(session.takeBaseline()));
    const Rest rest = session.restNow();
    putFilter({.name = "baseline", .rest = rest.baseline});
    tell(QString::fromStdString(baselineText(rest.baseline, rest.numFrames)) +
         "; it is a filter, A switches the filters off");
  } catch (const std::exception& error) {
    refuse(QString::fromUtf8(error.what()));
  }
}

bool BaselineControls::canUndo() const {
  const LiveSource* source = windowState_.displayed.source();
  if (source == nullptr) return false;
  RecipeEditor& editor = windowState_.activeFilters.editor();
  return source->session->canUndoBaseline() ||
         (!put_.empty() && editor.recipe() == put_ && editor.canUndo());
}

void BaselineControls::undo() {
  LiveSource* source = windowState_.displayed.source();
  if (!canUndo()) return;
  if (source->session->canUndoBaseline())
    source->session->undoBaseline();
  else
    windowState_.activeFilters.editor().undo();
  windowState_.messages.flash("the previous baseline is back");
  windowState_.actionEnabler.refresh();
}

void BaselineControls::putFilter(FilterStep step) {
  ActiveFilters& filters = windowState_.activeFilters;
  Recipe recipe = filters.recipe();
  const auto there = std::find_if(recipe.steps.begin(), recipe.steps.end(), [](const auto& each) {
    return each.name == "baseline";
  });
  if (there == recipe.steps.end()) {
    recipe.steps.insert(recipe.steps.begin(), step);
  } else {
    for (const auto& [key, value] : there->explicitOptions)
      if (key != "from" && key != "to") step.explicitOptions.emplace(key, value);
    step.matrices = there->matrices;
    *there = step;
    // A rest that was taken is of what the hand sends, before any other filter.
    if (step.rest) std::rotate(recipe.steps.begin(), there, std::next(there));
  }
  filters.editor().setRecipe(recipe);
  put_ = filters.recipe();
  filters.setOn(true);
}

void BaselineControls::takeOfSelection() {
  const OpenedRecordingPtr recording = windowState_.displayed.recorded();
  const auto span = windowState_.selection.span();
  if (!recording || !span) return;
  if (!recording->profile.givesReadings()) {
    constexpr double kPerS = 1'000.0;
    FilterStep step{.name = "baseline"};
    for (const auto& [key, seconds] : {std::pair("from", span->fromS), std::pair("to", span->toS)})
      if (const double rounded = std::round(std::max(seconds, 0.0) * kPerS) / kPerS;
          rounded != step.value(key))
        step.explicitOptions[key] = rounded;
    try {
      putFilter(std::move(step));
    } catch (const std::invalid_argument& error) {  // shorter than a millisecond
      refuse(error.what());
    }
    return;
  }
  const auto rest = std::make_shared<Rest>();
  reading_.start(
      {},
      [rest, profile = recording->profile, durationS = recording->durationS(), span = *span](
          const Progress&) {
        *rest = restIn(
            profile, std::max(span.fromS, 0.0), std::min(span.toS, durationS), RestOf::kReadings);
      },
      [this, rest, recording, span = *span] {
        if (windowState_.displayed.recorded() != recording) return;
        const QString text = QString::fromStdString(baselineText(rest->baseline, rest->numFrames));
        try {
          Event event =
              baselineEvent(rest->baseline, timeUsOf(*recording, span.fromS), kNewBaselineKind);
          event.text += ", " + text.toStdString();
          windowState_.events.keep(kNewBaselineKind, event, "a baseline");
          tell(text + "; Ctrl+S saves it, Ctrl+Z undoes it");
        } catch (const Error& error) {
          refuse(QString::fromUtf8(error.what()));
        }
      });
}

}  // namespace palpate::gui
