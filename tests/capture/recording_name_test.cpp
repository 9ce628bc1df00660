#include "palpate/capture/recording_name.h"

#include <cstdlib>
#include <ctime>
#include <stdexcept>

#include "palpate/core/error.h"

#include "testing/testing.h"

namespace palpate::recording_name_test {
namespace {
namespace fs = std::filesystem;
using testing::TemporaryFolder;
using testing::writeFile;

// 2014-11-27 10:31:05.5 UTC (date -u -d '2014-11-27 10:31:05' +%s).
constexpr std::int64_t kTimeUs = 1'417'084'265'500'000;

class RecordingName : public ::testing::Test {
 protected:
  RecordingName() {
    ::setenv("TZ", "UTC-3", 1);  // three hours east, whatever the machine has
    ::tzset();
  }
  ~RecordingName() override {
    ::unsetenv("TZ");
    ::tzset();
  }
};

TEST_F(RecordingName, fillsThePlaceholders) {
  EXPECT_EQ(recordingFileName(
                "{date}_{time}_{operator}_{object}_{run}", {kTimeUs, "Ada", "foam ball"}, 7),
            "2014-11-27_13-31-05_Ada_foam_ball_007.palpate");
  EXPECT_EQ(recordingFileName("grasp", {}, 1), "grasp.palpate");
  EXPECT_EQ(recordingFileName("grasp.palpate", {}, 1), "grasp.palpate");
  EXPECT_EQ(recordingFileName("run{run}", {}, 12345), "run12345.palpate");
  EXPECT_EQ(recordingFileName("{date}", {-1, "", ""}, 1), "1970-01-01.palpate");
}

TEST_F(RecordingName, anEmptyFieldLeavesNoHole) {
  EXPECT_EQ(recordingFileName("{operator}_{object}_{run}", {kTimeUs, "", "cup"}, 1),
            "cup_001.palpate");
  EXPECT_EQ(recordingFileName("{object}_{operator}_{run}", {kTimeUs, "", "cup"}, 1),
            "cup_001.palpate");
  EXPECT_EQ(recordingFileName("{object}", {}, 1), "recording.palpate");
  EXPECT_EQ(recordingFileName("", {}, 1), "recording.palpate");
}

TEST_F(RecordingName, aPlaceholderMustBeKnownAndStandOnce) {
  EXPECT_THROW(recordingFileName("{hand}", {}, 1), std::invalid_argument);
  EXPECT_THROW(recordingFileName("{run}_{run}", {}, 1), std::invalid_argument);
  EXPECT_THROW(recordingFileName("{run", {}, 1), std::invalid_argument);
  try {
    recordingFileName("{hand}", {}, 1);
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("{operator}"), std::string::npos) << error.what();
  }
}

// R19: no text typed by the user leads out of the folder.
TEST_F(RecordingName, whateverPeopleTypeTheNameStaysInItsFolder) {
  const std::string attacks[] = {"../../etc/passwd",
                                 "..",
                                 ".",
                                 "/etc/shadow",
                                 "a/b",
                                 "a\\b",
                                 "C:\\x",
                                 "-rf",
                                 "~root",
                                 ".hidden",
                                 "a\nb",
                                 "a\x1b[2Jb",
                                 std::string("a\0b", 3),
                                 "\xff\xfe",
                                 "\xc0\xaf",  // "/" in overlong UTF-8
                                 "a\xe2\x80\xae"
                                 "txt",  // right-to-left override
                                 "$(reboot)",
                                 "`id`",
                                 "x;y|z",
                                 "{run}",
                                 std::string(5000, 'a'),
                                 std::string(300, '.'),
                                 std::string(299, 'a') + "\xc3\xbc",
                                 "\x01\x02"};
  const TemporaryFolder folder;
  for (const std::string& attack : attacks) {
    for (const bool inTemplate : {false, true}) {
      RecordingNameFields fields{kTimeUs, attack, attack};
      std::string nameTemplate = "{operator}_{object}_{run}";
      if (inTemplate) {
        if (attack == "{run}") continue;
        nameTemplate = attack;
      }
      const fs::path path = nextRecordingPath(folder.path(), nameTemplate, fields);
      const std::string name = path.filename().string();
      EXPECT_EQ(path.parent_path(), folder.path()) << attack;
      EXPECT_LE(name.size(), 200u);
      EXPECT_TRUE(name.ends_with(".palpate")) << name;
      EXPECT_EQ(name.find_first_of(std::string("/\\\0\n\x1b ", 6)), std::string::npos) << name;
      EXPECT_EQ(name.find_first_of("-.~"), name.find(".palpate"))
          << name;  // none at the begin, none doubled
      // The system accepts the name, and the file is in the folder.
      writeFile(path, "x");
      EXPECT_TRUE(fs::exists(folder / name)) << name;
      fs::remove(path);
    }
  }
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST_F(RecordingName, lettersOfAnyLanguageStay) {
  EXPECT_EQ(fileNamePart("Jos\xc3\xa9 M\xc3\xbcller"), "Jos\xc3\xa9_M\xc3\xbcller");
  EXPECT_EQ(fileNamePart("\xe6\xb1\x9f"), "\xe6\xb1\x9f");
  // No UTF-8 character is cut in two.
  std::string umlauts;
  for (int i = 0; i < 100; ++i) umlauts += "\xc3\xbc";
  EXPECT_EQ(fileNamePart("x" + umlauts), "x" + umlauts.substr(0, 58));
}

TEST_F(RecordingName, runIsTheNextFreeNumberOfThisOperatorAndObject) {
  const TemporaryFolder folder;
  const RecordingNameFields cup{kTimeUs, "Ada", "cup"};
  const std::string form = "{operator}_{object}_{run}";
  EXPECT_EQ(nextRecordingPath(folder.path(), form, cup), folder / "Ada_cup_001.palpate");
  for (const char* name : {"Ada_cup_001.palpate",
                           "Ada_cup_004_002.palpate",  // a second part
                           "Ada_cup_x.palpate",
                           "Ada_ball_017.palpate",
                           "Bob_cup_018.palpate"})
    writeFile(folder / name, "");
  EXPECT_EQ(nextRecordingPath(folder.path(), form, cup), folder / "Ada_cup_005.palpate");
  writeFile(folder / "Ada_cup_0999.palpate-journal", "");  // of an unfinished recording
  EXPECT_EQ(nextRecordingPath(folder.path(), form, cup), folder / "Ada_cup_1000.palpate");
  writeFile(folder / "Ada_cup_1003.mcap", "");  // whose recording was moved away
  EXPECT_EQ(nextRecordingPath(folder.path(), form, cup), folder / "Ada_cup_1004.palpate");
}

TEST_F(RecordingName, runGoesOnThoughTheTimeDiffers) {
  const TemporaryFolder folder;
  writeFile(folder / "2014-11-27_08-00-00_003.palpate", "");
  writeFile(folder / "2014-11-26_08-00-00_009.palpate", "");  // another day
  EXPECT_EQ(nextRecordingPath(folder.path(), "{date}_{time}_{run}", {kTimeUs, "", ""}),
            folder / "2014-11-27_13-31-05_004.palpate");
}

TEST_F(RecordingName, withoutRunATakenNameGetsANumber) {
  const TemporaryFolder folder;
  writeFile(folder / "cup.palpate", "");
  EXPECT_EQ(nextRecordingPath(folder.path(), "cup", {}), folder / "cup-2.palpate");
  fs::create_symlink("/nowhere", folder / "cup-2.palpate");
  EXPECT_EQ(nextRecordingPath(folder.path(), "cup", {}), folder / "cup-3.palpate");
  writeFile(folder / "cup-3.mcap", "");
  EXPECT_EQ(nextRecordingPath(folder.path(), "cup", {}), folder / "cup-4.palpate");
  EXPECT_THROW(nextRecordingPath(folder / "none", "cup", {}), FileError);
}

TEST_F(RecordingName, TheTextOfARunStandsBeforeItsNumber) {
  const RecordingNameFields left{kTimeUs, "", "ball", "left side"};
  EXPECT_EQ(recordingFileName("{object}_{run}", left, 2), "ball_left_side_002.palpate");
  const TemporaryFolder folder;
  writeFile(folder / "ball_left_side_004.palpate", "");
  writeFile(folder / "ball_right_009.palpate", "");
  EXPECT_EQ(nextRecordingPath(folder.path(), "{object}_{run}", left),
            folder / "ball_left_side_005.palpate");
}

}  // namespace
}  // namespace palpate::recording_name_test
