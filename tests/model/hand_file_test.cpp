#include "palpate/model/hand_file.h"

#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>
#include <set>

#include <gtest/gtest.h>

#include "palpate/core/error.h"

#include "testing/testing.h"

namespace palpate::testing::hand_file_test {
namespace {

// A hand of one matrix; `more` is inserted into the hand, `matrix` into its matrix.
std::string handText(const std::string& more = "", const std::string& matrix = "") {
  return R"({"format": "palpate-hand", "version": 1, "name": "pad", "full_scale": 1000,
             "matrices": [{"name": "a", "rows": 2, "columns": 3, "pitch_mm": 4.5)" +
         matrix + "}]" + more + "}";
}

HandDescription parsed(const std::string& more = "", const std::string& matrix = "") {
  return parseHand(handText(more, matrix), "", "hand.json");
}

std::string faultOf(const std::string& text, const std::string& urdf = "") {
  try {
    parseHand(text, urdf, "hand.json");
  } catch (const FormatError& error) {
    return error.what();
  }
  return "no fault";
}

TEST(HandFile, ReadsAPad) {
  const HandDescription hand = parsed(
      R"(, "maker": "us", "unit": "kPa", "saturation": 900, "temperature_sensors": [{"name": "t"}])",
      R"(, "mask": ["##.", "###"], "temperature_sensor": 0, "picture": {"column": 2, "row": 1})");
  EXPECT_EQ(hand.name, "pad");
  EXPECT_EQ(hand.maker, "us");
  EXPECT_EQ(hand.unit, "kPa");
  EXPECT_EQ(hand.maximumCounts, 1000.0F);
  EXPECT_EQ(hand.saturationCounts, 900.0F);
  ASSERT_EQ(hand.layout->numMatrices(), 1u);
  const MatrixLayout& matrix = hand.layout->matrix(0);
  EXPECT_EQ(matrix.rows, 2);
  EXPECT_EQ(matrix.columns, 3);
  EXPECT_EQ(matrix.pitchMm, 4.5);
  EXPECT_EQ(matrix.staticMask, (Mask{1, 1, 0, 1, 1, 1}));
  EXPECT_EQ(hand.matrices[0].pictureColumn, 2);
  EXPECT_EQ(hand.matrices[0].temperatureSensor, 0u);
  EXPECT_TRUE(hand.axes.empty());
  EXPECT_TRUE(hand.file->surfaces.empty());
}

TEST(HandFile, APitchIsOneNumberOrTwo) {
  const auto with = [](const std::string& pitch) {
    return R"({"format": "palpate-hand", "version": 1, "name": "pad", "full_scale": 1000,
               "matrices": [{"name": "a", "rows": 2, "columns": 3, "pitch_mm": )" +
           pitch + "}]}";
  };
  EXPECT_EQ(parseHand(with("[5.28, 10.28]"), "", "hand.json").layout->matrix(0).pitchMm,
            TaxelPitch(5.28, 10.28));
  for (const char* wrong :
       {"[5.28]", "[1, 2, 3]", "[5.28, 0]", "[-1, 5]", "[5, 1001]", "[5, \"a\"]", "\"5\"", "0"})
    EXPECT_NE(faultOf(with(wrong)).find("pitch_mm"), std::string::npos) << wrong;
}

TEST(HandFile, AMatrixMayHaveItsOwnFullScaleAndSaturation) {
  const auto own = [](const std::string& matrix) {
    return parsed(R"(, "saturation": 900)", matrix);
  };
  const HandDescription usual = own("");
  EXPECT_EQ(usual.maximumOf(0), 1000.0F);
  EXPECT_EQ(usual.saturationOf(0), 900.0F);
  const HandDescription scale = own(R"(, "full_scale": 250)");
  EXPECT_EQ(scale.maximumOf(0), 250.0F);
  EXPECT_EQ(scale.saturationOf(0), 250.0F);
  const HandDescription larger = own(R"(, "full_scale": 950)");
  EXPECT_EQ(larger.saturationOf(0), 900.0F);
  const HandDescription both = own(R"(, "full_scale": 250, "saturation": 200)");
  EXPECT_EQ(both.maximumOf(0), 250.0F);
  EXPECT_EQ(both.saturationOf(0), 200.0F);
  EXPECT_EQ(both.maximumCounts, 1000.0F);
  EXPECT_EQ(both.saturationText(), "200");
  EXPECT_EQ(own(R"(, "saturation": 950)").saturationOf(0), 950.0F);
  EXPECT_NE(faultOf(handText("", R"(, "full_scale": 1001)")).find("matrices[0].full_scale"),
            std::string::npos);
  EXPECT_NE(faultOf(handText("", R"(, "full_scale": 250, "saturation": 251)"))
                .find("matrices[0].saturation"),
            std::string::npos);
}

TEST(HandFile, ReadsAxesAndPreshapes) {
  const HandDescription hand = parsed(R"(, "axes": [
      {"name": "slide", "unit": "mm", "minimum": 0, "maximum": 50, "maximum_force_n": 80},
      {"name": "turn", "minimum": -90, "maximum": 90, "velocity": 100}],
      "preshapes": [{"name": "close", "joints": [[50, -50], [0, 45]]}])");
  ASSERT_EQ(hand.axes.size(), 2u);
  EXPECT_TRUE(hand.axes[0].isSliding);
  EXPECT_STREQ(hand.axes[0].unit(), "mm");
  EXPECT_EQ(hand.axes[0].maximumTorqueNmm, 80.0);
  EXPECT_STREQ(hand.axes[1].unit(), "deg");
  ASSERT_EQ(hand.file->preshapes.size(), 1u);
  EXPECT_EQ(hand.file->preshapes[0].anglesDeg(0.5), (std::vector<double>{25.0, 22.5}));
}

TEST(HandFile, NamesThePlaceOfAFault) {
  const auto expectFault = [](const std::string& text, const std::string& part) {
    const std::string fault = faultOf(text);
    EXPECT_NE(fault.find("hand.json: "), std::string::npos) << fault;
    EXPECT_NE(fault.find(part), std::string::npos) << fault;
  };
  expectFault("[]", "isn't a JSON object");
  expectFault("{}", "has no \"format\"");
  expectFault(R"({"format": "x"})", "format is not");
  expectFault(R"({"format": "palpate-hand", "version": 2})", "newer Palpate");
  expectFault(handText(R"(, "colour": 1)"), "unknown key 'colour'");
  expectFault(handText("", R"(, "mask": ["###"])"), "matrices[0].mask has 1 row instead of 2");
  expectFault(handText("", R"(, "mask": ["##", "###"])"), "mask[0] has 2 characters instead of 3");
  expectFault(handText("", R"(, "mask": ["##x", "###"])"), "mask[0] contains something else");
  expectFault(handText("", R"(, "mask": ["...", "..."])"), "leaves no taxel");
  expectFault(handText("", R"(, "temperature_sensor": 0)"), "empty list");
  expectFault(handText(R"(, "saturation": 1001)"), "saturation is 1001, not in");
  expectFault(handText(R"(, "axes": [{"name": "x", "minimum": 1, "maximum": 1}])"),
              "axes[0].maximum isn't above minimum");
  expectFault(handText(R"(, "axes": [{"name": "x", "unit": "m", "minimum": 0, "maximum": 1}])"),
              "neither \"deg\" nor \"mm\"");
  expectFault(handText(R"(, "preshapes": [{"name": "x", "joints": [[0, 1]]}])"),
              "preshapes[0].joints has 1 item for 0 axes");
  expectFault(handText(R"(, "urdf": "hand.urdf")"), "urdf names a file");
  const std::string surface =
      R"(, "surface": {"origin_mm": [0, 0, 0], "x_axis": [1, 0, 0], "y_axis": )";
  expectFault(handText("", surface + "[1, 0, 0]}"), "y_axis isn't perpendicular to x_axis");
  expectFault(handText("", surface + "[0, 0.5, 0]}"), "y_axis isn't of length 1");
  expectFault(handText("", R"(, "surface": {"taxels": []})"), "has 0 items instead of 6");
  expectFault(handText("", R"(, "surface": {"link": "tip", "origin_mm": [0, 0, 0],
                                 "x_axis": [1, 0, 0], "y_axis": [0, 1, 0]})"),
              "names no \"urdf\"");
  // Two matrices with one name, at one place of the picture, with a surface in one of two.
  const auto two = [](const std::string& first, const std::string& second) {
    return R"({"format": "palpate-hand", "version": 1, "name": "x", "full_scale": 1, "matrices": [
        {"rows": 1, "columns": 1, "pitch_mm": 1, )" +
           first + R"(}, {"rows": 1, "columns": 1, "pitch_mm": 1, )" + second + "}]}";
  };
  expectFault(two(R"("name": "a")", R"("name": "a")"), "matrices[1].name is used twice");
  expectFault(two(R"("name": "a", "picture": {"column": 0, "row": 0})",
                  R"("name": "b", "picture": {"column": 0, "row": 0})"),
              "is the place of a, too");
  expectFault(two(R"("name": "a", "surface": {"origin_mm": [0, 0, 0], "x_axis": [1, 0, 0],
                     "y_axis": [0, 1, 0]})",
                  R"("name": "b")"),
              "in 1 of 2 matrices");
}

TEST(HandFile, RefusesHugeLayouts) {
  std::string text = R"({"format": "palpate-hand", "version": 1, "name": "x", "full_scale": 1,
                         "matrices": [{"name": "a", "rows": 1000, "columns": 1000, "pitch_mm": 1}]})";
  EXPECT_NE(faultOf(text).find("matrices[0].rows is 1000, not in 1..256"), std::string::npos);
}

// What is kept in a recording gives the same hand again, with the recording's masks.
TEST(HandFile, ARecordingKeepsItsHand) {
  const HandDescription hand = parsed(R"(, "unit": "N")");
  const std::map<std::string, std::string> meta = handMeta(hand);
  EXPECT_EQ(meta.at("hand"), "pad");
  MatrixLayout masked = hand.layout->matrix(0);
  masked.dynamicMask[0] = 0;
  const HandDescription again = recordedHand(meta, SensorLayout({masked}), 0, 0);
  EXPECT_EQ(again.name, "pad");
  EXPECT_EQ(again.unit, "N");
  EXPECT_EQ(again.maximumCounts, 1000.0F);
  EXPECT_FALSE(again.layout->matrix(0).enabled(0, 0));
  // Another layout, or a copy that can't be read: the layout alone counts.
  const SensorLayout other({MatrixLayout::full(5, 5, 1.0)});
  EXPECT_EQ(recordedHand(meta, other, 0, 0).name, "unknown sensor");
  EXPECT_EQ(recordedHand({{"hand_json", "{"}}, other, 0, 0).name, "unknown sensor");
  EXPECT_EQ(recordedHand({}, *builtInHand("sdh2").layout, 0, 0).name, builtInHand("sdh2").name);
}

TEST(HandFile, FindsHandsByNameAndByFolder) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "mine");
  std::ofstream(folder.path() / "mine/hand.json") << handText();
  EXPECT_EQ(findHand("mine", {folder.path()}).name, "pad");
  EXPECT_EQ(findHand((folder.path() / "mine").string(), {}).name, "pad");
  EXPECT_EQ(findHand((folder.path() / "mine/hand.json").string(), {}).name, "pad");
  EXPECT_EQ(findHand("flat_pad_16x16", {folder.path()}).layout->numTaxels(), 256u);
  try {
    findHand("yours", {folder.path()});
    FAIL();
  } catch (const Error& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find("mine"), std::string::npos) << what;
    EXPECT_NE(what.find("sdh2"), std::string::npos) << what;
  }
}

// Sets a variable of the environment, and restores it.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    value ? setenv(name, value, 1) : unsetenv(name);
  }
  ~Variable() { before_ ? setenv(name_, before_->c_str(), 1) : unsetenv(name_); }

