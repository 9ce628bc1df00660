#include "palpate/core/file_name.h"

#include <random>
#include <string>
#include <vector>

#include "testing/testing.h"

namespace palpate::file_name_test {
namespace {

TEST(NaturalOrder, numbersCountAsNumbers) {
  // Each before the next one.
  const std::vector<std::string> sorted{"",
                                        "2",
                                        "10",
                                        "99999999999999999999999",
                                        "100000000000000000000000",
                                        "a",
                                        "a-1",
                                        "a2b3",
                                        "a2b20",
                                        "a10b1",
                                        "ab",
                                        "run_1",
                                        "run_01",
                                        "run_2",
                                        "run_2.dsa",
                                        "run_02x",
                                        "run_10",
                                        "\xC3\xA4"};
  // "run_01" is "run_1" but for its zero: "run_0.." lies before "run_1" byte by byte.
  std::vector<std::string> expected = sorted;
  std::swap(expected[11], expected[12]);
  for (std::size_t i = 0; i < expected.size(); ++i)
    for (std::size_t k = 0; k < expected.size(); ++k)
      EXPECT_EQ(naturalOrder(expected[i], expected[k]), i <=> k)
          << expected[i] << " and " << expected[k];
}

TEST(NaturalOrder, isAnOrder) {
  std::mt19937 random(5);
  const auto text = [&random] {
    std::string made;
    for (unsigned i = 0; i < random() % 6; ++i) made += "0019a_"[random() % 6];
    return made;
  };
  for (int round = 0; round < 20000; ++round) {
    const std::string a = text();
    const std::string b = text();
    const std::string c = text();
    EXPECT_EQ(naturalOrder(a, b) == 0, a == b) << a << ", " << b;
    EXPECT_EQ(naturalOrder(a, b), 0 <=> naturalOrder(b, a)) << a << ", " << b;
    if (naturalOrder(a, b) < 0 && naturalOrder(b, c) < 0) {
      EXPECT_TRUE(naturalOrder(a, c) < 0) << a << ", " << b << ", " << c;
    }
  }
}

TEST(FileEnding, IsTheLastOneInSmallLettersWithItsDot) {
  EXPECT_EQ(lowerEndingOf("folder.x/Run_1.PALPATE"), ".palpate");
  EXPECT_EQ(lowerEndingOf("a.tar.Gz"), ".gz");
  EXPECT_EQ(lowerEndingOf("folder.x/name"), "");
  EXPECT_EQ(lowerEndingOf(".hidden"), "");
}

}  // namespace
}  // namespace palpate::file_name_test
