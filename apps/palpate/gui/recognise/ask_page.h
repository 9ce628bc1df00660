// The page Ask of the dock Recognise: names the object that is held or was grasped, in large type,
// with the certainty and the basis of the answer.
#pragma once

#include <QWidget>

#include "gui/appearance/theme.h"
#include "gui/recognise/recognition_controller.h"

class QCheckBox;
class QComboBox;
class QLabel;
class QMenu;
class QPushButton;

namespace palpate::gui {

class Ask;
class AnswerView;

class AskPage : public QWidget {
  Q_OBJECT
 public:
  AskPage(RecognitionController& controller, Ask& ask, QWidget* parent = nullptr);
  // `live`: a connected hand is shown, which can be asked repeatedly. `silence`: why nothing
  // arrives from it, so that it can't be asked; empty: frames arrive.
  void setLive(bool live, const QString& silence = {});
  bool byItself() const;
  AnswerView& view() noexcept { return *view_; }

 signals:
  void asked();
  // The user wants the full-screen view.
  void showRequested();

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
