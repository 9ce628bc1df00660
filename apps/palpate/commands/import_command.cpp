// The command `palpate import DATA --hand HAND` imports a table of another program as a recording.
#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/imports/import_time.h"
#include "palpate/imports/recording_import.h"

#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/hand_options.h"

namespace palpate::commands {
namespace fs = std::filesystem;
namespace {

constexpr std::array<OptionWord<char>, 2> kDecimalWords{{{"point", '.'}, {"comma", ','}}};
constexpr std::array<OptionWord<HeaderChoice>, 3> kHeaderWords{{{"present", HeaderChoice::kPresent},
                                                                {"absent", HeaderChoice::kAbsent},
                                                                {"detect", HeaderChoice::kDetect}}};
constexpr std::array<OptionWord<ComponentOrder>, 2> kComponentWords{
    {{"interleaved", ComponentOrder::kInterleaved}, {"planar", ComponentOrder::kPlanar}}};
constexpr OptionRange kRateHz{1e-6, 1e6, "Hz"};
constexpr OptionRange kFactor{-1e12, 1e12};

auto delimiterWords() {
  return wordsOf(std::array{"comma", "semicolon", "tab", "blank", "detect"},
                 [](const char* word) { return word; });
}

auto timeUnitWords() {
  return wordsOf(std::array{"s", "ms", "us", "ns", "min", "h", "iso", "dmy", "mdy"},
                 [](const char* word) { return word; });
}

// "2=left*" of --matrix; without a number all matrices.
MatrixMapping matrixOption(const std::string& text) {
  MatrixMapping made;
  const auto equals = text.find('=');
  made.columns = text;
  if (equals != std::string::npos)
    if (const auto matrix = parseInteger(text.substr(0, equals))) {
      if (*matrix < 0 || *matrix > 255)
        throw UsageError("--matrix: the number of the matrix is 0 to 255, not " +
                         std::to_string(*matrix));
      made.matrix = static_cast<std::size_t>(*matrix);
      made.columns = text.substr(equals + 1);
    }
  if (made.columns.empty()) throw UsageError("--matrix names no columns");
  return made;
}

// The mapping of --map with what the other options say instead.
ImportMapping importMappingOf(const CommandLine& given) {
  ImportMapping mapping;
  if (const auto file = given.text("map")) mapping = readMapping(*file);
  if (const auto delimiter = given.chosen("delimiter", delimiterWords()))
    mapping.text.delimiter = *delimiterNamed(*delimiter);
  if (const auto decimal = given.chosen("decimal", kDecimalWords)) mapping.text.decimal = *decimal;
  if (const auto header = given.chosen("header", kHeaderWords)) mapping.text.header = *header;
  if (const auto column = given.text("time")) {
    mapping.time.column = *column;
    mapping.time.rateHz.reset();
  }
  if (const auto unit = given.chosen("time-unit", timeUnitWords())) mapping.time.unit = *unit;
  if (const auto rate = given.number("rate", kRateHz)) mapping.time.rateHz = *rate;
  if (given.has("rate") && given.has("time"))
    throw UsageError("--rate makes the times: --time can't be given as well");
  if (const auto start = given.text("start")) {
    mapping.time.startUs = parseDate(*start);
    if (!mapping.time.startUs)
      throw UsageError("--start " + inQuotes(*start) +
                       " is not a date such as 2026-11-22T10:31:05Z");
  }
  if (given.has("matrix")) {
    mapping.matrices.clear();
    for (const std::string& text : given.texts("matrix"))
      mapping.matrices.push_back(matrixOption(text));
  }
  const bool scaled = given.has("scale") || given.has("offset") || given.has("unit");
  if (scaled && mapping.matrices.empty())
    throw UsageError("--scale, --offset and --unit need --matrix, or matrices in the mapping");
  for (MatrixMapping& matrix : mapping.matrices) {
    matrix.values.scale = given.number("scale", kFactor).value_or(matrix.values.scale);
    matrix.values.offset = given.number("offset", kFactor).value_or(matrix.values.offset);
    matrix.values.unit = given.text("unit").value_or(matrix.values.unit);
    if (matrix.values.scale == 0.0) throw UsageError("--scale 0 would make every value the same");
  }
  mapping.components = given.chosen("components", kComponentWords).value_or(mapping.components);
  if (const auto angles = given.text("angles")) mapping.angles.columns = *angles;
  if (const auto unit = given.text("angle-unit")) mapping.angles.values.unit = *unit;
  if (const auto temperatures = given.text("temperatures"))
    mapping.temperatures.columns = *temperatures;
  return mapping;
}

// NAME and the rest of "NAME=..".
std::pair<std::string, std::string> namedValue(const char* option, const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
    throw UsageError("--" + std::string(option) + " " + inQuotes(text) +
                     " is not NAME=" + (option == std::string_view("series") ? "FILE" : "HZ"));
  return {text.substr(0, equals), text.substr(equals + 1)};
}

// The tables of --series with the rates of --series-rate.
std::vector<SeriesFile> seriesFilesOf(const CommandLine& given) {
  std::vector<SeriesFile> files;
  const auto named = [&](const std::string& name) {
    return std::find_if(
        files.begin(), files.end(), [&](const SeriesFile& each) { return each.name == name; });
  };
  for (const std::string& text : given.texts("series")) {
    const auto [name, file] = namedValue("series", text);
    if (const std::string valid = seriesName(name); valid != name)
      throw UsageError(
          "--series: " + inQuotes(name) +
          " is not a name of a series: a small letter, then small letters, digits or _ (" + valid +
          ")");
    if (named(name) != files.end())
      throw UsageError("--series names " + inQuotes(name) + " twice; give each file its own name");
    files.push_back({name, file, std::nullopt});
  }
  for (const std::string& text : given.texts("series-rate")) {
    const auto [name, value] = namedValue("series-rate", text);
    const auto rate = parseDouble(value);
    if (named(name) == files.end())
      throw UsageError("--series-rate: there is no --series " + inQuotes(name));
    if (!rate || !(*rate >= 1e-6 && *rate <= 1e6))
      throw UsageError("--series-rate: " + inQuotes(value) + " is not a rate of 1e-6 to 1e6 Hz");
    named(name)->rateHz = *rate;
  }
  return files;
}

std::string secondsText(double seconds) { return fixedText(seconds, 3) + " s"; }

void printImportPreview(const ImportPreview& preview) {
  std::string text = preview.form + "\n";
  constexpr std::size_t kMaxShownColumns = 12;
  const std::size_t shown = std::min(kMaxShownColumns, preview.columns.size());
  text += counted(preview.columns.size(), "column") + ":\n";
  for (std::size_t c = 0; c < shown; ++c) {
    const TableColumn& column = preview.columns[c];
    text += "  #" + std::to_string(c + 1) + " " + column.name;
    if (!column.unit.empty()) text += " [" + column.unit + "]";
    if (column.numRows) text += ", " + counted(*column.numRows, "row");
    for (const std::size_t size : column.shape) text += " x " + std::to_string(size);
    text += ", " + column.type + ":";
    for (std::size_t r = 0; r < std::min<std::size_t>(4, preview.rows.size()); ++r)
      text += (r > 0 ? ", " : " ") + preview.rows[r][c];
    text += "\n";
  }
  if (shown < preview.columns.size())
    text += "  and " + std::to_string(preview.columns.size() - shown) + " more\n";
  for (const std::string& choice : preview.choices) text += choice + "\n";
  if (!preview.time.empty()) text += "time: " + preview.time + "\n";
  for (const std::string& note : preview.notes) text += "note: " + note + "\n";
  const ImportReport& sample = preview.sample;
  if (preview.problem.empty()) {
    text += (preview.isWhole ? "all " : "the first ") + counted(sample.rows, "row") + ": " +
            counted(sample.frames, "frame") + " in " + secondsText(sample.durationS) + ", " +
            fixedText(sample.meanRateHz, 1) + " Hz, " + counted(sample.gaps, "gap") + "\n";
    for (const ImportedSeries& series : sample.series) text += series.text() + "\n";
    if (sample.isPartial()) text += sample.lossText() + "\n";
  }
  std::string safe;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    safe += escapedLine(text.substr(at, end - at)) + "\n";
    at = end + 1;
  }
  std::fputs(safe.c_str(), stdout);
}

Json importJson(const fs::path& out, const ImportReport& report) {
  Json refused = Json::object();
  refused.set("wrong_count", static_cast<std::int64_t>(report.refused.wrongCount))
      .set("text", static_cast<std::int64_t>(report.refused.text))
      .set("not_finite", static_cast<std::int64_t>(report.refused.notFinite))
      .set("missing", static_cast<std::int64_t>(report.refused.missing))
      .set("not_later", static_cast<std::int64_t>(report.refused.notLater))
      .set("first", report.refused.first);
  return Json::object()
      .set("file", out.string())
      .set("rows", static_cast<std::int64_t>(report.rows))
      .set("frames", static_cast<std::int64_t>(report.frames))
      .set("joint_angles", static_cast<std::int64_t>(report.angles))
      .set("temperatures", static_cast<std::int64_t>(report.temperatures))
      .set("series",
           jsonList(report.series,
                    [](const ImportedSeries& series) {
                      return Json::object()
                          .set("name", series.description.name)
                          .set("columns",
                               jsonList(series.description.columns,
                                        [](const Column& column) {
                                          return Json::object()
                                              .set("name", column.name)
                                              .set("unit", column.unit);
                                        }))
                          .set("samples", static_cast<std::int64_t>(series.samples))
                          .set("mean_rate_hz", series.meanRateHz)
                          .set("gaps", static_cast<std::int64_t>(series.gaps))
                          .set("longest_gap_s", series.longestGapS);
                    }))
      .set("duration_s", report.durationS)
      .set("mean_rate_hz", report.meanRateHz)
      .set("gaps", static_cast<std::int64_t>(report.gaps))
      .set("longest_gap_s", report.longestGapS)
      .set("missing_frames", static_cast<std::int64_t>(report.missingFrames))
      .set("absent_frames", static_cast<std::int64_t>(report.absentFrames))
      .set("counter_restarts", static_cast<std::int64_t>(report.counterRestarts))
      .set("nul_bytes", static_cast<std::int64_t>(report.nulBytes.count))
      .set("refused", std::move(refused))
      .set("outside",
           Json::object()
               .set("above", static_cast<std::int64_t>(report.outside.above))
               .set("below", static_cast<std::int64_t>(report.outside.below))
               .set("nan", static_cast<std::int64_t>(report.outside.notANumber))
               .set("first", report.outside.first))
      .set("not_numbers",
           Json::object()
               .set("count", static_cast<std::int64_t>(report.notNumbers.count))
               .set("first", report.notNumbers.first))
      .set("notes", jsonList(report.notes))
      .set("doubts", jsonList(report.doubts));
}

std::string importText(const fs::path& out, const ImportReport& report) {
  std::string text = out.string() + ": " + counted(report.frames, "frame");
  if (report.angles > 0) text += ", " + counted(report.angles, "sample") + " of joint angles";
  if (report.temperatures > 0)
    text += ", " + counted(report.temperatures, "sample") + " of temperatures";
  text += " in " + secondsText(report.durationS);
  if (report.frames > 1) text += ", " + fixedText(report.meanRateHz, 1) + " Hz";
  if (report.gaps > 0)
    text +=
        ", " + counted(report.gaps, "gap") + " (longest " + secondsText(report.longestGapS) + ")";
  if (report.absentFrames > 0)
    text += "; " + counted(report.absentFrames, "frame") +
            " without an active taxel are not in the list";
  return text;
}

}  // namespace

