#include "palpate/emulator/emulated_hand.h"

#include "emulator/line_client.h"
#include "emulator/still_hand.h"
#include "testing/testing.h"

namespace palpate {
namespace {

using namespace std::chrono_literals;
using testing::hexText;
using testing::LineClient;
using testing::Octets;
using testing::octets;
using testing::StillHand;
using testing::TemporaryFolder;

constexpr auto kNow = 500ms;

std::string exchange(LineClient& client, const std::string& request, std::size_t answerBytes) {
  client.send(octets(request));
  return hexText(client.receiveExactly(answerBytes));
}

// The vendor's sequence of section 4.1, byte by byte, over a pty at the line's own speed.
TEST(EmulatedHand, OpensAsTheVendorsTactileLibraryDoes) {
  const TemporaryFolder folder;
  EmulatedHand hand(std::make_unique<StillHand>(), {.dsaPort = folder / "tactile"});
  EXPECT_EQ(hand.dsaPort(), folder / "tactile");
  LineClient client(folder / "tactile");
  EXPECT_EQ(exchange(client, "AA AA AA 03 03 00 01 00 00 2F 6A", 10),
            "AA AA AA 03 02 00 00 00 4B B9");
  EXPECT_TRUE(client.receive(1000ms).empty());
  EXPECT_EQ(exchange(client, "AA AA AA 01 00 00", 26),
            "AA AA AA 01 12 00 00 00 57 00 9B 1D 10 00 29 80 70 00 00 00 00 00 00 00 2F 36");
  EXPECT_EQ(exchange(client, "AA AA AA 02 00 00", 20),
            "AA AA AA 02 0C 00 00 00 06 00 69 00 01 57 00 9B 1D 00 6F E1");
  for (const char* matrix :
       {"00 CB FB", "01 EA EB", "02 89 DB", "03 A8 CB", "04 4F BB", "05 6E AB"})
    EXPECT_EQ(exchange(client, std::string("AA AA AA 0B 01 00 ") + matrix, 60).substr(0, 23),
              "AA AA AA 0B 34 00 00 00");
  EXPECT_EQ(exchange(client, "AA AA AA 03 03 00 81 01 00 7C 5C", 10),
            "AA AA AA 03 02 00 00 00 4B B9");
  for (int i = 0; i < 5; ++i) {
    const auto packet = client.packet();
    ASSERT_TRUE(packet);
    EXPECT_EQ(packet->id, 0);
    EXPECT_TRUE(testing::decodeFramePayload(packet->payload));
  }
  client.send(octets("AA AA AA 03 03 00 01 00 00 2F 6A"));
  EXPECT_TRUE(client.answer(0x03));
  EXPECT_TRUE(client.receive(1000ms).empty());
}

// Section 4.2.
TEST(EmulatedHand, OpensAsTheVendorsMotionLibraryDoes) {
  EmulatedHand hand(std::make_unique<StillHand>());
  LineClient client(hand.sdhPort());
  client.send(" \r\n");
  EXPECT_TRUE(client.receive(100ms).empty());
  for (int i = 0; i < 2; ++i) {
    client.send("ver");
    client.send("\r\n");
    EXPECT_EQ(client.receiveLine(), "VER=0.0.3.3");
  }
  client.send("vlim\r\n");
  EXPECT_EQ(client.receiveLine(),
            "VLIM=83.0000,140.0000,200.0000,140.0000,200.0000,140.0000,200.0000");
  client.send("alim\r\n");
  EXPECT_EQ(client.receiveLine(),
            "ALIM=5000.0000,400.0000,1500.0000,400.0000,1500.0000,400.0000,1500.0000");
  client.send("con\r\n");
  EXPECT_EQ(client.receiveLine(), "CON=0");
  EXPECT_EQ(exchange(client, "83 03 00 DC 1E", 34).substr(0, 12), "83 20 07 00 ");
  EXPECT_EQ(exchange(client, "A4 1F 07 00x28 FA 6E", 34).substr(0, 12), "A4 20 07 00 ");
  EXPECT_TRUE(client.receive(100ms).empty());
}

}  // namespace
}  // namespace palpate
