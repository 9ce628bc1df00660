// A series from a channel of the test and over TCP: times, silence, losses, reconnection.
#include "palpate/device/series_source.h"

#include <algorithm>
#include <stdexcept>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>

#include "palpate/core/error.h"
#include "palpate/core/file_descriptor.h"
#include "palpate/core/json.h"

#include "device/collecting_sink.h"
#include "device/pty_pair.h"
#include "device/scripted_channel.h"
#include "device/series_link.h"
#include "testing/awaited.h"

namespace palpate::testing::series_source_test {
namespace {

class RowSink : public CollectingSink {
 public:
  void onSample(Sample&& sample) override {
    if (fails) throw std::runtime_error("the sink fails");
    EXPECT_EQ(sample.series, 5u);
    CollectingSink::onSample(std::move(sample));
  }
  bool fails = false;
  const std::vector<Sample>& rows() const { return temperatures; }  // all that are no angles
};

// The rounds of the thread, on a clock of the test.
struct Bench {
  explicit Bench(std::vector<Column> columns = {}) {
    const SeriesSourceOptions options{.name = "wrist", .source = "port", .columns = columns};
    link = std::make_unique<SeriesLink>(
        options, [this](const std::string& port) { return open(port); }, nullptr, time, clock);
    link->setSeries(5);
    link->begin(sink);
    link->step();
  }
  std::unique_ptr<ByteChannel> open(const std::string& port) {
    if (!plugged) throw DeviceError(DeviceFault::kNotFound, port, "no such port");
    auto channel = std::make_unique<ScriptedChannel>(clock, nullptr);
    line = channel.get();
    return channel;
  }
  void send(std::string_view text, std::int64_t afterUs = 10'000) {
    clock.nowUs += afterUs;
    line->arrive(textBytes(text));
    link->step();
  }
  void silence(std::int64_t us) {
    for (const std::int64_t endUs = clock.nowUs + us; clock.nowUs < endUs;) link->step();
  }
  void retry() {
    clock.nowUs += 1'100'000;
    link->step();
  }
  std::vector<Event> events(const std::string& kind) const {
    std::vector<Event> found;
    std::ranges::copy_if(
        sink.events, std::back_inserter(found), [&](const Event& e) { return e.kind == kind; });
    return found;
  }

