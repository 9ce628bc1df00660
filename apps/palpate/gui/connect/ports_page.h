// The page "Hand on ports" of the Connect dialog: two ports, what answers at each, and what to do
// when it isn't what was expected.
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
  PortsPage(PortScan& scan, Theme theme, QWidget* parent);

  ~PortsPage() override;

  void setPorts(const QString& tactile, const QString& motion);
  QString tactilePort() const { return tactile_->port(); }
  QString motionPort() const { return motion_->port(); }
  // What problemOf() can't know: two names of one port. One line; empty: nothing.
  QString problem() const;
  // Lists and asks the ports, unless that is going on. Fields that the user hasn't touched are
  // filled with what answers as their controller, when it is one only.
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
  Theme theme_;
  QList<ScannedPort> ports_;
  QHash<QString, PortProbe> answers_;  // by keyOf()
  QSet<QString> asking_;
  QSet<const PortField*> filled_;  // by us, not by the user or from last time
  bool looked_ = false;            // a list has come
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
