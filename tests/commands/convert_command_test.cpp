#include "palpate/emulator/synthetic_profile.h"
#include "palpate/recording/recording.h"

#include "commands/palpate_program.h"

namespace palpate::convert_command_test {
namespace {

using testing::expectOneLineError;
using testing::palpate;

class ConvertCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(palpate({"synthesize", "-o", in("a.dsa"), "--duration", "2"}).exitCode, 0);
  }
  std::string in(const char* name) const { return folder_ / name; }

  testing::TemporaryFolder folder_;
};

TEST_F(ConvertCommand, toNativeAndBackGivesTheSameXml) {
  ASSERT_EQ(palpate({"convert", in("a.dsa"), in("b.palpate")}).exitCode, 0);
  ASSERT_EQ(palpate({"convert", in("b.palpate"), in("c.dsa")}).exitCode, 0);
  const auto xml = [&](const char* name) {
    return testing::runProgram("/bin/sh", {"-c", "bzip2 -dc '" + in(name) + "'"}).out;
  };
  EXPECT_FALSE(xml("a.dsa").empty());
  EXPECT_TRUE(xml("a.dsa") == xml("c.dsa"));
  const auto info = palpate({"info", in("b.palpate")});
  EXPECT_EQ(info.exitCode, 0);
  EXPECT_NE(info.out.find("palpate"), std::string::npos) << info.out;
  EXPECT_EQ(palpate({"verify", in("b.palpate")}).exitCode, 0);
}

TEST_F(ConvertCommand, aRangeOfFramesIncludesBothEnds) {
  ASSERT_EQ(
      palpate({"convert", in("a.dsa"), in("b.palpate"), "--from", "10", "--to", "19"}).exitCode, 0);
  const Profile whole = openRecording(in("a.dsa"));
  const Profile part = openRecording(in("b.palpate"));
  ASSERT_EQ(part.numFrames(), 10u);
  EXPECT_EQ(part.frameTimeUs(0), whole.frameTimeUs(10));
  EXPECT_EQ(part.frame(9).values, whole.frame(19).values);
  expectOneLineError(
      palpate({"convert", in("a.dsa"), in("c.dsa"), "--from", "60", "--to", "64"}), 1, {"0..63"});
  EXPECT_FALSE(std::filesystem::exists(in("c.dsa")));
}

TEST_F(ConvertCommand, toHdf5AndBackIsTheSameAsStraight) {
  const auto result = palpate({"convert", in("a.dsa"), in("a.h5")});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  ASSERT_EQ(palpate({"convert", in("a.h5"), in("b.palpate")}).exitCode, 0);
  ASSERT_EQ(palpate({"convert", in("a.dsa"), in("c.palpate")}).exitCode, 0);
  EXPECT_TRUE(testing::readFile(in("b.palpate")) == testing::readFile(in("c.palpate")));
  const auto info = palpate({"info", in("a.h5"), "--json"});
  EXPECT_NE(info.out.find("\"frames\": 64"), std::string::npos) << info.out;
  EXPECT_EQ(palpate({"verify", in("a.h5")}).exitCode, 0);
  EXPECT_EQ(palpate({"signals", in("a.h5")}).out, palpate({"signals", in("a.dsa")}).out);
  // By its first bytes, whatever its name.
  std::filesystem::rename(in("a.h5"), in("plain"));
  EXPECT_EQ(palpate({"signals", in("plain")}).out, palpate({"signals", in("a.dsa")}).out);
}

TEST_F(ConvertCommand, toMcapAndBackIsTheSameAsStraight) {
  ASSERT_EQ(palpate({"convert", in("a.dsa"), in("c.palpate")}).exitCode, 0);
  const std::vector<std::vector<std::string>> choices{
      {}, {"--compression", "lz4"}, {"--compression", "none", "--images", "foxglove"}};
  for (const auto& options : choices) {
    std::vector<std::string> words{"convert", in("a.dsa"), in("a.mcap"), "--force"};
    words.insert(words.end(), options.begin(), options.end());
    ASSERT_EQ(palpate(words).exitCode, 0);
    ASSERT_EQ(palpate({"convert", in("a.mcap"), in("b.palpate"), "--force"}).exitCode, 0);
    EXPECT_TRUE(testing::readFile(in("b.palpate")) == testing::readFile(in("c.palpate")));
  }
  const auto info = palpate({"info", in("a.mcap"), "--json"});
  EXPECT_NE(info.out.find("\"frames\": 64"), std::string::npos) << info.out;
  EXPECT_EQ(palpate({"verify", in("a.mcap")}).exitCode, 0);
  // By its first bytes, whatever its name.
  std::filesystem::rename(in("a.mcap"), in("plain"));
  EXPECT_EQ(palpate({"signals", in("plain")}).out, palpate({"signals", in("a.dsa")}).out);
  expectOneLineError(palpate({"convert", in("a.dsa"), in("d.h5"), "--images", "ros"}),
                     2,
                     {"--images is for .mcap"});
  expectOneLineError(
      palpate({"convert", in("a.dsa"), in("d.mcap"), "--compression", "gzip"}), 2, {"compression"});
  testing::writeFile(in("x.mcap"), "hello");
  expectOneLineError(palpate({"info", in("x.mcap")}), 1, {"isn't an MCAP file"});
}

