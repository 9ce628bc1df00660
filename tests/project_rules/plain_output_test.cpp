// What the program says is of this version: no string of it promises something, or excuses itself.
#include <array>
#include <cctype>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "project_rules/source_tree.h"

namespace palpate::testing::plain_output_test {
namespace {

constexpr std::array<std::string_view, 3> kForbidden = {"later version", "not yet", "todo"};

struct Literal {
  std::size_t line = 0;
  std::string text;
};

// String literals of C++; those that stand one behind the other are one, as the compiler has it.
class LiteralReader {
 public:
  explicit LiteralReader(std::string_view source) : source_(source) {}

  std::vector<Literal> read() {
    while (at_ < source_.size()) {
      const char c = source_[at_];
      if (std::isspace(static_cast<unsigned char>(c))) {
        advance(1);
      } else if (begins("//")) {
        advance(source_.find('\n', at_) - at_);
      } else if (begins("/*")) {
        advance(source_.find("*/", at_) + 2 - at_);
      } else if (begins("R\"")) {
        readRaw();
      } else if (c == '"') {
        readPlain();
      } else {
        joined_ = false;
        // A digit separator is no character literal.
        if (c == '\'' && (at_ == 0 || !std::isalnum(static_cast<unsigned char>(source_[at_ - 1]))))
          skipCharacter();
        else
          advance(1);
      }
    }
    return std::move(literals_);
  }

 private:
  bool begins(std::string_view word) const { return source_.substr(at_).starts_with(word); }
  void advance(std::size_t count) {
    const std::size_t end = count > source_.size() - at_ ? source_.size() : at_ + count;
    for (; at_ < end; ++at_) line_ += source_[at_] == '\n' ? 1 : 0;
  }
  void add(std::size_t line, std::string_view text) {
    if (!joined_) literals_.push_back({line, {}});
    literals_.back().text += text;
    joined_ = true;
  }
  void skipCharacter() {
    advance(1);
    while (at_ < source_.size() && source_[at_] != '\'') advance(source_[at_] == '\\' ? 2 : 1);
    advance(1);
  }
  void readPlain() {
    const std::size_t line = line_;
    std::string text;
    for (advance(1); at_ < source_.size() && source_[at_] != '"'; advance(1)) {
      if (source_[at_] != '\\') {
        text += source_[at_];
        continue;
      }
      advance(1);
      text += source_[at_] == 'n' || source_[at_] == 't' ? ' ' : source_[at_];
    }
    advance(1);
    add(line, text);
  }
  void readRaw() {
    const std::size_t open = source_.find('(', at_);
    const std::string end = ")" + std::string(source_.substr(at_ + 2, open - at_ - 2)) + "\"";
    const std::size_t close = source_.find(end, open);
    add(line_, source_.substr(open + 1, close - open - 1));
    advance(close + end.size() - at_);
  }

  std::string_view source_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  bool joined_ = false;
  std::vector<Literal> literals_;
};

// In small letters, a single blank for each white space.
std::string plain(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (!std::isspace(static_cast<unsigned char>(c)))
      out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (!out.empty() && out.back() != ' ')
      out += ' ';
  }
  return out;
}

bool holdsWord(const std::string& text, std::string_view word) {
  const auto isLetter = [&](std::size_t at) {
    return at < text.size() && std::isalnum(static_cast<unsigned char>(text[at]));
  };
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
    if ((at == 0 || !isLetter(at - 1)) && !isLetter(at + word.size())) return true;
  return false;
}

std::vector<std::string> forbiddenIn(std::string_view source) {
  std::vector<std::string> found;
  for (const Literal& literal : LiteralReader(source).read())
    for (const std::string_view word : kForbidden)
      if (holdsWord(plain(literal.text), word))
        found.push_back(std::to_string(literal.line) + ": " + std::string(word));
  return found;
}

TEST(PlainOutput, NoStringPromisesWhatIsNotThere) {
  std::size_t numFiles = 0;
  for (const SourceFile& file : cppFiles({"include", "src", "apps"})) {
    ++numFiles;
    for (const std::string& found : forbiddenIn(file.text))
      ADD_FAILURE() << file.path << ":" << found;
  }
  EXPECT_GT(numFiles, 500u);
}

TEST(PlainOutput, IsReadFromStringsAlone) {
  using Found = std::vector<std::string>;
  EXPECT_EQ(forbiddenIn("a;\nsay(\"comes in a later \"\n  // why\n  \"version\");"),
            Found{"2: later version"});
  EXPECT_EQ(forbiddenIn("say(\"Not\\nyet known\");"), Found{"1: not yet"});
  EXPECT_EQ(forbiddenIn("say(R\"(a \"quoted\" TODO: it)\");"), Found{"1: todo"});
  EXPECT_EQ(forbiddenIn("x = '\"'; // not yet\nsay(\"\\\"\" /* TODO */); y = 1'000; toDouble();"),
            Found{});
  EXPECT_EQ(forbiddenIn("say(\"mastodon\", \"a later\", \"version\");"), Found{});
}

}  // namespace
}  // namespace palpate::testing::plain_output_test
