#include "gui/connect/sensor_rows.h"

#include <QStringList>
#include <cmath>
#include <utility>

#include <palpate/core/escaped_line.h>
#include <palpate/core/number_text.h>

#include "gui/appearance/captions.h"

namespace palpate::gui {
namespace {

constexpr std::size_t kRowsShown = 5;
constexpr std::size_t kColumnsShown = 8;

}  // namespace

SensorRows::SensorRows(SeriesSourceOptions options) : source_(std::move(options)) {
  source_.start(*this, kHandSeries);
}

SensorRows::~SensorRows() { source_.stop(); }

void SensorRows::onSample(Sample&& sample) {
  const std::lock_guard lock(mutex_);
  newest_.push_back(std::move(sample));
  if (newest_.size() > kRowsShown) newest_.pop_front();
}

QString SensorRows::text() const {
  const SeriesStatus status = source_.status();
  const bool comes = status.port.state == PortState::kStreaming;
  QString state = comes ? numberOf(status.port.items, "row") : QString("no rows come");
  if (status.rateHz > 0.0) state += ", " + figure(status.rateHz, 1) + "/s";
  if (status.port.suspect > 0)
    state += ", " + numberOf(status.port.suspect, "line") +
             " refused, the last: " + QString::fromStdString(escapedLine(source_.lastFault()));
  else if (!comes && !status.port.message.empty())
    state += ": " + QString::fromStdString(escapedLine(status.port.message));
  QStringList lines{state};
  const auto line = [&lines](std::size_t count, const auto& textOf) {
    QStringList cells;
    for (std::size_t i = 0; i < std::min(count, kColumnsShown); ++i) cells << textOf(i);
    if (count > kColumnsShown) cells << "…";
    lines << cells.join("  ");
  };
  const std::vector<Column> columns = source_.description().columns;
  if (!columns.empty())
    line(columns.size(), [&](std::size_t i) {
      const Column& column = columns[i];
      return QString::fromStdString(
          escapedLine(column.unit.empty() ? column.name : column.name + " [" + column.unit + "]"));
    });
  const std::lock_guard lock(mutex_);
  for (const Sample& sample : newest_)
    line(sample.values.size(), [&](std::size_t i) {
      const double value = sample.values[i];
      return std::isnan(value) ? QString("–") : QString::fromStdString(numberText(value));
    });
  return lines.join('\n');
}

}  // namespace palpate::gui
