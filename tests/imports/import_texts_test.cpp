#include "imports/import_texts.h"

#include <string>

#include <gtest/gtest.h>

namespace palpate::import_texts_test {
namespace {

TEST(ImportTexts, ASentenceHasItsValues) {
  constexpr Reason kReason{"%1: $2 is not ~2, 100 of %1"};
  EXPECT_EQ(
      sentenceOf(kReason, {"%2", std::string(101, 'a')}),
      "%2: \"" + std::string(100, 'a') + "..\" is not " + std::string(100, 'a') + ".., 100 of %2");
  EXPECT_EQ(sentenceOf(reason::kAxisByName, {}),
            "the last axis of the arrays is the frames, as its name says");
}

}  // namespace
}  // namespace palpate::import_texts_test
