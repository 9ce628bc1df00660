// The page Sequence of the dock Hand: a table of motions that is repeated. A step is added with the
// values of the pages Grasp and Joints. Stop, Esc, a lost port and a hot motor end the sequence.
#pragma once

#include <QSettings>
#include <QWidget>
#include <functional>
#include <memory>
#include <vector>

#include <palpate/capture/capture_session.h>
#include <palpate/control/motion_sequence.h>

#include "gui/source/file_reading.h"

class QDoubleSpinBox;
class QListWidget;
class QMenu;
class QPushButton;
class QSpinBox;

namespace palpate::gui {

class Ask;
class StatusLines;

class SequencePanel : public QWidget {
  Q_OBJECT
 public:
  // Stores the table in `settings`, which must outlive this.
  SequencePanel(QSettings& settings, Ask& ask, QWidget* parent);
  // Null: no hand that can be moved; the tool tips then tell `whyNot`. Both must outlive this, or
  // be replaced by null before they are destroyed.
  void setHand(CaptureSession* session,
               GraspControl* control,
               const QString& whyNot = "No hand is connected");
  // Shows the state of the control. Call it several times a second.
  void refresh(const GraspStatus& status);
  bool running() const { return run_ && run_->running(); }
  // The place in the running sequence, one line.
  QString stateText() const;
  const MotionSequence& sequence() const noexcept { return sequence_; }

  // The grasp as chosen on the page Grasp.
  std::function<GraspRequest(GraspMode mode)> graspRequest;
  // Own poses that can be added, and the velocity of the page Joints.
  std::function<std::vector<SavedPose>()> poses;
  std::function<double()> poseVelocity;

 signals:
  void begins();
  void refused(const QString& why);
  void asked();

 private:
  void makeButtons();
  void fillAddMenu();
  void add(SequenceStep step);
  void changed(int current);
  void list(int current);
  void moveStep(int by);
  void start();
  void openFile();
  void saveFile();

  QSettings& settings_;
  Ask& ask_;
  CaptureSession* session_ = nullptr;
  GraspControl* control_ = nullptr;
  QString whyNot_ = "No hand is connected";
  MotionSequence sequence_;
  std::unique_ptr<SequenceRun> run_;
  QListWidget* steps_;
  QPushButton* add_;
  QMenu* addMenu_;
  QDoubleSpinBox* seconds_;
  QPushButton* remove_;
  QPushButton* up_;
  QPushButton* down_;
  QSpinBox* times_;
  QPushButton* start_;
  QPushButton* file_;
  StatusLines* state_;
  // What the page did last, until the sequence runs.
  QString said_;
  FileReading reading_{this};
};

}  // namespace palpate::gui
