#include "palpate/recognition/filtered_recording.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "palpate/emulator/synthetic_profile.h"

#include "testing/testing.h"

namespace palpate::filtered_recording_test {
namespace {

class FilteredRecording : public ::testing::Test {
 protected:
  Profile by(const std::vector<std::string>& filters) {
    return filteredBy(parseRecipe(filters), recorded_, file_);
  }
  testing::TemporaryFolder folder_;
  const Profile recorded_ = synthesize({.durationS = 1.0, .grasps = 1});
  const std::filesystem::path file_ = folder_ / "a.palpate";
};

TEST_F(FilteredRecording, WithoutFiltersIsTheRecordingAndNoFileIsRead) {
  const Profile same = by({});
  TactileFrame before, after;
  recorded_.readFrame(20, before);
  same.readFrame(20, after);
  EXPECT_EQ(before.values, after.values);
}

TEST_F(FilteredRecording, NamesTheFileWhoseMatrixIsMissing) {
  saveRecording(recorded_, {}, file_);
  EXPECT_EQ(by({"median"}).numFrames(), recorded_.numFrames());
  try {
    by({"median:matrices=9"});
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with(file_.string() + ": ")) << error.what();
  }
}

}  // namespace
}  // namespace palpate::filtered_recording_test
