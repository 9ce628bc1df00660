#include "palpate/interop/foxglove_messages.h"

#include <cmath>
#include <numbers>

#include "palpate/core/json.h"
#include "palpate/device/sdh2.h"
#include "palpate/model/hand_file.h"

#include "interop/sample_results.h"
#include "testing/testing.h"

namespace palpate::foxglove_messages_test {
namespace {
using testing::sampleResults;

// Decodes as RFC 4648 says, by a table of its own.
std::string decoded(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<std::uint32_t>(digits.find(c));
    if ((count += 6) >= 8) bytes += static_cast<char>(bits >> (count -= 8) & 0xFF);
  }
  return bytes;
}

std::string base64(const std::string& bytes) {
  std::string text;
  appendBase64(text, bytes.data(), bytes.size());
  return text;
}

TEST(FoxgloveMessages, Base64IsThatOfRfc4648) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64(std::string("\xFF\xFE\x00", 3)), "//4A");
}

// The colours of Matplotlib's viridis at 0, 64/256, 1/2 and 1, within what lies between the five.
TEST(FoxgloveMessages, ColoursAreThoseOfViridis) {
  const auto color = [](double value) {
    const FoxgloveColor c = foxgloveColor(value);
    return std::array<int, 3>{c.red, c.green, c.blue};
  };
  EXPECT_EQ(color(0.0), (std::array<int, 3>{68, 1, 84}));
  EXPECT_EQ(color(0.25), (std::array<int, 3>{59, 82, 139}));
  EXPECT_EQ(color(0.5), (std::array<int, 3>{33, 145, 140}));
  EXPECT_EQ(color(1.0), (std::array<int, 3>{253, 231, 37}));
  EXPECT_EQ(color(7.0), color(1.0));
  EXPECT_EQ(color(-1.0), color(0.0));
  EXPECT_EQ(color(std::nan("")), color(0.0));
}

