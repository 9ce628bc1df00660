// The fields of the object that is grasped: its name, under which it is remembered where grasps
// touched it, with a button that forgets it, and its size, from which the touch is expected.
#pragma once

#include <QWidget>
#include <memory>
#include <optional>
#include <string>

#include <palpate/control/grasp_approach.h>
#include <palpate/kinematics/hand_geometry.h>
#include <palpate/model/hand_description.h>

class QComboBox;
class QLabel;
class QPushButton;

namespace palpate::gui {

class SecondsField;

class ObjectFields : public QWidget {
  Q_OBJECT
 public:
  explicit ObjectFields(QWidget* parent);
  // The hand that is connected: its geometry tells where an object of this size touches.
  void setHand(const HandDescription& hand);
  void setPreshape(const std::string& preshape);
  void setTouches(const TouchMemory& touches);
  // Forgetting must wait until the hand stands still.
  void setIdle(bool idle);
  // Of a grasp that keeps its limit.
  void apply(GraspRequest& request) const;
  std::string name() const;
  // "ball, 40 mm"; empty: nothing is known of it.
  QString text() const;

 signals:
  void changed();
  void forgets(const std::string& preshape, const std::string& object);

 private:
  void showNames();
  void showRemembered();
  void renewTouchRatio();

  QComboBox* name_;
  SecondsField* size_;
  QLabel* remembered_;
  QPushButton* forget_;
  std::string preshape_;
  TouchMemory touches_;
  bool idle_ = true;
  HandDescription hand_;
  // Of hand_, once it was needed.
  std::unique_ptr<const HandGeometry> geometry_;
  // By the size; empty: not known.
  std::optional<double> touchRatio_;
};

}  // namespace palpate::gui
