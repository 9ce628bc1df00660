// The content of the dock Filter: the chain of filters with its options, what it costs and delays,
// presets and files.
#pragma once

#include <QWidget>
#include <filesystem>
#include <functional>
#include <optional>

#include "gui/source/filter_worker.h"
#include "gui/window_state/recipe_editor.h"

class QCheckBox;
class QLabel;
class QMenu;
class QProgressBar;
class QPushButton;
class QToolButton;

namespace palpate::gui {

class FilterForm;
class FilterList;

class FilterPanel : public QWidget {
  Q_OBJECT
 public:
  // Of this chain, which must outlive it.
  explicit FilterPanel(RecipeEditor& editor, QWidget* parent = nullptr);

  RecipeEditor& editor() noexcept { return editor_; }
  // Filtered is what is shown (after), or the recording as it is (before).
  bool on() const noexcept { return on_; }
  void setOn(bool on);
  // Of what is shown: the names of the matrices, frames per second, and whether a hand is live.
  void setSource(const QStringList& matrixNames, double rateHz, bool live);
  void showFigures(const std::optional<FilterFigures>& figures);
  // While a recording is being filtered; nothing: done.
  void showProgress(const std::optional<double>& fraction);
  void showFailure(const QString& message);
  void setKeepable(bool keepable);
  QSize sizeHint() const override { return {455, 520}; }

  // How files are asked for; an empty answer means cancelled. Tests answer themselves.
  std::function<std::filesystem::path()> askForRecipe;
  std::function<std::filesystem::path(const QString& suggestion)> askForPlace;

 signals:
  void onChanged(bool on);
  void keepRequested();  // with the recording
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
};

}  // namespace palpate::gui
