// What `cmake --install` makes: a folder that is complete, works wherever it lies, and says of
// itself what is true.
#include <cstdint>
#include <iterator>
#include <optional>
#include <regex>
#include <set>

#include <gtest/gtest.h>

#include "project_rules/source_tree.h"
#include "testing/program.h"
#include "testing/testing.h"

namespace palpate::testing::installed_test {
namespace {
namespace fs = std::filesystem;

class Installed : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    const ProgramResult result =
        runProgram(PALPATE_CMAKE,
                   {"--install", PALPATE_BUILD_FOLDER, "--prefix", (*folder_ / "first").string()});
    ASSERT_EQ(result.exitCode, 0) << result.out << result.err;
    // Whatever finds its data by where it was installed fails from here on.
    fs::rename(*folder_ / "first", *folder_ / "moved");
  }
  static void TearDownTestSuite() { delete folder_; }

  static fs::path path(const std::string& name) { return folder_->path() / "moved" / name; }
  static std::string text(const std::string& name) { return readFile(path(name)); }
  static ProgramResult palpate(const std::vector<std::string>& words) {
    const TemporaryFolder home;
    return runProgram(path("bin/palpate"),
                      words,
                      {{"PALPATE_DATA", ""},
                       {"HOME", home.path().string()},
                       {"XDG_RUNTIME_DIR", home.path().string()},
                       {"XDG_CONFIG_HOME", home.path().string()}});
  }
  // Runs a tool of the system; nothing where it isn't installed.
  static std::optional<ProgramResult> tool(const std::string& name,
                                           const std::vector<std::string>& words) {
    const fs::path program = fs::path("/usr/bin") / name;
    if (!fs::exists(program)) return std::nullopt;
    return runProgram(program, words);
  }
  static std::string bytesOf(const std::string& recording) {
    EXPECT_EQ(palpate({"convert", "-q", path("share/palpate/demo_grasps.dsa").string(), recording})
                  .exitCode,
              0);
    return readFile(recording);
  }

 private:
  static inline TemporaryFolder* folder_ = nullptr;
};

TEST_F(Installed, HasEverythingThatAPackageTakes) {
  for (const char* name : {"bin/palpate",
                           "libexec/palpate/palpate_window",
                           "libexec/palpate/palpate_stop",
                           "libexec/palpate/palpate_hdf5",
                           "share/applications/palpate.desktop",
                           "share/metainfo/org.example.palpate.metainfo.xml",
                           "share/mime/packages/palpate.xml",
                           "share/icons/hicolor/scalable/apps/palpate.svg",
                           "share/man/man1/palpate.1.gz",
                           "share/bash-completion/completions/palpate",
                           "share/zsh/vendor-completions/_palpate",
                           "share/fish/vendor_completions.d/palpate.fish",
                           "share/doc/palpate/copyright",
                           "share/doc/palpate/changelog.Debian.gz",
                           "share/doc/palpate/README.md",
                           "share/doc/palpate/docs/manual/commands.md",
                           "share/palpate/docs/manual/commands.md",
                           "share/palpate/docs/pictures/window.png",
                           "share/palpate/demo_grasps.dsa",
                           "share/palpate/emulated_objects.json",
                           "share/palpate/scenes/ball.json"})
    EXPECT_TRUE(fs::is_regular_file(path(name))) << name;
  for (const auto& entry : fs::directory_iterator(dataFolder() / "scenes"))
    EXPECT_TRUE(fs::exists(path("share/palpate/scenes") / entry.path().filename())) << entry.path();
  for (const auto& entry : fs::directory_iterator(projectFolder() / "docs"))
    EXPECT_TRUE(fs::exists(path("share/palpate/docs") / entry.path().filename())) << entry.path();
}

TEST_F(Installed, HasNothingOfTheBuild) {
  for (const auto& entry : fs::recursive_directory_iterator(path(""))) {
    const std::string name = entry.path().filename().string();
    EXPECT_FALSE(name.ends_with("_test") || name.ends_with(".a") || name.ends_with(".h") ||
                 name == "__pycache__")
        << entry.path();
    if (!entry.is_regular_file()) continue;
    const bool runs = (entry.status().permissions() & fs::perms::owner_exec) != fs::perms::none;
    EXPECT_EQ(runs,
              entry.path() == path("bin/palpate") ||
                  entry.path().parent_path() == path("libexec/palpate"))
        << entry.path();
  }
}

TEST_F(Installed, ProgramFindsItsDataWhereverItLies) {
  const TemporaryFolder folder;
  const std::string out = folder / "ball.dsa";
  ProgramResult result =
      palpate({"synthesize", "-q", "--scene", "ball", "--duration", "1", "-o", out});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_TRUE(fs::exists(out));
  // It is its own folder and no other (the sources' would have it).
  fs::rename(path("share/palpate/scenes/pen.json"), path("share/palpate/scenes/feather.json"));
  result =
      palpate({"synthesize", "-q", "--scene", "pen", "--duration", "1", "-o", folder / "pen.dsa"});
  EXPECT_EQ(result.exitCode, 1);
  result = palpate(
      {"synthesize", "-q", "--scene", "feather", "--duration", "1", "-o", folder / "feather.dsa"});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  fs::rename(path("share/palpate/scenes/feather.json"), path("share/palpate/scenes/pen.json"));
}

