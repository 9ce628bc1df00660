// The Connect dialog: the user chooses what to connect to, which is a hand on its ports, a stream
// of frames, the emulated hand, or a recording that is replayed.
#pragma once

#include <QDialog>
#include <QSettings>
#include <QStringList>
#include <array>
#include <filesystem>
#include <vector>

#include "gui/appearance/theme.h"
#include "gui/connect/port_scan.h"
#include "gui/source/connection.h"

class QComboBox;
class QLabel;
class QPushButton;
class QRadioButton;
class QStackedWidget;

namespace palpate::gui {

class Ask;
class PortsPage;
class ReplayPage;
class ScenePage;
class StreamPage;
class StateMark;

// The values that the dialog starts with.
struct ConnectChoices {
  // The connection that the dialog starts with.
  Connection last;
  // Folder with the scenes of the emulated hand.
  std::filesystem::path scenesFolder;
  // Where hands are looked for by name.
  std::vector<std::filesystem::path> handFolders = {};
  // Paths, newest first.
  QStringList recentRecordings = {};
  // Stores connections that are saved under a name; null: none can be saved. It must outlive the
  // dialog.
  QSettings* settings = nullptr;
};

class ConnectDialog : public QDialog {
  Q_OBJECT
 public:
  // `scan` must outlive this. Ports are probed only once the page with the ports is shown; when the
  // dialog closes, they are free again.
  ConnectDialog(const ConnectChoices& choices, PortScan& scan, Ask& ask, QWidget* parent);
  ~ConnectDialog() override;

  // The chosen connection; it also contains the fields of the kinds that are not chosen.
  Connection connection() const;
  // Why the chosen connection cannot be tried, in one line; empty when it can.
  QString problem() const;

  void done(int result) override;

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  QWidget* makeKinds();
  QWidget* makeSaved();
  QWidget* makeFoot();
  // Fills all fields.
  void fill(const Connection& connection);
  void listSaved(const QString& chosen);
  void saveUnderName();
  void choose(Connection::Kind kind);
  void refresh();

  PortScan& scan_;
  Ask& ask_;
  Connection last_;
  QSettings* settings_;
  Connection::Kind kind_;
  bool looked_ = false;
  bool listed_ = false;
  std::array<QRadioButton*, kAllConnectionKinds.size()> kinds_ = {};
  QStackedWidget* pages_ = nullptr;
  QComboBox* saved_ = nullptr;
  QPushButton* forget_ = nullptr;
  PortsPage* ports_ = nullptr;
  StreamPage* stream_ = nullptr;
  ScenePage* scenes_ = nullptr;
  ReplayPage* replay_ = nullptr;
  StateMark* mark_ = nullptr;
  QLabel* problem_ = nullptr;
  // Whether something moves after connecting.
  QLabel* calm_ = nullptr;
  QPushButton* connect_ = nullptr;
};

}  // namespace palpate::gui
