// The page "Hand on ports" of the Connect dialog: two ports, what answers at each, and help when
// the answer is not the expected one.
#pragma once

#include <QHash>
#include <QList>
#include <QSet>
#include <QWidget>
#include <optional>

#include "gui/appearance/theme.h"
#include "gui/connect/port_field.h"
#include "gui/connect/port_scan.h"

class QFrame;
class QLabel;
class QProgressBar;
class QPushButton;

namespace palpate::gui {

class PortsPage : public QWidget {
  Q_OBJECT
 public:
  // `scan` must outlive this.
  PortsPage(PortScan& scan, QWidget* parent);

  ~PortsPage() override;

  void setPorts(const QString& tactile, const QString& motion);
  QString tactilePort() const { return tactile_->port(); }
  QString motionPort() const { return motion_->port(); }
  // A problem that problemOf() cannot detect: both fields name the same port. One line; empty when
  // there is none.
  QString problem() const;
  // Lists and probes the ports, unless a scan is running. A field that the user has not touched is
  // filled with the port that answers as its controller, when there is exactly one.
  void look();

 signals:
  void changed();

 private:
  QWidget* makeSwapRow();
  QWidget* makeLookRow();
  void takeList(const QList<ScannedPort>& ports);
  void takeProbe(const QString& port, const PortProbe& probe);
  void askTyped(const QString& port);
  void fill();
  void fill(PortField& field, const PortField& other, PortAnswer wanted);
  void refresh();
  QString keyOf(const QString& port) const;
  const ScannedPort* listed(const QString& key) const;
  std::optional<PortProbe> probeOf(const PortField& field) const;
  PortFieldState stateOf(const PortField& field, PortAnswer wanted) const;
  QString swapText() const;
  QString helpText() const;

  PortScan& scan_;
  QList<ScannedPort> ports_;
  // By keyOf().
  QHash<QString, PortProbe> answers_;
  QSet<QString> asking_;
  // Fields that this page filled, rather than the user or the previous connection.
  QSet<const PortField*> filled_;
  // A list of ports has arrived.
  bool looked_ = false;
  PortField* tactile_ = nullptr;
  PortField* motion_ = nullptr;
  QFrame* swapRow_ = nullptr;
  QLabel* swapText_ = nullptr;
  QLabel* help_ = nullptr;
  QProgressBar* progress_ = nullptr;
  QLabel* progressText_ = nullptr;
  QPushButton* look_ = nullptr;
};

}  // namespace palpate::gui
