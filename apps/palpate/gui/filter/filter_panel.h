// The content of the dock Filter: the chain of filters with its options, its computing time and
// delay, presets and recipe files.
#pragma once

#include <QWidget>
#include <optional>

#include "gui/source/file_reading.h"
#include "gui/source/filter_worker.h"
#include "gui/window_state/recipe_editor.h"

class QCheckBox;
class QLabel;
class QMenu;
class QProgressBar;
class QPushButton;
class QToolButton;

namespace palpate::gui {

class Ask;
class FilterForm;
class FilterList;

class FilterPanel : public QWidget {
  Q_OBJECT
 public:
  // Edits the recipe of `editor`, which must outlive this.
  FilterPanel(RecipeEditor& editor, Ask& ask, QWidget* parent = nullptr);

  RecipeEditor& editor() noexcept { return editor_; }
  // Whether the filtered values are shown (after), or the recording as it is (before).
  bool on() const noexcept { return on_; }
  void setOn(bool on);
  // Describes the shown source: the names of its matrices, its frame rate [Hz], and whether it is a
  // live hand.
  void setSource(const QStringList& matrixNames, double rateHz, bool live);
  void showFigures(const std::optional<FilterFigures>& figures);
  // Progress while a recording is filtered; nothing when that is done.
  void showProgress(const std::optional<double>& fraction);
  void showFailure(const QString& message);
  void setKeepable(bool keepable);
  QSize sizeHint() const override { return {455, 520}; }

 signals:
  void onChanged(bool on);
  // The recipe is to be kept with the recording.
  void keepRequested();
  void message(const QString& message);

 private:
  QWidget* makeTop();
  QWidget* makeButtons();
  void fillAddMenu(QMenu& menu);
  void fillMoreMenu(QMenu& menu);
  void renew();
  void showForm();
  void showTotals();
  void addStep(const std::string& name);
  void openRecipe();
  void saveRecipe();

  RecipeEditor& editor_;
  Ask& ask_;
  bool on_ = false;
  bool live_ = false;
  double rateHz_ = 0.0;
  std::optional<FilterFigures> figures_;
  QString failure_;

  QCheckBox* onBox_;
  QToolButton* undo_;
  QToolButton* redo_;
  QAction* keep_ = nullptr;
  FilterList* list_;
  QPushButton* up_ = nullptr;
  QPushButton* down_ = nullptr;
  QPushButton* remove_ = nullptr;
  QLabel* heading_;
  FilterForm* form_;
  QLabel* totals_;
  QProgressBar* progress_;
  FileReading reading_{this};
};

}  // namespace palpate::gui
