// The part of the dock Hand below the grasp buttons that folds: the object, the unit of the limit,
// limits of single fingers, and how a slip-aware grasp holds, with the words of `palpate grasp`.
#pragma once

#include <QSettings>
#include <QWidget>
#include <vector>

#include <palpate/control/grasp_request.h>

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QFormLayout;
class QLabel;
class QToolButton;

namespace palpate::gui {

class ObjectFields;

inline constexpr const char* kCalibrationBeingRead = "The calibration is being read";

class GraspOptions : public QWidget {
  Q_OBJECT
 public:
  // Stores choices in `settings`, which must outlive this. Not stored: loosening and the object,
  // which each session begins without.
  GraspOptions(QSettings& settings, QWidget* parent);

  bool inNewtons() const;
  bool eachFinger() const;
  ObjectFields& object() noexcept { return *object_; }
  // What is known of the calibration of the connected hand.
  enum class Calibrated { kNoHand, kNot, kBeingRead, kYes };
  // With a calibration limits in newtons can be chosen. Without one the limit is in counts; the
  // chosen unit returns with the next calibration. While it is read, the limit is in the chosen
  // unit.
  void setCalibrated(Calibrated calibrated);
  // Sets what is chosen here; `request` has its common limits already.
  void apply(GraspRequest& request) const;

 signals:
  // The unit, or whether each finger has its own limit, was chosen.
  void limitsChanged();

 private:
  void makeLimits(QFormLayout& form);
  void makeHolding(QFormLayout& form);
  void open(bool on);
  void showChoice();
  void remember();
  QString summary() const;
  QDoubleSpinBox* field(
      const QString& name, const QString& title, double least, double most, int decimals);

  QSettings& settings_;
  QToolButton* header_;
  QLabel* summary_;
  QWidget* body_;
  ObjectFields* object_;
  QComboBox* unit_;
  // Why newtons can't be chosen.
  QLabel* whyCounts_;
  QCheckBox* eachFinger_;
  // One per finger, in each unit.
  std::vector<QDoubleSpinBox*> fingerCounts_;
  std::vector<QDoubleSpinBox*> fingerNewtons_;
  QDoubleSpinBox* most_ = nullptr;
  QDoubleSpinBox* hold_ = nullptr;
  QDoubleSpinBox* calm_ = nullptr;
  QCheckBox* loosen_ = nullptr;
  QDoubleSpinBox* mass_ = nullptr;
  QDoubleSpinBox* newtonsPerCount_ = nullptr;
};

}  // namespace palpate::gui
