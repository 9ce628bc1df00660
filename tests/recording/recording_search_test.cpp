#include "palpate/recording/recording_search.h"

#include <cstdlib>
#include <ctime>

#include "testing/testing.h"

namespace palpate::recording_search_test {
namespace {

RecordingDetails sample() {
  RecordingDetails details;
  details.path = "/data/today/grasps/Foam_Ball.dsa";
  details.form = "dsa";
  details.operatorName = "J\xC3\x96RG";  // JÖRG
  details.object = "tennis ball";
  details.run = "run 12";
  details.notes = "cold room\nold glove";
  details.labels = {"slip", "drop it"};
  details.startUs = 1'417'084'265'123'000;  // 2014-11-27 10:31:05.123 UTC
  return details;
}

bool found(std::string_view text) {
  return RecordingSearch(text).matches(searchableText(sample(), "/data/today"));
}

TEST(RecordingSearch, everyWordMustBeFoundSomewhere) {
  for (const char* text : {"",
                           "  ",
                           "foam",
                           "FOAM ball",
                           "grasps/",
                           "tennis 12 slip",
                           "glove cold",
                           "j\xC3\xB6rg",
                           "dsa",
                           "finished"})
    EXPECT_TRUE(found(text)) << text;
  for (const char* text : {"cup", "foam cup", "today", "/data", "rig"})
    EXPECT_FALSE(found(text)) << text;
}

TEST(RecordingSearch, quotesMakeOneOfSeveralWords) {
  EXPECT_TRUE(found("\"tennis ball\""));
  EXPECT_FALSE(found("\"ball tennis\""));
  EXPECT_TRUE(found("ball tennis"));
  EXPECT_TRUE(found("label:\"drop it\""));
  EXPECT_FALSE(found("label:\"it drop\""));
  EXPECT_TRUE(found("\"cold room"));  // still being typed
  EXPECT_TRUE(found("\"\""));
}

TEST(RecordingSearch, aKeyLooksInOnePlace) {
  for (const char* text : {"name:foam",
                           "path:grasps/foam",
                           "object:ball",
                           "OBJECT:Tennis",
                           "operator:j\xC3\x96rg",
                           "run:12",
                           "notes:glove",
                           "label:slip",
                           "form:dsa",
                           "state:finished",
                           "object:"})
    EXPECT_TRUE(found(text)) << text;
  for (const char* text : {"object:foam", "name:tennis", "name:grasps", "label:cold", "run:slip"})
    EXPECT_FALSE(found(text)) << text;
  EXPECT_FALSE(found("weight:3"));  // no key: as it stands
  RecordingDetails details = sample();
  details.notes = "weight:3 kg";
  EXPECT_TRUE(RecordingSearch("weight:3").matches(searchableText(details, "/data")));
}

TEST(RecordingSearch, theDateIsThatOfThisPlace) {
  const char* before = std::getenv("TZ");
  const std::string kept = before ? before : "";
  setenv("TZ", "<+05>-5", 1);  // five hours ahead of UTC
  tzset();
  EXPECT_TRUE(found("date:2014-11-27"));
  EXPECT_TRUE(found("date:\"27 15:31\""));
  EXPECT_FALSE(found("date:10:31"));
  if (before)
    setenv("TZ", kept.c_str(), 1);
  else
    unsetenv("TZ");
  tzset();
}

TEST(RecordingSearch, smallLettersOfSeveralScripts) {
  EXPECT_EQ(smallLetters("AbZ 09_[`"), "abz 09_[`");
  // ÀÞ× ŁŹ ΑΩ АЯЁ (Unicode CaseFolding.txt)
  EXPECT_EQ(smallLetters("\xC3\x80\xC3\x9E\xC3\x97 \xC5\x81\xC5\xB9 \xCE\x91\xCE\xA9 "
                         "\xD0\x90\xD0\xAF\xD0\x81"),
            "\xC3\xA0\xC3\xBE\xC3\x97 \xC5\x82\xC5\xBA \xCE\xB1\xCF\x89 "
            "\xD0\xB0\xD1\x8F\xD1\x91");
  EXPECT_EQ(smallLetters("\xE2\x82\xAC \xF0\x9F\x98\x80 \xFF\xC3"),
            "\xE2\x82\xAC \xF0\x9F\x98\x80 \xFF\xC3");  // other characters, and none at all
}

}  // namespace
}  // namespace palpate::recording_search_test
