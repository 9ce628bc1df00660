#include "palpate/recording/label_table.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <tuple>

#include "palpate/core/csv_rows.h"
#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/core/time.h"
#include "palpate/core/utf8.h"

namespace palpate {
namespace {

constexpr std::array<std::string_view, 4> kLabelKinds = {"label", "note", "mark", "segment"};
// The window notes a recording without grasps as this moment; it is no label.
constexpr std::string_view kNoGrasp = "no grasp";
constexpr int kTimeDecimals = 6;

bool isLabelKind(std::string_view kind) {
  return std::find(kLabelKinds.begin(), kLabelKinds.end(), kind) != kLabelKinds.end();
}

// Without blanks around it, in small letters.
std::string smallName(std::string_view name) {
  std::string small(trimmed(name));
  std::transform(small.begin(), small.end(), small.begin(), [](unsigned char letter) {
    return static_cast<char>(std::tolower(letter));
  });
  return small;
}

// Index of each column in the rows; nothing: the table doesn't have it.
struct LabelColumns {
  std::optional<std::size_t> begin, end, kind, text, matrix, file;
  std::size_t count = 0;
  bool textHasBlanks = false;  // behind each separator
};

LabelColumns columnsOf(const std::vector<std::string>& names) {
  LabelColumns columns;
  columns.count = names.size();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string name = smallName(names[i]);
    if (name == "begin_s") columns.begin = i;
    if (name == "end_s") columns.end = i;
    if (name == "kind") columns.kind = i;
    if (name == "text") columns.text = i;
    if (name == "matrix") columns.matrix = i;
    if (name == "file") columns.file = i;
  }
  if (columns.text) columns.textHasBlanks = names[*columns.text].starts_with(' ');
  if (!columns.begin || !columns.text)
    throw Error(
        "the first line must name the columns begin_s and text (and may name end_s, kind, matrix)");
  return columns;
}

// Reads rows of one recording. Throws Error with the problem of a row.
class LabelReader {
 public:
  LabelReader(const LabelColumns& columns,
              const Profile& profile,
              const std::filesystem::path& recording)
      : columns_(columns),
        hand_(profile.hand()),
        recording_(recording),
        numMatrices_(profile.layout().numMatrices()),
        beginUs_(profile.frameTimeUs(0)),
        endUs_(profile.frameTimeUs(profile.numFrames() - 1)) {}

  Event eventOf(const std::vector<std::string>& cells) const {
    if (cells.size() != columns_.count)
      throw Error("has " + counted(cells.size(), "cell") + ", the first line has " +
                  std::to_string(columns_.count));
    const auto cell = [&](const std::optional<std::size_t>& column) {
      return column ? std::string(trimmed(cells[*column])) : std::string();
    };
    Event event;
    event.kind = cell(columns_.kind).empty() ? "label" : cell(columns_.kind);
    if (!isLabelKind(event.kind))
      throw Error("kind " + quotedCell(event.kind) + " is not label, note, mark or segment");
    event.tUs = timeOf("begin_s", cell(columns_.begin));
    event.t1Us = cell(columns_.end).empty() ? event.tUs : timeOf("end_s", cell(columns_.end));
    if (event.t1Us < event.tUs) throw Error("ends before it begins");
    event.text = columns_.textHasBlanks ? cell(columns_.text) : cells[*columns_.text];
    if (!isUtf8(event.text)) throw Error("its text is not UTF-8: save the table as UTF-8");
    if (event.text.empty() && event.kind != "segment") throw Error("has no text");
    if (event.text.size() + event.kind.size() > kMaxEventBytes) throw Error("its text is too long");
    event.matrix = matrixOf(cell(columns_.matrix));
    return event;
  }

  // Whether a row is one of another recording.
  bool isOther(const std::vector<std::string>& cells) const {
    if (!columns_.file || cells.size() != columns_.count || recording_.empty()) return false;
    const std::filesystem::path named(trimmed(cells[*columns_.file]));
    std::error_code failure;
    if (named.empty() || std::filesystem::equivalent(named, recording_, failure)) return false;
    return std::filesystem::exists(named, failure) || named.filename() != recording_.filename();
  }

