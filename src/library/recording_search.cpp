#include "palpate/library/recording_search.h"

#include <algorithm>

#include "palpate/core/time.h"

namespace palpate {
namespace {

std::string pathWithin(const std::filesystem::path& path, const std::filesystem::path& folder) {
  const std::string& whole = path.native();
  const std::string& root = folder.native();
  if (root.empty() || !whole.starts_with(root)) return whole;
  std::string_view rest = std::string_view(whole).substr(root.size());
  while (rest.starts_with('/')) rest.remove_prefix(1);
  return std::string(rest);
}

}  // namespace

SearchableText searchableText(const RecordingDetails& details,
                              const std::filesystem::path& folder,
                              const CaseFolding& folded) {
  SearchableText text;
  const auto field = [&text](SearchKey key) -> std::string& {
    return text[static_cast<std::size_t>(key)];
  };
  field(SearchKey::kName) = details.path.filename().string();
  field(SearchKey::kPath) = pathWithin(details.path, folder);
  field(SearchKey::kOperator) = details.operatorName;
  field(SearchKey::kObject) = details.object;
  field(SearchKey::kRun) = details.run;
  field(SearchKey::kNotes) = details.notes;
  for (const std::string& label : details.labels) field(SearchKey::kLabel) += label + '\n';
  if (details.startUs) field(SearchKey::kDate) = localText(*details.startUs, "%Y-%m-%d %H:%M");
  field(SearchKey::kForm) = details.form;
  field(SearchKey::kState) = nameOf(details.state);
  for (std::string& part : text) part = folded(part);
  return text;
}

RecordingSearch::RecordingSearch(std::string_view text, const CaseFolding& folded) {
  std::string word;
  bool quoted = false;
  const auto end = [&] {
    if (!word.empty()) {
      Word made{folded(word), {}};
      const std::size_t colon = made.text.find(':');
      const auto key =
          colon == std::string::npos
              ? kSearchKeys.end()
              : std::find(kSearchKeys.begin(), kSearchKeys.end(), made.text.substr(0, colon));
      if (key != kSearchKeys.end()) {
        made.key = static_cast<std::size_t>(key - kSearchKeys.begin());
        made.text.erase(0, colon + 1);
      } else if (colon != std::string::npos) {
        const std::string before = made.text.substr(0, colon);
        const auto isLetter = [](char c) { return c >= 'a' && c <= 'z'; };
        if (!before.empty() && std::ranges::all_of(before, isLetter) &&
            std::ranges::find(unknownKeys_, before) == unknownKeys_.end())
          unknownKeys_.push_back(before);
      }
      // "object:" while the word behind it is still being typed
      if (!made.text.empty()) words_.push_back(std::move(made));
    }
    word.clear();
  };
  for (const char letter : text) {
    if (letter == '"') {
      quoted = !quoted;
    } else if (!quoted && (letter == ' ' || letter == '\t' || letter == '\n')) {
      end();
    } else {
      word += letter;
    }
  }
  end();
}

bool RecordingSearch::matches(const SearchableText& text) const {
  return std::all_of(words_.begin(), words_.end(), [&](const Word& word) {
    const auto holds = [&](const std::string& field) {
      return field.find(word.text) != std::string::npos;
    };
    return word.key ? holds(text[*word.key]) : std::any_of(text.begin(), text.end(), holds);
  });
}

}  // namespace palpate
