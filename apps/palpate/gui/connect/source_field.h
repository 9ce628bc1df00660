// The fields for where lines or packets come from: a serial port with its baud rate, a TCP
// connection, or a TCP or UDP port of this machine. For streams of frames and for sensors.
#pragma once

#include <QWidget>
#include <array>

#include "gui/connect/port_scan.h"

class QComboBox;
class QFormLayout;
class QLabel;
class QLineEdit;
class QSpinBox;
class QStackedWidget;

namespace palpate::gui {

class PortField;
class StateMark;

class SourceField : public QWidget {
  Q_OBJECT
 public:
  // `name` begins the object names, as in "streamPlace". `scan` must outlive this.
  SourceField(const QString& name, PortScan& scan, QWidget* parent);
  ~SourceField() override;

  // The kind of source, and below it this widget.
  void addPlaceTo(QFormLayout& form);
  void addBaudTo(QFormLayout& form);

  // As StreamDeviceOptions::source; empty while nothing is chosen.
  QString source() const;
  int baud() const;
  void setSource(const QString& source, int baud);
  // Why the source can't be used, in one line; empty when it can, or while nothing is chosen.
  QString problem() const;
  // Lists the serial ports. None is opened: what is sent to an unknown device may disturb it.
  void look() { scan_.listOnly(); }

 signals:
  void changed();

 private:
  // In the order of the choices and of their fields.
  enum Place { kSerial, kConnect, kListen, kUdp };

  void makeFields();
  Place place() const;
  void refresh();

  const QString name_;
  PortScan& scan_;
  QComboBox* place_;
  QStackedWidget* fields_;
  PortField* port_;
  QLineEdit* host_;
  QSpinBox* hostPort_;
  // By Place; null for places where no sender is awaited.
  std::array<QLineEdit*, 4> addresses_ = {};
  std::array<QSpinBox*, 4> ports_ = {};
  StateMark* placeMark_;
  QLabel* placeText_;
  QComboBox* baud_;
  QWidget* baudTitle_ = nullptr;
};

// A line of text with a mark in front of it, two lines high.
QWidget* markedLine(StateMark*& mark, QLabel*& label, const QString& name);

}  // namespace palpate::gui
