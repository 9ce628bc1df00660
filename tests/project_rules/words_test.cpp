// Pages and messages avoid the phrases of the table "Words" in docs/architecture.md. Where old
// texts have them, words_exceptions.txt says how often; these numbers only become smaller.
#include <gtest/gtest.h>

#include "project_rules/source_tree.h"
#include "project_rules/words_rule.h"
#include "testing/testing.h"

namespace palpate::testing::words_test {
namespace {
namespace fs = std::filesystem;

constexpr const char* kExceptions = "tests/project_rules/words_exceptions.txt";

std::vector<AvoidedPhrase> phrases() {
  return avoidedPhrases(readFile(projectFolder() / "docs/architecture.md"));
}

// What people read: pages (not the table of the phrases itself) and string literals.
std::map<std::string, std::string> texts() {
  std::map<std::string, std::string> found;
  for (const char* name : {"README.md", "CHANGELOG.md", "CONTRIBUTING.md"})
    found[name] = readFile(projectFolder() / name);
  for (const auto& entry : fs::recursive_directory_iterator(projectFolder() / "docs"))
    if (entry.path().extension() == ".md")
      found[fs::relative(entry.path(), projectFolder()).generic_string()] = readFile(entry.path());
  std::string& own = found.at("docs/architecture.md");
  for (const std::string& line : sectionOf(own, "Words"))
    if (const auto at = own.find(line); cellsOf(line).size() == 3) own.erase(at, line.size());
  for (const SourceFile& file : cppFiles({"src", "apps"})) found[file.path] = literalsOf(file.text);
  return found;
}

TEST(Words, NewTextsAvoidThePhrases) {
  PhraseCounts now;
  std::map<std::string, std::string> better;
  const auto all = phrases();
  for (const auto& [name, text] : texts())
    for (const AvoidedPhrase& phrase : all) {
      better[phrase.phrase] = phrase.better;
      if (const std::size_t count = countOf(phrase, text)) now[{name, phrase.phrase}] = count;
    }
  const PhraseCounts allowed = parseCounts(readFile(projectFolder() / kExceptions));
  for (const auto& [where, count] : now) {
    const auto known = allowed.find(where);
    EXPECT_LE(count, known == allowed.end() ? 0 : known->second)
        << where.first << ": write '" << better.at(where.second) << "' for '" << where.second
        << "' (docs/architecture.md, Words)";
  }
  for (const auto& [where, count] : allowed) {
    const auto found = now.find(where);
    EXPECT_LE(count, found == now.end() ? 0 : found->second)
        << where.first << " has '" << where.second << "' less often: lower the number in "
        << kExceptions;
  }
  // The whole list as it would be.
  writeFile(fs::path(PALPATE_BUILD_FOLDER) / "words_exceptions.txt", textOf(now));
}

TEST(Words, TheTableNamesFifteenPhrases) {
  const auto all = phrases();
  EXPECT_GE(all.size(), 15u);
  for (const AvoidedPhrase& phrase : all) EXPECT_FALSE(phrase.better.empty()) << phrase.phrase;
}

TEST(Words, PhrasesAreWholeWordsInAnyCaseAndAcrossLines) {
  const AvoidedPhrase phrase{
      .phrase = "is no", .better = "is not a", .before = {"there"}, .after = {"longer"}};
  EXPECT_EQ(countOf(phrase, "A mark is no\n  label. This IS NO label."), 2u);
  EXPECT_EQ(countOf(phrase, "There is no label. It is no longer there. It is not. Chris nods."),
            0u);
  EXPECT_EQ(countOf(phrase, "It is no"), 1u);
}

TEST(Words, OfSourcesOnlyLiteralsAreRead) {
  EXPECT_EQ(literalsOf("#include \"a.h\"\n// \"no\"\nf(\"one \"\n  \"two\", 'x', \"th\\\"ree\");"),
            "one two\nth\"ree");
  EXPECT_EQ(literalsOf("/* \"no\" */ g('\"', 1'000, R\"x(raw \"text\")x\");"), "raw \"text\"");
}

TEST(Words, ExceptionsAreReadAsTheyAreWritten) {
  const PhraseCounts counts{{{"docs/a.md", "of its own"}, 2}, {{"src/b.cpp", "anew"}, 1}};
  EXPECT_EQ(parseCounts("# old texts\n" + textOf(counts)), counts);
  EXPECT_THROW(parseCounts("docs/a.md anew\n"), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::testing::words_test
