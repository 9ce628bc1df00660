#include "palpate/imports/recording_import.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/core/time.h"
#include "palpate/model/hand_file.h"
#include "palpate/model/timing.h"
#include "palpate/recording/palpate_writer.h"
#include "palpate/recording/recording.h"

#include "imports/import_rows.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMaxPreviewColumns = 64;

// The first rows of every column as texts, one column after the other: arrays may differ in length.
void readPreviewRows(TableSource& source, ImportPreview& preview) {
  const std::size_t numColumns = std::min(kMaxPreviewColumns, preview.columns.size());
  preview.rows.assign(kShownPreviewRows, std::vector<std::string>(numColumns));
  std::size_t numRows = 0;
  const auto isArray = [](const TableColumn& column) { return column.numRows.has_value(); };
  if (std::none_of(preview.columns.begin(), preview.columns.end(), isArray)) {  // all at once
    std::vector<std::size_t> chosen(numColumns);
    std::iota(chosen.begin(), chosen.end(), 0);
    source.start(chosen, std::nullopt);
    for (TableRow row; numRows < kShownPreviewRows && source.next(row); ++numRows)
      for (std::size_t c = 0; row.complete && c < numColumns; ++c)
        preview.rows[numRows][c] = source.textOf(c);
    preview.rows.resize(numRows);
    return;
  }
  for (std::size_t c = 0; c < numColumns; ++c) {
    const TableColumn& column = preview.columns[c];
    const bool isDateArray = column.hasDates && column.numRows.has_value();
    if (!column.isNumeric && !isDateArray) continue;
    const std::vector<std::size_t> chosen = {c};
    TableRow row;
    try {
      if (isDateArray)
        source.start({}, c);
      else
        source.start(chosen, std::nullopt);
    } catch (const FormatError&) {
      continue;  // it is refused where it is taken
    }
    for (std::size_t r = 0; r < kShownPreviewRows && source.next(row); ++r) {
      if (row.complete && isDateArray)
        preview.rows[r][c] = row.time.text.empty() ? utcText(row.time.whole.value_or(0))
                                                   : std::string(row.time.text);
      else if (row.complete)
        preview.rows[r][c] = source.textOf(0) + (column.width() > 1 ? " .." : "");
      numRows = std::max(numRows, r + 1);
    }
  }
  preview.rows.resize(numRows);
}

void requireImportable(const fs::path& data, const HandDescription& hand, const fs::path& out) {
  if (!hand.layout) throw std::invalid_argument("importRecording: the hand has no layout");
  if (formatOf(out).name != std::string_view("palpate"))
    throw FileError(out, "an import is written as .palpate; convert it afterwards");
  std::error_code ignored;
  if (fs::exists(out, ignored)) requireOther(data, out);
}

}  // namespace

std::string RefusedRows::summary() const {
  if (total() == 0) return {};
  std::string parts;
  const auto add = [&](std::uint64_t count, const char* what) {
    if (count > 0) parts += (parts.empty() ? "" : ", ") + std::to_string(count) + " " + what;
  };
  add(wrongCount, "of another form");
  add(text, "with text");
  add(notFinite, "with NaN or too large values");
  add(missing, "with missing values");
  add(notLater, "with a time that is not later");
  return counted(total(), "row") + " refused: " + parts;
}

std::string OutsideValues::summary() const {
  if (total() == 0) return {};
  std::string parts;
  const auto add = [&](std::uint64_t count, const char* what) {
    if (count > 0) parts += (parts.empty() ? "" : ", ") + std::to_string(count) + " " + what;
  };
  add(above, "above full scale");
  add(below, isSigned ? "below minus full scale" : "below 0");
  add(notANumber, "NaN (taken as 0)");
  return counted(total(), "value") + " outside the hand's range: " + parts;
}

std::string ImportedSeries::text() const {
  constexpr std::size_t kShown = 6;
  std::string names;
  for (std::size_t c = 0; c < std::min(kShown, description.columns.size()); ++c) {
    const Column& column = description.columns[c];
    names += (c > 0 ? ", " : "") + column.name;
    if (!column.unit.empty()) names += " [" + column.unit + "]";
  }
  if (description.columns.size() > kShown) names += ", ..";
  std::string text = "series " + description.name + ": " +
                     counted(description.columns.size(), "column") + " (" + names + "), " +
                     counted(samples, "sample");
  if (samples > 1) text += ", " + fixedText(meanRateHz, 1) + " Hz";
  if (gaps > 0)
    text += ", " + counted(gaps, "gap") + " (longest " + fixedText(longestGapS, 3) + " s)";
  return text;
}

