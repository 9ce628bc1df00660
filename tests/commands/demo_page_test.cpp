// The page of the tour as text: well-formed, and what strangers wrote stays text.
#include "commands/demo_page.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "palpate/core/xml.h"

namespace palpate::commands::demo_page_test {
namespace {

// All text and every attribute of a page, by a reader of XML.
class PageReader : public XmlHandler {
 public:
  explicit PageReader(const std::string& page) {
    XmlParser parser(*this);
    parser.push(page.substr(page.find('\n') + 1));  // without its document type
    parser.finish();
  }
  void startElement(std::string_view name, const char* const* attributes) override {
    elements.emplace_back(name);
    for (; *attributes; attributes += 2) values.emplace_back(attributes[1]);
  }
  void endElement(std::string_view) override {}
  void text(std::string_view piece) override { words += piece; }

  std::size_t count(const std::string& element) const {
    return static_cast<std::size_t>(std::count(elements.begin(), elements.end(), element));
  }
  std::vector<std::string> elements, values;
  std::string words;
};

const std::string kHostile = "<script>alert(\"1\")</script> & 'x' ]]> <!--";

DemoFacts hostileFacts() {
  DemoFacts facts;
  facts.version = kHostile + "version";
  facts.madeAt = kHostile + "at";
  facts.steps = {{kHostile + "name", kHostile + "what", "failed", kHostile + "figure"}};
  facts.things = {{kHostile + "thing", DemoGrip{3, 12.34}, "PNG"}};
  facts.files = {{kHostile + "file", kHostile + "about", 1234}};
  facts.recognition.emplace();
  AskedGrasp asked;
  asked.known = {"x", kHostile + "object"};
  asked.problem = kHostile + "trouble";
  facts.recognition->grasps = {asked};
  facts.recognition->warnings = {kHostile + "warning"};
  facts.windowPng = "PNG";
  return facts;
}

TEST(DemoPage, WhatStrangersWroteStaysText) {
  const PageReader read(demoPage(hostileFacts()));
  EXPECT_EQ(read.count("script"), 0u);
  for (const char* where : {"version",
                            "at",
                            "name",
                            "what",
                            "figure",
                            "thing",
                            "file",
                            "about",
                            "object",
                            "trouble",
                            "warning"})
    EXPECT_NE(read.words.find(kHostile + where), std::string::npos) << where;
}

TEST(DemoPage, CarriesItsPictures) {
  const PageReader read(demoPage(hostileFacts()));
  EXPECT_EQ(read.count("img"), 2u);
  EXPECT_EQ(std::count(read.values.begin(), read.values.end(), "data:image/png;base64,UE5H"), 2);
}

TEST(DemoPage, SaysWhatIsWrongAndWhatWasNotSeen) {
  DemoFacts facts = hostileFacts();
  AskedGrasp& asked = facts.recognition->grasps.front();
  asked.inTraining = true;
  asked.prediction.emplace();
  asked.called = "pen";
  asked.rank = 4;
  asked.probability = 0.0123;
  facts.pitchMm = 3.4;
  facts.slip = DemoSlip{.motion = {.matrix = 5, .beganUs = 0, .endedUs = 1, .movedTaxels = 2.5},
                        .alarm = {},
                        .matrices = {},
                        .early = 7};
  const std::string words = PageReader(demoPage(facts)).words;
  for (const char* part : {"pen", "wrong", "0.012", "matrix 5", "2.50 taxels, 8.5 mm", "none", "7"})
    EXPECT_NE(words.find(part), std::string::npos) << part;
}

TEST(DemoPage, LeavesOutWhatThereIsNot) {
  const PageReader read(demoPage({}));
  EXPECT_EQ(read.count("img"), 0u);
  for (const char* part : {"What was held", "What was recognised", "What slipped", "The window"})
    EXPECT_EQ(read.words.find(part), std::string::npos) << part;
}

}  // namespace
}  // namespace palpate::commands::demo_page_test
