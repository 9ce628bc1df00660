// Tests of the physical hand through its emulated ports, as a client sees it.
#include <algorithm>
#include <numeric>

#include "palpate/emulator/emulated_hand.h"
#include "palpate/emulator/physical_hand.h"

#include "emulator/hand_session.h"
#include "testing/testing.h"

namespace palpate::emulated_physical_hand_test {
namespace {

using namespace std::chrono_literals;
using testing::DecodedFrame;
using testing::kPush;
using testing::kPushRaw;
using testing::kStop;
using testing::LineClient;
using testing::Octets;
using testing::readFrames;

std::unique_ptr<PhysicalHand> handIn(const std::string& scene) {
  return std::make_unique<PhysicalHand>(loadScene(scene, testing::dataFolder() / "scenes"));
}

// Frames per second by the controller's clock.
double rateOf(const std::vector<DecodedFrame>& frames) {
  if (frames.size() < 2) return 0.0;
  return 1000.0 * double(frames.size() - 1) / (frames.back().deviceMs - frames.front().deviceMs);
}

std::vector<DecodedFrame> stream(LineClient& client, const Octets& start, std::size_t count) {
  client.send(start);
  if (!client.answer(0x03)) return {};
  auto frames = readFrames(client, count);
  client.send(kStop);
  client.receiveUntilSilent(100ms);
  client.scanner() = {};
  return frames;
}

void setThreshold(LineClient& client, std::uint8_t counts) {
  EXPECT_EQ(client.ask(0x13, {0x02, 0, counts, 0}), (Octets{0, 0}));
}

// Enables one matrix only: all of it, or the taxels of one octet of its mask.
void setMasks(LineClient& client, std::uint8_t matrix, std::optional<std::uint8_t> octet) {
  for (std::uint8_t m = 0; m < 6; ++m) {
    Octets mask(m % 2 == 0 ? 13 : 12, m == matrix && !octet ? 0xFF : 0);
    mask[0] = 1;
    mask[1] = m;
    if (m == matrix && octet) mask[3] = *octet;
    EXPECT_EQ(client.ask(0xAB, mask), (Octets{0, 0}));
  }
}

// Sections 1.6.1 and 3.1 of the protocol document, in the hand's own time.
TEST(EmulatedPhysicalHand, HasTheFrameRatesOfARealOne) {
  EmulatedHand hand(handIn("empty"), {.rate = EmulationRate::kMax});
  LineClient client(hand.dsaPort());
  EXPECT_NEAR(rateOf(stream(client, kPush, 200)), 31.7, 0.1);
  EXPECT_NEAR(rateOf(stream(client, kPushRaw, 200)), 11.7, 0.1);
  setThreshold(client, 0);
  const auto noisy = stream(client, kPush, 200);
  EXPECT_GT(rateOf(noisy), 15.0);
  EXPECT_LT(rateOf(noisy), 19.0);
  setThreshold(client, 200);
  setMasks(client, 3, std::nullopt);
  const double oneMatrix = rateOf(stream(client, kPush, 200));
  EXPECT_GT(oneMatrix, 55.0);
  EXPECT_LT(oneMatrix, 58.0);
  setMasks(client, 3, 0x18);  // two taxels
  EXPECT_NEAR(rateOf(stream(client, kPush, 200)), 76.0, 1.0);
}

TEST(EmulatedPhysicalHand, ThresholdZeroHalvesTheRateOnTheLineItself) {
  EmulatedHand hand(handIn("empty"));
  LineClient client(hand.dsaPort());
  setThreshold(client, 0);
  const double rate = rateOf(stream(client, kPush, 25));
  EXPECT_GT(rate, 15.0);
  EXPECT_LT(rate, 19.0);
}

TEST(EmulatedPhysicalHand, UntouchedItIsZeroAndWithoutThresholdItIsNoise) {
  EmulatedHand hand(handIn("empty"), {.rate = EmulationRate::kMax});
  LineClient client(hand.dsaPort());
  for (const DecodedFrame& frame : stream(client, kPush, 50))
    EXPECT_EQ(std::accumulate(frame.values.begin(), frame.values.end(), 0), 0);
  setThreshold(client, 0);
  for (const DecodedFrame& frame : stream(client, kPush, 50))
    EXPECT_GT(std::accumulate(frame.values.begin(), frame.values.end(), 0), 456 * 20);
}

// A grasp that is commanded at one port, measured at the other, and compared with the truth.
TEST(EmulatedPhysicalHand, FeelsWhatItGrasps) {
  std::uint64_t contacts = 0;
  double mostN = 0.0;
  Scene scene = loadScene("ball", testing::dataFolder() / "scenes");
  scene.script.clear();
  EmulatedHand hand(std::make_unique<PhysicalHand>(scene),
                    {.rate = EmulationRate::kMax},
                    [&](const EmulatedFrame& frame) {
                      for (const MatrixTruth& matrix : frame.model.truth()) {
                        contacts += matrix.contact ? 1 : 0;
                        mostN = std::max(mostN, matrix.forceN);
                      }
                    });
  LineClient tactile(hand.dsaPort()), motion(hand.sdhPort());
  stream(tactile, kPush, 20);
  hand.withModel([&](HandModel&) { EXPECT_EQ(contacts, 0u); });
  motion.send("p=60,7,-7,7,-7,7,-7\r\nm\r\n");  // centrical, closed
  ASSERT_TRUE(motion.receiveLine());
  const auto answer = motion.receiveLine();
  ASSERT_TRUE(answer && answer->starts_with("M=")) << answer.value_or("nothing");
  const auto frames = stream(tactile, kPush, 200);  // six seconds of the hand's time
  ASSERT_EQ(frames.size(), 200u);
  const auto& last = frames.back().values;
  int fingers = 0;
  for (std::ptrdiff_t finger = 0; finger < 3; ++finger)
    fingers +=
        *std::max_element(last.begin() + 162 * finger, last.begin() + 162 * (finger + 1)) > 0;
  EXPECT_GE(fingers, 2);
  hand.withModel([&](HandModel&) {
    EXPECT_GT(contacts, 0u);
    EXPECT_GT(mostN, 0.1);
  });
  motion.send("temp\r\n");
  const auto temperatures = motion.receiveLine();
  ASSERT_TRUE(temperatures);
  EXPECT_EQ(std::count(temperatures->begin(), temperatures->end(), ','), 8);
}

}  // namespace
}  // namespace palpate::emulated_physical_hand_test
