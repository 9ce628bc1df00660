// Phrases that the pages and messages of the project avoid, with the better form (the table "Words"
// of docs/architecture.md), and where they still are.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace palpate::testing {

struct AvoidedPhrase {
  std::string phrase;               // lower case; found as whole words
  std::string better;               // what to write instead
  std::vector<std::string> before;  // good English if one of these words precedes it
  std::vector<std::string> after;   // or follows it
};

// From the page: rows "| phrase | better | unless |". In the last column "x .." is a word before
// the phrase, ".. x" one after it; several are separated by commas.
std::vector<AvoidedPhrase> avoidedPhrases(std::string_view page);

// How often a phrase is in a text; line breaks count as blanks.
std::size_t countOf(const AvoidedPhrase& phrase, std::string_view text);

// The string literals of a C++ source, adjacent ones joined, one per line; no comments, no
// #include.
std::string literalsOf(std::string_view source);

// (file, phrase) -> count.
using PhraseCounts = std::map<std::pair<std::string, std::string>, std::size_t>;

// Lines "COUNT FILE PHRASE"; lines that begin with '#' are comments.
PhraseCounts parseCounts(std::string_view text);
std::string textOf(const PhraseCounts& counts);

}  // namespace palpate::testing
