#include "gui/source/file_reading.h"

#include <algorithm>
#include <mutex>
#include <utility>

namespace palpate::gui {
namespace {

struct Gate {
  std::mutex mutex;
  std::function<void()> pass;
};

// Never destroyed: threads may run longer than the statics live.
Gate& gateOfReadings() {
  static auto* const gate = new Gate;
  return *gate;
}

void passGate() {
  std::function<void()> pass;
  {
    const std::lock_guard guard(gateOfReadings().mutex);
    pass = gateOfReadings().pass;
  }
  if (pass) pass();
}

}  // namespace

void FileReading::start(Work work, Failed failed) {
  Abandonable::start(
      [work = std::move(work)](const Asker&) {
        passGate();
        return work();
      },
      std::move(failed));
}

void FileReading::settleAll(const QObject& root) {
  // An answer may destroy other readings: they are looked for anew after each.
  for (;;) {
    const auto all = root.findChildren<FileReading*>();
    const auto busy = std::find_if(
        all.begin(), all.end(), [](const FileReading* reading) { return reading->busy(); });
    if (busy == all.end()) return;
    (*busy)->settle();
  }
}

void FileReading::setGate(std::function<void()> gate) {
  const std::lock_guard guard(gateOfReadings().mutex);
  gateOfReadings().pass = std::move(gate);
}

}  // namespace palpate::gui