  bool plugged = true;
  ManualClock clock;
  HostTime time{clock};
  RowSink sink;
  ScriptedChannel* line = nullptr;
  std::unique_ptr<SeriesLink> link;
};

TEST(SeriesSource, RowsHaveTheirTimeOfArrivalAndTheSendersBesideIt) {
  Bench bench;
  EXPECT_TRUE(bench.link->description().columns.empty());
  bench.send("time_ms,fx[N]\n3600000,1\n3600010,2\n");  // a clock an hour apart
  bench.send("3600005,3\n");                            // which goes back
  ASSERT_EQ(bench.sink.rows().size(), 3u);
  EXPECT_EQ(bench.link->description(), (SeriesDescription{"wrist", "", {{"fx", "N"}}, "port"}));
  EXPECT_EQ(bench.sink.rows()[0].deviceUs, 3'600'000'000);
  for (std::size_t i = 1; i < 3; ++i) {
    EXPECT_GT(bench.sink.rows()[i].hostUs, bench.sink.rows()[i - 1].hostUs);
    EXPECT_GE(*bench.sink.rows()[i].deviceUs, *bench.sink.rows()[i - 1].deviceUs);
  }
  EXPECT_EQ(bench.sink.rows()[2].hostUs, bench.time.nowUs());
  EXPECT_EQ(bench.link->status().items, 3u);
  EXPECT_EQ(bench.link->status().state, PortState::kStreaming);
}

// Two rows at 1 kHz that came in one read can't be told apart: one wake-up per row is what true
// times cost.
TEST(SeriesSource, EachRowOfAFastSeriesIsDeliveredAtItsTimeOfArrival) {
  Bench bench;
  bench.send("f[N]\n");
  const std::int64_t beginUs = bench.time.nowUs();
  std::vector<std::int64_t> arrivalUs;
  std::int64_t afterUs = 0;
  for (int i = 0; i < 1000; ++i) {
    afterUs += 700 + 37 * (i % 17);  // near 1 kHz, not evenly
    bench.line->arrive(textBytes(std::to_string(i) + "\n"), afterUs);
    arrivalUs.push_back(beginUs + afterUs);
  }
  for (std::size_t i = 0; i < arrivalUs.size(); ++i) {
    bench.link->step();
    ASSERT_EQ(bench.sink.rows().size(), i + 1);
    EXPECT_EQ(bench.time.nowUs(), arrivalUs[i]);
    EXPECT_EQ(bench.sink.rows()[i].hostUs, arrivalUs[i]);
  }
}

TEST(SeriesSource, ASilenceIsAGapOfTheSeries) {
  Bench bench;
  for (int i = 0; i < 100; ++i) bench.send("1,2\n");
  EXPECT_NEAR(bench.link->rateHz(), 100.0, 1e-6);
  const std::int64_t fromUs = bench.time.nowUs();
  bench.silence(1'000'000);
  EXPECT_EQ(bench.link->status().state, PortState::kSilent);
  EXPECT_EQ(bench.link->rateHz(), 0.0);
  const auto open = bench.link->openGap(bench.time.nowUs());
  ASSERT_TRUE(open.has_value());
  EXPECT_EQ(Json::parse(open->json).at("stream").asString(), "wrist");
  bench.send("1,2\n", 0);
  const auto gaps = bench.events("gap");
  ASSERT_EQ(gaps.size(), 1u);
  EXPECT_EQ(gaps[0].tUs, fromUs);
  EXPECT_EQ(gaps[0].t1Us, bench.time.nowUs());
  EXPECT_EQ(Json::parse(gaps[0].json).at("stream").asString(), "wrist");
  EXPECT_NEAR(static_cast<double>(Json::parse(gaps[0].json).at("lost").asInteger()), 99.0, 6.0);
  EXPECT_EQ(bench.link->status().lost,
            static_cast<std::uint64_t>(Json::parse(gaps[0].json).at("lost").asInteger()));
  EXPECT_FALSE(bench.link->openGap(bench.time.nowUs()).has_value());
}

TEST(SeriesSource, ASlowSeriesIsNotSilent) {
  Bench bench;
  for (int i = 0; i < 10; ++i) {
    bench.silence(1'900'000);
    bench.send("20.5\n", 0);
  }
  EXPECT_TRUE(bench.events("gap").empty());
  EXPECT_EQ(bench.link->status().state, PortState::kStreaming);
}

TEST(SeriesSource, AnUnpluggedSourceComesBackWithItsColumns) {
  Bench bench;
  bench.send("fx[N],fy[N]\n");
  for (int i = 0; i < 10; ++i) bench.send("1,2\n");
  bench.plugged = false;
  bench.line->pullThePlug();
  bench.link->step();
  EXPECT_EQ(bench.link->status().state, PortState::kLost);
  EXPECT_TRUE(bench.link->status().unplugged);
  bench.retry();
  bench.plugged = true;
  bench.retry();
  bench.send("3,4\n");
  EXPECT_EQ(bench.sink.rows().size(), 11u);
  EXPECT_EQ(bench.link->status().reconnects, 1u);
  EXPECT_EQ(bench.link->description().columns[1].name, "fy");
  ASSERT_EQ(bench.events("gap").size(), 1u);
  EXPECT_GT(bench.link->status().lost, 100u);
}

TEST(SeriesSource, ASenderThatEndsHasLostNothing) {
  Bench bench;
  for (int i = 0; i < 10; ++i) bench.send("1,2\n");
  bench.line->endStream();
  bench.link->step();
  EXPECT_FALSE(bench.link->openGap(bench.time.nowUs() + 5'000'000).has_value());
  bench.retry();
  bench.send("3,4\n");
  EXPECT_EQ(bench.link->status().lost, 0u);
}

TEST(SeriesSource, WhatIsRefusedIsToldOnce) {
  Bench bench;
  bench.send("a,b\n1,2\n1,2,3\n");
  for (int i = 0; i < 100; ++i) bench.send("1,2,3\n");
  EXPECT_EQ(bench.link->status().suspect, 101u);
  EXPECT_EQ(bench.events("alarm").size(), 1u);
  EXPECT_EQ(bench.link->lastFault(), "line 103: 3 numbers instead of 2");
  EXPECT_EQ(bench.link->status().message, "port: line 103: 3 numbers instead of 2");
}

TEST(SeriesSource, AnExceptionEndsTheConnectionOnly) {
  Bench bench;
  bench.sink.fails = true;
  bench.send("1,2\n");
  EXPECT_EQ(bench.link->status().state, PortState::kFault);
  bench.sink.fails = false;
  bench.retry();
  bench.send("3,4\n");
  ASSERT_EQ(bench.sink.rows().size(), 1u);
  EXPECT_EQ(bench.sink.rows()[0].values, (std::vector<double>{3, 4}));
}

TEST(SeriesSource, OptionsAreChecked) {
  EXPECT_THROW((SeriesSource({.name = "Wrist", .source = "-"})), std::invalid_argument);
  EXPECT_THROW((SeriesSource({.name = "wrist", .source = ""})), std::invalid_argument);
  EXPECT_THROW((SeriesSource({.name = "wrist", .source = "udp:nine"})), std::invalid_argument);
  EXPECT_THROW((SeriesSource({.name = "wrist", .source = "-", .columns = {{"a", ""}, {"a", ""}}})),
               std::invalid_argument);
}

TEST(SeriesSource, APortMayHaveItsBaudRate) {
  const auto text = [](std::string_view given) {
    const SeriesPlace place = seriesPlaceOf(given);
    return place.source + " " + std::to_string(place.baud);
  };
  EXPECT_EQ(text("serial:/dev/ttyUSB0@921600"), "/dev/ttyUSB0 921600");
  EXPECT_EQ(text("/dev/ttyUSB0@9600"), "/dev/ttyUSB0 9600");
  EXPECT_EQ(text("serial:/dev/ttyUSB0"), "/dev/ttyUSB0 115200");
  EXPECT_EQ(text("/dev/serial/by-id/usb-a@b"), "/dev/serial/by-id/usb-a@b 115200");
  EXPECT_EQ(text("tcp:host@9600"), "tcp:host@9600 115200");
  EXPECT_EQ(text("-"), "- 115200");
  EXPECT_THROW(seriesPlaceOf("/dev/ttyUSB0@49"), std::invalid_argument);
  EXPECT_THROW(seriesPlaceOf("/dev/ttyUSB0@10000001"), std::invalid_argument);
}

TEST(SeriesSource, ReadsOverTcpAndAcceptsTheNextSender) {
  RowSink sink;
  SeriesSource source({.name = "wrist", .source = "listen:0"});
  source.start(sink, 5);
  EXPECT_THROW(source.start(sink, 5), std::logic_error);
  ASSERT_TRUE(awaited([&] { return source.localPort().has_value(); }));
  for (std::size_t n = 1; n <= 2; ++n) {
    FileDescriptor sender(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port = htons(source.localPort().value());
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    ASSERT_EQ(::connect(sender.get(), reinterpret_cast<const sockaddr*>(&place), sizeof place), 0);
    constexpr std::string_view kText = "fx[N],fy[N]\n1,2\n";
    ASSERT_EQ(::send(sender.get(), kText.data(), kText.size(), 0),
              static_cast<ssize_t>(kText.size()));
    EXPECT_TRUE(awaited([&] { return source.status().port.items == n; }));
  }
  EXPECT_EQ(source.description().columns, (std::vector<Column>{{"fx", "N"}, {"fy", "N"}}));
  source.stop();
  EXPECT_EQ(source.status().port.state, PortState::kClosed);
}

}  // namespace
}  // namespace palpate::testing::series_source_test