// A camera beside the pad is a note, a value that is not a number a loss.
TEST_F(ConvertCommand, whatAForeignMcapLosesIsSaidAndInTheExitCode) {
  const auto python = testing::runProgram("/usr/bin/python3",
                                          {"-c",
                                           R"(
import sys, math
sys.dont_write_bytecode = True
sys.path.insert(0, sys.argv[1])
import mcap_check as m
w = m.Writer(sys.argv[2])
for at in 1000, 2000:
  w.message('/pad', 'sensor_msgs/msg/Image', m.cdr_image(at, [[1, math.nan]], '32FC1'), at)
  w.message('/other', 'sensor_msgs/msg/Image', m.cdr_image(at, [[5]], 'mono8'), at)
  w.message('/camera', 'sensor_msgs/msg/Image', m.cdr_image(at, [[1, 2, 3]], 'rgb8'), at)
w.close()
)",
                                           PALPATE_MCAP_CHECK_FOLDER,
                                           in("a.mcap")});
  ASSERT_EQ(python.exitCode, 0) << python.err;
  const auto both = palpate({"convert", in("a.mcap"), in("b.palpate")});
  EXPECT_EQ(both.exitCode, 3) << both.err;
  EXPECT_NE(both.err.find("\"/camera\" is left out"), std::string::npos) << both.err;
  EXPECT_NE(both.err.find("2 values of the topic \"/pad\" are taken as 0"), std::string::npos)
      << both.err;
  EXPECT_EQ(openRecording(in("b.palpate")).frame(1).values, (std::vector<float>{5, 1, 0}));
  const auto other = palpate({"convert", in("a.mcap"), in("c.palpate"), "--topic", "/other"});
  EXPECT_EQ(other.exitCode, 0) << other.err;
  EXPECT_EQ(other.err, "");
  EXPECT_EQ(openRecording(in("c.palpate")).frame(1).values, (std::vector<float>{5}));
  EXPECT_EQ(palpate({"info", in("a.mcap"), "--topic", "/other"}).exitCode, 0);
  EXPECT_EQ(palpate({"info", in("a.mcap")}).exitCode, 3);
  EXPECT_EQ(palpate({"signals", in("a.mcap")}).exitCode, 3);
  EXPECT_EQ(palpate({"recover", in("a.mcap"), in("d.palpate"), "--topic", "/pad"}).exitCode, 3);
  EXPECT_EQ(palpate({"convert", in("a.mcap"), "-o", in("{name}.npz")}).exitCode, 3);
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"derive", in("a.mcap"), "m0_sum"},
                                             {"calibrate", "tare", in("a.mcap")},
                                             {"render", in("a.mcap"), "-o", in("a.svg")},
                                             {"render", in("a.mcap"), "-o", in("{name}.png")}}) {
    const auto result = palpate(words);
    EXPECT_EQ(result.exitCode, 3) << words.front() << ": " << result.err;
    EXPECT_NE(result.err.find("2 values of the topic \"/pad\" are taken as 0"), std::string::npos)
        << words.front() << ": " << result.err;
  }
  expectOneLineError(palpate({"convert", in("a.mcap"), in("e.npz"), "--topic", "/camera"}),
                     1,
                     {"\"/camera\" can't be read"});
  expectOneLineError(palpate({"info", in("a.dsa"), "--topic", "/pad"}), 1, {"has no topics"});
}

