// The page Teach of the dock Recognise: the folder that teaches and what it holds, capture of a
// labelled series, training.
#pragma once

#include <QWidget>
#include <filesystem>
#include <functional>

#include "gui/appearance/theme.h"
#include "gui/recognise/training_controller.h"

class QLabel;
class QLineEdit;
class QPushButton;

namespace palpate::gui {

class FiguresTable;

class TrainingPage : public QWidget {
  Q_OBJECT
 public:
  explicit TrainingPage(TrainingController& controller, QWidget* parent = nullptr);
  void setTheme(Theme theme);
  // A hand is connected: there is something to capture.
  void setLive(bool live);
  bool capturing() const;
  QString object() const;  // that is captured now
  // A grasp ended.
  void take(const Profile& clip);
  // The newest grasp is taken out; whether there was one.
  bool undo();

  // How folders and files are asked for; an empty answer means cancelled.
  std::function<std::filesystem::path()> askForFolder;
  std::function<std::filesystem::path(const QString& suggestion)> askForPlace;
  // What the new model shall know of the empty hand.
  std::function<std::optional<EmptyHandZero>()> zeroNow;

 private:
  void showFolder();
  void showClips();
  void showState();
  void train();
  void actOnClip();
  int chosenClip() const;

  TrainingController& controller_;
  bool live_ = false;
  QLabel* folder_;
  FiguresTable* objects_;
  QLineEdit* object_;
  QPushButton* capture_;
  QLabel* state_;
  FiguresTable* clips_;
  QPushButton* act_;
  QPushButton* train_;
};

}  // namespace palpate::gui