TEST_F(Installed, ProgramIsFoundThroughALink) {
  const TemporaryFolder folder;
  fs::create_symlink(path("bin/palpate"), folder / "p");
  const std::vector<std::string> words = {
      "synthesize", "-q", "--scene", "box", "--duration", "1", "-o"};
  std::vector<std::string> all = words;
  all.push_back(folder / "box.dsa");
  EXPECT_EQ(runProgram(folder / "p", all, {{"PALPATE_DATA", ""}}).exitCode, 0);
}

TEST_F(Installed, BuildFolderWorksWithoutInstallation) {
  const TemporaryFolder folder;
  const ProgramResult result = runProgram(
      PALPATE_PROGRAM,
      {"synthesize", "-q", "--scene", "ball", "--duration", "1", "-o", folder / "ball.dsa"},
      {{"PALPATE_DATA", ""}});
  EXPECT_EQ(result.exitCode, 0) << result.err;
}

TEST_F(Installed, WindowOpensOnItsDemonstration) {
  const TemporaryFolder folder;
  const std::string picture = folder / "window.png";
  const ProgramResult result =
      palpate({"--screenshot", picture, path("share/palpate/demo_grasps.dsa").string()});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_TRUE(readFile(picture).starts_with("\x89PNG"));
}

TEST_F(Installed, ProgramOfTheWindowFindsItsDataToo) {
  const TemporaryFolder folder;
  const ProgramResult result = palpate({"render",
                                        path("share/palpate/demo_grasps.dsa").string(),
                                        "-o",
                                        folder / "frame.png",
                                        "--frame",
                                        "1"});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  const ProgramResult unknown = palpate({"emulate", "--scene", "no_such_scene"});
  EXPECT_NE(unknown.err.find((path("share/palpate") / "").string()), std::string::npos)
      << unknown.err;
}

TEST_F(Installed, WithoutTheProgramOfTheWindowTheOtherCommandsWork) {
  const fs::path window = path("libexec/palpate/palpate_window");
  fs::rename(window, window.string() + "_away");
  const ProgramResult info = palpate({"info", path("share/palpate/demo_grasps.dsa").string()});
  const ProgramResult train = palpate({"train", "--help"});
  const ProgramResult open = palpate({"--demo"});
  fs::rename(window.string() + "_away", window);
  EXPECT_EQ(info.exitCode, 0) << info.err;
  for (const ProgramResult& result : {train, open}) {
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_EQ(result.err,
              "palpate: " + window.string() +
                  ": the part of palpate with the window and this command can't be started: No "
                  "such file or directory; install palpate again\n");
  }
}

TEST_F(Installed, WithoutTheProgramOfTheLastStopAGraspSaysSo) {
  const fs::path stop = path("libexec/palpate/palpate_stop");
  const auto grasp = [] {
    return palpate({"grasp", "--sdh", "/no/such/port", "--preshape", "centrical", "--wait", "0.1"});
  };
  const std::string without = stop.string() + ": can't be started (No such file or directory)";
  EXPECT_EQ(grasp().err.find(without), std::string::npos);
  fs::rename(stop, stop.string() + "_away");
  const ProgramResult result = grasp();
  fs::rename(stop.string() + "_away", stop);
  EXPECT_TRUE(result.err.starts_with("palpate: " + without)) << result.err;
}

TEST_F(Installed, WithoutTheProgramThatReadsHdf5OneLineNamesIt) {
  const TemporaryFolder folder;
  const std::string recording = folder / "a.h5";
  bytesOf(recording);
  EXPECT_EQ(palpate({"verify", recording}).exitCode, 0);
  const fs::path reader = path("libexec/palpate/palpate_hdf5");
  fs::rename(reader, reader.string() + "_away");
  const ProgramResult info = palpate({"info", recording});
  fs::rename(reader.string() + "_away", reader);
  EXPECT_EQ(info.exitCode, 1);
  EXPECT_NE(info.err.find("palpate_hdf5 can't be started: No such file or directory"),
            std::string::npos)
      << info.err;
}

TEST_F(Installed, PythonModuleIsFound) {
  const fs::path modules = path("lib/python3/dist-packages");
  if (!fs::exists(modules)) GTEST_SKIP() << "built without the Python module (PALPATE_PYTHON=OFF)";
  const ProgramResult result = runProgram("/usr/bin/python3",
                                          {"-B",
                                           "-c",
                                           "import palpate, sys; print(palpate.__file__); "
                                           "print(palpate.load(sys.argv[1]))",
                                           path("share/palpate/demo_grasps.dsa").string()},
                                          {{"PYTHONPATH", modules.string()}});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_TRUE(result.out.starts_with(modules.string())) << result.out;
  EXPECT_NE(result.out.find("761 frames"), std::string::npos) << result.out;
}