int importCommand(const Arguments& words) {
  const CommandLine given(
      {.synopsis =
           "palpate import DATA --hand NAME|FOLDER [-o OUT.palpate] [--map M.json] [--preview]",
       .purpose = "Imports a table of another program as a recording: text (CSV, JSON lines, or "
                  "lines that microcontrollers print), NumPy's .npy and .npz, HDF5, MAT files; or "
                  "a folder with a file per frame or per matrix. A row is a frame. Columns "
                  "are found by names and shapes, or chosen: NAME, A..B, #3..#86 (by position, "
                  "from 1), left*, m{m}[{y}][{x}] (matrix, row, column), table[0]..table[5]. Other "
                  "columns of numbers become series in addition to the frames. Rows "
                  "that can't be used are left out and counted, and so are values outside of the "
                  "hand's range: exit code 3.",
       .options =
           {handOption(),
            {"output,o", "OUT.palpate", "default: DATA with the ending .palpate"},
            {"map", "M.json", "the mapping of an earlier import; other options override it"},
            {"save-map", "M.json", "save the mapping"},
            {"preview", "", "show columns, first rows and the mapping; write nothing"},
            {"json", "", "the report as JSON"},
            {"matrix",
             "[M=]COLUMNS",
             "the columns of matrix M (number or name), or of all matrices; may be repeated"},
            worded("components",
                   "ORDER",
                   "of taxels with three components: x, y, z of each taxel, or all x, then all y, "
                   "then all z",
                   kComponentWords,
                   "by the names"),
            ranged("scale", "X", "of the matrices: value = number * X + offset", kFactor),
            ranged("offset", "X", "see --scale", kFactor),
            {"unit", "UNIT", "of the matrices, after scale and offset (kPa, Pa, N, ..)"},
            {"angles", "COLUMNS", "the joint angles, in the order of the axes, or none"},
            {"angle-unit", "UNIT", "deg or rad, mm or m"},
            {"temperatures", "COLUMNS", "the temperatures, in the order of the sensors, or none"},
            {"time",
             "COLUMN",
             "the times of the rows; DATE,CLOCK or S,NS (S,US, S,MS): two columns; or a file with "
             "the times of the rows"},
            worded("time-unit",
                   "UNIT",
                   "dmy, mdy: dates with the day or month first",
                   timeUnitWords()),
            ranged("rate", "HZ", "rows at equal intervals, where there are no times", kRateHz),
            {"start",
             "DATE",
             "date of the first row (2026-11-22T10:31:05Z); the day of times of day"},
            {"series",
             "NAME=FILE",
             "import another table as the series NAME, with the times of its rows; may be "
             "repeated"},
            {"series-rate",
             "NAME=HZ",
             "rows of that table at equal intervals, where it has no times"},
            worded("delimiter", "NAME", "", delimiterWords(), "detect"),
            worded("decimal", "NAME", "", kDecimalWords, "point"),
            worded("header", "WORD", "a line of names", kHeaderWords, "detect"),
            {"strict", "", "fail at the first row that can't be used or has a NaN"},
            {"force", "", "replace OUT, and the file of --save-map"}},
       .example = "palpate import pad.csv --hand flat_pad_16x16 -o pad.palpate",
       .minArguments = 1,
       .maxArguments = 1},
      words);
  if (given.helpShown()) return kDone;
  const fs::path data = given.words()[0];
  if (!given.has("hand"))
    throw UsageError("import needs --hand NAME|FOLDER; 'palpate hands' lists the names");
  const bool preview = given.has("preview");
  for (const char* option : {"output", "save-map", "strict", "force", "json"})
    if (preview && given.has(option))
      throw UsageError("--preview writes nothing: leave out --" + std::string(option));
  const ImportMapping mapping = importMappingOf(given);
  const std::vector<SeriesFile> series = seriesFilesOf(given);
  const HandDescription hand = *handOf(given);
  if (preview) {
    const ImportPreview shown = previewImport(data, hand, mapping, series);
    printImportPreview(shown);
    if (shown.problem.empty()) return shown.sample.isPartial() ? kPartlyDone : kDone;
    throw Error(shown.problem);
  }
  fs::path out = given.text("output").value_or("");
  if (out.empty()) out = fs::path(data).replace_extension(".palpate");
  const Overwrite overwrite = given.has("force") ? Overwrite::kReplace : Overwrite::kRefuse;
  if (const auto file = given.text("save-map")) requireWritable(*file, overwrite);
  const ImportReport report = [&] {
    ProgressLine progress("importing " + data.string(), given.quiet());
    return importRecording(
        data,
        hand,
        mapping,
        out,
        {.series = series, .strict = given.has("strict"), .overwrite = overwrite},
        progress.callback());
  }();
  if (const auto file = given.text("save-map")) writeMapping(mapping, *file, overwrite);
  if (given.has("json")) {
    std::printf("%s\n", importJson(out, report).text().c_str());
  } else if (!given.quiet()) {
    std::printf("%s\n", escapedLine(importText(out, report)).c_str());
    for (const ImportedSeries& each : report.series)
      std::printf("%s\n", escapedLine(each.text()).c_str());
    for (const std::string& note : report.notes)
      std::printf("note: %s\n", escapedLine(note).c_str());
  }
  if (!report.isPartial()) return kDone;
  sayLine(data.string() + ": " + report.lossText());
  return kPartlyDone;
}

}  // namespace palpate::commands
