// Fake byte channel whose other end is a function. Its time advances only while the tested code
// waits for bytes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "palpate/core/error.h"
#include "palpate/core/time.h"
#include "palpate/device/byte_channel.h"

namespace palpate::testing {

using Bytes = std::vector<std::byte>;

// Converts "AA 03 ff" to bytes; text that isn't a pair of hexadecimal digits is skipped.
inline Bytes bytesOf(const std::string& hex) {
  Bytes bytes;
  std::string digits;
  for (const char c : hex)
    if (std::isxdigit(static_cast<unsigned char>(c)) != 0) digits += c;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
    bytes.push_back(static_cast<std::byte>(std::stoi(digits.substr(i, 2), nullptr, 16)));
  return bytes;
}

class ManualClock : public Clock {
 public:
  std::int64_t monotonicUs() const override { return nowUs; }
  std::int64_t wallUs() const override { return 1'500'000'000'000'000 + nowUs + wallJumpUs; }
  std::int64_t nowUs = 0;
  std::int64_t wallJumpUs = 0;
};

class ScriptedChannel : public ByteChannel {
 public:
  using Answer = std::function<void(const Bytes& request, ScriptedChannel& line)>;
  ScriptedChannel(ManualClock& clock, Answer answer) : clock_(clock), answer_(std::move(answer)) {}

  // `bytes` arrive `delayUs` from now (0: at once).
  void arrive(const Bytes& bytes, std::int64_t delayUs = 0) {
    coming_.emplace(clock_.nowUs + delayUs, bytes);
  }
  void pullThePlug() { gone_ = true; }
  // The other side ends the stream in order.
  void endStream() { gone_ = atEnd_ = true; }

  std::size_t read(std::span<std::byte> into, std::chrono::milliseconds timeout) override {
    if (gone_) throw DeviceError(DeviceFault::kDisconnected, name_, "unplugged");
    const std::int64_t endUs = clock_.nowUs + std::int64_t{timeout.count()} * 1000;
    if (here_.empty()) {
      if (coming_.empty() || coming_.begin()->first > endUs) {
        clock_.nowUs = endUs;
        return 0;
      }
      clock_.nowUs = std::max(clock_.nowUs, coming_.begin()->first);
      here_ = std::move(coming_.begin()->second);
      coming_.erase(coming_.begin());
    }
    const std::size_t n = std::min({into.size(), here_.size(), mostAtOnce});
    std::copy_n(here_.begin(), n, into.begin());
    here_.erase(here_.begin(), here_.begin() + static_cast<std::ptrdiff_t>(n));
    return n;
  }
  void write(std::span<const std::byte> bytes) override {
    if (gone_) throw DeviceError(DeviceFault::kDisconnected, name_, "unplugged");
    const Bytes request(bytes.begin(), bytes.end());
    written.insert(written.end(), request.begin(), request.end());
    requests.push_back(request);
    if (answer_) answer_(request, *this);
  }
  void interrupt() noexcept override {}
  const std::string& name() const noexcept override { return name_; }
  bool isNetwork() const noexcept override { return network; }
  bool isDatagrams() const noexcept override { return datagrams; }
  bool atEnd() const noexcept override { return atEnd_; }

  bool network = false;
  bool datagrams = false;
  Bytes written;
  std::vector<Bytes> requests;
  std::size_t mostAtOnce = SIZE_MAX;

 private:
  ManualClock& clock_;
  Answer answer_;
  Bytes here_;
  std::multimap<std::int64_t, Bytes> coming_;
  bool gone_ = false;
  bool atEnd_ = false;
  std::string name_ = "scripted";
};

}  // namespace palpate::testing