std::string ImportReport::nulText() const {
  if (nulBytes.count == 0) return {};
  return counted(nulBytes.count, "byte") + " 0 left out (a power cut?), from line " +
         std::to_string(nulBytes.line) + " on";
}

std::string ImportReport::lossText() const {
  std::string text;
  const auto add = [&](const std::string& summary, const std::string& first) {
    if (summary.empty()) return;
    text += (text.empty() ? "" : "; ") + summary + "; the first: " + first;
  };
  add(refused.summary(), refused.first);
  if (refused.notLater > 0) text += "; where times repeat, --rate keeps all rows";
  add(outside.summary(), outside.first);
  if (notNumbers.count > 0)
    add(counted(notNumbers.count, "cell") + " of series " +
            (notNumbers.count == 1 ? "is not a number" : "are not numbers"),
        notNumbers.first);
  if (missingFrames > 0)
    add(counted(missingFrames, "frame") + (missingFrames == 1 ? " is" : " are") +
            " missing by the numbers in the file",
        firstMissing);
  if (nulBytes.count > 0) text += (text.empty() ? "" : "; ") + nulText();
  for (const std::string& doubt : doubts) text += (text.empty() ? "" : "; ") + doubt;
  return text;
}

ImportReport importRecording(const fs::path& data,
                             const HandDescription& hand,
                             const ImportMapping& mapping,
                             const fs::path& out,
                             const ImportOptions& options,
                             const Progress& progress) {
  requireImportable(data, hand, out);
  requireWritable(out, options.overwrite);
  const auto source = openTable(data, mapping.text);
  for (const SeriesFile& series : options.series) {
    std::error_code ignored;
    if (fs::equivalent(data, series.file, ignored))
      throw FileError(series.file, "is the table itself: its columns become series anyway");
    requireOther(series.file, out);
  }
  const ImportPlan plan = planImport(*source, hand, mapping, mapping.text, options.series);
  ImportReport report;
  RecordingMeta meta = handMeta(hand);
  meta["imported_from"] = data.filename().string();
  writePalpate(
      out,
      hand.layout,
      meta,
      [&](PalpateWriter& writer) {
        ImportSink sink;
        std::int64_t firstUs = 0;
        sink.frame = [&](const TactileFrame& frame) {
          if (firstUs == 0) firstUs = frame.hostUs;
          writer.addFrame(frame);
        };
        sink.sample = [&](const Sample& sample) { writer.addSample(sample); };
        for (const PlannedSeries& series : plan.series)
          if (series.kind == PlannedSeries::Kind::kFurther) writer.addSeries(series.further);
        ImportRows rows(hand, mapping, plan, options.strict, std::move(sink));
        rows.run(*source, UINT64_MAX, progress);
        report = rows.report();
        if (report.frames == 0)
          throw FormatError(data,
                            "no row can be used" + (report.refused.first.empty()
                                                        ? ": there is none"
                                                        : "; the first: " + report.refused.first));
        // Who reads the recording later has not seen what the import said.
        if (report.isPartial())
          writer.addEvent(
              {firstUs,
               firstUs,
               "alarm",
               {},
               "imported from " + shortened(data.filename().string()) + ": " + report.lossText(),
               ""});
      },
      options.overwrite);
  return report;
}

ImportPreview previewImport(const fs::path& data,
                            const HandDescription& hand,
                            const ImportMapping& mapping,
                            const std::vector<SeriesFile>& series) {
  const auto source = openTable(data, mapping.text);
  ImportPreview preview;
  preview.form = source->form();
  preview.columns = source->columns();
  readPreviewRows(*source, preview);
  try {
    const ImportPlan plan = planImport(*source, hand, mapping, mapping.text, series, kPreviewRows);
    std::vector<std::int64_t> stampsUs;
    ImportSink sink;
    sink.frame = [&](const TactileFrame& frame) { stampsUs.push_back(frame.hostUs); };
    ImportRows rows(hand, mapping, plan, false, std::move(sink));
    rows.run(*source, kPreviewRows, {});
    preview.rateHz = timingOf(stampsUs).rateHz;
    for (const PlannedSeries& each : plan.series)
      preview.choices.insert(
          preview.choices.end(), each.description.begin(), each.description.end());
    preview.time = plan.timeDescription;
    preview.sample = rows.report();
    preview.notes = preview.sample.notes;
    preview.isWhole = rows.atEnd();
    if (preview.sample.frames == 0)
      preview.problem =
          "no row can be used" + (preview.sample.refused.first.empty()
                                      ? std::string()
                                      : "; the first: " + preview.sample.refused.first);
  } catch (const FileError& error) {
    preview.problem = error.what();
  } catch (const FormatError& error) {
    preview.problem = error.what();
  }
  return preview;
}

}  // namespace palpate
