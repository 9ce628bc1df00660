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
  EXPECT_EQ(image.at("frame_id").asString(), "tactile/finger_0_distal");
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
  // One axis moves two joints; NaN has no position.
  ASSERT_EQ(joints.at("joints").size(), 7u);
  const auto nameOf = [&](std::size_t i) {
    return joints.at("joints").at(i).at("name").asString();
  };
  EXPECT_EQ(nameOf(0), "finger_0_base");
  EXPECT_EQ(nameOf(1), "finger_2_base");
  EXPECT_EQ(nameOf(2), "finger_0_proximal");
  EXPECT_EQ(nameOf(3), "finger_1_proximal");
  EXPECT_DOUBLE_EQ(joints.at("joints").at(std::size_t{2}).at("position").asDouble(),
                   -std::numbers::pi / 2.0);
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
  results.angles = Sample{1, std::vector<double>(5, 0.0)};
  EXPECT_FALSE(messages.setPose(results));  // angles of another hand
  results.angles = Sample{1, {10.0, -20.0, 30.0, -40.0, 20.0, -10.0, 50.0}};
  ASSERT_TRUE(messages.setPose(results));
  const Json transforms = Json::parse(messages.transforms(1)).at("transforms");
  const Json cloud = Json::parse(messages.taxels(*results.frame));
  const std::string bytes = decoded(cloud.at("data").asString());
  ASSERT_EQ(bytes.size(), 456u * 20u);
  std::size_t found = 0;
  for (std::size_t i = 0; i < transforms.size(); ++i) {
    const Json transform = transforms.at(i);
    const Json turn = transform.at("rotation");
    EXPECT_NEAR(std::pow(turn.at("x").asDouble(), 2) + std::pow(turn.at("y").asDouble(), 2) +
                    std::pow(turn.at("z").asDouble(), 2) + std::pow(turn.at("w").asDouble(), 2),
                1.0,
                1e-9);
    if (transform.at("child_frame_id").asString() != "tactile/finger_0_proximal") continue;
    EXPECT_EQ(transform.at("parent_frame_id").asString(), "palm");
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

// What a program with the URDF moves by these messages: links and joints have its names, and a link
// stands in the frame of its parent. The second joint follows the first one; the numbers by hand.
TEST(FoxgloveMessages, LinksAndJointsHaveTheNamesOfTheUrdf) {
  const std::string urdf = R"(<robot name="x"><link name="base_link"/><link name="near"/>
<link name="far"><visual><origin xyz="0.01 0 0"/><geometry><sphere radius="0.002"/></geometry></visual></link>
<joint name="bend" type="revolute"><parent link="base_link"/><child link="near"/>
<origin xyz="0.1 0 0"/><axis xyz="0 0 1"/><limit lower="-2" upper="2" effort="1" velocity="1"/></joint>
<joint name="follow" type="revolute"><parent link="near"/><child link="far"/>
<origin xyz="0.05 0 0"/><axis xyz="0 0 1"/><limit lower="-2" upper="2" effort="1" velocity="1"/>
<mimic joint="bend" multiplier="-0.5" offset="0.1"/></joint></robot>)";
  const std::string json = R"({"format":"palpate-hand","version":1,"name":"x","full_scale":1,
"urdf":"hand.urdf","axes":[{"name":"the axis","minimum":-90,"maximum":90,"joints":["bend"]}],
"matrices":[{"name":"far","rows":1,"columns":1,"pitch_mm":1,
"surface":{"link":"far","origin_mm":[0,0,0],"x_axis":[1,0,0],"y_axis":[0,1,0]}}]})";
  FoxgloveMessages messages(parseHand(json, urdf, "hand.json"));
  ASSERT_EQ(messages.geometryProblem(), "");
  LiveResults results;
  results.angles = Sample{1, {90.0}};
  ASSERT_TRUE(messages.setPose(results));

  const Json joints = Json::parse(messages.joints(*results.angles)).at("joints");
  ASSERT_EQ(joints.size(), 2u);
  EXPECT_EQ(joints.at(std::size_t{0}).at("name").asString(), "bend");
  EXPECT_NEAR(joints.at(std::size_t{0}).at("position").asDouble(), std::numbers::pi / 2, 1e-12);
  EXPECT_EQ(joints.at(std::size_t{1}).at("name").asString(), "follow");
  const double follow = 0.1 - std::numbers::pi / 4;
  EXPECT_NEAR(joints.at(std::size_t{1}).at("position").asDouble(), follow, 1e-12);

  const Json transforms = Json::parse(messages.transforms(1)).at("transforms");
  ASSERT_EQ(transforms.size(), 3u);
  const auto expectFrame =
      [&](std::size_t i, const char* parent, const char* child, double x, double turned) {
        const Json transform = transforms.at(i);
        EXPECT_EQ(transform.at("parent_frame_id").asString(), parent);
        EXPECT_EQ(transform.at("child_frame_id").asString(), child);
        EXPECT_NEAR(transform.at("translation").at("x").asDouble(), x, 1e-9);
        EXPECT_NEAR(transform.at("translation").at("y").asDouble(), 0.0, 1e-9);
        EXPECT_NEAR(transform.at("rotation").at("z").asDouble(), std::sin(turned / 2), 1e-9);
        EXPECT_NEAR(transform.at("rotation").at("w").asDouble(), std::cos(turned / 2), 1e-9);
      };
  expectFrame(0, "base_link", "near", 0.1, std::numbers::pi / 2);
  expectFrame(1, "near", "far", 0.05, follow);
  // The matrix has the name of a link, and a frame of its own.
  EXPECT_EQ(transforms.at(std::size_t{2}).at("child_frame_id").asString(), "tactile/far");

  const Json shape = Json::parse(messages.shapes(1)).at("entities").at(std::size_t{0});
  EXPECT_EQ(shape.at("frame_id").asString(), "far");
  const Json place = shape.at("spheres").at(std::size_t{0}).at("pose").at("position");
  EXPECT_NEAR(place.at("x").asDouble(), 0.01, 1e-12);
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
    EXPECT_TRUE(frame == "palm" || frame.ends_with("_link")) << frame;
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
    if (!hand.axes.empty()) results.angles = Sample{1, std::vector<double>(hand.axes.size())};
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
