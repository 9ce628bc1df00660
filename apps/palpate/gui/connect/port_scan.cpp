#include "gui/connect/port_scan.h"

#include <QMetaObject>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <filesystem>
#include <list>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

namespace palpate::gui {
namespace {

constexpr int kAtOnce = 8;  // ports probed at the same time
constexpr const char* kOurPort = "this window is connected to it";

PortScan::Functions realFunctions() {
  return {[] { return listPorts(); },
          [](const std::string& port, const std::function<bool()>& isCancelled) {
            return probePort(port, {.open = {}, .isCancelled = isCancelled});
          }};
}

QString whyNotRequested(const PortInfo& port) {
  // Opening a Bluetooth port would connect to the remote device.
  if (port.bluetooth) return "Bluetooth: not checked";
  if (!port.readable || !port.writable)
    return "no permission to open it: add yourself to the group dialout (sudo adduser $USER "
           "dialout), then log in again";
  return {};
}

}  // namespace

// The threads of a scan. A thread uses only this object, never the PortScan itself, so that a
// thread that is blocked in the system can outlive the PortScan.
struct PortScan::Round {
  struct Worker {
    std::thread thread;
    bool done = false;
  };

  std::atomic<bool> cancelled = false;
  std::mutex mutex;
  std::condition_variable idle;
  // Null when the PortScan is destroyed or has cancelled.
  QObject* receiver = nullptr;
  int numRunning = 0;
  std::list<Worker> workers;

  // Runs `work` in a thread; the function that it returns runs in the thread of the receiver.
  static void start(const std::shared_ptr<Round>& round,
                    std::function<std::function<void()>()> work) {
    const std::lock_guard lock(round->mutex);
    round->reap();
    Worker& worker = round->workers.emplace_back();
    worker.thread = std::thread([round, &worker, work = std::move(work)]() mutable {
      std::function<void()> report = work();
      const std::lock_guard finished(round->mutex);
      if (round->receiver)
        QMetaObject::invokeMethod(round->receiver, std::move(report), Qt::QueuedConnection);
      worker.done = true;
      --round->numRunning;
      round->idle.notify_all();
    });
    ++round->numRunning;
  }

  // Joins the threads that are done. The caller holds the mutex; these threads don't need it any
  // more.
  void reap() {
    workers.remove_if([](Worker& worker) {
      if (worker.done) worker.thread.join();
      return worker.done;
    });
  }

