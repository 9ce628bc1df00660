// The page Ask of the dock Recognise: what is held, what was grasped; large, with how sure it is,
// and what it rests on.
#pragma once

#include <QWidget>
#include <filesystem>
#include <functional>

#include "gui/appearance/theme.h"
#include "gui/recognise/recognition_controller.h"

class QCheckBox;
class QComboBox;
class QLabel;
class QMenu;
class QPushButton;

namespace palpate::gui {

class AnswerView;

class AskPage : public QWidget {
  Q_OBJECT
 public:
  explicit AskPage(RecognitionController& controller, QWidget* parent = nullptr);
  void setTheme(Theme theme);
  // What a hand is connected to that is shown; the button says what is asked about.
  void setLive(bool live, bool held);
  bool byItself() const;
  AnswerView& view() noexcept { return *view_; }

  // How a model is asked for; an empty answer means cancelled.
  std::function<std::filesystem::path()> askForModel;

 signals:
  void asked();
  void showAsked();  // full screen

 private:
  void showModel();
  void showTelling();

  RecognitionController& controller_;
  QLabel* model_;
  QMenu* models_;
  QPushButton* ask_;
  QCheckBox* byItself_;
  AnswerView* view_;
  QComboBox* classes_;
  QPushButton* tell_;
};

}  // namespace palpate::gui
