// The page Today of the dock Recognise: the offset with which the hand reads sizes in this session,
// how it was determined, and the grasps of the session.
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
  // `why`: why the hand cannot be closed now; empty when it can. `closing`: the measurement is
  // running.
  void setZeroPossible(const QString& why, bool closing);

  std::function<std::filesystem::path(const QString& suggestion)> askForPlace;

 signals:
  void zeroRequested();

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
