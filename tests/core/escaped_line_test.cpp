#include "palpate/core/escaped_line.h"

#include "palpate/core/error.h"

#include "testing/testing.h"

namespace palpate::escaped_line_test {
namespace {

TEST(OneLine, KeepsWhatIsFitForALine) {
  for (const char* text : {"", "foam ball.dsa", "Größe 3.4 mm²", "手", "\xF0\x9F\x96\x90"})
    EXPECT_EQ(escapedLine(text), text);
}

TEST(OneLine, EscapesWhatBreaksOrBendsTheLine) {
  EXPECT_EQ(escapedLine("a\nb\r\tc"), "a\\nb\\r\\tc");
  EXPECT_EQ(escapedLine("\x1B[31mred"), "\\x1B[31mred");
  EXPECT_EQ(escapedLine(std::string_view("\0", 1)), "\\x00");
  EXPECT_EQ(escapedLine("\xC2\x85"), "\\u{0085}");  // C1: next line
  EXPECT_EQ(escapedLine("a\xE2\x80\xAE"
                        "b"),
            "a\\u{202E}b");                             // right-to-left override
  EXPECT_EQ(escapedLine("\xE2\x80\xA8"), "\\u{2028}");  // line separator
}

TEST(OneLine, ShowsBytesThatAreNoUtf8) {
  EXPECT_EQ(escapedLine("a\xFF"
                        "b"),
            "a\\xFFb");
  EXPECT_EQ(escapedLine("\xC0\x80"), "\\xC0\\x80");           // overlong
  EXPECT_EQ(escapedLine("\xED\xA0\x80"), "\\xED\\xA0\\x80");  // a surrogate
  EXPECT_EQ(escapedLine("\xE2\x80"), "\\xE2\\x80");           // cut
}

TEST(OneLine, BeginningNeverCutsACharacter) {
  EXPECT_EQ(beginningOf("abc", 5), "abc");
  EXPECT_EQ(beginningOf("abcdef", 3), "abc");
  EXPECT_EQ(beginningOf("ab\xC3\xA4", 3), "ab");
  EXPECT_EQ(beginningOf("\x80\x80\x80", 2), "");
}

TEST(OneLine, TextOfAFileIsShownByItsFirst100Bytes) {
  const std::string longest(100, 'a');
  EXPECT_EQ(shortened(longest), longest);
  EXPECT_EQ(shortened(longest + "b"), longest + "..");
  EXPECT_EQ(inQuotes(longest + "b"), "\"" + longest + "..\"");
  EXPECT_EQ(shortened("a\nb"), "a\\nb");
  // What is escaped takes no more room.
  EXPECT_EQ(shortened(std::string(60, '\x1B')), shortened(std::string(100'000, '\x1B')));
  EXPECT_EQ(shortened(std::string(60, '\x1B')).size(), 102u);
  // No character is cut in two.
  EXPECT_EQ(shortened(std::string(99, 'a') + "\xC3\xA4"), std::string(99, 'a') + "..");
}

TEST(OneLine, ErrorsAreOneLineWhateverTheyName) {
  EXPECT_STREQ(FileError("a\nb", "is\nodd").what(), "a\\nb: is\\nodd");
  EXPECT_STREQ(FormatError("x\ty", "bad", 7).what(), "x\\ty: bad (at byte 7)");
}

TEST(Trimmed, TakesTheBlanksAroundATextAndNoneWithin) {
  EXPECT_EQ(trimmed(" \t a b\t "), "a b");
  EXPECT_EQ(trimmed("a"), "a");
  EXPECT_EQ(trimmed(" \t"), "");
  EXPECT_EQ(trimmed(""), "");
}

TEST(Trimmed, KnowsNoOtherBlanksThanItWasTold) {
  EXPECT_EQ(trimmed("a\n"), "a\n");
  EXPECT_EQ(trimmed("\r a\n", " \r\n"), "a");
}

}  // namespace
}  // namespace palpate::escaped_line_test