 private:
  const char* name_;
  std::optional<std::string> before_;
};

TEST(HandFile, HandsAreLookedForInTheUsersFolderFirst) {
  using Paths = std::vector<std::filesystem::path>;
  const Variable home("HOME", "/home/me");
  {
    const Variable data("XDG_DATA_HOME", "/my/data");
    EXPECT_EQ(userDataFolder(), "/my/data/palpate");
    EXPECT_EQ(handFolders("/program"), (Paths{"/my/data/palpate/hands", "/program/hands"}));
  }
  const Variable data("XDG_DATA_HOME", nullptr);
  EXPECT_EQ(handFolders("/program"),
            (Paths{"/home/me/.local/share/palpate/hands", "/program/hands"}));
  const Variable nobody("HOME", nullptr);
  EXPECT_EQ(userDataFolder(), "");
  EXPECT_EQ(handFolders("/program"), (Paths{"/program/hands"}));
}

TEST(HandFile, OfEqualNamesTheFirstFolderIsTaken) {
  const TemporaryFolder first, second;
  const auto add = [](const std::filesystem::path& folder, const std::string& name) {
    std::filesystem::create_directories(folder);
    std::string text = handText();
    text.replace(text.find("pad"), 3, name);
    std::ofstream(folder / "hand.json") << text;
  };
  add(first / "mine", "first");
  add(second / "mine", "second");
  add(second / "sole", "my sole");
  std::filesystem::create_directories(first / "empty");
  const std::vector<std::filesystem::path> folders = {first.path(), "/not/there", second.path()};
  std::map<std::string, std::filesystem::path> known;
  for (const KnownHand& each : knownHands(folders)) known.emplace(each.key, each.folder);
  EXPECT_EQ(known.size(), builtInHands().size() + 1);
  EXPECT_EQ(known.at("mine"), first / "mine");
  EXPECT_EQ(known.at("sole"), second / "sole");
  EXPECT_EQ(known.at("sdh2"), "");
  EXPECT_EQ(findHand("mine", folders).name, "first");
  EXPECT_EQ(findHand("sole", folders).name, "my sole");
}

TEST(HandFile, TheBuiltInHandsAreThoseOfTheDataFolder) {
  std::set<std::string> built;
  for (const BuiltInHand& each : builtInHands()) built.insert(each.key);
  std::set<std::string> folders;
  for (const auto& entry : std::filesystem::directory_iterator(dataFolder() / "hands")) {
    if (!entry.is_directory()) continue;
    folders.insert(entry.path().filename().string());
    EXPECT_EQ(readHandFolder(entry.path()).file->json,
              builtInHand(entry.path().filename().string()).file->json);
  }
  EXPECT_EQ(built, folders);
  EXPECT_THROW(builtInHand("none"), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::testing::hand_file_test
