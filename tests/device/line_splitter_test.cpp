// The ends of lines, lines that are too long or cut off, and what is counted of them.
#include "palpate/device/line_splitter.h"

#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace palpate::testing::line_splitter_test {
namespace {

using Kind = SplitLine::Kind;
using Texts = std::vector<std::string>;

struct Splitting {
  explicit Splitting(bool skipsFirst = false) : splitter(kLongest, skipsFirst) {}
  Splitting& push(std::string_view text, std::size_t piece = 1'000'000) {
    pushed += text.size();
    for (; !text.empty(); text.remove_prefix(std::min(piece, text.size()))) {
      splitter.push(std::as_bytes(std::span(text.substr(0, piece))), take);
      EXPECT_LE(splitter.pendingBytes(), kLongest);
    }
    expectEveryByteOnce();
    return *this;
  }
  void expectEveryByteOnce() const {
    const LineCounts& counts = splitter.counts();
    EXPECT_EQ(counts.lineBytes + counts.skippedBytes + splitter.pendingBytes(), pushed);
  }

  static constexpr std::size_t kLongest = 10;
  LineSplitter splitter;
  std::size_t pushed = 0;
  Texts texts;  // "2 text"; of other kinds "2!" (too long), "2?" (cut off)
  LineSplitter::Take take = [this](const SplitLine& line) {
    texts.push_back(std::to_string(line.number) + (line.kind == Kind::kTooLong ? "!"
                                                   : line.kind == Kind::kCutOff
                                                       ? "?"
                                                       : " " + std::string(line.text)));
  };
};

TEST(LineSplitter, EveryUsualEndEndsOneLine) {
  for (const std::string end : {"\n", "\r", "\r\n", "\n\r", "\r\r\n"})
    for (const std::size_t piece : {1, 2, 3, 100}) {
      Splitting split;
      split.push("a" + end + "bc" + end + "d", piece);
      EXPECT_EQ(split.texts, (Texts{"1 a", "2 bc"})) << ::testing::PrintToString(end) << piece;
      split.splitter.endLine(split.take);
      EXPECT_EQ(split.texts.back(), "3 d");
      split.expectEveryByteOnce();
    }
}

TEST(LineSplitter, EmptyLinesAreLines) {
  EXPECT_EQ(Splitting().push("a\n\nb\n").texts, (Texts{"1 a", "2 ", "3 b"}));
  EXPECT_EQ(Splitting().push("a\r\n\r\nb\r\n").texts, (Texts{"1 a", "2 ", "3 b"}));
  EXPECT_EQ(Splitting().push("a\r\rb\r").texts, (Texts{"1 a", "2 ", "3 b"}));
}

TEST(LineSplitter, ALineThatIsTooLongIsToldOnceAndSkipped) {
  for (const std::size_t piece : {1, 4, 100}) {
    Splitting split;
    split.push("0123456789\n01234567890123456789\nb\n", piece);
    EXPECT_EQ(split.texts, (Texts{"1 0123456789", "2!", "3 b"})) << piece;
    EXPECT_EQ(split.splitter.counts().lines, 3u);
    EXPECT_EQ(split.splitter.counts().skippedBytes, 21u);
  }
}

TEST(LineSplitter, TheFirstLineMayBeSkippedWithoutAWord) {
  Splitting split(/*skipsFirst=*/true);
  split.push("a rest that is long\nb\n", 5);
  EXPECT_EQ(split.texts, (Texts{"2 b"}));
  EXPECT_EQ(split.splitter.counts().skippedBytes, 20u);
}

TEST(LineSplitter, WhatMayLackDigitsIsCutOff) {
  const auto lastOf = [](std::string_view text) {
    Splitting split;
    split.push("a\n").push(text);
    split.splitter.cutOff(split.take);
    EXPECT_EQ(split.splitter.pendingBytes(), 0u);
    split.expectEveryByteOnce();
    return split.texts.back();
  };
  EXPECT_EQ(lastOf("1,2"), "2?");
  for (const std::string whole : {"[1, 2] ", "{\"a\":1}", "# note", "(1)"})
    EXPECT_EQ(lastOf(whole), "2 " + whole);
  EXPECT_EQ(lastOf(std::string_view("1\0", 2)), "2 " + std::string("1\0", 2));
  EXPECT_EQ(lastOf("01234567890"), "2!");
  EXPECT_EQ(lastOf(""), "1 a");
}

TEST(LineSplitter, AnotherConnectionBeginsWithALineAndGoesOnCounting) {
  Splitting split;
  split.push("a\nhalf");
  split.splitter.restart();
  split.push("b\r");
  split.splitter.restart();
  split.push("\nc\n");  // this end belongs to nothing before
  EXPECT_EQ(split.texts, (Texts{"1 a", "2 b", "3 ", "4 c"}));
  EXPECT_EQ(split.splitter.counts().skippedBytes, 4u);
}

TEST(LineSplitter, ALineThatFailsIsNotHandedOutAgain) {
  Splitting split;
  split.push("1,");
  EXPECT_THROW(split.splitter.push(std::as_bytes(std::span("2\n", 2)),
                                   [](const SplitLine&) { throw std::runtime_error("fails"); }),
               std::runtime_error);
  split.splitter.cutOff(split.take);
  EXPECT_TRUE(split.texts.empty());
}

TEST(LineSplitter, PiecesMakeNoDifference) {
  std::mt19937 random(3);
  constexpr std::string_view kLetters = "ab\n\r\r\n";
  for (int i = 0; i < 300; ++i) {
    std::string text;
    for (int k = 0; k < 80; ++k) text += kLetters[random() % kLetters.size()];
    const std::size_t piece = 1 + random() % 7;
    EXPECT_EQ(Splitting().push(text, piece).texts, Splitting().push(text).texts);
  }
}

}  // namespace
}  // namespace palpate::testing::line_splitter_test
