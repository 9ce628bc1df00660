// The table of formats: what each row promises, of all rows at once.
#include "palpate/recording/recording_format.h"

#include <algorithm>
#include <functional>
#include <set>

#include "palpate/core/error.h"
#include "palpate/emulator/synthetic_profile.h"
#include "palpate/recording/event_store.h"
#include "palpate/recording/recording.h"

#include "testing/testing.h"

namespace palpate::recording_format_test {
namespace {

std::string errorOf(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

Profile shortGrasp() { return synthesize({.durationS = 1.0, .grasps = 1}); }

TEST(RecordingFormat, EndingsAreUniqueAndFoundInCapitalLetters) {
  std::set<std::string> seen;
  for (const RecordingFormat* format : recordingFormats())
    for (const std::string ending : format->endings) {
      EXPECT_TRUE(ending.starts_with('.')) << ending;
      EXPECT_TRUE(seen.insert(ending).second) << ending;
      std::string capitals = "A" + ending;
      std::transform(capitals.begin(), capitals.end(), capitals.begin(), [](char letter) {
        return letter >= 'a' && letter <= 'z' ? static_cast<char>(letter - 'a' + 'A') : letter;
      });
      EXPECT_EQ(&formatOf(capitals), format) << capitals;
    }
  EXPECT_EQ(recordingEndings().size(), seen.size());
  const std::string message = errorOf([] { formatOf("a.docx"); });
  EXPECT_TRUE(message.starts_with("a.docx: its name must end in .dsa, .palpate, .csv")) << message;
  EXPECT_TRUE(message.ends_with(" or " + recordingEndings().back())) << message;
}

TEST(RecordingFormat, WhatIsReadHasAllOfWhatWasSavedWhateverItsName) {
  const testing::TemporaryFolder folder;
  const Profile profile = shortGrasp();
  const Event note{profile.frameTimeUs(3), profile.frameTimeUs(5), "note", {}, "here", ""};
  SaveExtras extras;
  extras.meta["operator"] = "Ada";
  for (const RecordingFormat* format : recordingFormats()) {
    SCOPED_TRACE(format->name);
    const auto file = folder / (std::string("a") + format->endings.front());
    saveRecording(profile, std::vector{note}, file, Overwrite::kRefuse, {}, extras);
    if (!format->reader) continue;
    // The notes of a .dsa lie beside it, under its name.
    const bool eventsInside = !std::filesystem::exists(file.string() + ".notes.json");
    const auto renamed = folder / (std::string(format->name) + ".txt");
    std::filesystem::copy_file(file, renamed);
    for (const auto& path : {file, renamed}) {
      const Recording recording = readRecording(path);
      recording.requireEvents();
      EXPECT_EQ(recording.profile.info().format, format->name);
      ASSERT_EQ(recording.profile.numFrames(), profile.numFrames());
      for (std::size_t i = 0; i < profile.numFrames(); ++i)
        ASSERT_EQ(recording.profile.frame(i).values, profile.frame(i).values) << i;
      if (path == file || eventsInside) {
        ASSERT_EQ(recording.events.size(), 1u);
        EXPECT_EQ(recording.events[0].text, "here");
        EXPECT_EQ(readEvents(path).events, recording.events);
      }
      EXPECT_EQ(recording.meta.contains("operator"), eventsInside);
      EXPECT_EQ(readRecordingMeta(path), recording.meta);
      EXPECT_EQ(recording.damage.text, "");
      EXPECT_EQ(verifyRecording(path).state, VerifyReport::State::kSound);
    }
  }
}

TEST(RecordingFormat, WhereNotesCanNotBeAddedThatIsSaid) {
  const testing::TemporaryFolder folder;
  for (const auto& [name, kind] : {std::pair("a.h5", "an HDF5 file"), {"a.mcap", "an MCAP file"}}) {
    saveRecording(shortGrasp(), {}, folder / name);
    EXPECT_EQ(errorOf([&] {
                saveEvents(folder / name, {}, std::vector{Event{1, 1, "note", {}, "a", ""}});
              }),
              (folder / name).string() + ": notes can't be added to " + kind +
                  "; convert it to .palpate and add them there");
  }
}

// Only who needs the events fails; the samples are there.
TEST(RecordingFormat, NotesThatCanNotBeReadKeepNoRecordingClosed) {
  const testing::TemporaryFolder folder;
  const Profile profile = shortGrasp();
  saveRecording(profile, {}, folder / "a.dsa");
  testing::writeFile(folder / "a.dsa.notes.json", "{");
  const Recording recording = readRecording(folder / "a.dsa");
  EXPECT_EQ(recording.profile.numFrames(), profile.numFrames());
  EXPECT_THROW(recording.requireEvents(), FormatError);
  EXPECT_NE(recording.damage.eventsFault().find("a.dsa.notes.json"), std::string::npos);
  EXPECT_EQ(readableRecording(folder / "a.dsa").damage.text, recording.damage.eventsFault());
  EXPECT_THROW(readEvents(folder / "a.dsa"), FormatError);
}

}  // namespace
}  // namespace palpate::recording_format_test
