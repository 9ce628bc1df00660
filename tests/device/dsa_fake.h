// Fake tactile controller, written from the protocol document; answers on a ScriptedChannel.
#pragma once

#include <vector>

#include "device/dsa_wire.h"

namespace palpate::testing {

class FakeDsa {
 public:
  // Configured behaviour.
  unsigned firmware = 0x2900;
  unsigned serialByte = 0x57;
  bool knowsMasks = true;
  std::int64_t deafUntilUs = 0;  // it boots until then
  int swallow = 0;               // number of requests without an answer
  int swallowMasks = 0;          // number of requests for a mask without an answer
  std::int64_t framePeriodUs = 31'500;
  std::int64_t answerUs = 500;
  std::int64_t clockAheadMs = 20'000;  // its clock minus that of the test
  // Reported number of rows of each matrix; 0: the actual number.
  int rowsTold = 0;
  int columnsTold = 0;
  // Settings that it received.
  std::vector<unsigned> thresholds = {150, 300, 150, 300, 150, 300};
  std::vector<float> sensitivities = std::vector<float>(6, 0.5F);
  std::vector<Bytes> dynamicMasks;
  bool streaming = false;
  bool runLength = true;
  bool setWhileStreaming = false;  // a setting arrived during the stream
  int stops = 0;
  std::vector<unsigned> asked;  // ids of the requests, in order

  explicit FakeDsa(ManualClock& clock) : clock_(clock) {
    for (int m = 0; m < 6; ++m)
      dynamicMasks.push_back(m % 2 == 0 ? bytesOf("FFFFFFFFFFFFFFFFFFFF0F")
                                        : bytesOf("FFFFFFFFFFFFFFFFFF3F"));
  }

  void operator()(const Bytes& request, ScriptedChannel& line) {
    if (clock_.nowUs < deafUntilUs || request.size() < 6) return;
    const auto at = [&](std::size_t i) { return std::to_integer<unsigned>(request.at(i)); };
    const unsigned id = at(3);
    asked.push_back(id);
    if (swallow > 0) {
      --swallow;
      return;
    }
    const auto answer = [&](const Bytes& payload) {
      line.arrive(wirePacket(id, payload), answerUs);
    };
    const auto m = request.size() > 6 ? at(6) : 0u;
    switch (id) {
      case 0x01: {
        Bytes record = bytesOf("00 00 57 00 9B 1D 10 00 00 80 70 00 00 00 00 00 00 00");
        record[2] = static_cast<std::byte>(serialByte);
        record[7] = static_cast<std::byte>(firmware & 0xFFu);
        record[8] = static_cast<std::byte>(firmware >> 8);
        return answer(record);
      }
      case 0x02:
        return answer(bytesOf("00 00 06 00 69 00 01 57 00 9B 1D 00"));
      case 0x03:
        return acquire(at(6), at(7) | at(8) << 8, line);
      case 0x04: {
        if (!knowsMasks) return answer(bytesOf("0D 00"));
        if (swallowMasks > 0) return void(--swallowMasks);
        Bytes payload = bytesOf("00 00");
        const Bytes mask = m == 0 ? (at(7) % 2 == 0 ? bytesOf("FFFFFFFFFFFFFFFFFFFF0F")
                                                    : bytesOf("9EE779DEFFFFFFFFFF3F"))
                                  : dynamicMasks.at(at(7));
        payload.insert(payload.end(), mask.begin(), mask.end());
        return answer(payload);
      }
      case 0x0B: {
        Bytes record = bytesOf(
            "0000 9A995940 9A995940 0600 0E00 102233445566 0000 01 000048C2 000000C2 00000000"
            "00000000 00000000 00000000 FF0F0000 02");
        if (m % 2 == 1) record[12] = std::byte{13};
        const auto tell = [&](std::size_t place, int count) {
          if (count == 0) return;
          record[place] = static_cast<std::byte>(count & 0xFF);
          record[place + 1] = static_cast<std::byte>(count >> 8);
        };
        tell(10, columnsTold);
        tell(12, rowsTold);
        return m < 6 ? answer(record) : answer(bytesOf("18 00"));
      }
      case 0x0F: {
        setWhileStreaming |= streaming;
        std::uint32_t bits = 0;
        for (std::size_t i = 4; i > 0; --i) bits = bits << 8 | at(8 + i - 1);
        sensitivities.at(at(7)) = (m & 1u) != 0 ? 0.5F : std::bit_cast<float>(bits);
        return (m & 0x80u) != 0 ? void() : answer(bytesOf("00 00"));
      }
      case 0x12: {
        Bytes record = bytesOf("00 00 02 00 00 00 00 00 00 00 3F");
        const auto bits = std::bit_cast<std::uint32_t>(sensitivities.at(m));
        for (std::size_t i = 0; i < 4; ++i)
          record[3 + i] = static_cast<std::byte>(bits >> 8 * i & 0xFFu);
        return answer(record);
      }
      case 0x13:
        setWhileStreaming |= streaming;
        thresholds.at(at(7)) = at(8) | at(9) << 8;
        return (m & 0x80u) != 0 ? void() : answer(bytesOf("00 00"));
      case 0x14:
        return answer({std::byte{0},
                       std::byte{0},
                       static_cast<std::byte>(thresholds.at(m) & 0xFFu),
                       static_cast<std::byte>(thresholds.at(m) >> 8)});
      case 0xAB:
        setWhileStreaming |= streaming;
        dynamicMasks.at(at(7)) = Bytes(request.begin() + 8, request.end() - 2);
        return answer(bytesOf("00 00"));
      default:
        return answer(bytesOf("0D 00"));
    }
  }

  // Sends the frames of the next `us`, as a streaming controller does.
  void streamFor(std::int64_t us, ScriptedChannel& line) {
    for (std::int64_t at = framePeriodUs; streaming && at <= us; at += framePeriodUs)
      sendFrame(line, at);
  }
  void sendFrame(ScriptedChannel& line, std::int64_t delayUs) {
    const auto ms = static_cast<std::uint32_t>((clock_.nowUs + delayUs) / 1000 + clockAheadMs);
    line.arrive(wirePacket(0, framePayload(ms, std::vector<unsigned>(486, 0), runLength)), delayUs);
  }

 private:
  void acquire(unsigned flags, unsigned rate, ScriptedChannel& line) {
    runLength = (flags & 1u) != 0;
    const bool on = (flags & 0x80u) != 0;
    if (!on) ++stops;
    streaming = on && rate > 0;
    line.arrive(wirePacket(0x03, bytesOf("00 00")), answerUs);
    if (on && rate == 0) sendFrame(line, answerUs + framePeriodUs);
  }

  ManualClock& clock_;
};

}  // namespace palpate::testing
