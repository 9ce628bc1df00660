// What to connect: a hand on its ports, the emulated hand, or a recording that is replayed.
#pragma once

#include <QDialog>
#include <QStringList>
#include <array>
#include <filesystem>

#include "gui/appearance/theme.h"
#include "gui/connect/port_scan.h"
#include "gui/source/connection.h"

class QLabel;
class QPushButton;
class QRadioButton;
class QStackedWidget;

namespace palpate::gui {

class PortsPage;
class ReplayPage;
class ScenePage;
class StateMark;

struct ConnectChoices {
  Connection last;                     // where the dialog begins
  std::filesystem::path scenesFolder;  // of the emulated hand
  QStringList recentRecordings = {};   // paths, newest first
  Theme theme = Theme::kDark;
};

class ConnectDialog : public QDialog {
  Q_OBJECT
 public:
  // `scan` must outlive this. Ports are asked as soon as the page of the ports is shown, not
  // before; when the dialog closes they are free again.
  ConnectDialog(const ConnectChoices& choices, PortScan& scan, QWidget* parent);
  ~ConnectDialog() override;

  // What is chosen; of the other kinds what stands in their fields.
  Connection connection() const;
  // Why it can't be tried, one line; empty: it can.
  QString problem() const;

  void done(int result) override;

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  QWidget* makeKinds();
  QWidget* makeFoot();
  void choose(Connection::Kind kind);
  void refresh();

  PortScan& scan_;
  Connection last_;
  Theme theme_;
  Connection::Kind kind_;
  bool looked_ = false;
  std::array<QRadioButton*, kAllConnectionKinds.size()> kinds_ = {};
  QStackedWidget* pages_ = nullptr;
  PortsPage* ports_ = nullptr;
  ScenePage* scenes_ = nullptr;
  ReplayPage* replay_ = nullptr;
  StateMark* mark_ = nullptr;
  QLabel* problem_ = nullptr;
  QPushButton* connect_ = nullptr;
};

}  // namespace palpate::gui