TEST_F(ConvertCommand, anExportSaysWhereItComesFromAndHasSeriesUnlessTheyAreLeftOut) {
  ASSERT_EQ(palpate({"convert", in("a.dsa"), in("a.h5"), "--filter", "median:size=3"}).exitCode, 0);
  ASSERT_EQ(palpate({"convert", in("a.dsa"), in("b.h5"), "--no-signals", "--no-slip"}).exitCode, 0);
  ASSERT_EQ(palpate({"convert", in("a.dsa"), in("a.mat")}).exitCode, 0);
  const auto python = testing::runProgram("/usr/bin/python3",
                                          {"-c",
                                           R"(
import sys, hashlib, h5py, scipy.io
folder = sys.argv[1] + '/'
sha = hashlib.sha256(open(folder + 'a.dsa', 'rb').read()).hexdigest()
a = h5py.File(folder + 'a.h5'); b = h5py.File(folder + 'b.h5')
assert a.attrs['source_file'] == 'a.dsa' and a.attrs['source_sha256'] == sha
assert a.attrs['program'].startswith('palpate ') and 'median' in a.attrs['filters']
assert a['tactile/m0'].dtype == 'float32' and b['tactile/m0'].dtype == 'uint16'
assert a['signals/values'].shape == (64, 49) and a['slip/values'].shape == (64, 66)
assert 'signals' not in b and 'slip' not in b and b.attrs['filters'] == ''
mat = scipy.io.loadmat(folder + 'a.mat', simplify_cells=True)
assert mat['provenance']['source_sha256'] == sha and mat['slip']['values'].shape == (66, 64)
)",
                                           folder_.path().string()});
  EXPECT_EQ(python.exitCode, 0) << python.err;
  expectOneLineError(palpate({"convert", in("a.dsa"), in("c.palpate"), "--filter", "median"}),
                     2,
                     {"palpate filter"});
  expectOneLineError(palpate({"info", in("a.mat")}), 1, {"MAT files are written, not read"});
  testing::writeFile(in("x.h5"), "hello");
  expectOneLineError(palpate({"info", in("x.h5")}), 1, {"can't be opened as HDF5"});
}

TEST_F(ConvertCommand, aFolderIsConvertedToHdf5) {
  const testing::TemporaryFolder made;
  std::filesystem::copy_file(in("a.dsa"), in("b.dsa"));
  const auto result = palpate({"convert", in(""), made / "out", "--to-form", "h5"});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(openRecording(made / "out/b.h5").numFrames(), 64u);
}

TEST_F(ConvertCommand, theUnitsStandInTheSecondRowWhereTheyAreAskedFor) {
  ASSERT_EQ(palpate({"convert", in("a.dsa"), in("a.csv"), "--units-row"}).exitCode, 0);
  const auto secondRow = [&](const char* name) {
    const std::string text = testing::readFile(in(name));
    const std::size_t begin = text.find('\n') + 1;
    return text.substr(begin, text.find('\n', begin) - begin);
  };
  EXPECT_EQ(secondRow("a.csv"), ",ms,,,,counts,us");
  EXPECT_EQ(secondRow("a.csv.angles.csv"), ",ms,deg,deg,deg,deg,deg,deg,deg,us");
  EXPECT_EQ(secondRow("a.csv.temperatures.csv"),
            ",ms,degC,degC,degC,degC,degC,degC,degC,degC,degC,us");
  expectOneLineError(
      palpate({"convert", in("a.dsa"), in("a.npz"), "--units-row"}), 2, {"is for .csv"});
}

TEST_F(ConvertCommand, csvHasARowPerActiveTaxelAndItsNeighbours) {
  ASSERT_EQ(palpate({"convert", in("a.dsa"), in("a.csv")}).exitCode, 0);
  const Profile profile = openRecording(in("a.dsa"));
  std::ptrdiff_t active = 0;
  for (std::size_t i = 0; i < profile.numFrames(); ++i)
    for (const float value : profile.frame(i).values) active += value > 0.0F ? 1 : 0;
  const std::string table = testing::readFile(in("a.csv"));
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), active + 1);
  EXPECT_EQ(table.substr(0, table.find('\n')), "frame,time_ms,matrix,y,x,value,time_us");
  const std::string angles = testing::readFile(in("a.csv.angles.csv"));
  EXPECT_EQ(std::count(angles.begin(), angles.end(), '\n'),
            static_cast<std::ptrdiff_t>(profile.numAngles()) + 1);
}

