#include "palpate/signals/min_max_decimation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace palpate {
namespace {

constexpr std::size_t kMaxPixelColumns = 1'000'000;

// The samples of one column that are kept.
class PixelColumn {
 public:
  explicit PixelColumn(std::span<const double> y) : y_(y) {}

  void add(std::size_t i) {
    if (empty_) {
      first_ = smallest_ = largest_ = i;
      empty_ = false;
    }
    // A NaN is never the smallest or the largest value.
    if (!(y_[i] >= y_[smallest_])) smallest_ = std::isnan(y_[i]) ? smallest_ : i;
    if (!(y_[i] <= y_[largest_])) largest_ = std::isnan(y_[i]) ? largest_ : i;
    last_ = i;
  }

  // Appends the kept samples in their order and begins a new column.
  void flush(std::span<const double> x, std::vector<SeriesPoint>& out) {
    if (empty_) return;
    std::array<std::size_t, 4> kept = {first_, smallest_, largest_, last_};
    std::sort(kept.begin(), kept.end());
    const auto end = std::unique(kept.begin(), kept.end());
    for (auto i = kept.begin(); i != end; ++i) out.push_back({x[*i], y_[*i]});
    empty_ = true;
  }

 private:
  std::span<const double> y_;
  bool empty_ = true;
  std::size_t first_ = 0;
  std::size_t smallest_ = 0;
  std::size_t largest_ = 0;
  std::size_t last_ = 0;
};

// PixelColumn of a position: -1 before the visible range, `columns` after it.
std::ptrdiff_t columnOf(double x, const DecimationOptions& options) {
  if (x < options.from) return -1;
  const auto columns = static_cast<std::ptrdiff_t>(options.columns);
  if (x > options.to) return columns;
  if (!(options.to > options.from)) return 0;
  const double fraction = (x - options.from) / (options.to - options.from);
  return std::min(static_cast<std::ptrdiff_t>(fraction * static_cast<double>(columns)),
                  columns - 1);
}

}  // namespace

void DecimationOptions::validate() const {
  if (!(std::isfinite(from) && std::isfinite(to) && from <= to))
    throw std::invalid_argument("DecimationOptions: from..to must be finite and ascending, is " +
                                std::to_string(from) + ".." + std::to_string(to));
  if (columns < 1 || columns > kMaxPixelColumns)
    throw std::invalid_argument("DecimationOptions: columns must be 1..1000000, is " +
                                std::to_string(columns));
}

std::vector<SeriesPoint> minMaxDecimated(std::span<const double> x,
                                         std::span<const double> y,
                                         const DecimationOptions& options) {
  options.validate();
  if (x.size() != y.size())
    throw std::invalid_argument("minMaxDecimated: " + std::to_string(x.size()) + " x, " +
                                std::to_string(y.size()) + " y");
  auto begin =
      static_cast<std::size_t>(std::lower_bound(x.begin(), x.end(), options.from) - x.begin());
  auto end = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), options.to) - x.begin());
  if (begin > 0) --begin;
  if (end < x.size()) ++end;

  std::vector<SeriesPoint> points;
  PixelColumn column(y);
  std::ptrdiff_t current = -1;
  auto nextBreak = std::lower_bound(options.breaks.begin(), options.breaks.end(), begin);
  for (std::size_t i = begin; i < end; ++i) {
    const std::ptrdiff_t its = columnOf(x[i], options);
    if (its != current) column.flush(x, points);
    current = its;
    column.add(i);
    if (nextBreak == options.breaks.end() || *nextBreak != i) continue;
    column.flush(x, points);
    if (i + 1 < end) points.push_back({x[i], std::numeric_limits<double>::quiet_NaN()});
    ++nextBreak;
  }
  column.flush(x, points);
  return points;
}

}  // namespace palpate
