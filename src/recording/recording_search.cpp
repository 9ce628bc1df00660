#include "palpate/recording/recording_search.h"

#include <algorithm>
#include <cstdint>
#include <ctime>

namespace palpate {
namespace {

// Small letter of a code point below 0x800 (Unicode's simple case folding of these blocks).
std::uint32_t smallLetter(std::uint32_t point) {
  const auto within = [point](std::uint32_t first, std::uint32_t last) {
    return point >= first && point <= last;
  };
  if (within(0xC0, 0xDE) && point != 0xD7) return point + 0x20;  // Latin-1
  // Latin Extended-A: pairs, the capital first
  if (within(0x100, 0x12F) || within(0x132, 0x137) || within(0x14A, 0x177)) return point | 1;
  if ((within(0x139, 0x148) || within(0x179, 0x17E)) && point % 2 == 1) return point + 1;
  if (point == 0x178) return 0xFF;
  if (within(0x391, 0x3A9) && point != 0x3A2) return point + 0x20;  // Greek
  if (within(0x400, 0x40F)) return point + 0x50;                    // Cyrillic
  if (within(0x410, 0x42F)) return point + 0x20;
  return point;
}

std::string localDate(std::int64_t us) {
  const std::time_t seconds = static_cast<std::time_t>(us / 1'000'000);
  std::tm parts{};
  char text[32] = "";
  if (::localtime_r(&seconds, &parts)) std::strftime(text, sizeof text, "%Y-%m-%d %H:%M", &parts);
  return text;
}

std::string pathWithin(const std::filesystem::path& path, const std::filesystem::path& folder) {
  const std::string& whole = path.native();
  const std::string& root = folder.native();
  if (root.empty() || !whole.starts_with(root)) return whole;
  std::string_view rest = std::string_view(whole).substr(root.size());
  while (rest.starts_with('/')) rest.remove_prefix(1);
  return std::string(rest);
}

}  // namespace

std::string smallLetters(std::string_view text) {
  std::string small;
  small.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto lead = static_cast<unsigned char>(text[i]);
    if (lead >= 'A' && lead <= 'Z') {
      small += static_cast<char>(lead + 0x20);
      continue;
    }
    const auto next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0u;
    if (lead < 0xC2 || lead > 0xDF || (next & 0xC0) != 0x80) {
      small += text[i];
      continue;
    }
    const std::uint32_t point = smallLetter((lead & 0x1Fu) << 6 | (next & 0x3Fu));
    small += static_cast<char>(0xC0 | point >> 6);
    small += static_cast<char>(0x80 | (point & 0x3F));
    ++i;
  }
  return small;
}

SearchableText searchableText(const RecordingDetails& details,
                              const std::filesystem::path& folder) {
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
  if (details.startUs) field(SearchKey::kDate) = localDate(*details.startUs);
  field(SearchKey::kForm) = details.form;
  field(SearchKey::kState) = nameOf(details.state);
  for (std::string& part : text) part = smallLetters(part);
  return text;
}

RecordingSearch::RecordingSearch(std::string_view text) {
  std::string word;
  bool quoted = false;
  const auto end = [&] {
    if (!word.empty()) {
      Word made{smallLetters(word), {}};
      const std::size_t colon = made.text.find(':');
      const auto key =
          colon == std::string::npos
              ? kSearchKeys.end()
              : std::find(kSearchKeys.begin(), kSearchKeys.end(), made.text.substr(0, colon));
      if (key != kSearchKeys.end()) {
        made.key = static_cast<std::size_t>(key - kSearchKeys.begin());
        made.text.erase(0, colon + 1);
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