TEST_F(ConvertCommand, nothingIsReplacedWithoutForceAndNeverTheInput) {
  const std::string before = testing::readFile(in("a.dsa"));
  testing::writeFile(in("b.palpate"), "mine");
  expectOneLineError(palpate({"convert", in("a.dsa"), in("b.palpate")}), 1, {"exists already"});
  EXPECT_EQ(testing::readFile(in("b.palpate")), "mine");
  EXPECT_EQ(palpate({"convert", in("a.dsa"), in("b.palpate"), "--force"}).exitCode, 0);
  expectOneLineError(
      palpate({"convert", in("a.dsa"), in("a.dsa"), "--force"}), 1, {"is the input itself"});
  EXPECT_TRUE(testing::readFile(in("a.dsa")) == before);
  expectOneLineError(palpate({"convert", in("a.dsa"), in("a.txt")}), 1, {".dsa, .palpate, .csv"});
}

TEST_F(ConvertCommand, aTreeIsConvertedAndTheInputUntouched) {
  namespace fs = std::filesystem;
  const testing::TemporaryFolder made;
  const fs::path tree = folder_ / "tree";
  fs::create_directories(tree / "deep/er");
  fs::copy_file(in("a.dsa"), tree / "a.dsa");
  fs::copy_file(in("a.dsa"), tree / "deep/er/b.dsa");
  const Event label{1'400'000'000'000'000, 1'400'000'000'000'000, "label", 2, "edge", ""};
  saveRecording(openRecording(in("a.dsa")), std::vector{label}, tree / "deep/c.palpate");
  const fs::path out = made / "new/folder";
  const auto result = palpate({"convert", tree.string(), out.string(), "--to-form", "palpate"});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(result.out,
            (out / "a.palpate").string() + ": 64 frames\n" + (out / "deep/c.palpate").string() +
                ": 64 frames\n" + (out / "deep/er/b.palpate").string() + ": 64 frames\n");
  const Profile whole = openRecording(in("a.dsa"));
  const Profile converted = openRecording(out / "deep/er/b.palpate");
  EXPECT_EQ(converted.frame(40).values, whole.frame(40).values);
  EXPECT_EQ(readEvents(out / "deep/c.palpate").events, std::vector{label});
  EXPECT_TRUE(testing::readFile(tree / "a.dsa") == testing::readFile(in("a.dsa")));
  // A second time nothing is replaced, unless asked.
  const auto again = palpate({"convert", tree.string(), out.string(), "--to-form", "palpate"});
  EXPECT_EQ(again.exitCode, 1);
  EXPECT_NE(again.err.find("exists already"), std::string::npos) << again.err;
  EXPECT_EQ(
      palpate({"convert", tree.string(), out.string(), "--to-form", "palpate", "--force"}).exitCode,
      0);
}

TEST_F(ConvertCommand, whatFailsInATreeDoesNotStopTheOthers) {
  namespace fs = std::filesystem;
  const testing::TemporaryFolder made;
  // Two that would get the same name, and one that is no recording.
  ASSERT_EQ(palpate({"convert", in("a.dsa"), in("a.palpate")}).exitCode, 0);
  testing::writeFile(in("bad.dsa"), "hello");
  testing::writeFile(in("z.dsa"), testing::readFile(in("a.dsa")));
  const auto result = palpate({"convert", in(""), made / "out", "--to-form", "csv", "--force"});
  EXPECT_EQ(result.exitCode, 3);
  EXPECT_NE(result.err.find("a.palpate: "), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("bad.dsa: "), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("2 of 4 recordings failed"), std::string::npos) << result.err;
  EXPECT_TRUE(fs::exists(made / "out/a.csv"));
  EXPECT_TRUE(fs::exists(made / "out/z.csv.angles.csv"));
  EXPECT_FALSE(fs::exists(made / "out/bad.csv"));
}

TEST_F(ConvertCommand, aFolderAndAFileAreNotMistakenForEachOther) {
  const std::string folder = folder_.path().string();
  const testing::TemporaryFolder made;
  expectOneLineError(palpate({"convert", folder, made / "out"}), 2, {"is a folder", "--to-form"});
  expectOneLineError(palpate({"convert", in("a.dsa"), made / "out.npz", "--to-form", "npz"}),
                     2,
                     {"a.dsa isn't one"});
  expectOneLineError(
      palpate({"convert", folder, made / "out", "--to-form", "npz", "--from", "3"}), 2, {"--from"});
  expectOneLineError(palpate({"convert", folder, made / "out", "--to-form", "mp3"}),
                     2,
                     {"dsa, palpate, csv, npz"});
  expectOneLineError(palpate({"convert", folder, folder_ / "sub/out", "--to-form", "npz"}),
                     1,
                     {"is in the folder"});
  expectOneLineError(palpate({"convert", folder, folder, "--to-form", "npz"}), 1, {"is in"});
  testing::writeFile(made / "file", "mine");
  expectOneLineError(
      palpate({"convert", folder, made / "file", "--to-form", "npz"}), 1, {"is not a folder"});
  EXPECT_EQ(testing::readFile(made / "file"), "mine");
}