TEST_F(Installed, VersionIsTheSameEverywhere) {
  const std::string version = PALPATE_VERSION;
  EXPECT_EQ(palpate({"--version"}).out, "palpate " + version + "\n");
  const std::string changelog = readFile(projectFolder() / "cmake/package/changelog");
  EXPECT_TRUE(changelog.starts_with("palpate (" + version + "-")) << changelog.substr(0, 40);
  EXPECT_NE(text("share/metainfo/org.example.palpate.metainfo.xml")
                .find("<release version=\"" + version + "\" date=\"20"),
            std::string::npos);
}

TEST_F(Installed, FileTypesAreTheSameEverywhere) {
  const std::string types = text("share/mime/packages/palpate.xml");
  const std::regex type("<mime-type type=\"([^\"]+)\">");
  std::set<std::string> all;
  for (std::sregex_iterator at(types.begin(), types.end(), type), end; at != end; ++at)
    all.insert((*at)[1]);
  EXPECT_EQ(all.size(), 2u);
  for (const std::string& each : all) {
    EXPECT_NE(text("share/applications/palpate.desktop").find(each + ";"), std::string::npos)
        << each;
    EXPECT_NE(
        text("share/metainfo/org.example.palpate.metainfo.xml").find("<mediatype>" + each + "<"),
        std::string::npos);
  }
}

TEST_F(Installed, NativeRecordingHasTheBytesThatItsTypeIsKnownBy) {
  const std::string types = text("share/mime/packages/palpate.xml");
  std::smatch match;
  ASSERT_TRUE(std::regex_search(
      types, match, std::regex("type=\"big32\" offset=\"([0-9]+)\" value=\"0x([0-9A-Fa-f]{8})\"")));
  const TemporaryFolder folder;
  const std::string bytes = bytesOf(folder / "grasps.palpate");
  const std::size_t offset = std::stoul(match[1]);
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value = value << 8 | static_cast<unsigned char>(bytes.at(offset + i));
  EXPECT_EQ(value, std::stoul(match[2], nullptr, 16));
  EXPECT_NE(types.find("offset=\"0\" value=\"SQLite format 3\\000\""), std::string::npos);
  EXPECT_TRUE(bytes.starts_with(std::string("SQLite format 3\0", 16)));
}

// Width and height of a PNG, from its header (PNG specification, 11.2.2).
std::pair<int, int> sizeOf(const std::string& png) {
  const auto at = [&](std::size_t i) {
    int value = 0;
    for (std::size_t k = 0; k < 4; ++k)
      value = value << 8 | static_cast<unsigned char>(png.at(i + k));
    return value;
  };
  return {at(16), at(20)};
}

TEST_F(Installed, IconsHaveTheSizesOfTheirFolders) {
  int found = 0;
  for (int size : {16, 24, 32, 48, 64, 128, 256}) {
    const std::string folder = std::to_string(size) + "x" + std::to_string(size);
    const std::string png = text("share/icons/hicolor/" + folder + "/apps/palpate.png");
    EXPECT_TRUE(png.starts_with("\x89PNG")) << size;
    EXPECT_EQ(sizeOf(png), std::make_pair(size, size));
    ++found;
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(path("share/icons/hicolor")), {}), found + 1);
}

TEST_F(Installed, DesktopEntryIsValid) {
  const auto result =
      tool("desktop-file-validate", {path("share/applications/palpate.desktop").string()});
  if (!result) PALPATE_CANNOT_SHOW("desktop-file-utils isn't installed");
  EXPECT_EQ(result->exitCode, 0) << result->out;
  EXPECT_EQ(result->out, "");
}

TEST_F(Installed, AppStreamMetadataIsValid) {
  const auto result = tool("appstreamcli",
                           {"validate",
                            "--pedantic",
                            "--no-net",
                            path("share/metainfo/org.example.palpate.metainfo.xml").string()});
  if (!result) PALPATE_CANNOT_SHOW("appstream isn't installed");
  EXPECT_EQ(result->exitCode, 0) << result->out;
}

TEST_F(Installed, FileTypesAndIconAreWellFormed) {
  const auto result = tool("xmllint",
                           {"--noout",
                            path("share/mime/packages/palpate.xml").string(),
                            path("share/icons/hicolor/scalable/apps/palpate.svg").string()});
  if (!result) PALPATE_CANNOT_SHOW("libxml2-utils isn't installed");
  EXPECT_EQ(result->exitCode, 0) << result->err;
}

}  // namespace
}  // namespace palpate::testing::installed_test
