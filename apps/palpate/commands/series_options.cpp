#include "commands/series_options.h"

#include <map>
#include <memory>
#include <stdexcept>
#include <utility>

#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/device/series_source.h"

namespace palpate::commands {
namespace {

std::pair<std::string, std::string> seriesValue(const std::string& option,
                                                const std::string& text) {
  const std::size_t at = text.find('=');
  if (at == std::string::npos || at == 0 || at + 1 == text.size())
    throw UsageError("--" + option + " needs NAME=" + (option == "series" ? "SOURCE" : "COLUMNS") +
                     ", not '" + escapedLine(text) + "'");
  return {text.substr(0, at), text.substr(at + 1)};
}

std::int64_t lostOf(const RecordingReport& report, const RecordedSeries& series) {
  return report.counter(seriesCounter(series.name, "lost")) + series.lost;
}

}  // namespace

std::vector<OptionSpec> seriesOptions() {
  return {{"series",
           "NAME=SOURCE",
           "also record rows of numbers of another sensor, SOURCE as for --stream, or PORT@BAUD; "
           "may be repeated"},
          {"series-columns",
           "NAME=COLUMNS",
           "what its numbers are, as 'time_ms,fx[N],fy[N]', where no header says it"}};
}

void addSeriesSources(const CommandLine& given, CaptureSession& session) {
  std::map<std::string, std::string> columns;
  for (const std::string& text : given.texts("series-columns"))
    if (!columns.insert(seriesValue("series-columns", text)).second)
      throw UsageError("--series-columns names '" + escapedLine(text) + "' a second time");
  bool takesInput = given.text("stream") == "-";
  for (const std::string& text : given.texts("series")) {
    SeriesSourceOptions options;
    std::string place;
    std::tie(options.name, place) = seriesValue("series", text);
    if (place == "-" && std::exchange(takesInput, true))
      throw UsageError("standard input (-) can be the source of one thing only");
    try {
      SeriesPlace from = seriesPlaceOf(place);
      options.source = std::move(from.source);
      options.baud = from.baud;
      if (const auto at = columns.extract(options.name)) options.columns = columnsOf(at.mapped());
      auto source = std::make_unique<SeriesSource>(std::move(options));
      if (source->isOpenToOthers())
        sayLine(text + ": any machine that reaches this address can send rows");
      session.addSeries(std::move(source));
    } catch (const std::invalid_argument& wrong) {
      throw UsageError("--series " + escapedLine(text) + ": " + escapedLine(wrong.what()));
    }
  }
  if (!columns.empty())
    throw UsageError("--series-columns: there is no --series " +
                     escapedLine(columns.begin()->first) + "=SOURCE");
}

SeriesNotice::SeriesNotice(const CaptureSession& session, bool quiet) : session_(session) {
  if (!quiet) shown_.resize(session.seriesSources().size());
}

void SeriesNotice::show() {
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    const SeriesSource& source = *session_.seriesSources()[i];
    Shown& shown = shown_[i];
    const std::string place = shown.place ? std::string() : source.notice();
    if (!place.empty()) sayLine(place);
    shown.place = shown.place || !place.empty();
    const PortStatus port = source.status().port;
    const bool comes = port.state == PortState::kStreaming;
    // Programs that must connect to a port of this machine were named above.
    const bool isSaid = port.message.empty() || port.message.starts_with("looking for") ||
                        (source.localPort() && port.items == 0);
    if (!comes && !isSaid && (!shown.missed || port.state != shown.state)) {
      sayLine("series " + source.name() + ": " + port.message);
      shown.missed = true;
    } else if (comes && std::exchange(shown.missed, false)) {
      sayLine("series " + source.name() + " is there");
    }
    if (comes || shown.missed) shown.state = port.state;
  }
}

std::string seriesText(const RecordingReport& report) {
  std::string text;
  for (const RecordedSeries& series : report.series)
    text += "; " + escapedLine(series.name) + ": " + counted(series.samples, "sample") + " (" +
            fixedText(series.rateHz, 1) + "/s), " + std::to_string(lostOf(report, series)) +
            " lost";
  return text;
}

Json seriesJson(const RecordingReport& report) {
  return jsonList(report.series, [&](const RecordedSeries& series) {
    return Json::object()
        .set("name", series.name)
        .set("samples", series.samples)
        .set("lost", lostOf(report, series))
        .set("refused", report.counter(seriesCounter(series.name, "suspect")))
        .set("rate_hz", series.rateHz > 0.0 ? Json(series.rateHz) : Json());
  });
}

std::string seriesLeftOutText(const RecordingReport& report, const CaptureSession& session) {
  std::string text;
  const auto add = [&](const std::string& name, const std::string& what) {
    text += (text.empty() ? "" : "; ") + ("series " + name + ": ") + what;
  };
  for (const auto& source : session.seriesSources()) {
    const std::string& name = source->name();
    const std::int64_t lost = report.counter(seriesCounter(name, "lost"));
    const std::int64_t refused = report.counter(seriesCounter(name, "suspect"));
    bool isEmpty = true;
    for (const RecordedSeries& series : report.series)
      isEmpty = isEmpty && !(series.name == name && series.samples > 0);
    if (isEmpty) add(name, "no row was recorded");
    if (lost > 0) add(name, "about " + counted(lost, "sample") + " lost");
    if (refused > 0)
      add(name, counted(refused, "row") + " refused (the last: " + source->lastFault() + ")");
  }
  return escapedLine(text);
}

}  // namespace palpate::commands
