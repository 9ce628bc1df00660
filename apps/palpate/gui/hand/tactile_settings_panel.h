// Sensitivity and threshold of every matrix, set on the hand as they are chosen; reset; sets kept
// by name.
#pragma once

#include <QWidget>
#include <future>
#include <vector>

#include <palpate/capture/capture_session.h>
#include <palpate/control/grasp_control.h>
#include <palpate/control/tactile_settings.h>

#include "gui/appearance/theme.h"
#include "gui/hand/hand_settings_store.h"

class QComboBox;
class QLabel;
class QPushButton;

namespace palpate::gui {

class ValueSlider;

class TactileSettingsPanel : public QWidget {
  Q_OBJECT
 public:
  // `settings` must outlive it.
  TactileSettingsPanel(QSettings& settings, QWidget* parent);
  // Null: no hand. Both must outlive this, or be taken away before.
  void setHand(CaptureSession* session, GraspControl* control);
  // Shows what the hand says, and whether it may be changed now. Now and then.
  void refresh(const GraspStatus& status, const DeviceInfo& facts);
  void setTheme(Theme theme);
  // Marks the matrices that can't tell a limit [counts], as they are set: why, one text per matrix;
  // empty: it can.
  void showUnmeasurable(const std::vector<QString>& why, int limitCounts);
  // How a name is asked for; an empty answer means cancelled. Tests answer themselves.
  std::function<QString(const QString& suggestion)> askForName;

 signals:
  void refused(const QString& why);
  void changedByHand();  // a value was set, a set brought, or a reset asked for

 private:
  struct Row {
    QWidget* square;
    QLabel* name;
    ValueSlider* sensitivity;
    ValueSlider* threshold;
  };
  QWidget* makeRow(int row, const QString& name);
  void makeButtons();
  void send(const std::vector<DeviceCommand>& commands);
  void applySettings(const TactileSettings& to);
  void showValues(const TactileSettings& values);
  void listNames();
  void pollReplies();
  QString serial() const;

  HandSettingsStore store_;
  CaptureSession* session_ = nullptr;
  GraspControl* control_ = nullptr;
  std::vector<Row> rows_;  // the first one is for all matrices
  QLabel* note_;
  QWidget* table_;
  QPushButton* reset_;
  QComboBox* names_;
  QPushButton* save_;
  QPushButton* remove_;
  QString listedFor_;         // serial number
  QString unmeasurableText_;  // which can't tell the limit; empty: all can
  Theme theme_ = Theme::kDark;
  std::vector<std::shared_future<CommandAnswer>> pending_;
};

}  // namespace palpate::gui
