// The page "Stream of frames" of the Connect dialog: where the stream of another hand comes from,
// which hand it is, and how its frames are written.
#pragma once

#include <QHash>
#include <QWidget>
#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <vector>

#include "gui/appearance/theme.h"
#include "gui/connect/port_scan.h"
#include "gui/source/connection.h"
#include "gui/source/file_reading.h"

class QComboBox;
class QFormLayout;
class QLabel;
class QLineEdit;
class QSpinBox;
class QStackedWidget;

namespace palpate::gui {

class Ask;
class PortField;
class StateMark;

class StreamPage : public QWidget {
  Q_OBJECT
 public:
  // `handFolders`: where hands are looked for by name; their files are read here. `scan` must
  // outlive this.
  StreamPage(const std::vector<std::filesystem::path>& handFolders,
             PortScan& scan,
             Ask& ask,
             QWidget* parent);
  ~StreamPage() override;

  void setStream(const StreamConnection& stream);
  StreamConnection stream() const;
  // A problem that problemOf() cannot detect, in one line: a source or a hand that can't be used.
  // Empty when there is none.
  QString problem() const;
  // Lists the serial ports. None is opened: what is sent to an unknown device may disturb it.
  void look();

 signals:
  void changed();

 private:
  // In the order of the choices and of their fields.
  enum Place { kSerial, kConnect, kListen, kUdp };
  // What is known about a hand of the list.
  struct Choice {
    // Empty when the hand can't be used.
    QString summary;
    // What is wrong, in one line; empty when the hand can be used.
    QString fault;
    // That is why it can't be used yet.
    bool beingRead = false;
  };

  QWidget* makePlace();
  QWidget* makeHand(Ask& ask);
  void makeForm();
  Place place() const;
  QString source() const;
  void setSource(const QString& source);
  int handIndex(const QString& nameOrFolder);
  void read(const QString& nameOrFolder);
  QString sourceProblem() const;
  void refresh();

  std::vector<std::filesystem::path> folders_;
  PortScan& scan_;
  QHash<QString, Choice> hands_;
  std::map<QString, std::unique_ptr<FileReading>> readings_;
  QFormLayout* form_;
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
  QComboBox* hand_;
  StateMark* handMark_;
  QLabel* handText_;
  QComboBox* format_;
  QComboBox* time_;
  QComboBox* baud_;
  QWidget* baudRow_;
};

}  // namespace palpate::gui
