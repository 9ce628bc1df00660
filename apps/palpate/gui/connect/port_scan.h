// Lists the serial ports and asks each what is behind it, in threads of its own. Signals come in
// the thread of this object.
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

struct ScannedPort {
  PortInfo info;
  QString notAsked = {};  // why this port isn't asked, one line; empty: it is
};

// What our own connection has found behind its ports, each judged by itself; of one that doesn't
// answer yet nothing.
QHash<QString, PortProbe> knownProbes(const Connection& connection, const DeviceStatus& status);

// The device that a name of a port leads to; the name itself where that is no file.
QString deviceOf(const QString& port);

class PortScan : public QObject {
  Q_OBJECT
 public:
  // listPorts() and probePort(); tests hand in their own. Both are called from other threads.
  struct Functions {
    std::function<std::vector<PortInfo>()> list;
    // Has to return soon after `isCancelled` says true.
    std::function<PortProbe(const std::string& port, const std::function<bool()>& isCancelled)>
        probe;
  };

  explicit PortScan(QObject* parent = nullptr);
  PortScan(Functions functions, QObject* parent = nullptr);
  static constexpr std::chrono::milliseconds kPatience{150};
  // As cancel(). A thread that the system holds up longer ends by itself later, and is heard no
  // more.
  ~PortScan() override;

  // Ports (by any of their names) that aren't asked: those of our own connection; and what is known
  // to answer there.
  void setBusy(const QStringList& ports, const QHash<QString, PortProbe>& known = {}) {
    busyPorts_ = ports;
    known_ = known;
  }
  bool isBusy(const QString& port) const;
  // Lists the ports, then asks them, several at a time. Does nothing while it is running.
  void scan();
  // Asks one port more that isn't listed: a pty, "tcp:HOST:PORT". One of setBusy() is answered for
  // at once.
  void ask(const QString& port);
  // Ends what is running, without finished(). Returns when the ports are free again (usually
  // after 20 ms), at the latest after `patience`; false: one isn't yet.
  bool cancel(std::chrono::milliseconds patience = kPatience);
  // A list or an answer is still to come.
  bool running() const noexcept { return pending_ > 0; }

 signals:
  // In the order of listPorts(); one probed() follows for each that is asked, or of which setBusy()
  // knows.
  void listed(const QList<palpate::gui::ScannedPort>& ports);
  // `port` as listed (PortInfo::name) or as handed to ask().
  void probed(const QString& port, const palpate::PortProbe& probe);
  // Nothing is to come any more.
  void finished();

 private:
  struct Round;
  Round& currentRound();
  void askNext();
  void takeList(std::vector<PortInfo> found);
  void takeProbe(const QString& port, const PortProbe& probe);
  void conclude();
  PortProbe probeOfBusy(const QString& port) const;

  Functions functions_;
  QStringList busyPorts_;
  QHash<QString, PortProbe> known_;
  QStringList waiting_;  // to be asked as soon as a thread is free
  int pending_ = 0;      // the list, and the ports that are asked or wait
  int asking_ = 0;       // ports that are asked now
  std::shared_ptr<Round> round_;
};

}  // namespace palpate::gui
