// The dialog that adds a sensor to the hand: its name, where its lines come from, what their
// numbers are; and, when asked, what arrives.
#pragma once

#include <QDialog>
#include <QTimer>
#include <memory>

#include "gui/connect/port_scan.h"
#include "gui/source/sensor.h"

class QLabel;
class QLineEdit;
class QPushButton;

namespace palpate::gui {

class SensorRows;
class SourceField;

class SensorDialog : public QDialog {
  Q_OBJECT
 public:
  // `taken`: names that a sensor can't have. `scan` must outlive this.
  SensorDialog(const Sensor& proposal, QStringList taken, PortScan& scan, QWidget* parent);
  ~SensorDialog() override;

  Sensor sensor() const;
  // What still reads the source; whoever opens it releases this first, in another thread.
  std::shared_ptr<void> takePreview();

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  void refresh();
  void showRows(bool wanted);
  void endPreview();

  QStringList taken_;
  QLineEdit* name_;
  SourceField* source_;
  QLineEdit* columns_;
  QPushButton* look_;
  QLabel* rows_;
  QLabel* problem_;
  QPushButton* add_;
  QTimer timer_;
  std::shared_ptr<SensorRows> preview_;
};

}  // namespace palpate::gui
