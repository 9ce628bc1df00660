// The part of the dock Hand with the sensitivity and threshold of every matrix. A changed value is
// sent to the hand at once; the panel also resets them and stores sets of them by name.
#pragma once

#include <QWidget>
#include <future>
#include <vector>

#include <palpate/capture/capture_session.h>
#include <palpate/control/grasp_control.h>
#include <palpate/control/tactile_settings.h>
#include <palpate/control/tactile_settings_history.h>

#include "gui/appearance/named_items.h"
#include "gui/appearance/theme.h"

class QComboBox;
class QLabel;
class QPushButton;

namespace palpate::gui {

class Ask;
class ValueSlider;

class TactileSettingsPanel : public QWidget {
  Q_OBJECT
 public:
  // `settings` must outlive this.
  TactileSettingsPanel(QSettings& settings, Ask& ask, QWidget* parent);
  // Null: no hand. Both must outlive this, or be replaced by null before they are destroyed.
  void setHand(CaptureSession* session, GraspControl* control);
  // Shows one row for each matrix of `hand`, and one for all.
  void setMatrices(const HandDescription& hand);
  // Shows the values that the hand reports, and whether they can be changed now. Call it
  // repeatedly.
  void refresh(const GraspStatus& status, const DeviceInfo& info);
  // Shows how many taxels are scanned, by the layout of the newest frame; null: not known.
  void showScanned(const std::shared_ptr<const SensorLayout>& layout);
  // Keeps the present settings, to which Undo goes back: something is about to change them.
  void keepForUndo();
  // Marks the matrices that cannot detect a limit [counts] with their settings: one reason for each
  // matrix; empty when it can.
  void showUnmeasurable(const std::vector<QString>& why, int limitCounts);

 signals:
  void refused(const QString& why);
  // The user set a value, applied a stored set, or requested a reset.
  void changedByHand();

 private:
  struct Row {
    QWidget* square;
    QLabel* name;
    ValueSlider* sensitivity;
    ValueSlider* threshold;
  };
  void makeTable();
  void makeRow(int row, const QString& name);
  void makeButtons();
  void send(const std::vector<DeviceCommand>& commands);
  void applySettings(const TactileSettings& to);
  void restore(bool undo);
  void showValues(const TactileSettings& values);
  void listNames();
  void pollReplies();
  QString serial() const;
  // Those that were saved for this hand.
  NamedItems<TactileSettings> saved() const;

  QSettings& settings_;
  Ask& ask_;
  CaptureSession* session_ = nullptr;
  GraspControl* control_ = nullptr;
  // The first row sets all matrices.
  std::vector<Row> rows_;
  // Of the rows, without the first.
  QStringList rowNames_;
  // [counts], as the controller sends them.
  int fullScale_ = 0;
  QLabel* note_;
  QWidget* table_;
  QLabel* scanned_;
  QPushButton* undo_;
  QPushButton* redo_;
  QPushButton* reset_;
  QComboBox* names_;
  QPushButton* save_;
  QPushButton* remove_;
  // The serial number that the listed names belong to.
  QString listedFor_;
  // Which matrices cannot detect the limit; empty when all can.
  QString unmeasurableText_;
  TactileSettingsHistory history_;
  bool restoring_ = false;                      // what is sent comes from the history
  std::shared_ptr<const SensorLayout> layout_;  // as shown
  std::vector<std::shared_future<CommandAnswer>> pending_;
};

}  // namespace palpate::gui