  bool end(std::chrono::milliseconds patience) {
    cancelled = true;
    std::unique_lock lock(mutex);
    receiver = nullptr;
    const bool allDone = idle.wait_for(lock, patience, [this] { return numRunning == 0; });
    reap();
    for (Worker& worker : workers) worker.thread.detach();
    return allDone;
  }
};

QHash<QString, PortProbe> knownProbes(const Connection& connection, const DeviceStatus& status) {
  QHash<QString, PortProbe> known;
  const auto add = [&](const QString& name, const PortStatus& port, PortAnswer belongs) {
    if (name.isEmpty() || (!port.found && port.state != PortState::kStreaming)) return;
    PortProbe probe;
    probe.port = name.toStdString();
    probe.answer = port.found.value_or(belongs);
    probe.message = std::string(probe.answer == PortAnswer::kTactile ? "tactile" : "motion") +
                    " controller; this window is connected to it";
    known.insert(name, probe);
  };
  add(connection.dsaPort, status.tactile, PortAnswer::kTactile);
  add(connection.sdhPort, status.motion.value_or(PortStatus{}), PortAnswer::kMotion);
  return known;
}

QString deviceOf(const QString& port) {
  if (!port.startsWith('/')) return port;
  std::error_code failed;
  const auto device = std::filesystem::canonical(port.toStdString(), failed);
  return failed ? port : QString::fromStdString(device.string());
}

PortScan::PortScan(QObject* parent) : PortScan(realFunctions(), parent) {}

PortScan::PortScan(Functions functions, QObject* parent)
    : QObject(parent), functions_(std::move(functions)) {}

PortScan::~PortScan() { cancel(); }

PortScan::Round& PortScan::currentRound() {
  if (!round_) {
    round_ = std::make_shared<Round>();
    round_->receiver = this;
  }
  return *round_;
}

void PortScan::scan() {
  if (running()) return;
  currentRound();
  ++pending_;
  Round::start(round_, [this, round = round_, list = functions_.list]() -> std::function<void()> {
    std::vector<PortInfo> found = list();
    return [this, round, found = std::move(found)]() mutable {
      if (round == round_) takeList(std::move(found));
    };
  });
}

void PortScan::listOnly() {
  currentRound();
  Round::start(round_, [this, round = round_, list = functions_.list]() -> std::function<void()> {
    std::vector<PortInfo> found = list();
    return [this, round, found = std::move(found)]() mutable {
      if (round == round_) emit portsListed(scanned(std::move(found)));
    };
  });
}

void PortScan::ask(const QString& port) {
  if (port.isEmpty()) return;
  if (isBusy(port)) {
    emit probed(port, probeOfBusy(port));
    return;
  }
  currentRound();
  ++pending_;
  waiting_.append(port);
  askNext();
}

bool PortScan::cancel(std::chrono::milliseconds patience) {
  waiting_.clear();
  pending_ = 0;
  asking_ = 0;
  const auto round = std::exchange(round_, nullptr);
  return !round || round->end(patience);
}

QList<ScannedPort> PortScan::scanned(std::vector<PortInfo> found) const {
  QList<ScannedPort> ports;
  for (PortInfo& info : found) {
    const bool busy = isBusy(QString::fromStdString(info.name)) ||
                      isBusy(QString::fromStdString(info.stableName));
    QString why = busy ? QString(kOurPort) : whyNotRequested(info);
    ports.append({std::move(info), std::move(why)});
  }
  return ports;
}

void PortScan::takeList(std::vector<PortInfo> found) {
  const QList<ScannedPort> ports = scanned(std::move(found));
  for (const ScannedPort& port : ports)
    if (port.notAsked.isEmpty()) {
      waiting_.append(QString::fromStdString(port.info.name));
      ++pending_;
    }
  const auto round = round_;
  emit listed(ports);
  for (const ScannedPort& port : ports) {
    // A receiver of the signal has cancelled the scan.
    if (round != round_) return;
    const QString name = QString::fromStdString(port.info.name);
    if (isBusy(name) && probeOfBusy(name).answer != PortAnswer::kBusy)
      emit probed(name, probeOfBusy(name));
  }
  if (round != round_) return;
  askNext();
  conclude();
}

PortProbe PortScan::probeOfBusy(const QString& port) const {
  const QString device = deviceOf(port);
  for (auto known = known_.begin(); known != known_.end(); ++known)
    if (known.key() == port || deviceOf(known.key()) == device) return known.value();
  PortProbe ours;
  ours.port = port.toStdString();
  ours.answer = PortAnswer::kBusy;
  ours.message = kOurPort;
  return ours;
}

void PortScan::askNext() {
  while (asking_ < kAtOnce && !waiting_.isEmpty()) {
    ++asking_;
    Round::start(round_,
                 [this, round = round_, ask = functions_.probe, port = waiting_.takeFirst()]()
                     -> std::function<void()> {
                   PortProbe probe;
                   try {
                     probe = ask(port.toStdString(), [&round] { return round->cancelled.load(); });
                   } catch (const std::exception& error) {
                     probe.message = error.what();
                   }
                   probe.port = port.toStdString();
                   return [this, round, port, probe] {
                     if (round == round_) takeProbe(port, probe);
                   };
                 });
  }
}

void PortScan::takeProbe(const QString& port, const PortProbe& probe) {
  --asking_;
  const auto round = round_;
  emit probed(port, probe);
  if (round != round_) return;
  askNext();
  conclude();
}

void PortScan::conclude() {
  if (--pending_ == 0) emit finished();
}

bool PortScan::isBusy(const QString& port) const {
  const QString device = deviceOf(port);
  for (const QString& busy : busyPorts_)
    if (busy == port || deviceOf(busy) == device) return true;
  return false;
}

}  // namespace palpate::gui
