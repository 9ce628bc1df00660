// Applies the edited chain of filters to the displayed source, a recording or a live hand, and
// holds the switch that turns it on; shows a recording over the baselines of its events as they are
// edited. The recording on disk doesn't change.
#pragma once

#include <QObject>
#include <QSettings>
#include <QString>
#include <optional>
#include <vector>

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
  // All arguments must outlive this object.
  ActiveFilters(DisplayedSource& displayed,
                EventController& events,
                LiveController& live,
                Messages& messages,
                QSettings& settings,
                QObject* parent = nullptr);

  // Edits the chain; changes apply at once.
  RecipeEditor& editor() noexcept { return editor_; }
  const Recipe& recipe() const noexcept { return editor_.recipe(); }
  // True: the filtered values are shown; false: the values as recorded.
  bool on() const noexcept { return on_; }
  void setOn(bool on);
  // Shows `recipe` until giveBack(), and then the user's filters again. The settings keep those of
  // the user. If the user has edited the chain meanwhile, it stays.
  void lend(const Recipe& recipe);
  void giveBack();
  // Takes `recipe` and switches it on; without one, takes recipe and switch from the settings of
  // the last session.
  void restore(const std::optional<Recipe>& recipe);

  // Whether the values shown now are filtered.
  bool applied() const;
  // The enabled steps as text.
  QString text() const;
  // " · filtered: .." for captions of pictures; empty when the values aren't filtered.
  QString caption() const;
  // Adds the recipe to the displayed recording, as one of its events.
  void keepWithRecording();
  // Cost and latency of the steps on the live source, for display four times a second; nothing when
  // no live source is filtered.
  std::optional<FilterFigures> liveFigures();
  // Waits until the filtering of the recording has ended; for tests and pictures.
  void wait() { worker_.settle(); }

 signals:
  void onChanged(bool on);
  // Another recording or hand is filtered from now on.
  void sourceChanged();
  // Progress while a recording is being filtered, 0..1; nothing: done.
  void progressed(const std::optional<double>& fraction);
  void measured(const std::optional<palpate::gui::FilterFigures>& figures);
  void failed(const QString& message);

 private:
  // What is applied was lent, and not edited since.
  bool isLent() const;
  void apply();
  // The filters that are on.
  Recipe recipeOn() const { return on_ ? recipe() : Recipe{}; }
  // The baselines among the events of the recording where they differ from those that it was read
  // with; nothing: they are the same.
  std::optional<std::vector<Event>> newBaselines(const OpenedRecordingPtr& recording) const;
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
  // Chain and switch are those of the last session, and no recording was shown yet.
  bool ofLastSession_ = false;
  struct Lent {
    Recipe recipe;
    // The user's filters.
    Recipe own;
    bool ownOn = false;
  };
  std::optional<Lent> lent_;
  bool sourceIsNew_ = false;
  // The recording madeOf_ filtered by the recipe madeBy_ and over the baselines madeOver_; null:
  // not made yet.
  OpenedRecordingPtr made_;
  OpenedRecordingPtr madeOf_;
  Recipe madeBy_;
  std::optional<std::vector<Event>> madeOver_;
  // The edited baselines over which the displayed recording is shown; nothing: those in its file.
  std::optional<std::vector<Event>> over_;
  // The recording whose stored recipe was taken last.
  OpenedRecordingPtr keptTaken_;
  // The figures of liveRecipe_.
  FilterFigures liveFigures_;
  Recipe liveRecipe_;
};

}  // namespace palpate::gui
