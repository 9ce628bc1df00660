// The page Today of the dock Recognise: the offset with which the hand reads sizes in this session,
// how it was determined, and the grasps of the session.
#pragma once

#include <QWidget>
#include <optional>

#include <palpate/recognition/empty_hand.h>

#include "gui/appearance/theme.h"
#include "gui/recognise/recognition_controller.h"

class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QPushButton;

namespace palpate::gui {

class Ask;
class FiguresTable;

class TodayPage : public QWidget {
  Q_OBJECT
 public:
  TodayPage(RecognitionController& controller, Ask& ask, QWidget* parent = nullptr);
  // `why`: why the hand cannot be closed now; empty when it can. `closing`: the measurement is
  // running.
  void setZeroPossible(const QString& why, bool closing);
  // The zero of the empty hand that was measured in this connection, or none.
  void setMeasuredZero(std::optional<EmptyHandZero> zero);

 signals:
  void zeroRequested();

 private:
  void showDay();
  void showAboutZero();
  void choose();

  RecognitionController& controller_;
  QLabel* offset_;
  QLabel* unsure_;
  QComboBox* source_;
  QDoubleSpinBox* typed_;
  QPushButton* zero_;
  QLabel* aboutZero_;
  std::optional<EmptyHandZero> measured_;
  FiguresTable* grasps_;
  QPushButton* forget_;
  QPushButton* save_;
  QString why_ = "No hand is connected.";
  bool closing_ = false;
};

}  // namespace palpate::gui
