// The page Check of the dock Recognise: how well what the folder teaches is recognised, by
// cross-validation: confusion matrix, figures of the objects, and the grasps behind each cell.
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
  void setTheme(Theme theme);
  // The grasps that are listed now, rows of the table of features.
  const std::vector<std::size_t>& listed() const noexcept { return listed_; }
  ConfusionView& confusion() noexcept { return *confusion_; }
  bool shown() const;
  std::vector<ExportedTable> tables() const;
  void paint(QPainter& painter, const PictureLook& look);

 signals:
  // This grasp of a recording shall be seen.
  void graspAsked(const std::filesystem::path& file, std::size_t begin, std::size_t end);

 private:
  void showCheck();
  void listObjects();
  void listCell(int truth, int called);
  void openGrasp(std::size_t row);  // of those that are listed

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
  Theme theme_ = Theme::kDark;
};

}  // namespace palpate::gui
