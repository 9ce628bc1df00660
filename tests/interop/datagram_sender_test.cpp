#include "palpate/interop/datagram_sender.h"

#include <chrono>
#include <stdexcept>

#include "interop/udp_receiver.h"
#include "testing/testing.h"
#include "testing/time_limit.h"

namespace palpate::datagram_sender_test {
namespace {
using testing::UdpReceiver;

TEST(DatagramSender, WhatIsSentArrivesWhole) {
  UdpReceiver receiver;
  ASSERT_NE(receiver.port(), 0);
  DatagramSender sender(receiver.port());
  const std::string large(DatagramSender::kMaxBytes, 'x');
  EXPECT_TRUE(sender.send("{\"a\":1}"));
  EXPECT_TRUE(sender.send(large));
  EXPECT_EQ(receiver.receive(), "{\"a\":1}");
  EXPECT_EQ(receiver.receive(), large);
  EXPECT_EQ(sender.stats().sent, 2u);
  EXPECT_EQ(sender.stats().dropped, 0u);
  EXPECT_FALSE(sender.stats().nobodyListened());
  EXPECT_TRUE(sender.stats().delivered);
}

TEST(DatagramSender, WithoutAListenerItIsSaidAndNothingWaits) {
  std::uint16_t port = 0;
  {
    const UdpReceiver gone;
    port = gone.port();
  }
  DatagramSender sender(port);
  const auto begin = std::chrono::steady_clock::now();
  constexpr int kDatagrams = 1000;
  for (int i = 0; i < kDatagrams; ++i) {
    sender.send("x");
    ASSERT_FALSE(sender.stats().delivered) << i;
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, testing::timeLimit(std::chrono::seconds(1)));
  EXPECT_EQ(sender.stats().sent + sender.stats().dropped, 1000u);
  // The system reports a missing receiver after a datagram: at least every second one is known as
  // dropped.
  EXPECT_GE(sender.stats().dropped, 499u);
  EXPECT_TRUE(sender.stats().nobodyListened()) << sender.stats().unheard;
}

TEST(DatagramSender, AReceiverThatDoesNotReadHoldsNothingUp) {
  UdpReceiver receiver;
  DatagramSender sender(receiver.port());
  const std::string large(60'000, 'x');
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 1000; ++i) sender.send(large);  // 60 MB: more than any buffer
  EXPECT_LT(std::chrono::steady_clock::now() - begin, testing::timeLimit(std::chrono::seconds(2)));
  EXPECT_EQ(sender.stats().sent + sender.stats().dropped, 1000u);
  EXPECT_EQ(receiver.receive(), large);
}

TEST(DatagramSender, WhatIsTooLongIsDropped) {
  UdpReceiver receiver;
  DatagramSender sender(receiver.port());
  EXPECT_FALSE(sender.send(std::string(DatagramSender::kMaxBytes + 1, 'x')));
  EXPECT_EQ(sender.stats().dropped, 1u);
  EXPECT_TRUE(sender.send("next"));
  EXPECT_EQ(receiver.receive(), "next");
}

TEST(DatagramSender, NeedsAPort) { EXPECT_THROW(DatagramSender(0), std::invalid_argument); }

}  // namespace
}  // namespace palpate::datagram_sender_test
