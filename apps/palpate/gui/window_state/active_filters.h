// The filters that what is shown is seen through, a recording or a live hand. What is on disk stays
// as it is.
#pragma once

#include <QObject>
#include <QSettings>
#include <QString>
#include <optional>

#include <palpate/filter/recipe.h>

#include "gui/source/filter_worker.h"
#include "gui/window_state/displayed_source.h"
#include "gui/window_state/event_controller.h"
#include "gui/window_state/messages.h"
#include "gui/window_state/recipe_editor.h"

namespace palpate::gui {

class ActiveFilters : public QObject {
  Q_OBJECT
 public:
  // All of them must outlive it.
  ActiveFilters(DisplayedSource& displayed,
                EventController& events,
                LiveController& live,
                Messages& messages,
                QSettings& settings,
                QObject* parent = nullptr);

  // The chain that is edited; changes apply at once.
  RecipeEditor& editor() noexcept { return editor_; }
  const Recipe& recipe() const noexcept { return editor_.recipe(); }
  // Filtered is what is shown (after), or as it was recorded (before).
  bool on() const noexcept { return on_; }
  void setOn(bool on);
  // As of the last day, or this one, switched on.
  void restore(const std::optional<Recipe>& recipe);

  // What is shown now is filtered.
  bool applied() const;
  QString text() const;     // of the steps that are on
  QString caption() const;  // " · filtered: .."; empty: it isn't
  // With the recording that is looked at, as one of its events.
  void keepWithRecording();
  // Of what is live, four times a second; nothing: nothing is filtered there.
  std::optional<FilterFigures> liveFigures();
  // For tests and pictures: until nothing is at work any more.
  void wait() { worker_.wait(); }

 signals:
  void onChanged(bool on);
  void sourceChanged();  // another recording or hand is seen through it
  // While a recording is being filtered; nothing: done.
  void progressed(const std::optional<double>& fraction);
  void measured(const std::optional<palpate::gui::FilterFigures>& figures);
  void failed(const QString& message);

 private:
  void apply();
  void takeKeptRecipe();
  void noteInLiveRecording();

  DisplayedSource& displayed_;
  EventController& events_;
  LiveController& live_;
  Messages& messages_;
  QSettings& settings_;
  RecipeEditor editor_;
  FilterWorker worker_;
  bool on_ = false;
  bool sourceIsNew_ = false;
  OpenedRecordingPtr made_;  // madeOf_ through madeBy_; null: none yet
  OpenedRecordingPtr madeOf_;
  Recipe madeBy_;
  OpenedRecordingPtr keptTaken_;  // whose kept recipe was taken
  FilterFigures liveFigures_;     // of liveRecipe_
  Recipe liveRecipe_;
};

}  // namespace palpate::gui
