// The part of the dock Hand that moves the hand: fields for preshape, closing, velocity and limit,
// and the buttons that start a motion.
#pragma once

#include <QSettings>
#include <QTimer>
#include <QWidget>
#include <functional>

#include <palpate/control/grasp_control.h>

#include "gui/appearance/theme.h"

class QAction;
class QCheckBox;
class QComboBox;
class QFormLayout;
class QLabel;
class QPushButton;

namespace palpate::gui {

class GraspOptions;
struct HandActions;
class StatusLines;
class TouchStore;
class ValueSlider;

class GraspPanel : public QWidget {
  Q_OBJECT
 public:
  // Stores the chosen values in `settings`, which must outlive this, as must `touches`.
  GraspPanel(QSettings& settings, TouchStore& touches, const HandActions& actions, QWidget* parent);
  // Null: no hand, or one that is read only; the tool tips then tell `whyNot`. `control` must
  // outlive this, or be replaced by null before it is destroyed.
  void setControl(GraspControl* control, const QString& whyNot = "No hand is connected");
  // The connected hand is another one.
  void setHand(const HandDescription& hand);
  // The close ratio of a plain grasp while the user has chosen none.
  void setUsualClose(double ratio);
  // A grasp with a limit in newtons must wait for the calibration.
  void setCalibrationBeingRead(bool beingRead);
  // Enables the motions that are possible now; the tool tips tell why others are not.
  void showStatus(const GraspStatus& status);
  GraspRequest request(GraspMode mode) const;
  // The highest limit that the matrices can measure in such a grasp [counts]; a limit in newtons is
  // watched together with it.
  std::function<int(const GraspRequest& request)> highestLimit;
  // Whether the window shows the hand, and not a recording: only then the actions are enabled.
  void setInSight(bool on);
  const QPushButton* relaxButton() const { return relax_.button; }

 signals:
  // A motion is about to be requested.
  void begins();
  void refused(const QString& why);
  // A motion was started or refused.
  void asked();

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  // What moves the hand: a button, and an action with the same texts that clicks it, so that what
  // is typed in a field counts for both.
  struct Motion {
    QAction* action;
    QPushButton* button;
  };
  void offer(const Motion& motion, bool can, const QString& tip);
  void begin(const GraspRequest& request);
  void remember();
  void makeForecast(QFormLayout& form);
  void showLimit();
  // Soon, and only while the panel is seen.
  void renewForecast();
  void showForecast();

  QSettings& settings_;
  TouchStore& touches_;
  GraspControl* control_ = nullptr;
  QString whyNot_ = "No hand is connected";
  bool calibrationBeingRead_ = false;
  // As it was given to showStatus() last.
  GraspStatus shown_;
  QComboBox* preshape_;
  ValueSlider* close_;
  ValueSlider* velocity_;
  ValueSlider* limit_;
  ValueSlider* forceLimit_;
  QLabel* limitLabel_;
  QCheckBox* keep_;
  StatusLines* forecast_;
  QTimer forecastTimer_;
  // The angles of which the forecast is [deg].
  std::vector<double> forecastDeg_;
  GraspOptions* options_;
  bool inSight_ = true;
  Motion grasp_;
  Motion reactive_;
  Motion slipAware_;
  Motion open_;
  Motion relax_;
};

}  // namespace palpate::gui
