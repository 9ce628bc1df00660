#include "palpate/recording/tactile_sensor_json.h"

#include <sstream>

#include "palpate/core/error.h"
#include "palpate/core/json.h"
#include "palpate/device/sdh2.h"
#include "palpate/model/hand_description.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/recording.h"

#include "testing/counted_allocations.h"
#include "testing/testing.h"

namespace palpate::tactile_sensor_json_test {
namespace {

Json parsed(const TactileFrame& frame, std::uint64_t sequence = 0) {
  std::string text;
  appendTactileSensorJson(text, frame, sequence);
  EXPECT_EQ(text.find('\n'), std::string::npos);
  return Json::parse(text);
}

TEST(TactileSensorJson, HasTheFieldsOfTheMessage) {
  TactileFrame frame(sdh2().layout);
  frame.hostUs = 1'416'996'123'250'007;
  frame.matrix(1)(12, 5) = 4095.0F;  // finger 0 distal: 13 rows of 6
  frame.matrix(4)(0, 3) = 1.0F;
  const Json message = parsed(frame, 7);
  EXPECT_EQ(message.keys(), (std::vector<std::string>{"header", "tactile_matrix"}));
  const Json header = message.at("header");
  EXPECT_EQ(header.at("seq").asInteger(), 7);
  EXPECT_EQ(header.at("stamp").at("secs").asInteger(), 1'416'996'123);
  EXPECT_EQ(header.at("stamp").at("nsecs").asInteger(), 250'007'000);
  EXPECT_EQ(header.at("frame_id").asString(), "hand");
  const Json matrices = message.at("tactile_matrix");
  ASSERT_EQ(matrices.size(), 6u);
  for (std::size_t m = 0; m < 6; ++m) {
    const Json matrix = matrices.at(m);
    EXPECT_EQ(matrix.keys(),
              (std::vector<std::string>{"matrix_id", "cells_x", "cells_y", "tactile_array"}));
    EXPECT_EQ(matrix.at("matrix_id").asInteger(), static_cast<std::int64_t>(m));
    EXPECT_EQ(matrix.at("cells_x").asInteger(), 6);
    EXPECT_EQ(matrix.at("cells_y").asInteger(), m % 2 == 0 ? 14 : 13);
    EXPECT_EQ(matrix.at("tactile_array").size(), m % 2 == 0 ? 84u : 78u);
  }
  // tactile_array[cells_x * y + x]
  EXPECT_EQ(matrices.at(1).at("tactile_array").at(6 * 12 + 5).asInteger(), 4095);
  EXPECT_EQ(matrices.at(4).at("tactile_array").at(3).asInteger(), 1);
  EXPECT_EQ(matrices.at(0).at("tactile_array").at(0).asInteger(), 0);
}

// arrays A4: newtons, kilopascals and filtered values are not rounded.
TEST(TactileSensorJson, ValuesKeepTheirDecimalsAndSigns) {
  TactileFrame frame(sdh2().layout);
  auto matrix = frame.matrix(0);
  matrix(0, 0) = 12.766F;
  matrix(0, 1) = -3.0F;
  matrix(0, 2) = 0.45F;
  matrix(0, 3) = std::numeric_limits<float>::quiet_NaN();
  matrix(0, 4) = 100000.0F;
  matrix(0, 5) = -0.125F;
  std::string text;
  appendTactileSensorJson(text, frame, 0);
  EXPECT_NE(text.find("\"tactile_array\":[12.766,-3,0.45,null,100000,-0.125,0,"), std::string::npos)
      << text.substr(0, 200);
  EXPECT_NO_THROW(Json::parse(text));
}

TEST(TactileSensorJson, NanosecondsCountUpwardsBefore1970) {
  TactileFrame frame(sdh2().layout);
  frame.hostUs = -1;
  const Json stamp = parsed(frame).at("header").at("stamp");
  EXPECT_EQ(stamp.at("secs").asInteger(), -1);
  EXPECT_EQ(stamp.at("nsecs").asInteger(), 999'999'000);
}

// A live stream writes a line per frame, of 486 taxels.
TEST(TactileSensorJson, TakesNoAllocationPerTaxel) {
  const TactileFrame frame(sdh2().layout);
  std::string text;
  testing::countAllocations();
  appendTactileSensorJson(text, frame, 0);
  EXPECT_LE(testing::allocationsCounted(), 300);
}

TEST(TactileSensorLines, HoldEveryFrameOfARecording) {
  constexpr int kFrames = 300;  // more than one piece
  ProfileBuilder builder(sdh2().layout);
  std::vector<float> values(486, 0.0F);
  for (int i = 0; i < kFrames; ++i) {
    values[100] = static_cast<float>(i);
    builder.addFrame(1'400'000'000'000'000 + i * 32'000, values);
  }
  const Profile profile = builder.finish({});
  const testing::TemporaryFolder folder;
  saveRecording(profile, {}, folder / "a.jsonl");
  std::istringstream lines(testing::readFile(folder / "a.jsonl"));
  std::string line;
  std::int64_t count = 0;
  for (; std::getline(lines, line); ++count) {
    const Json message = Json::parse(line);
    ASSERT_EQ(message.at("header").at("seq").asInteger(), count);
    // Place 100 is the 17th of matrix 1, which begins at 84.
    ASSERT_EQ(message.at("tactile_matrix").at(1).at("tactile_array").at(16).asInteger(), count);
  }
  EXPECT_EQ(count, kFrames);
  EXPECT_THROW(saveRecording(profile, {}, folder / "a.jsonl"), FileError);  // never replaced
  EXPECT_THROW(writeTactileSensorLines(
                   profile, folder / "b.jsonl", Overwrite::kRefuse, [](double) { return false; }),
               Cancelled);
  EXPECT_FALSE(std::filesystem::exists(folder / "b.jsonl"));
}

}  // namespace
}  // namespace palpate::tactile_sensor_json_test
