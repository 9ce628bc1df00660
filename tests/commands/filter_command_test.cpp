// `palpate filter`, and --filter of the commands that look at recordings.
#include <sstream>

#include "palpate/core/number_text.h"
#include "palpate/device/sdh2.h"
#include "palpate/emulator/synthetic_profile.h"
#include "palpate/filter/filtered_profile.h"
#include "palpate/model/hand_description.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/recording.h"

#include "commands/palpate_program.h"

namespace palpate::filter_command_test {
namespace {

using testing::expectOneLineError;
using testing::palpate;

std::string writeGrasps(const testing::TemporaryFolder& folder) {
  const std::string path = folder / "in.dsa";
  saveRecording(synthesize({.durationS = 6.0, .grasps = 2, .noiseCounts = 10.0}), {}, path);
  return path;
}

void expectFrames(const Profile& got, const Profile& expected) {
  ASSERT_EQ(got.numFrames(), expected.numFrames());
  for (std::size_t i = 0; i < got.numFrames(); ++i) {
    ASSERT_EQ(got.frameTimeUs(i), expected.frameTimeUs(i));
    ASSERT_EQ(got.frame(i).values, expected.frame(i).values) << i;
  }
}

TEST(FilterCommand, WritesTheSameFramesAsTheLibrary) {
  const testing::TemporaryFolder folder;
  const std::string in = writeGrasps(folder);
  const std::vector<std::string> chain = {"median:masked=1", "kalman:q=0.2"};
  const Profile expected = filteredProfile(openRecording(in), parseRecipe(chain));
  for (const char* name : {"out.palpate", "out.dsa"}) {
    const std::string out = folder / name;
    const auto result = palpate({"filter",
                                 in,
                                 out,
                                 "--filter",
                                 chain[0],
                                 "--filter",
                                 chain[1],
                                 "--save-recipe",
                                 folder / "r.json",
                                 "--force"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_NE(result.out.find("median:size=3,masked=1 | kalman:q=0.2,r=0.5"), std::string::npos)
        << result.out;
    const Profile got = openRecording(out);
    expectFrames(got, expected);
    EXPECT_EQ(got.info().valueType, ValueType::kFloat);
    EXPECT_EQ(got.numAngles(), expected.numAngles());
    // What was done to it stands in the recording.
    const auto events = readEvents(out).events;
    ASSERT_EQ(events.size(), 1u);
    EXPECT_EQ(events[0].kind, "filtered");
    EXPECT_EQ(events[0].text.find("median:size=3,masked=1 | kalman:q=0.2,r=0.5"), 0u)
        << events[0].text;
    EXPECT_EQ(recipeFromJson(Json::parse(events[0].json)), parseRecipe(chain));
  }
  const auto byRecipe = palpate(
      {"filter", in, folder / "by_recipe.palpate", "--recipe", folder / "r.json", "--quiet"});
  ASSERT_EQ(byRecipe.exitCode, 0) << byRecipe.err;
  EXPECT_EQ(byRecipe.out, "");
  expectFrames(openRecording(folder / "by_recipe.palpate"), expected);
}

TEST(FilterCommand, OffersWhatThereIs) {
  const auto result = palpate({"filter", "--list"});
  ASSERT_EQ(result.exitCode, 0);
  for (const FilterKind& kind : filterKinds()) {
    EXPECT_NE(("\n" + result.out).find("\n" + kind.name + " "), std::string::npos) << kind.name;
    for (const FilterOption& option : kind.options)
      EXPECT_NE(result.out.find("    " + option.key + " "), std::string::npos) << option.key;
  }
}

TEST(FilterCommand, RefusesWhatMakesNoSense) {
  const testing::TemporaryFolder folder;
  const std::string in = writeGrasps(folder);
  const std::string out = folder / "out.palpate";
  expectOneLineError(palpate({"filter", in, out}), 2, {"--filter", "--list"});
  expectOneLineError(palpate({"filter", in}), 2, {"IN and OUT"});
  expectOneLineError(palpate({"filter", in, out, "--filter", "medain"}), 2, {"medain", "median, "});
  expectOneLineError(
      palpate({"filter", in, out, "--filter", "median:sise=3"}), 2, {"sise", "size"});
  expectOneLineError(palpate({"filter", in, out, "--filter", "median:size=4"}), 2, {"odd"});
  expectOneLineError(palpate({"filter", in, out, "--filter", "gaussian:sigma=-1"}), 2, {"sigma"});
  expectOneLineError(palpate({"filter", in, out, "--filter", "median:matrices=9"}),
                     1,
                     {"in.dsa", "no matrix 9", "0..5"});
  expectOneLineError(
      palpate({"filter", in, out, "--recipe", folder / "none.json"}), 1, {"none.json"});
  testing::writeFile(
      folder / "bad.json",
      R"({"format": "palpate-recipe", "version": 1, "steps": [{"filter": "blur"}]})");
  expectOneLineError(palpate({"filter", in, out, "--recipe", folder / "bad.json"}),
                     1,
                     {"bad.json", "step 1", "blur", "box, gaussian"});
  expectOneLineError(palpate({"filter", in, in, "--filter", "median", "--force"}), 1, {"in.dsa"});
  expectOneLineError(
      palpate({"filter", in, folder / "out.xyz", "--filter", "median"}), 1, {".palpate"});
  expectOneLineError(
      palpate({"filter", folder / "none.dsa", out, "--filter", "median"}), 1, {"none.dsa"});
  EXPECT_FALSE(std::filesystem::exists(out));
  ASSERT_EQ(palpate({"filter", in, out, "--filter", "median"}).exitCode, 0);
  expectOneLineError(palpate({"filter", in, out, "--filter", "median"}), 1, {"--force"});
  // A slope is negative on the way down: a .dsa has no place for that.
  expectOneLineError(
      palpate({"filter", in, folder / "slope.dsa", "--filter", "savitzky-golay:derivative=1"}),
      1,
      {"negative"});
  EXPECT_FALSE(std::filesystem::exists(folder / "slope.dsa"));
  EXPECT_EQ(palpate({"filter", in, folder / "slope.npz", "--filter", "savitzky-golay:derivative=1"})
                .exitCode,
            0);
}

TEST(FilterCommand, RecordingsOfOneFrameAndShortOnesAreFiltered) {
  const testing::TemporaryFolder folder;
  ProfileBuilder builder(sdh2().layout);
  TactileFrame frame(sdh2().layout);
  frame.matrix(1)(7, 2) = 500.0F;
  builder.addFrame(1'400'000'000'000'000, frame.values);
  saveRecording(builder.finish({}), {}, folder / "one.dsa");
  for (const char* spec : {"running-mean:window=101,centred=1",
                           "rts",
                           "kelvin-voigt",
                           "median3d",
                           "savitzky-golay:window=99,order=5,centred=1"}) {
    const auto result =
        palpate({"filter", folder / "one.dsa", folder / "o.palpate", "--filter", spec, "--force"});
    ASSERT_EQ(result.exitCode, 0) << spec << " " << result.err;
    const Profile got = openRecording(folder / "o.palpate");
    ASSERT_EQ(got.numFrames(), 1u);
    if (std::string(spec) != "median3d") {
      EXPECT_NEAR(got.frame(0).matrix(1)(7, 2), 500.0F, 1e-3F) << spec;
    }
  }
}

TEST(FilterCommand, SignalsAndSpectraLookThroughFiltersToo) {
  const testing::TemporaryFolder folder;
  const std::string in = writeGrasps(folder);
  ASSERT_EQ(palpate({"filter", in, folder / "f.palpate", "--filter", "gaussian:size=5"}).exitCode,
            0);
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"signals"},
        std::vector<std::string>{"spectrum", "--matrix", "1", "--signal", "sum"}}) {
    auto direct = command;
    direct.insert(direct.end(), {in, "--filter", "gaussian:size=5"});
    auto afterwards = command;
    afterwards.push_back(folder / "f.palpate");
    auto raw = command;
    raw.push_back(in);
    const auto got = palpate(direct);
    ASSERT_EQ(got.exitCode, 0) << got.err;
    EXPECT_EQ(got.out, palpate(afterwards).out) << command[0];
    EXPECT_NE(got.out, palpate(raw).out) << command[0];
    auto wrong = raw;
    wrong.insert(wrong.end(), {"--filter", "nope"});
    expectOneLineError(palpate(wrong), 2, {"nope"});
  }
}

TEST(FilterCommand, SignalsThemselvesAreSmoothedToo) {
  const testing::TemporaryFolder folder;
  const std::string in = writeGrasps(folder);
  const auto column = [](const std::string& csv, std::size_t index) {
    std::vector<double> values;
    std::istringstream lines(csv);
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line)) {
      std::istringstream cells(line);
      std::string cell;
      for (std::size_t i = 0; i <= index; ++i) std::getline(cells, cell, ',');
      values.push_back(parseDouble(cell).value());
    }
    return values;
  };
  const auto raw = palpate({"signals", in, "--matrix", "1"});
  const auto smooth =
      palpate({"signals", in, "--matrix", "1", "--smooth", "running-mean:window=3"});
  ASSERT_EQ(smooth.exitCode, 0) << smooth.err;
  for (const std::size_t index : {3u, 5u, 6u, 8u}) {  // mean, min, max, active
    const auto before = column(raw.out, index);
    const auto after = column(smooth.out, index);
    ASSERT_EQ(before.size(), after.size());
    for (std::size_t i = 2; i < before.size(); ++i)
      ASSERT_NEAR(after[i], (before[i - 2] + before[i - 1] + before[i]) / 3.0, 1e-3)
          << index << " " << i;
  }
  expectOneLineError(palpate({"signals", in, "--smooth", "median"}), 2, {"median", "neighbours"});
}

