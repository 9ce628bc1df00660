#include "palpate/imports/import_mapping.h"

#include <gtest/gtest.h>

#include "palpate/core/error.h"

#include "testing/testing.h"

namespace palpate::import_mapping_test {
namespace {

ImportMapping wholeMapping() {
  ImportMapping mapping;
  mapping.text = {';', ',', HeaderChoice::kPresent};
  mapping.time = {"t", "ms", std::nullopt, 1'417'084'265'123'456};
  mapping.matrices = {{0, "left[{y}][{x}]", {0.1, -2.0, "kPa"}, false},
                      {std::nullopt, "#86..#169", {}, true}};
  mapping.angles = {"joint*", {1.0, 0.0, "rad"}, "joint_time"};
  mapping.temperatures.columns = kNoColumns;
  mapping.components = ComponentOrder::kPlanar;
  return mapping;
}

TEST(ImportMapping, ReadsBackWhatWasWritten) {
  const testing::TemporaryFolder folder;
  writeMapping(wholeMapping(), folder / "m.json");
  EXPECT_EQ(readMapping(folder / "m.json"), wholeMapping());
  ImportMapping rate;
  rate.time.rateHz = 31.7;
  EXPECT_EQ(mappingFromJson(mappingJson(rate).text(), "m.json"), rate);
  EXPECT_EQ(mappingFromJson(mappingJson({}).text(), "m.json"), ImportMapping());
  EXPECT_THROW(writeMapping(rate, folder / "m.json"), FileError);
  EXPECT_EQ(readMapping(folder / "m.json"), wholeMapping());
}

TEST(ImportMapping, TheExampleOfTheHeaderIsOne) {
  const ImportMapping mapping = mappingFromJson(
      R"({"format": "palpate import mapping 1",
          "text": {"delimiter": "semicolon", "decimal": ",", "header": "present"},
          "time": {"column": "t", "unit": "ms", "start": "2026-11-22T10:31:05Z"},
          "matrices": [{"matrix": 0, "columns": "left[{y}][{x}]", "scale": 0.1, "offset": -2, "unit": "kPa"},
                       {"matrix": 1, "columns": "#86..#169", "order": "columns"}],
          "angles": {"columns": "joint*", "unit": "rad", "time": "joint_time"},
          "temperatures": {"columns": "none"}, "components": "planar"})",
      "m.json");
  EXPECT_EQ(mapping.components, ComponentOrder::kPlanar);
  EXPECT_EQ(mapping.text.delimiter, ';');
  ASSERT_EQ(mapping.matrices.size(), 2u);
  EXPECT_EQ(mapping.matrices[0].values.scale, 0.1);
  EXPECT_TRUE(mapping.matrices[1].columnByColumn);
  EXPECT_EQ(mapping.angles.time, "joint_time");
}

TEST(ImportMapping, RefusesWhatMakesNoSenseWithItsPlace) {
  const auto refused = [](const std::string& rest) -> std::string {
    try {
      mappingFromJson(R"({"format": "palpate import mapping 1", )" + rest + "}", "m.json");
    } catch (const FormatError& error) {
      return error.what();
    }
    return "";
  };
  const std::vector<std::pair<std::string, std::string>> cases = {
      {R"("colour": 1)", "unknown key \"colour\""},
      {R"("time": {"unit": "weeks"})", "time.unit is not s, ms"},
      {R"("time": {"rate_hz": 0})", "time.rate_hz"},
      {R"("time": {"rate_hz": "fast"})", "time.rate_hz is not a number"},
      {R"("time": {"start": "yesterday"})", "time.start is not a date"},
      {R"("time": [])", "time is not an object"},
      {R"("matrices": {})", "matrices is not a list"},
      {R"("matrices": [{"columns": "a", "scale": 0}])", "matrices[0].scale is 0"},
      {R"("matrices": [{"columns": "a"}, {}])", "matrices[1] names no columns"},
      {R"("matrices": [{"columns": "a", "matrix": 1.5}])", "matrices[0].matrix"},
      {R"("matrices": [{"columns": "a", "order": "x"}])", "matrices[0].order"},
      {R"("matrices": [{"columns": 3}])", "matrices[0].columns is not a text"},
      {R"("text": {"decimal": ";"})", "text.decimal"},
      {R"("components": "xyz")", "components is not interleaved or planar"},
      {R"("text": {"delimiter": "|"})", "text.delimiter"},
      {R"("text": {"header": "yes"})", "text.header"}};
  for (const auto& [rest, words] : cases) {
    const std::string what = refused(rest);
    EXPECT_NE(what.find(words), std::string::npos) << rest << ": " << what;
    EXPECT_EQ(what.find("m.json: "), 0u) << what;
  }
  EXPECT_THROW(mappingFromJson("{}", "m.json"), FormatError);
  EXPECT_THROW(mappingFromJson("[1]", "m.json"), FormatError);
  EXPECT_THROW(mappingFromJson("// no\n{}", "m.json"), FormatError);
}

}  // namespace
}  // namespace palpate::import_mapping_test
