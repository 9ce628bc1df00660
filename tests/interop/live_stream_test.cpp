#include "palpate/interop/live_stream.h"

#include <stdexcept>

#include "palpate/core/json.h"

#include "interop/sample_results.h"
#include "interop/udp_receiver.h"
#include "testing/testing.h"

namespace palpate::live_stream_test {
namespace {
using testing::sampleResults;
using testing::UdpReceiver;

TEST(LiveStream, IsOffUntilItIsSwitchedOn) {
  UdpReceiver receiver;
  LiveStream stream{HandDescription()};
  stream.send(sampleResults());
  EXPECT_FALSE(stream.on(StreamKind::kSignals));
  EXPECT_FALSE(stream.stats(StreamKind::kTactile));
  stream.switchOn(StreamKind::kSignals, receiver.port());
  stream.send(sampleResults(2'000'000));
  // only one datagram was sent
  EXPECT_EQ(Json::parse(receiver.receive().value()).at("t").asDouble(), 2.0);
  stream.switchOff(StreamKind::kSignals);
  stream.send(sampleResults(3'000'000));
  EXPECT_FALSE(stream.on(StreamKind::kSignals));
  EXPECT_FALSE(receiver.receive(50));
}

TEST(LiveStream, EachStreamHasItsPortAndCounts) {
  UdpReceiver signalReceiver, tactileReceiver;
  LiveStream stream{HandDescription()};
  stream.switchOn(StreamKind::kSignals, signalReceiver.port());
  stream.switchOn(StreamKind::kTactile, tactileReceiver.port());
  for (int i = 0; i < 3; ++i) stream.send(sampleResults());
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(Json::parse(signalReceiver.receive().value()).at("sequence").asInteger(), i);
    // Six matrices are more than one datagram holds.
    std::size_t matrices = 0;
    while (matrices < 6) {
      const Json message = Json::parse(tactileReceiver.receive().value());
      EXPECT_EQ(message.at("header").at("seq").asInteger(), i);
      const Json parts = message.at("tactile_matrix");
      if (matrices == 0) {
        EXPECT_EQ(parts.at(1).at("tactile_array").at(6 * 8 + 2).asInteger(), 300);
      }
      matrices += parts.size();
    }
  }
  EXPECT_EQ(stream.stats(StreamKind::kSignals)->sent, 3u);
  EXPECT_EQ(stream.stats(StreamKind::kTactile)->sent, 6u);
}

TEST(LiveStream, AsksForTheLinkFourTimesASecondAtMost) {
  UdpReceiver receiver;
  int asked = 0;
  LiveStream stream({}, [&asked] {
    LinkHealth health;
    health.lost = static_cast<std::uint64_t>(++asked);
    return health;
  });
  stream.send(sampleResults());
  EXPECT_EQ(asked, 0);  // the stream is off
  stream.switchOn(StreamKind::kSignals, receiver.port());
  for (int i = 0; i < 100; ++i) stream.send(sampleResults(1'000'000 + i * 10'000));  // 1 s
  EXPECT_EQ(asked, 4);
  EXPECT_EQ(Json::parse(receiver.receive().value()).at("link").at("lost").asInteger(), 1);
  stream.send(sampleResults(5));  // a new source with another time
  EXPECT_EQ(asked, 5);
}

TEST(LiveStream, DatagramsHoldWhatOneTextHolds) {
  const LiveResults results = sampleResults();
  for (const StreamKind kind : kAllStreamKinds) {
    std::string whole;
    appendStreamed(whole, kind, results, 4, nullptr);
    const auto parts = streamedDatagrams(kind, results, 4, nullptr);
    if (kind == StreamKind::kSignals) {
      EXPECT_EQ(parts, std::vector<std::string>{whole});
    } else {
      EXPECT_EQ(parts.size(), 2u);
      EXPECT_EQ(Json::parse(parts[1]).at("header").text(), Json::parse(whole).at("header").text());
    }
  }
}

TEST(RecentLink, AsksAgainAfterAQuarterOfASecond) {
  EXPECT_EQ(RecentLink({}).at(0), nullptr);
  int asked = 0;
  RecentLink link([&asked] {
    LinkHealth health;
    health.lost = static_cast<std::uint64_t>(++asked);
    return health;
  });
  for (const std::int64_t us : {1'000'000, 1'249'999, 1'250'000, 1'000'001})
    ASSERT_NE(link.at(us), nullptr);
  EXPECT_EQ(asked, 2);
  EXPECT_EQ(link.at(1'000'000)->lost, 3u);  // an earlier time counts as well
}

TEST(LiveStream, RefusesPortZero) {
  LiveStream stream{HandDescription()};
  EXPECT_THROW(stream.switchOn(StreamKind::kSignals, 0), std::invalid_argument);
  EXPECT_FALSE(stream.on(StreamKind::kSignals));
}

}  // namespace
}  // namespace palpate::live_stream_test
