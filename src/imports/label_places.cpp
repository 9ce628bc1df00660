#include "palpate/imports/label_places.h"

#include <algorithm>

#include "palpate/core/error.h"
#include "palpate/imports/import_plan.h"

namespace palpate {
namespace {

// A table that has columns only.
class NamedColumns final : public TableSource {
 public:
  explicit NamedColumns(const std::vector<std::string>& names) {
    for (const std::string& name : names) columns_.push_back({.name = name, .type = "number"});
  }
  const std::filesystem::path& path() const noexcept override { return path_; }
  const std::vector<TableColumn>& columns() const noexcept override { return columns_; }
  std::string form() const override { return "labels"; }
  const char* rowWord() const noexcept override { return "line"; }
  void start(std::span<const std::size_t>, std::optional<std::size_t>) override {}
  bool next(TableRow&) override { return false; }
  double fraction() const noexcept override { return 1.0; }
  std::string textOf(std::size_t) const override { return {}; }
  std::string placeOf(std::size_t) const override { return {}; }

 private:
  std::filesystem::path path_ = "labels";
  std::vector<TableColumn> columns_;
};

}  // namespace

std::vector<std::size_t> placesOfLabels(const HandDescription& hand,
                                        const std::vector<std::string>& labels,
                                        std::vector<std::string>& notes) {
  NamedColumns table(labels);
  ImportMapping mapping;
  mapping.time.rateHz = 1.0;  // no label is a time
  mapping.angles.columns = mapping.temperatures.columns = kNoColumns;
  std::vector<std::size_t> places(labels.size());
  try {
    const ImportPlan plan = planImport(table, hand, mapping, {});
    const PlannedSeries& frames = plan.series.front();
    if (frames.columns.size() != labels.size()) return {};
    for (std::size_t i = 0; i < frames.columns.size(); ++i)
      places[frames.columns[i]] = frames.values[i].target.value();
    notes.insert(notes.end(), plan.notes.begin(), plan.notes.end());
    notes.insert(notes.end(), plan.doubts.begin(), plan.doubts.end());
  } catch (const Error&) {
    return {};
  }
  // Of fewer labels than places, the values are those of the taxels.
  std::vector<std::size_t> sorted = places;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t& place : places)
    place = static_cast<std::size_t>(std::lower_bound(sorted.begin(), sorted.end(), place) -
                                     sorted.begin());
  return places;
}

}  // namespace palpate
