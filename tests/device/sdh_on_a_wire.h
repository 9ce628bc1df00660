// Test bench of the SDH-2's driver and an independent fake hand, on a ScriptedChannel whose time
// advances only while the driver waits.
#pragma once

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "palpate/device/sdh_controller.h"

#include "device/fake_sdh_hand.h"
#include "device/scripted_channel.h"

namespace palpate::testing {

class SdhWire : public ScriptedChannel {
 public:
  SdhWire(ManualClock& clock, Answer answer)
      : ScriptedChannel(clock, std::move(answer)), time_(clock) {}
  std::size_t read(std::span<std::byte> into, std::chrono::milliseconds timeout) override {
    if (onRead) onRead();
    if (!babble) return ScriptedChannel::read(into, timeout);
    time_.nowUs += 1000;
    for (std::byte& b : into)
      b = static_cast<std::byte>(noise_ = noise_ * 1'664'525u + 1'013'904'223u);
    return into.size();
  }
  bool isNetwork() const noexcept override { return network; }

  bool network = false;
  bool babble = false;           // random bytes without end
  std::function<void()> onRead;  // called before each read

 private:
  ManualClock& time_;
  unsigned noise_ = 1;
};

class SdhOnAWire : public ::testing::Test {
 protected:
  FakeSdhHand hand;
  ManualClock clock;
  bool urgent = false;
  std::int64_t answerAfterUs = 3400;
  SdhWire line{clock, [this](const Bytes& request, ScriptedChannel& channel) {
                 const Bytes answer = hand.receive(request);
                 if (!answer.empty()) channel.arrive(answer, answerAfterUs);
               }};
  SdhController controller{line, clock, {.urgent = [this] { return urgent; }}};

  double seconds() const { return static_cast<double>(clock.nowUs) * 1e-6; }

  // Expects std::invalid_argument with these words, and that no byte was sent.
  template <typename Call>
  void expectRefused(Call call, const std::vector<std::string>& words) {
    const std::size_t before = hand.bytesSeen;
    try {
      call();
      ADD_FAILURE() << "not refused";
    } catch (const std::invalid_argument& error) {
      for (const std::string& word : words)
        EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
    EXPECT_EQ(hand.bytesSeen, before) << "bytes were sent";
  }
};

template <typename Call>
DeviceError errorOf(Call call) {
  try {
    call();
  } catch (const DeviceError& error) {
    return error;
  }
  ADD_FAILURE() << "no error";
  return DeviceError(DeviceFault::kUnsupported, "", "");
}

}  // namespace palpate::testing
