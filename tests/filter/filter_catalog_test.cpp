#include "palpate/filter/filter_catalog.h"

#include <set>
#include <stdexcept>

#include "palpate/filter/filter_step.h"

#include "testing/testing.h"

namespace palpate::filter_catalog_test {
namespace {

TEST(FilterCatalog, HasThePromisedNamesKeysAndDefaults) {
  // interfaces: "box:size=3", "kalman:q=0.05,r=0.5", ...
  const std::pair<const char*, std::vector<std::pair<const char*, double>>> promised[] = {
      {"box", {{"size", 3}, {"masked", 0}}},
      {"gaussian", {{"size", 3}, {"masked", 0}}},
      {"median", {{"size", 3}, {"masked", 0}}},
      {"bilateral", {{"diameter", 3}, {"sigma_value", 50}, {"sigma_space", 3}, {"masked", 0}}},
      {"nlm", {{"patch", 3}, {"search", 5}, {"h", 50}, {"masked", 0}}},
      {"opening", {{"size", 3}, {"masked", 0}}},
      {"threshold", {{"above", 10}}},
      {"running-mean", {{"window", 5}, {"centred", 0}}},
      {"temporal-gaussian", {{"window", 5}, {"sigma", 1.5}, {"centred", 0}}},
      {"temporal-min", {{"window", 3}, {"centred", 0}}},
      {"kalman", {{"q", 0.05}, {"r", 0.5}}},
      {"rts", {{"q", 0.05}, {"r", 0.5}}},
      {"low-pass", {{"cutoff", 5}, {"order", 2}, {"centred", 0}}},
      {"high-pass", {{"cutoff", 0.5}, {"order", 2}, {"centred", 0}}},
      {"band-pass", {{"low", 1}, {"high", 5}, {"order", 2}, {"centred", 0}}},
      {"band-stop", {{"low", 4}, {"high", 6}, {"order", 2}, {"centred", 0}}},
      {"median3d", {{"size", 3}, {"window", 3}, {"masked", 0}, {"centred", 0}}},
      {"min-median", {{"window", 3}, {"size", 3}, {"masked", 0}, {"centred", 0}}},
      {"savitzky-golay", {{"window", 5}, {"order", 2}, {"derivative", 0}, {"centred", 0}}},
  };
  for (const auto& [name, options] : promised) {
    const FilterKind& kind = filterKind(name);
    for (const auto& [key, defaultValue] : options) {
      ASSERT_NE(kind.option(key), nullptr) << name << " " << key;
      EXPECT_EQ(kind.option(key)->defaultValue, defaultValue) << name << " " << key;
    }
  }
  EXPECT_TRUE(filterKind("gaussian").option("sigma")->automatic());
  EXPECT_EQ(filterKind("opening").option("shape")->choices,
            (std::vector<std::string>{"cross", "rectangle", "ellipse"}));
  for (const char* key : {"m", "e", "eta"})
    EXPECT_TRUE(filterKind("kelvin-voigt").option(key)->automatic()) << key;
}

TEST(FilterCatalog, EveryFilterSaysWhatItIs) {
  std::set<std::string> names;
  for (const FilterKind& kind : filterKinds()) {
    EXPECT_TRUE(names.insert(kind.name).second) << kind.name << " twice";
    EXPECT_FALSE(kind.title.empty() || kind.purpose.empty() || kind.border.empty() ||
                 kind.source.empty())
        << kind.name;
    for (const FilterOption& option : kind.options) {
      EXPECT_FALSE(option.purpose.empty()) << kind.name << " " << option.key;
      EXPECT_LT(option.minimum, option.maximum) << kind.name << " " << option.key;
      if (!option.automatic()) {
        EXPECT_GE(option.defaultValue, option.minimum) << kind.name << " " << option.key;
        EXPECT_LE(option.defaultValue, option.maximum) << kind.name << " " << option.key;
      }
    }
    EXPECT_NO_THROW(FilterStep{.name = kind.name}.validate()) << kind.name;
  }
  EXPECT_EQ(names.size(), 21u);
}

TEST(FilterCatalog, UnknownNamesListTheKnownOnes) {
  try {
    filterKind("medain");
    FAIL();
  } catch (const std::invalid_argument& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("\"medain\""), std::string::npos) << text;
    for (const FilterKind& kind : filterKinds())
      EXPECT_NE(text.find(kind.name), std::string::npos) << kind.name;
  }
}

}  // namespace
}  // namespace palpate::filter_catalog_test
