// Fake port of a tactile controller (a new one at every opening, with factory settings) that then
// misbehaves: sends random bytes, falls silent, sends a byte now and then, or is unplugged.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <thread>

#include "device/dsa_fake.h"

namespace palpate::testing {

enum class Behaviour { kHonest, kSilent, kBabbling, kDripping, kDisconnected };

struct BabblerControls {
  std::atomic<Behaviour> behaviour{Behaviour::kHonest};
  std::atomic<std::uint64_t> bytes{0};  // random bytes delivered
  // After this number of random bytes the controller is silent.
  std::atomic<std::uint64_t> most{0};
  std::atomic<unsigned> threshold2{0};  // threshold of matrix 2 in the controller
  std::atomic<bool> setWhileStreaming{false};
  std::atomic<unsigned> serialByte{0x57};  // lowest byte of the controller's serial number
};

class BabblingChannel : public ByteChannel {
 public:
  explicit BabblingChannel(BabblerControls& controls) : controls_(controls) {
    hand_.serialByte = controls.serialByte;
  }

  std::size_t read(std::span<std::byte> into, std::chrono::milliseconds timeout) override {
    switch (controls_.behaviour.load()) {
      case Behaviour::kHonest: {
        std::size_t n = line_.read(into, std::chrono::milliseconds(1));
        if (n == 0) rest(std::chrono::milliseconds(1));
        if (n == 0 && hand_.streaming) {
          hand_.sendFrame(line_, hand_.framePeriodUs);
          n = line_.read(into, std::chrono::milliseconds(hand_.framePeriodUs / 1000 + 1));
        }
        return n;
      }
      case Behaviour::kSilent:
        rest(timeout);
        return 0;
      case Behaviour::kDripping:
        rest(timeout);
        if (std::chrono::steady_clock::now() < nextDrop_) return 0;
        nextDrop_ = std::chrono::steady_clock::now() + std::chrono::seconds(1);
        into[0] = std::byte{0xAA};
        return 1;
      case Behaviour::kDisconnected:
        throw DeviceError(DeviceFault::kDisconnected, name_, "unplugged");
      case Behaviour::kBabbling:
        break;
    }
    if (controls_.bytes >= controls_.most) {
      rest(timeout);
      return 0;
    }
    // xorshift64*; every few hundred bytes a sequence that looks like a packet header.
    for (std::size_t i = 0; i + 8 <= into.size(); i += 8) {
      random_ ^= random_ >> 12;
      random_ ^= random_ << 25;
      random_ ^= random_ >> 27;
      std::uint64_t word = random_ * 2685821657736338717ull;
      if (word % 61 == 0) word = 0x03D100AAAAAAull | word << 48;
      std::memcpy(&into[i], &word, 8);
    }
    controls_.bytes += into.size();
    return into.size();
  }
  void write(std::span<const std::byte> bytes) override {
    if (controls_.behaviour == Behaviour::kDisconnected)
      throw DeviceError(DeviceFault::kDisconnected, name_, "unplugged");
    if (controls_.behaviour == Behaviour::kHonest) line_.write(bytes);
    controls_.threshold2 = hand_.thresholds[2];
    controls_.setWhileStreaming = controls_.setWhileStreaming || hand_.setWhileStreaming;
  }
  void interrupt() noexcept override { interrupted_ = true; }
  const std::string& name() const noexcept override { return name_; }

 private:
  void rest(std::chrono::milliseconds most) {
    const auto end = std::chrono::steady_clock::now() + most;
    while (!interrupted_.exchange(false) && std::chrono::steady_clock::now() < end)
      std::this_thread::sleep_for(std::min(most, std::chrono::milliseconds(2)));
  }

  BabblerControls& controls_;
  ManualClock clock_;
  FakeDsa hand_{clock_};
  ScriptedChannel line_{
      clock_, [this](const Bytes& request, ScriptedChannel& channel) { hand_(request, channel); }};
  std::chrono::steady_clock::time_point nextDrop_{};
  std::uint64_t random_ = 88172645463325252ull;
  std::atomic<bool> interrupted_{false};
  std::string name_ = "babbler";
};

}  // namespace palpate::testing