TEST(FoxgloveMessages, AnImageHoldsTheCounts) {
  const FoxgloveMessages messages(sdh2());
  const LiveResults results = sampleResults();
  const Json image = Json::parse(messages.image(*results.frame, 1));
  EXPECT_EQ(image.at("timestamp").at("sec").asInteger(), 1'416'996'123);
  EXPECT_EQ(image.at("timestamp").at("nsec").asInteger(), 250'007'000);
  EXPECT_EQ(image.at("frame_id").asString(), "finger_0_distal");
  EXPECT_EQ(image.at("encoding").asString(), "mono16");
  EXPECT_EQ(image.at("width").asInteger(), 6);
  EXPECT_EQ(image.at("height").asInteger(), 13);
  EXPECT_EQ(image.at("step").asInteger(), 12);
  const std::string bytes = decoded(image.at("data").asString());
  ASSERT_EQ(bytes.size(), 13u * 12u);
  for (std::size_t i = 0; i < 78; ++i) {
    const int value = static_cast<unsigned char>(bytes[2 * i]) |
                      static_cast<unsigned char>(bytes[2 * i + 1]) << 8;
    EXPECT_EQ(value, i == 8 * 6 + 2 ? 300 : i == 9 * 6 + 2 ? 100 : 0) << i;
  }
}

TEST(FoxgloveMessages, AColouredImageShowsWhereThereIsNoTaxel) {
  const FoxgloveMessages messages(sdh2(), FoxgloveImage::kColored);
  const LiveResults results = sampleResults();
  const Json image = Json::parse(messages.image(*results.frame, 1));
  EXPECT_EQ(image.at("encoding").asString(), "rgb8");
  EXPECT_EQ(image.at("step").asInteger(), 18);
  const std::string bytes = decoded(image.at("data").asString());
  EXPECT_EQ(bytes.substr(0, 3), std::string(3, '\0'));  // (0, 0) is no taxel
  EXPECT_EQ(bytes.substr(3, 3), "\x44\x01\x54");        // (0, 1) is not touched
}

TEST(FoxgloveMessages, ValuesOfAPhysicalUnitAreNotRounded) {
  HandDescription hand = sdh2();
  hand.unit = "kPa";
  const FoxgloveMessages messages(hand);
  TactileFrame frame(hand.layout);
  frame.matrix(0)(0, 0) = 1.25F;
  const Json image = Json::parse(messages.image(frame, 0));
  EXPECT_EQ(image.at("encoding").asString(), "32FC1");
  EXPECT_EQ(decoded(image.at("data").asString()).substr(0, 4), std::string("\0\0\xA0\x3F", 4));
}

TEST(FoxgloveMessages, JointsAreInRadians) {
  const FoxgloveMessages messages(sdh2());
  const Json joints =
      Json::parse(messages.joints({1'000'000, {0.0, -90.0, std::nan(""), 0.0, 0.0, 0.0, 45.0}}));
  ASSERT_EQ(joints.at("joints").size(), 6u);  // NaN has no position
  const Json second = joints.at("joints").at(std::size_t{1});
  EXPECT_EQ(second.at("name").asString(), sdh2().axes[1].name);
  EXPECT_DOUBLE_EQ(second.at("position").asDouble(), -std::numbers::pi / 2.0);
}

TEST(FoxgloveMessages, EventsHaveALevelAndTheirMatrix) {
  const FoxgloveMessages messages(sdh2());
  const Json gap =
      Json::parse(messages.event({5'000'000, 5'000'000, "gap", {}, "3 \"frames\"", ""}));
  EXPECT_EQ(gap.at("level").asInteger(), 3);
  EXPECT_EQ(gap.at("message").asString(), "3 \"frames\"");
  EXPECT_EQ(gap.at("timestamp").at("sec").asInteger(), 5);
  const Json slip = Json::parse(messages.event({0, 0, "slip", 1, "begins", ""}));
  EXPECT_EQ(slip.at("level").asInteger(), 2);
  EXPECT_EQ(slip.at("message").asString(), "finger 0 distal: begins");
}

// A transform moves a taxel's place in its matrix to where the point cloud shows it.
TEST(FoxgloveMessages, TransformsAgreeWithTheTaxels) {
  FoxgloveMessages messages(sdh2());
  LiveResults results = sampleResults();
  EXPECT_FALSE(messages.setPose(results));  // no angles yet
  results.angles = JointAngles{1, std::vector<double>(5, 0.0)};
  EXPECT_FALSE(messages.setPose(results));  // angles of another hand
  results.angles = JointAngles{1, {10.0, -20.0, 30.0, -40.0, 20.0, -10.0, 50.0}};
  ASSERT_TRUE(messages.setPose(results));
  const Json transforms = Json::parse(messages.transforms(1)).at("transforms");
  const Json cloud = Json::parse(messages.taxels(*results.frame));
  const std::string bytes = decoded(cloud.at("data").asString());
  ASSERT_EQ(bytes.size(), 456u * 20u);
  std::size_t found = 0;
  for (std::size_t i = 0; i < transforms.size(); ++i) {
    const Json transform = transforms.at(i);
    EXPECT_EQ(transform.at("parent_frame_id").asString(), "hand");
    const Json turn = transform.at("rotation");
    EXPECT_NEAR(std::pow(turn.at("x").asDouble(), 2) + std::pow(turn.at("y").asDouble(), 2) +
                    std::pow(turn.at("z").asDouble(), 2) + std::pow(turn.at("w").asDouble(), 2),
                1.0,
                1e-9);
    if (transform.at("child_frame_id").asString() != "finger_0_proximal") continue;
    ++found;  // a flat matrix: its frame lies at the centre of taxel (0, 0), the first point
    float at[3];
    std::memcpy(at, bytes.data(), sizeof at);
    const Json place = transform.at("translation");
    EXPECT_NEAR(place.at("x").asDouble(), static_cast<double>(at[0]), 1e-6);
    EXPECT_NEAR(place.at("y").asDouble(), static_cast<double>(at[1]), 1e-6);
    EXPECT_NEAR(place.at("z").asDouble(), static_cast<double>(at[2]), 1e-6);
  }
  EXPECT_EQ(found, 1u);
}

TEST(FoxgloveMessages, ShapesStandInTheFramesOfTheirLinks) {
  EXPECT_FALSE(FoxgloveMessages(sdh2()).shapesChannel());  // its URDF describes none
  const FoxgloveMessages messages(builtInHand("four_fingers"));
  ASSERT_TRUE(messages.shapesChannel());
  EXPECT_TRUE(messages.channels()[*messages.shapesChannel()].latched);
  const Json entities = Json::parse(messages.shapes(1)).at("entities");
  ASSERT_EQ(entities.size(), 21u);  // as many as its URDF has visuals
  for (std::size_t i = 0; i < entities.size(); ++i) {
    const Json entity = entities.at(i);
    const std::string frame = entity.at("frame_id").asString();
    EXPECT_TRUE(frame == "hand" || frame.starts_with("finger_")) << frame;
    EXPECT_EQ(entity.at("cubes").size() + entity.at("cylinders").size() +
                  entity.at("spheres").size() + entity.at("models").size(),
              1u);
  }
}

// Every hand that is built in, of 1 to many matrices, with and without joints.
TEST(FoxgloveMessages, EveryHandHasItsChannels) {
  for (const std::string name :
       {"sdh2", "flat_pad_16x16", "four_fingers", "parallel_gripper", "sole"}) {
    const HandDescription hand = builtInHand(name);
    FoxgloveMessages messages(hand);
    EXPECT_EQ(messages.geometryProblem(), "") << name;
    EXPECT_EQ(messages.numImages(), hand.layout->numMatrices());
    EXPECT_EQ(messages.jointsChannel().has_value(), !hand.axes.empty()) << name;
    EXPECT_EQ(messages.transformsChannel().has_value(), hasGeometry(hand)) << name;
    std::set<std::string> topics;
    for (const FoxgloveChannel& channel : messages.channels()) {
      EXPECT_TRUE(topics.insert(channel.topic).second) << channel.topic;
      EXPECT_EQ(Json::parse(channel.schema).at("title").asString(), channel.schemaName);
    }
    LiveResults results;
    TactileFrame frame(hand.layout);
    frame.hostUs = 1;
    results.frame = std::make_shared<const TactileFrame>(frame);
    if (!hand.axes.empty()) results.angles = JointAngles{1, std::vector<double>(hand.axes.size())};
    for (std::size_t m = 0; m < messages.numImages(); ++m)
      EXPECT_TRUE(Json::parse(messages.image(*results.frame, m)).isObject());
    EXPECT_EQ(messages.setPose(results), hasGeometry(hand)) << name;
    if (hasGeometry(hand)) {
      EXPECT_TRUE(Json::parse(messages.taxels(*results.frame)).isObject());
    }
  }
}

TEST(FoxgloveMessages, NamesThatAreNoneBecomeTopicsOfTheirOwn) {
  HandDescription hand = sdh2();
  hand.matrices[0].name = hand.matrices[1].name = "Pad \"A\"/links";
  hand.matrices[2].name = "\xC3\xA4";
  const FoxgloveMessages messages(hand);
  EXPECT_EQ(messages.channels()[0].topic, "/tactile/pad_a_links/image");
  EXPECT_EQ(messages.channels()[1].topic, "/tactile/pad_a_links_2/image");
  EXPECT_EQ(messages.channels()[2].topic, "/tactile/n/image");
}

}  // namespace
}  // namespace palpate::foxglove_messages_test
