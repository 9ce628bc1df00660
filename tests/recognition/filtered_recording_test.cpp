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
    return filteredBy(parseRecipe(filters), recording_, "a.palpate");
  }
  Recording recording_{.profile = synthesize({.durationS = 1.0, .grasps = 1})};
  const Profile& recorded_ = recording_.profile;
};

TEST_F(FilteredRecording, WithoutFiltersIsTheRecordingAndNoFileIsRead) {
  const Profile same = by({});
  TactileFrame before, after;
  recorded_.readFrame(20, before);
  same.readFrame(20, after);
  EXPECT_EQ(before.values, after.values);
}

TEST_F(FilteredRecording, NamesTheFileWhoseMatrixIsMissing) {
  EXPECT_EQ(by({"median"}).numFrames(), recorded_.numFrames());
  try {
    by({"median:matrices=9"});
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("a.palpate: ")) << error.what();
  }
}

}  // namespace
}  // namespace palpate::filtered_recording_test
