// Lists the serial ports and probes what answers at each, in its own threads. Signals are emitted
// in the thread of this object. Used by the Connect dialog.
#pragma once

#include <QHash>
#include <QList>
#include <QObject>
#include <QStringList>
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <palpate/device/device.h>
#include <palpate/device/port_list.h>
#include <palpate/device/port_probe.h>

#include "gui/source/connection.h"

namespace palpate::gui {

// A port of the list, and whether it is probed.
struct ScannedPort {
  PortInfo info;
  // Why this port is not probed, in one line; empty when it is.
  QString notAsked = {};
};

// What the current connection knows about its own ports, each controller judged separately; ports
// without an answer so far are left out.
QHash<QString, PortProbe> knownProbes(const Connection& connection, const DeviceStatus& status);

// The device that a port's name links to; the name itself when it is not a file.
QString deviceOf(const QString& port);

class PortScan : public QObject {
  Q_OBJECT
 public:
  // listPorts() and probePort(); tests pass their own. Both are called from other threads.
  struct Functions {
    std::function<std::vector<PortInfo>()> list;
    // Must return soon after `isCancelled` returns true.
    std::function<PortProbe(const std::string& port, const std::function<bool()>& isCancelled)>
        probe;
  };

  explicit PortScan(QObject* parent = nullptr);
  PortScan(Functions functions, QObject* parent = nullptr);
  static constexpr std::chrono::milliseconds kPatience{150};
  // Cancels as cancel() does. A thread that is blocked in the system for longer ends by itself
  // later; its result is ignored.
  ~PortScan() override;

  // Sets the ports (by any of their names) that are not probed because the current connection uses
  // them, and what is known to answer there.
  void setBusy(const QStringList& ports, const QHash<QString, PortProbe>& known = {}) {
    busyPorts_ = ports;
    known_ = known;
  }
  bool isBusy(const QString& port) const;
  // Lists the ports, then probes them, several at a time. Does nothing while a scan is running.
  void scan();
  // Lists the ports without probing them; only portsListed() follows.
  void listOnly();
  // Probes one more port that is not listed: a pty or "tcp:HOST:PORT". For a port of setBusy() the
  // known answer is reported at once.
  void ask(const QString& port);
  // Stops the running scan without finished(). Returns true once the ports are free again (usually
  // after 20 ms); false when one is still in use after `patience`.
  bool cancel(std::chrono::milliseconds patience = kPatience);
  // A list or an answer is still to come.
  bool running() const noexcept { return pending_ > 0; }

 signals:
  // The ports in the order of listPorts(). One probed() follows for each port that is probed or
  // that setBusy() knows.
  void listed(const QList<palpate::gui::ScannedPort>& ports);
  // The same ports, after listOnly().
  void portsListed(const QList<palpate::gui::ScannedPort>& ports);
  // `port` is the name as listed (PortInfo::name) or as passed to ask().
  void probed(const QString& port, const palpate::PortProbe& probe);
  // The scan is complete.
  void finished();

 private:
  struct Round;
  Round& currentRound();
  void askNext();
  QList<ScannedPort> scanned(std::vector<PortInfo> found) const;
  void takeList(std::vector<PortInfo> found);
  void takeProbe(const QString& port, const PortProbe& probe);
  void conclude();
  PortProbe probeOfBusy(const QString& port) const;

  Functions functions_;
  QStringList busyPorts_;
  QHash<QString, PortProbe> known_;
  // Ports to be probed as soon as a thread is free.
  QStringList waiting_;
  // The number of results to come: the list, and the ports that are being probed or wait.
  int pending_ = 0;
  // The number of ports that are being probed.
  int asking_ = 0;
  std::shared_ptr<Round> round_;
};

}  // namespace palpate::gui
