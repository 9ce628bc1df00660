// The page Joints of the dock Hand: one row for each joint with its present angle and a target, and
// own poses by name. Nothing moves before a button Move is pressed.
#pragma once

#include <QSettings>
#include <QWidget>
#include <functional>
#include <optional>
#include <vector>

#include <palpate/control/grasp_control.h>
#include <palpate/control/saved_pose.h>

#include "gui/appearance/named_items.h"
#include "gui/source/file_reading.h"

class QCheckBox;
class QComboBox;
class QGridLayout;
class QLabel;
class QPushButton;

namespace palpate::gui {

class Ask;
class ValueSlider;

class JointPanel : public QWidget {
  Q_OBJECT
 public:
  // Stores velocity and poses in `settings`, which must outlive this.
  JointPanel(QSettings& settings, Ask& ask, QWidget* parent);
  // As GraspPanel::setControl().
  void setControl(GraspControl* control, const QString& whyNot = "No hand is connected");
  // Call this repeatedly: shows present angles, and what is possible now. `phase`: what the hand
  // does; status.phase may say that a sequence occupies it.
  void showStatus(const GraspStatus& status, GraspPhase phase);
  // The poses of this hand that the user has saved.
  NamedItems<SavedPose> saved() const;
  double velocityDegPerS() const;

  // The limits of a reactive grasp, for moving under tactile control.
  std::function<GraspRequest()> reactiveLimits;

 signals:
  void begins();
  void refused(const QString& why);
  void asked();
  void posesChanged();

 private:
  void showPresent();
  struct Row {
    QLabel* name;
    QLabel* present;
    ValueSlider* target;
    QPushButton* move;
    bool changed = false;  // the target was set and not yet reached
    bool underWay = false;
  };
  void makeRows(QGridLayout& grid);
  QWidget* makePoses();
  void listPoses(const QString& chosen = {});
  void choosePose(const QString& name);
  void savePose();
  void renamePose();
  void removePose();
  void importPoses();
  void exportPoses();
  void move(std::optional<std::size_t> axis);
  void resetTargets();
  void takePoses(const std::vector<SavedPose>& poses);
  void showRow(Row& row);
  // A new target; the end of a motion that runs doesn't count as having reached it.
  static void setChanged(Row& row);
  // The user set a target: the targets are no longer those of the chosen pose.
  void setChangedByHand(Row& row);

  QSettings& settings_;
  Ask& ask_;
  GraspControl* control_ = nullptr;
  QString whyNot_ = "No hand is connected";
  std::vector<Row> rows_;
  ValueSlider* velocity_;
  QCheckBox* stopAtContact_;
  QPushButton* move_;
  QPushButton* reset_;
  QComboBox* names_;
  QPushButton* save_;
  QPushButton* rename_;
  QPushButton* remove_;
  QPushButton* file_;
  bool moving_ = false;  // a motion of this page
  FileReading reading_{this};
};

}  // namespace palpate::gui
