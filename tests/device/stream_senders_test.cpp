// The senders that docs/stream_senders gives to others: the Python programs are started and
// recorded, the Arduino sketches are compiled and run; every value is compared.
#include <algorithm>

#include <gtest/gtest.h>

#include "palpate/capture/capture_session.h"
#include "palpate/device/series_source.h"
#include "palpate/device/stream_device.h"
#include "palpate/device/stream_lines.h"
#include "palpate/device/stream_packets.h"
#include "palpate/recording/recording.h"

#include "device/arduino_stub.h"
#include "device/collecting_sink.h"
#include "device/stream_hands.h"
#include "testing/awaited.h"
#include "testing/background_program.h"
#include "testing/testing.h"

namespace palpate::testing::arduino::lines_sketch {
#include "../../docs/stream_senders/arduino_lines/arduino_lines.ino"
}
namespace palpate::testing::arduino::packets_sketch {
#include "../../docs/stream_senders/arduino_packets/arduino_packets.ino"
}

namespace palpate::testing::stream_senders_test {
namespace {

constexpr std::int64_t kFrames = 60;

// What the Python senders send as value k of frame n, plus `offset`.
float sentValue(std::int64_t n, std::int64_t k, float offset) {
  return static_cast<float>((7 * n + 3 * k) % 1000) + offset;
}

void recordAndCompare(const std::string& sender, float offset, const std::string& serial) {
  const TemporaryFolder folder;
  StreamDeviceOptions options;
  options.source = "listen:0";
  options.hand = padHand({{16, 16}});
  auto owned = std::make_unique<StreamDevice>(options);
  const StreamDevice& device = *owned;
  CaptureSession session(std::move(owned));
  RecordingOptions recording;
  recording.path = folder / "a.palpate";
  recording.stopAfterFrames = kFrames;
  recording.preTriggerS = 0.0;
  session.startRecording(recording);
  session.start();
  ASSERT_TRUE(awaited([&] { return device.localPort().has_value(); }));
  BackgroundProgram program("/usr/bin/python3",
                            {std::string(PALPATE_STREAM_SENDERS "/") + sender,
                             "127.0.0.1",
                             std::to_string(*device.localPort()),
                             std::to_string(kFrames)});
  EXPECT_EQ(program.wait(), 0) << program.err();
  ASSERT_TRUE(awaited([&] { return !session.recording(); })) << device.status().tactile.message;
  const PortStatus status = device.status().tactile;
  EXPECT_EQ(device.info().serial, serial);
  session.stop();
  const RecordingReport report = session.stopRecording();
  EXPECT_TRUE(report.complete) << report.message;
  EXPECT_EQ(status.lost, 0u);
  EXPECT_EQ(status.suspect, 0u) << device.lastFault();
  EXPECT_EQ(status.badChecksums, 0u);
  EXPECT_EQ(verifyRecording(folder / "a.palpate").state, VerifyReport::State::kSound);
  const Profile profile = openRecording(folder / "a.palpate");
  ASSERT_EQ(static_cast<std::int64_t>(profile.numFrames()), kFrames);
  std::optional<std::int64_t> lastUs;
  for (std::int64_t n = 0; n < kFrames; ++n) {
    const TactileFrame frame = profile.frame(static_cast<std::size_t>(n));
    ASSERT_EQ(frame.values.size(), 256u);
    for (std::int64_t k = 0; k < 256; ++k)
      ASSERT_EQ(frame.values[static_cast<std::size_t>(k)], sentValue(n, k, offset))
          << "frame " << n << ", value " << k;
    ASSERT_TRUE(frame.deviceUs);
    ASSERT_GE(*frame.deviceUs, lastUs.value_or(*frame.deviceUs));
    lastUs = frame.deviceUs;
  }
}

TEST(StreamSenders, EveryValueOfThePythonLinesIsRecorded) {
  recordAndCompare("send_lines.py", 0.0F, "");
}

TEST(StreamSenders, EveryValueOfThePythonPacketsIsRecorded) {
  recordAndCompare("send_packets.py", 0.25F, "P7");
}

TEST(StreamSenders, EveryRowOfThePythonSeriesIsRead) {
  constexpr std::size_t kRows = 50;
  BackgroundProgram program("/usr/bin/python3",
                            {PALPATE_STREAM_SENDERS "/send_series.py", "0", std::to_string(kRows)});
  const auto port = program.awaitLine("");
  ASSERT_TRUE(port.has_value()) << program.err();
  CollectingSink sink;
  SeriesSource source({.name = "cell", .source = "tcp:127.0.0.1:" + *port});
  source.start(sink, kHandSeries);
  ASSERT_TRUE(awaited([&] { return source.status().port.items == kRows; })) << source.lastFault();
  EXPECT_EQ(program.wait(), 0) << program.err();
  source.stop();
  EXPECT_EQ(source.description().columns, (std::vector<Column>{{"force", "N"}, {"count", ""}}));
  EXPECT_EQ(source.status().port.suspect, 0u);
  EXPECT_EQ(source.status().port.lost, 0u);
  ASSERT_EQ(sink.temperatures.size(), kRows);  // all samples that are no angles
  for (std::size_t n = 0; n < kRows; ++n) {
    const Sample& sample = sink.temperatures[n];
    const auto number = static_cast<double>(n);
    EXPECT_EQ(sample.values, (std::vector<double>{0.5 * number, -number}));
    ASSERT_TRUE(sample.deviceUs);
    EXPECT_GE(*sample.deviceUs, sink.temperatures[n == 0 ? 0 : n - 1].deviceUs.value_or(0));
  }
}

TEST(StreamSenders, TheArduinoLinesAreRead) {
  arduino::Serial.sent.clear();
  arduino::lines_sketch::setup();
  for (int n = 0; n < 3; ++n) {
    arduino::fakeMicros = 20'000U * static_cast<unsigned>(n + 1);
    arduino::lines_sketch::loop();
  }
  StreamLineParser parser{StreamShape(padHand({{4, 4}}))};
  std::uint32_t n = 0;
  parser.push(std::as_bytes(std::span(arduino::Serial.sent)), [&](const StreamItem& item) {
    EXPECT_EQ(item.sequence, n);
    EXPECT_EQ(item.deviceUs, 20'000 * (n + 1));
    for (std::size_t k = 0; k < 16; ++k)
      EXPECT_EQ(item.values[k], static_cast<float>(100 * (k / 4) + k % 4));
    ++n;
  });
  EXPECT_EQ(n, 3u) << parser.lastFault();
}

TEST(StreamSenders, TheArduinoPacketsAreRead) {
  arduino::Serial.sent.clear();
  arduino::packets_sketch::setup();
  for (unsigned n = 0; n < 300; ++n) {
    arduino::fakeMicros = 1000 * n;
    arduino::packets_sketch::loop();
  }
  StreamPacketParser parser{StreamShape(padHand({{4, 4}}))};
  std::uint32_t n = 0;
  parser.push(std::as_bytes(std::span(arduino::Serial.sent)), [&](const StreamItem& item) {
    EXPECT_EQ(item.sequence, n);
    EXPECT_EQ(item.deviceUs, 1000 * n);
    for (std::size_t k = 0; k < 16; ++k)
      EXPECT_EQ(item.values[k], static_cast<float>(100 * (k / 4) + k % 4));
    ++n;
  });
  EXPECT_EQ(n, 300u) << parser.lastFault();
  EXPECT_EQ(parser.stats().skippedBytes, 0u);
}

}  // namespace
}  // namespace palpate::testing::stream_senders_test