 private:
  std::int64_t timeOf(const std::string& name, const std::string& text) const {
    const auto seconds = parseDouble(text);
    if (!seconds) throw Error(name + " " + quotedCell(text) + " is not a number");
    const double lengthS = static_cast<double>(endUs_ - beginUs_) / kUsPerS;
    // Half a microsecond: the last time is written with six decimals.
    constexpr double kRounding = 0.6e-6;
    if (*seconds < -kRounding || *seconds > lengthS + kRounding)
      throw Error(name + " " + quotedCell(text) + " is outside the recording, which lasts " +
                  fixedText(lengthS, 3) + " s");
    return beginUs_ + std::llround(*seconds * kUsPerS);
  }
  std::optional<int> matrixOf(const std::string& text) const {
    if (text.empty()) return std::nullopt;
    const auto matrix = parseInteger(text);
    for (std::size_t m = 0; !matrix && m < std::min(numMatrices_, hand_.matrices.size()); ++m)
      if (smallName(text) == smallName(hand_.matrices[m].name) ||
          smallName(text) == smallName(hand_.matrices[m].shortName))
        return static_cast<int>(m);
    if (!matrix || *matrix < 0 || static_cast<std::size_t>(*matrix) >= numMatrices_)
      throw Error("matrix " + quotedCell(text) + " is not in 0.." +
                  std::to_string(numMatrices_ - 1) +
                  (matrix ? "" : ", and no matrix has this name"));
    return static_cast<int>(*matrix);
  }

  LabelColumns columns_;
  const HandDescription& hand_;
  const std::filesystem::path& recording_;
  std::size_t numMatrices_;
  std::int64_t beginUs_;
  std::int64_t endUs_;
};

}  // namespace

bool isTabledLabel(const Event& event) {
  const bool noGrasp = event.kind == "segment" && event.text == kNoGrasp && event.t1Us == event.tUs;
  return isLabelKind(event.kind) && !noGrasp;
}

std::unique_ptr<ResultTable> labelRows(std::span<const Event> events, const Profile& profile) {
  std::vector<Event> labels;
  if (profile.numFrames() > 0)
    std::copy_if(events.begin(), events.end(), std::back_inserter(labels), isTabledLabel);
  std::stable_sort(
      labels.begin(), labels.end(), [](const Event& a, const Event& b) { return a.tUs < b.tUs; });
  const std::int64_t beginUs = labels.empty() ? 0 : profile.frameTimeUs(0);
  const auto seconds = [beginUs](const char* name, const char* meaning, std::int64_t Event::*of) {
    return columnOf<Event>(
        name,
        "s",
        meaning,
        [beginUs, of](const Event& e) { return static_cast<double>(e.*of - beginUs) / kUsPerS; },
        kTimeDecimals);
  };
  return std::make_unique<RowTable<Event>>(
      "labels",
      std::vector<ColumnOf<Event>>{
          seconds("begin_s", "begin, from the first frame of the recording", &Event::tUs),
          seconds("end_s", "end, from the first frame of the recording", &Event::t1Us),
          columnOf<Event>("kind", "", "label, note, mark or segment", &Event::kind),
          columnOf<Event>("text", "", "what was noted", &Event::text),
          columnOf<Event>("matrix", "", "number of the matrix, from 0", &Event::matrix)},
      std::move(labels));
}

LabelTable readLabelTable(std::string_view csv,
                          const Profile& profile,
                          const std::filesystem::path& recording) {
  if (profile.numFrames() == 0) throw Error("the recording has no frames to label");
  if (csv.substr(0, 4).find('\0') != std::string_view::npos || csv.starts_with("\xFF\xFE") ||
      csv.starts_with("\xFE\xFF"))
    throw Error("is a text in UTF-16; save it as UTF-8");
  CsvRows lines(csv);
  std::vector<std::string> cells;
  if (!lines.next(cells)) throw Error("the table is empty");
  const LabelReader reader(columnsOf(cells), profile, recording);
  LabelTable table;
  while (lines.next(cells)) {
    const std::string line = "line " + std::to_string(lines.line()) + ": ";
    if (table.problems.size() == kMaximumTableProblems) {
      table.more = true;
      break;
    }
    if (table.events.size() == kMaximumLabels) {
      table.problems.push_back(line + "a table has at most " + std::to_string(kMaximumLabels) +
                               " labels");
      break;
    }
    try {
      if (lines.unclosed()) throw Error("a quote is never closed");
      if (reader.isOther(cells)) {
        ++table.numOthers;
        continue;
      }
      table.events.push_back(reader.eventOf(cells));
    } catch (const Error& error) {
      table.problems.push_back(line + error.what());
    }
  }
  if (table.numOthers > 0 && table.events.empty() && table.problems.empty())
    throw Error(
        "its column file names other recordings in each row; leave it out to take them all");
  return table;
}

std::vector<Event> newLabels(const LabelTable& table, std::span<const Event> present) {
  // Everything but the JSON.
  const auto keyOf = [](const Event& event) {
    return std::make_tuple(event.tUs, event.t1Us, event.kind, event.text, event.matrix);
  };
  std::set<decltype(keyOf(Event{}))> known;
  for (const Event& event : present) known.insert(keyOf(event));
  std::vector<Event> added;
  for (const Event& event : table.events)
    if (known.insert(keyOf(event)).second) added.push_back(event);
  return added;
}

}  // namespace palpate