// Lines of a table, without the columns behind the first `columns`.
std::vector<std::string> firstColumns(const std::string& table, int columns) {
  std::vector<std::string> lines;
  std::istringstream stream(table);
  for (std::string line; std::getline(stream, line);) {
    std::size_t end = 0;
    for (int i = 0; i < columns && end != std::string::npos; ++i)
      end = line.find(',', end == 0 ? 0 : end + 1);
    lines.push_back(line.substr(0, end));
  }
  return lines;
}

// O-A1: grasps, numbers of active taxels and spheres of a filtered copy are those of the recording,
// by every way to them.
TEST(FilterCommand, WhatIsTouchedStaysAsRecorded) {
  const testing::TemporaryFolder folder;
  const std::string in = writeGrasps(folder);
  const auto signals = palpate({"signals", in, "--matrix", "1"});
  const auto grasps = palpate({"grasps", in});
  const auto contact = palpate({"contact", in});
  ASSERT_EQ(signals.exitCode + grasps.exitCode + contact.exitCode, 0) << contact.err;
  ASSERT_EQ(firstColumns(grasps.out, 2).size(), 3u) << grasps.out;
  for (const char* filter : {"kalman", "rts", "gaussian", "running-mean"}) {
    SCOPED_TRACE(filter);
    const std::string copy = folder / "copy.palpate";
    ASSERT_EQ(palpate({"filter", in, copy, "--filter", filter, "--force"}).exitCode, 0);
    EXPECT_EQ(firstColumns(palpate({"grasps", copy}).out, 5), firstColumns(grasps.out, 5));
    // frame, time, active, centre and radius of the sphere: all but the force.
    EXPECT_EQ(firstColumns(palpate({"contact", copy}).out, 7), firstColumns(contact.out, 7));
    // Of the copy, and of the recording seen through the filter: the same to the digit.
    const auto ofCopy = palpate({"signals", copy, "--matrix", "1"});
    const auto seen = palpate({"signals", in, "--matrix", "1", "--filter", filter});
    EXPECT_EQ(ofCopy.out, seen.out);
    std::istringstream was(signals.out), is(ofCopy.out);
    std::string before, after;
    std::size_t others = 0;
    while (std::getline(was, before) && std::getline(is, after))
      others += before.substr(before.rfind(',')) == after.substr(after.rfind(',')) ? 0 : 1;
    EXPECT_EQ(others, 0u) << "area_mm2, the last column, differs";
  }
}

TEST(FilterCommand, AFrequencyMustBeBelowHalfTheRate) {
  const testing::TemporaryFolder folder;
  const std::string in = writeGrasps(folder);
  expectOneLineError(
      palpate({"filter", in, folder / "out.palpate", "--filter", "low-pass:cutoff=900"}),
      1,
      {"low-pass: 900 Hz is not below ", in});
  EXPECT_FALSE(std::filesystem::exists(folder / "out.palpate"));
  expectOneLineError(palpate({"signals", in, "--smooth", "band-pass:low=2,high=900"}),
                     1,
                     {"band-pass: 900 Hz is not below ", in});
  expectOneLineError(palpate({"signals", in, "--smooth", "band-pass:low=9,high=2"}),
                     2,
                     {"low must be below high"});
  const auto done = palpate(
      {"filter", in, folder / "out.palpate", "--filter", "low-pass:cutoff=5,order=3,centred=1"});
  EXPECT_EQ(done.exitCode, 0) << done.err;
  EXPECT_NE(done.out.find("needs later frames"), std::string::npos) << done.out;
}

}  // namespace
}  // namespace palpate::filter_command_test
