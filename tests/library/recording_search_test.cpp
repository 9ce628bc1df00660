#include "palpate/library/recording_search.h"

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

// Of ASCII, and of Ö, the only other letter here.
std::string folded(std::string_view text) {
  std::string small(text);
  for (std::size_t i = 0; i < small.size(); ++i) {
    if (small[i] >= 'A' && small[i] <= 'Z') small[i] = static_cast<char>(small[i] + 0x20);
    if (small[i] == '\x96' && i > 0 && small[i - 1] == '\xC3') small[i] = '\xB6';
  }
  return small;
}

bool found(std::string_view text) {
  return RecordingSearch(text, folded).matches(searchableText(sample(), "/data/today", folded));
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
  EXPECT_TRUE(
      RecordingSearch("weight:3", folded).matches(searchableText(details, "/data", folded)));
}

TEST(RecordingSearch, aWordThatIsNoKeyIsKnown) {
  const RecordingSearch search("objct:ball foam 10:31 objct:cup date:2014 wieght:3 \"a b:c\"",
                               folded);
  EXPECT_EQ(search.unknownKeys(), (std::vector<std::string>{"objct", "wieght"}));
  EXPECT_TRUE(RecordingSearch("object:ball name:x", folded).unknownKeys().empty());
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

}  // namespace
}  // namespace palpate::recording_search_test
