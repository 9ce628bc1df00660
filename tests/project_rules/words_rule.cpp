#include "project_rules/words_rule.h"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <stdexcept>

#include "project_rules/source_tree.h"

namespace palpate::testing {
namespace {

bool isLetter(char letter) {
  return std::isalnum(static_cast<unsigned char>(letter)) || letter == '_';
}

// Lower case, with one blank for all blanks and line breaks.
std::string plainText(std::string_view text) {
  std::string plain;
  for (const char letter : text) {
    const auto code = static_cast<unsigned char>(letter);
    if (!std::isspace(code))
      plain += static_cast<char>(std::tolower(code));
    else if (!plain.empty() && plain.back() != ' ')
      plain += ' ';
  }
  return plain;
}

bool isWordAt(std::string_view text, std::size_t at, std::size_t size) {
  return (at == 0 || !isLetter(text[at - 1])) &&
         (at + size >= text.size() || !isLetter(text[at + size]));
}

// Whether `words` are right before `at`, with a blank between.
bool precedes(std::string_view text, std::size_t at, const std::string& words) {
  if (at < words.size() + 1) return false;
  const std::size_t begin = at - words.size() - 1;
  return text.substr(begin, words.size()) == words && isWordAt(text, begin, words.size());
}

bool follows(std::string_view text, std::size_t end, const std::string& words) {
  return end + 1 < text.size() && text.substr(end + 1, words.size()) == words &&
         isWordAt(text, end + 1, words.size());
}

// Behind a literal or comment that begins at `at`; appends what a literal says to `said`.
std::size_t behindQuoted(std::string_view source, std::size_t at, std::string* said) {
  const char quote = source[at];
  std::size_t i = at + 1;
  for (; i < source.size() && source[i] != quote && source[i] != '\n'; ++i) {
    if (source[i] == '\\' && ++i < source.size()) {
      if (said) *said += source[i] == 'n' || source[i] == 't' ? ' ' : source[i];
    } else if (said) {
      *said += source[i];
    }
  }
  return std::min(i + 1, source.size());
}

std::size_t behindRaw(std::string_view source, std::size_t at, std::string& said) {
  const std::size_t open = source.find('(', at);
  if (open == std::string_view::npos) return source.size();
  const std::string end = ")" + std::string(source.substr(at + 1, open - at - 1)) + "\"";
  const std::size_t close = source.find(end, open);
  if (close == std::string_view::npos) return source.size();
  said += source.substr(open + 1, close - open - 1);
  return close + end.size();
}

}  // namespace

std::vector<AvoidedPhrase> avoidedPhrases(std::string_view page) {
  std::vector<AvoidedPhrase> phrases;
  for (const std::string& line : sectionOf(page, "Words")) {
    const auto cells = cellsOf(line);
    if (cells.size() != 3 || cells[0] == "avoid" || cells[0].starts_with("--")) continue;
    AvoidedPhrase phrase{.phrase = cells[0], .better = cells[1], .before = {}, .after = {}};
    std::istringstream unless(cells[2]);
    for (std::string each; std::getline(unless >> std::ws, each, ',');) {
      if (each.ends_with(" .."))
        phrase.before.push_back(each.substr(0, each.size() - 3));
      else if (each.starts_with(".. "))
        phrase.after.push_back(each.substr(3));
      else
        throw std::invalid_argument("Words: '" + each + "' is neither 'x ..' nor '.. x'");
    }
    phrases.push_back(std::move(phrase));
  }
  return phrases;
}

std::size_t countOf(const AvoidedPhrase& phrase, std::string_view text) {
  const std::string plain = plainText(text);
  const std::size_t size = phrase.phrase.size();
  std::size_t count = 0;
  for (std::size_t at = plain.find(phrase.phrase); at != std::string::npos;
       at = plain.find(phrase.phrase, at + size)) {
    if (!isWordAt(plain, at, size)) continue;
    const bool isGood =
        std::any_of(phrase.before.begin(),
                    phrase.before.end(),
                    [&](const std::string& words) { return precedes(plain, at, words); }) ||
        std::any_of(phrase.after.begin(), phrase.after.end(), [&](const std::string& words) {
          return follows(plain, at + size, words);
        });
    if (!isGood) ++count;
  }
  return count;
}

std::string literalsOf(std::string_view source) {
  std::string literals;
  bool isApart = false;  // code since the last literal
  for (std::size_t i = 0; i < source.size();) {
    const std::string_view rest = source.substr(i);
    if (rest.starts_with("//") || rest.starts_with("#include")) {
      i = std::min(source.find('\n', i), source.size());
    } else if (rest.starts_with("/*")) {
      const std::size_t end = source.find("*/", i);
      i = end == std::string_view::npos ? source.size() : end + 2;
    } else if (rest[0] == '"' ||
               (rest.starts_with("R\"") && (i == 0 || !isLetter(source[i - 1])))) {
      if (isApart && !literals.empty()) literals += '\n';
      isApart = false;
      i = rest[0] == '"' ? behindQuoted(source, i, &literals) : behindRaw(source, i + 1, literals);
    } else if (rest[0] == '\'' && (i == 0 || !isLetter(source[i - 1]))) {  // not 1'000
      isApart = true;
      i = behindQuoted(source, i, nullptr);
    } else {
      isApart = isApart || !std::isspace(static_cast<unsigned char>(rest[0]));
      ++i;
    }
  }
  return literals;
}

PhraseCounts parseCounts(std::string_view text) {
  PhraseCounts counts;
  for (const std::string& line : linesOf(text)) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream cells(line);
    std::size_t count = 0;
    std::string file, phrase;
    if (!(cells >> count >> file) || !std::getline(cells >> std::ws, phrase))
      throw std::invalid_argument("no line 'COUNT FILE PHRASE': " + line);
    counts[{file, phrase}] = count;
  }
  return counts;
}

std::string textOf(const PhraseCounts& counts) {
  std::string text;
  for (const auto& [where, count] : counts)
    text += std::to_string(count) + " " + where.first + " " + where.second + "\n";
  return text;
}

}  // namespace palpate::testing
