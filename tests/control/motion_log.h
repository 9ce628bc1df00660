// Log of the bytes that arrived at the motion port of an emulated hand. It decodes them by the
// protocol document alone: text lines, and binary records cmd u8 | n u8 | k u8 | k floats |
// checksum.
#pragma once

#include <cstring>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "palpate/emulator/emulated_hand.h"

namespace palpate::testing {

struct ArrivedCommand {
  std::int64_t monoUs = 0;     // arrival of its last byte [monotonic us]
  std::string name;            // "p", "v", "power", "stop", "m", ..
  std::vector<double> values;  // values to set; empty for a read request
};

class MotionLog {
 public:
  ReceiveObserver observer() {
    return [this](EmulatedPort port, std::span<const std::byte> bytes, std::int64_t monoUs) {
      if (port != EmulatedPort::kMotion) return;
      const std::lock_guard lock(mutex_);
      pending_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
      while (takeOne(monoUs)) {
      }
    };
  }
  std::vector<ArrivedCommand> all() const {
    const std::lock_guard lock(mutex_);
    return commands_;
  }
  std::vector<ArrivedCommand> named(const std::string& name) const {
    std::vector<ArrivedCommand> found;
    for (ArrivedCommand& command : all())
      if (command.name == name) found.push_back(std::move(command));
    return found;
  }
  // Commands that set a value or begin a motion, without read requests and stops.
  std::vector<ArrivedCommand> deeds() const {
    std::vector<ArrivedCommand> found;
    for (ArrivedCommand& command : all())
      if (command.name == "m" || command.name == "grip" || command.name == "selgrip" ||
          command.name == "ref" || !command.values.empty())
        found.push_back(std::move(command));
    return found;
  }
  // The first command of this name that arrived at or after a time.
  std::optional<ArrivedCommand> firstSince(const std::string& name, std::int64_t monoUs) const {
    for (ArrivedCommand& command : named(name))
      if (command.monoUs >= monoUs) return std::move(command);
    return std::nullopt;
  }
  void clear() {
    const std::lock_guard lock(mutex_);
    commands_.clear();
  }
  // The bytes of an incomplete command.
  std::string pending() const {
    const std::lock_guard lock(mutex_);
    return pending_;
  }
  // Drops the bytes of an incomplete command after the port was unplugged.
  void restart() {
    const std::lock_guard lock(mutex_);
    commands_.clear();
    pending_.clear();
  }

 private:
  bool takeOne(std::int64_t monoUs) {
    if (pending_.empty()) return false;
    return (static_cast<unsigned char>(pending_[0]) & 0x80u) != 0 ? takeRecord(monoUs)
                                                                  : takeLine(monoUs);
  }
  bool takeRecord(std::int64_t monoUs) {
    if (pending_.size() < 3) return false;
    const std::size_t size = 2u + static_cast<unsigned char>(pending_[1]);
    if (pending_.size() < size) return false;
    static const std::map<unsigned, std::string> kNames = {{0x80, "v"},
                                                           {0x81, "vel"},
                                                           {0x82, "rvel"},
                                                           {0x83, "pos"},
                                                           {0x84, "state"},
                                                           {0x85, "p"},
                                                           {0x86, "a"},
                                                           {0x8B, "tpap"},
                                                           {0x8C, "tvav"},
                                                           {0xA3, "ilim"},
                                                           {0xA4, "power"}};
    ArrivedCommand command{monoUs, "unknown record", {}};
    if (const auto known = kNames.find(static_cast<unsigned char>(pending_[0]));
        known != kNames.end())
      command.name = known->second;
    for (unsigned i = 0; i < static_cast<unsigned char>(pending_[2]); ++i) {
      float value = 0.0F;
      std::memcpy(&value, pending_.data() + 3 + 4 * i, sizeof value);
      command.values.push_back(static_cast<double>(value));
    }
    commands_.push_back(std::move(command));
    pending_.erase(0, size);
    return true;
  }
  bool takeLine(std::int64_t monoUs) {
    const std::size_t end = pending_.find_first_of("\r\n");
    if (end == std::string::npos) return false;
    std::string line = pending_.substr(0, end);
    pending_.erase(0, end + 1);
    while (!line.empty() && line.front() == ' ') line.erase(0, 1);
    if (line.empty()) return true;
    ArrivedCommand command{monoUs, line, {}};
    if (const std::size_t equals = line.find('='); equals != std::string::npos) {
      command.name = line.substr(0, equals);
      for (std::size_t at = equals; at != std::string::npos; at = line.find(',', at + 1))
        command.values.push_back(std::stod(line.substr(at + 1)));
    }
    commands_.push_back(std::move(command));
    return true;
  }

  mutable std::mutex mutex_;
  std::string pending_;
  std::vector<ArrivedCommand> commands_;
};

}  // namespace palpate::testing
