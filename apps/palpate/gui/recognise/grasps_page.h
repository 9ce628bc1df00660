// The page Grasps of the dock Recognise: the grasps of the training folder with their features as a
// table and as a scatter plot. Grasps can be left out of training and checking.
#pragma once

#include <QSettings>
#include <QWidget>
#include <filesystem>
#include <vector>

#include "gui/appearance/theme.h"
#include "gui/picture/exported_view.h"
#include "gui/recognise/training_controller.h"
#include "gui/widgets/rows_table.h"

class QComboBox;
class QLabel;
class QPushButton;
class QSortFilterProxyModel;
class QSplitter;
class QStackedWidget;

namespace palpate::gui {

class EmptyPage;
class FeatureScatter;
class GraspTableModel;

class GraspsPage : public QWidget {
  Q_OBJECT
 public:
  // Both must outlive the page.
  GraspsPage(TrainingController& controller, QSettings& settings, QWidget* parent = nullptr);
  FeatureScatter& scatter() noexcept { return *scatter_; }
  RowsTable& table() noexcept { return *view_; }
  // Chooses one row of the feature table, and no other.
  void choose(int row);
  // Whether there are grasps, and they are visible.
  bool shown() const;
  std::vector<ExportedTable> tables() const;
  void paint(QPainter& painter, const PictureLook& look);

 signals:
  // The user wants to see this grasp of a recording.
  void graspAsked(const std::filesystem::path& file, std::size_t begin, std::size_t end);

 private:
  QWidget* makeTable();
  QWidget* makePlot();
  void showTable();
  void showLeftOut();
  void showState();
  void fillAxes();
  void setAxes();
  void openRow(int row);
  void leaveOutChosen();
  void copy() const;
  // The chosen row of the feature table; -1: none.
  int chosenRow() const;
  std::vector<bool> leftOut() const;
  // Rows of the feature table in the order in which they are shown.
  std::vector<int> shownRows() const;

  TrainingController& controller_;
  QSettings& settings_;
  GraspTableModel* model_;
  QSortFilterProxyModel* sorted_;
  RowsTable* view_;
  FeatureScatter* scatter_;
  QComboBox* x_;
  QComboBox* y_;
  QPushButton* leave_;
  QPushButton* undo_;
  QPushButton* copy_;
  QLabel* state_;
  QSplitter* parts_;
  QStackedWidget* pages_;
  EmptyPage* empty_;
};

}  // namespace palpate::gui