TEST_F(ConvertCommand, labelsComeAlong) {
  const Event label{1'400'000'000'000'000, 1'400'000'000'000'000, "label", 2, "edge", ""};
  const std::vector<Event> events{label};
  saveRecording(openRecording(in("a.dsa")), events, in("b.palpate"));
  ASSERT_EQ(palpate({"convert", in("b.palpate"), in("c.dsa")}).exitCode, 0);
  ASSERT_EQ(palpate({"convert", in("c.dsa"), in("d.palpate")}).exitCode, 0);
  EXPECT_EQ(readEvents(in("d.palpate")).events, events);
}

// A file for each grasp, with the labels that touch it.
TEST_F(ConvertCommand, MakesAFileOfEachGrasp) {
  namespace fs = std::filesystem;
  const testing::TemporaryFolder folder;
  const Profile profile = synthesize({.durationS = 24.0, .grasps = 3});
  const std::int64_t t0 = profile.frameTimeUs(0);
  const std::int64_t t1 = profile.frameTimeUs(profile.numFrames() - 1);
  fs::create_directories(folder / "in/day");
  saveRecording(profile,
                std::vector<Event>{{t0, t1, "label", std::nullopt, "ball", ""}},
                folder / "in/day/run.palpate");
  const std::string names = (folder / "out/{name}_{n}.palpate").string();
  const auto made = palpate({"convert", "--each-grasp", folder / "in", "-o", names});
  EXPECT_EQ(made.exitCode, 0) << made.err;
  EXPECT_NE(made.out.find("run.palpate: 3 grasps"), std::string::npos) << made.out;
  std::size_t frames = 0;
  for (const char* name : {"run_01.palpate", "run_02.palpate", "run_03.palpate"}) {
    const fs::path file = folder / "out/day" / name;
    ASSERT_TRUE(fs::exists(file)) << file;
    frames += openRecording(file).numFrames();
    ASSERT_EQ(readEvents(file).events.size(), 1u);
    EXPECT_EQ(readEvents(file).events[0].text, "ball");
  }
  EXPECT_GT(frames, 60u);
  EXPECT_LT(frames, profile.numFrames());
  const auto again = palpate({"convert", "--each-grasp", folder / "in", "-o", names});
  EXPECT_EQ(again.exitCode, 1);
  EXPECT_EQ(palpate({"convert", "--each-grasp", folder / "in", "-o", names, "--force"}).exitCode,
            0);
  // As other batch work it goes on, in parallel, and reports.
  const std::string report = (folder / "report.csv").string();
  const auto resumed = palpate({"convert",
                                "--each-grasp",
                                folder / "in",
                                "-o",
                                names,
                                "--resume",
                                "--threads",
                                "2",
                                "--report",
                                report});
  EXPECT_EQ(resumed.exitCode, 0) << resumed.err;
  EXPECT_NE(resumed.out.find("run.palpate: 3 files are whole"), std::string::npos) << resumed.out;
  // A row for the recording: its first file, what was made, how many files.
  const std::string source = (folder / "in/day/run.palpate").string();
  const std::string row = source + "," + (folder / "out/day/run_01.palpate").string();
  EXPECT_EQ(
      testing::readFile(report),
      "source,result,state,text,files\n" + row + ",skipped," + source + ": 3 files are whole,3\n");
  fs::remove(folder / "out/day/run_02.palpate");
  EXPECT_EQ(
      palpate(
          {"convert", "--each-grasp", folder / "in", "-o", names, "--resume", "--report", report})
          .exitCode,
      0);
  EXPECT_EQ(testing::readFile(report),
            "source,result,state,text,files\n" + row + ",done," + source + ": 3 grasps,3\n");
  expectOneLineError(palpate({"convert", "--each-grasp", folder / "in"}), 2, {"needs -o"});
  expectOneLineError(
      palpate({"convert", "--each-grasp", folder / "in", "-o", "out/{name}.palpate"}), 2, {"{n}"});
}

}  // namespace
}  // namespace palpate::convert_command_test
