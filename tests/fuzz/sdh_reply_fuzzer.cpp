// Fuzzes what comes from the motion port: lines and records in pieces, and the driver's way through
// a whole conversation. Beyond not crashing: every byte is accounted for, splitting makes no
// difference, and the driver always comes back in bounded time, with values that a hand can have.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>
#include <vector>

#include "palpate/core/error.h"
#include "palpate/core/time.h"
#include "palpate/device/byte_channel.h"
#include "palpate/device/port_probe.h"
#include "palpate/device/sdh_controller.h"
#include "palpate/device/sdh_reply_parser.h"

namespace {

using namespace palpate;
using Bytes = std::span<const std::byte>;

void require(bool condition) {
  if (!condition) std::abort();
}

class Time : public Clock {
 public:
  std::int64_t monotonicUs() const override { return nowUs; }
  std::int64_t wallUs() const override { return nowUs; }
  std::int64_t nowUs = 0;
};

// The input is a list of answers, each behind its length (one byte): one per question, then
// silence.
class Line : public ByteChannel {
 public:
  Line(Bytes answers, bool network, Time& time)
      : answers_(answers), network_(network), time_(time) {}
  std::size_t read(std::span<std::byte> into, std::chrono::milliseconds timeout) override {
    if (answer_.empty()) {
      time_.nowUs += std::max<std::int64_t>(timeout.count(), 1) * 1000;
      return 0;
    }
    const std::size_t n = std::min(into.size(), answer_.size());
    std::copy_n(answer_.begin(), n, into.begin());
    answer_ = answer_.subspan(n);
    time_.nowUs += 100;
    return n;
  }
  void write(Bytes) override {
    if (answers_.empty()) return;
    const std::size_t size =
        std::min(std::to_integer<std::size_t>(answers_[0]), answers_.size() - 1);
    answer_ = answers_.subspan(1, size);
    answers_ = answers_.subspan(1 + size);
  }
  void interrupt() noexcept override {}
  const std::string& name() const noexcept override { return name_; }
  bool isNetwork() const noexcept override { return network_; }

 private:
  Bytes answers_;
  Bytes answer_;
  bool network_;
  Time& time_;
  std::string name_ = "line";
};

// What was found, in a form that compares; NaN by its bytes.
std::vector<std::string> repliesIn(Bytes bytes, bool checksum, std::size_t chunk) {
  SdhReplyParser parser(checksum);
  std::vector<std::string> replies;
  for (std::size_t at = 0; at < bytes.size(); at += chunk) {
    parser.push(bytes.subspan(at, std::min(chunk, bytes.size() - at)), [&](SdhReply&& reply) {
      if (const auto* line = std::get_if<SdhLine>(&reply)) {
        replies.push_back(line->name + "=" + line->text);
        if (const auto numbers = parseSdhNumbers(line->text))
          for (const double number : *numbers) require(std::isfinite(number));
      } else {
        const auto& record = std::get<SdhRecord>(reply);
        require(record.values.size() == kSdhAxes);
        replies.emplace_back(reinterpret_cast<const char*>(record.values.data()),
                             record.values.size() * sizeof(double));
      }
    });
    require(parser.pendingBytes() <= 254);
  }
  const SdhReplyStats& stats = parser.stats();
  require(stats.lineBytes + stats.recordBytes + stats.skippedBytes + parser.pendingBytes() ==
          bytes.size());
  return replies;
}

template <typename Call>
void bounded(const Time& time, Call call) {
  const std::int64_t before = time.nowUs;
  try {
    call();
  } catch (const DeviceError&) {
  } catch (const std::invalid_argument&) {  // limits of a hand that tells strange ones
  }
  require(time.nowUs - before < 40'000'000);
}

void inRange(const std::vector<double>& values, std::size_t count, double least, double most) {
  require(values.size() == count);
  for (const double value : values) require(value >= least && value <= most);
}

void converse(Bytes answers, bool network) {
  Time time;
  Line line(answers, network, time);
  SdhController hand(line, time);
  bounded(time, [&] { hand.open(); });
  bounded(time, [&] { inRange(hand.angles(), 7, -180.0, 180.0); });
  bounded(time, [&] {
    for (const int state : hand.states()) require(state >= 0 && state <= 7);
  });
  bounded(time, [&] { inRange(hand.temperatures(), 9, -55.0, 150.0); });
  bounded(time, [&] { hand.setTargets(std::vector<double>(7, 10.0)); });
  bounded(time, [&] { hand.setVelocity(3, 20.0); });
  bounded(time, [&] { require(hand.move() >= 0.0); });
  bounded(time, [&] { hand.pid(2); });
  bounded(time, [&] { hand.referenceRun({0, 0, 0, 0, 0, 0, 1}); });
  bounded(time, [&] { hand.stop(); });
}

void probe(Bytes answers, bool network) {
  Time time;
  PortProbeOptions options;
  options.open = [&](const std::string&) { return std::make_unique<Line>(answers, network, time); };
  probePort("line", options, time);
  require(time.nowUs < 3'000'000);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const bool network = (data[0] & 1) != 0;
  const Bytes bytes = std::as_bytes(std::span(data + 1, size - 1));
  require(repliesIn(bytes, !network, 4096) == repliesIn(bytes, !network, 1));
  converse(bytes, network);
  probe(bytes, network);
  return 0;
}
