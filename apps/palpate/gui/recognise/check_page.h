// The page Check of the dock Recognise: cross-validation of the training folder with its confusion
// matrix, a table of the objects, and the grasps of each cell.
#pragma once

#include <QWidget>
#include <filesystem>
#include <vector>

#include "gui/appearance/theme.h"
#include "gui/picture/exported_view.h"
#include "gui/recognise/training_controller.h"

class QComboBox;
class QLabel;
class QPushButton;
class QStackedWidget;

namespace palpate::gui {

class ConfusionView;
class EmptyPage;
class FiguresTable;

class CheckPage : public QWidget {
  Q_OBJECT
 public:
  explicit CheckPage(TrainingController& controller, QWidget* parent = nullptr);
  // The listed grasps as rows of the feature table.
  const std::vector<std::size_t>& listed() const noexcept { return listed_; }
  ConfusionView& confusion() noexcept { return *confusion_; }
  bool shown() const;
  std::vector<ExportedTable> tables() const;
  void paint(QPainter& painter, const PictureLook& look);

 signals:
  // The user wants to see this grasp of a recording.
  void graspAsked(const std::filesystem::path& file, std::size_t begin, std::size_t end);

 private:
  void showCheck();
  void listObjects();
  void listCell(int truth, int called);
  // `row`: index into the listed grasps.
  void openGrasp(std::size_t row);

  TrainingController& controller_;
  QComboBox* protocol_;
  QPushButton* check_;
  QLabel* result_;
  ConfusionView* confusion_;
  QLabel* caption_;
  QStackedWidget* lists_;
  FiguresTable* objects_;
  FiguresTable* grasps_;
  QPushButton* back_;
  QStackedWidget* pages_;
  EmptyPage* empty_;
  std::vector<std::size_t> listed_;
};

}  // namespace palpate::gui
