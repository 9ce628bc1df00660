// The page Teach of the dock Recognise: shows the training folder and its content, captures a
// series of labelled grasps, and trains a model.
#pragma once

#include <QList>
#include <QWidget>
#include <functional>

#include "gui/appearance/theme.h"
#include "gui/recognise/training_controller.h"

class QComboBox;
class QLabel;
class QLineEdit;
class QPushButton;

namespace palpate::gui {

class Ask;
class FiguresTable;

class TrainingPage : public QWidget {
  Q_OBJECT
 public:
  TrainingPage(TrainingController& controller, Ask& ask, QWidget* parent = nullptr);
  // `live`: a hand is connected, so that grasps can be captured.
  void setLive(bool live);
  bool capturing() const;
  // The object that is being captured.
  QString object() const;
  // Call this when a grasp ended.
  void take(const Profile& clip);

  // The zero of the empty hand that the new model will store.
  std::function<std::optional<EmptyHandZero>()> zeroNow;

 private:
  void showFolder();
  void showChoice();
  void choose();
  void showClips();
  void showState();
  void train();
  void actOnClip();
  int chosenClip() const;

  TrainingController& controller_;
  Ask& ask_;
  bool live_ = false;
  QLabel* folder_;
  QComboBox* set_;
  QComboBox* classifier_;
  QLabel* bound_;
  FiguresTable* objects_;
  QLineEdit* object_;
  QPushButton* capture_;
  QLabel* state_;
  FiguresTable* clips_;
  // The clip of each row (TrainingClip::id).
  QList<int> shownClips_;
  QPushButton* act_;
  QPushButton* train_;
};

}  // namespace palpate::gui
