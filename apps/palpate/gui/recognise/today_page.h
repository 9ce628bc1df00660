// The page Today of the dock Recognise: by how much the hand reads sizes wrong today, how that is
// known, and the day's grasps.
#pragma once

#include <QWidget>
#include <filesystem>
#include <functional>

#include "gui/appearance/theme.h"
#include "gui/recognise/recognition_controller.h"

class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QPushButton;

namespace palpate::gui {

class FiguresTable;

class TodayPage : public QWidget {
  Q_OBJECT
 public:
  explicit TodayPage(RecognitionController& controller, QWidget* parent = nullptr);
  void setTheme(Theme theme);
  // Why the hand can't be closed now; empty: it can. `closing`: it is being done.
  void setZeroPossible(const QString& why, bool closing);

  std::function<std::filesystem::path(const QString& suggestion)> askForPlace;

 signals:
  void zeroAsked();

 private:
  void showDay();
  void choose();

  RecognitionController& controller_;
  QLabel* offset_;
  QLabel* unsure_;
  QComboBox* source_;
  QDoubleSpinBox* typed_;
  QPushButton* zero_;
  FiguresTable* grasps_;
  QPushButton* forget_;
  QPushButton* save_;
  QString why_ = "No hand is connected.";
  bool closing_ = false;
};

}  // namespace palpate::gui
