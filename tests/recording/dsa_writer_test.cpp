// Writing .dsa recordings: the bytes of the prior program, and the data back.
#include "palpate/recording/dsa_writer.h"

#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"
#include "palpate/model/hand_file.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/dsa_reader.h"

#include "recording/dsa_corpus.h"
#include "testing/program.h"
#include "testing/testing.h"

namespace palpate::dsa_writer_test {
namespace {

void expectSameData(const Profile& a, const Profile& b) {
  EXPECT_EQ(a.layout(), b.layout());
  EXPECT_EQ(a.info().serial, b.info().serial);
  EXPECT_EQ(a.info().firmware, b.info().firmware);
  EXPECT_EQ(a.info().valueType, b.info().valueType);
  ASSERT_EQ(a.numFrames(), b.numFrames());
  TactileFrame x;
  TactileFrame y;
  for (std::size_t i = 0; i < a.numFrames(); ++i) {
    a.readFrame(i, x);
    b.readFrame(i, y);
    ASSERT_EQ(x.hostUs, y.hostUs) << i;
    ASSERT_EQ(x.values, y.values) << i;
  }
  ASSERT_EQ(a.numAngles(), b.numAngles());
  for (std::size_t i = 0; i < a.numAngles(); ++i) {
    ASSERT_EQ(a.angleTimeUs(i), b.angleTimeUs(i));
    ASSERT_EQ(a.angles(i).values, b.angles(i).values);
  }
  ASSERT_EQ(a.numTemperatures(), b.numTemperatures());
  for (std::size_t i = 0; i < a.numTemperatures(); ++i) {
    ASSERT_EQ(a.temperatureTimeUs(i), b.temperatureTimeUs(i));
    ASSERT_EQ(a.temperatures(i).values, b.temperatures(i).values);
  }
}

TEST(DsaWriter, writesTheExampleOfTheFormat) {
  const testing::TemporaryFolder folder;
  const std::string text = testing::exampleXml();
  const Profile profile =
      readDsaBytes(std::as_bytes(std::span(text.data(), text.size())), "example");
  writeDsa(profile, folder / "a.dsa");
  // As the prior program wraps masks and frames.
  std::string expected = text;
  for (const char* mask : {"static_mask", "dynamic_mask"})
    expected = testing::replaced(expected,
                                 std::string("<") + mask + ">111 111<",
                                 std::string("<") + mask +
                                     ">\r\n        111\r\n        111\r\n"
                                     "      <");
  expected = testing::replaced(expected, ">C0C00000<", ">\r\n        C0C00000\r\n      <");
  expected = testing::replaced(expected,
                               ">C0000000 42C80000 BF800000 447A0000 BF800000<",
                               ">\r\n        C000000042C80000BF800000447A0000BF800000\r\n      <");
  EXPECT_EQ(testing::decompressed(testing::readFile(folder / "a.dsa")), expected);
  expectSameData(readDsa(folder / "a.dsa"), profile);
}

TEST(DsaWriter, keepsFractionalValuesAndRoundsStampsDown) {
  const testing::TemporaryFolder folder;
  ProfileBuilder builder(sdh2().layout);
  std::vector<float> values(486, 0.0F);
  values[0] = 2941.18F;
  values[485] = 0.5F;
  builder.addFrame(1'400'000'000'000'999, values);
  builder.addFrame(1'400'000'000'032'001, std::vector<float>(486, 0.0F));
  writeDsa(builder.finish({}), folder / "a.dsa");
  const Profile back = readDsa(folder / "a.dsa");
  EXPECT_TRUE(back.info().warnings.empty());
  EXPECT_EQ(back.info().valueType, ValueType::kFloat);
  EXPECT_EQ(back.frameTimeUs(0), 1'400'000'000'000'000);
  EXPECT_EQ(back.frameTimeUs(1), 1'400'000'000'032'000);
  EXPECT_EQ(back.frame(0).values, values);
  EXPECT_EQ(back.layout(), *sdh2().layout);
}

TEST(DsaWriter, refusesNegativeValuesAndLeavesNothing) {
  const testing::TemporaryFolder folder;
  ProfileBuilder builder(sdh2().layout);
  std::vector<float> values(486, 0.0F);
  values[7] = -2.0F;
  builder.addFrame(1'400'000'000'000'000, values);
  EXPECT_THROW(writeDsa(builder.finish({}), folder / "a.dsa"), FileError);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(DsaWriter, refusesHandsOfOtherControllers) {
  const testing::TemporaryFolder folder;
  const auto refusalOf = [&](const HandDescription& hand) -> std::string {
    ProfileBuilder builder(hand);
    builder.addFrame(1'000'000, std::vector<float>(hand.layout->numCells(), 0.0F));
    try {
      writeDsa(builder.finish({}), folder / "pad.dsa");
    } catch (const FileError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_EQ(refusalOf(builtInHand("flat_pad_16x16")),
            (folder / "pad.dsa").string() +
                ": can't be written: .dsa is the format of the DSACON32-M; '" +
                builtInHand("flat_pad_16x16").name +
                "' has no such controller: use .palpate, CSV or NPZ");
  HandDescription unnamed = describeHand(SensorLayout({MatrixLayout::full(2, 2, 3.4)}), 0, 0);
  unnamed.unit = "kPa";
  EXPECT_NE(refusalOf(unnamed).find("a unit other than counts"), std::string::npos);
  unnamed.unit = "counts";
  unnamed.maximumCounts = 65'535.0F;
  EXPECT_NE(refusalOf(unnamed).find("more than 12 bits"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "pad.dsa"));
  unnamed.maximumCounts = 4095.0F;
  EXPECT_EQ(refusalOf(unnamed), "") << "another sensor on the same controller";
}

TEST(DsaWriter, replacesAFileOnlyWhenAskedAndLeavesItWholeWhenCancelled) {
  const testing::TemporaryFolder folder;
  const std::string text = testing::longXml(300, 300, 1);
  const Profile profile = readDsaBytes(std::as_bytes(std::span(text.data(), text.size())), "long");
  testing::writeFile(folder / "a.dsa", "mine");
  EXPECT_THROW(writeDsa(profile, folder / "a.dsa"), FileError);
  int calls = 0;
  EXPECT_THROW(
      writeDsa(profile, folder / "a.dsa", Overwrite::kReplace, [&](double) { return ++calls < 2; }),
      Cancelled);
  EXPECT_EQ(testing::readFile(folder / "a.dsa"), "mine");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
  std::vector<double> told;
  writeDsa(profile, folder / "a.dsa", Overwrite::kReplace, [&](double fraction) {
    told.push_back(fraction);
    return true;
  });
  EXPECT_EQ(told, (std::vector{0.0, 256.0 / 600.0, 512.0 / 600.0}));  // 300 frames, 300 angles
  expectSameData(readDsa(folder / "a.dsa"), profile);
}

TEST(DsaWriter, roundTripsRealRecordings) {
  const auto recordings = testing::recordingsFolder();
  PALPATE_NEED(recordings);
  const testing::TemporaryFolder folder;
  std::size_t files = 0;
  std::size_t comparable = 0;
  std::size_t identical = 0;
  for (const std::filesystem::path& path : testing::recordingsToTry(*recordings)) {
    SCOPED_TRACE(path.string());
    ++files;
    const Profile profile = readDsa(path);
    writeDsa(profile, folder / "copy.dsa", Overwrite::kReplace);
    expectSameData(readDsa(folder / "copy.dsa"), profile);
    // The profile doesn't keep line ends (edited files have CR LF throughout) nor whether an empty
    // element was there.
    const std::string xml = testing::decompressed(testing::readFile(path));
    if (xml.find("<root>\r\n") != std::string::npos) continue;
    if (xml.find("<temperatures>") == std::string::npos) continue;
    if (xml.find("<joint_angles>") == std::string::npos) continue;
    ++comparable;
    if (testing::decompressed(testing::readFile(folder / "copy.dsa")) == xml) ++identical;
  }
  std::cout << identical << " of " << files << " recordings rewritten byte by byte\n";
  EXPECT_EQ(identical, comparable);
  EXPECT_GE(comparable, files - 10);
  EXPECT_GE(files, testing::exhaustive() ? 600u : 60u);
}

// What the reader of the prior program's rules (tests/recording/prior_program_reader.py) counts:
// "frames temperatures angles"; what it refuses is a failure.
std::string readByThePriorProgram(const std::filesystem::path& path) {
  const auto reader =
      std::filesystem::path(PALPATE_INDEPENDENT_READER).parent_path() / "prior_program_reader.py";
  const auto result = testing::runProgram("/usr/bin/python3", {reader.string(), path.string()});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  return result.out;
}

// A profile as of a live hand: its controller's firmware, stamps in microseconds.
Profile liveProfile(const ProfileInfo& info, std::int64_t stepUs) {
  ProfileBuilder builder(sdh2().layout);
  constexpr std::int64_t kBeginUs = 1'400'000'000'000'900;
  for (std::int64_t i = 0; i < 5; ++i) {
    std::vector<float> values(486, 0.0F);
    values[static_cast<std::size_t>(i)] = 7.0F;
    builder.addFrame(kBeginUs + i * stepUs, values);
    builder.addAngles(kBeginUs + i * stepUs, std::vector<double>(7, 1.25));
    builder.addTemperatures(kBeginUs + i * stepUs, std::vector<double>(9, 30.0));
  }
  return builder.finish(info);
}

TEST(DsaWriter, aRecordingOfALiveHandIsReadByThePriorProgram) {
  const testing::TemporaryFolder folder;
  ProfileInfo info;
  info.serial = "1D9B0057";
  info.firmware = "2.9.0.0";
  writeDsa(liveProfile(info, 32'000), folder / "a.dsa");
  EXPECT_EQ(readByThePriorProgram(folder / "a.dsa"), "5 5 5\n");
  info.serial = "a <hand> with a long name";
  writeDsa(liveProfile(info, 32'000), folder / "b.dsa");
  EXPECT_EQ(readByThePriorProgram(folder / "b.dsa"), "5 5 5\n");
}

// C-A6: frames that were read in one burst are a microsecond apart.
TEST(DsaWriter, stampsGrowStrictly) {
  const testing::TemporaryFolder folder;
  writeDsa(liveProfile({}, 1), folder / "burst.dsa");
  EXPECT_EQ(readByThePriorProgram(folder / "burst.dsa"), "5 5 5\n");
  const Profile back = readDsa(folder / "burst.dsa");
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_EQ(back.frameTimeUs(i), 1'400'000'000'000'000 + static_cast<std::int64_t>(i) * 1000);
}

TEST(DsaWriter, realRecordingsRewrittenAreReadByThePriorProgram) {
  const auto recordings = testing::recordingsFolder();
  PALPATE_NEED(recordings);
  const testing::TemporaryFolder folder;
  writeDsa(readDsa(*recordings / "grasps/foam_ball.dsa"), folder / "a.dsa");
  EXPECT_EQ(readByThePriorProgram(folder / "a.dsa").substr(0, 5), "3289 ");
}

}  // namespace
}  // namespace palpate::dsa_writer_test
