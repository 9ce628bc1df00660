#include "palpate/laboratory/ghost_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace palpate {
namespace {

constexpr const char* kCandidates[] = {
    "median",
    "median:masked=1",
    "median:size=5,masked=1",
    "opening:shape=cross,masked=1",
    "opening:shape=rectangle,masked=1",
    "opening:shape=ellipse,masked=1",
    "box:masked=1",
    "gaussian:masked=1",
    "bilateral:masked=1",
    "nlm:masked=1",
    "temporal-min:window=2",
    "temporal-min:window=3",
    "running-mean",
    "temporal-gaussian",
    "kalman",
    "median3d:masked=1",
    "min-median:window=2,size=1,masked=1",
    "min-median:window=3,size=1,masked=1",
    "min-median:window=4,size=1,masked=1",
    "min-median:window=2,size=3,masked=1",
    "min-median:window=3,size=3,masked=1",
    "min-median:window=2,size=5,masked=1",
    "min-median:window=3,size=5,masked=1",
    "median3d:size=1,window=3,masked=1",
    "median3d:size=1,window=5,masked=1",
    "temporal-min:window=2 | median:masked=1",
    "median:masked=1 | temporal-min:window=2",
    "min-median:window=2,size=1,masked=1 | opening:shape=cross,masked=1",
    "min-median:window=3,size=1,masked=1 | opening:shape=cross,masked=1",
    "min-median:window=2,size=1,masked=1 | median:masked=1",
    "median3d:masked=1 | temporal-min:window=2",
};

constexpr int kDecimals = 4;
constexpr int kCostDecimals = 2;

double per(double sum, double number) { return number > 0.0 ? sum / number : std::nan(""); }
double per(std::uint64_t sum, std::uint64_t number) {
  return per(static_cast<double>(sum), static_cast<double>(number));
}

BeforeAfter touchedOf(const GhostSource& source, const GhostingReport& report, ContactSize size) {
  BeforeAfter sum;
  for (const ContactGhosting& seen : report.contacts)
    for (const NoisyContact& made : source.contacts)
      if (made.size == size && made.matrix == seen.matrix && seen.begin >= made.begin &&
          seen.begin < made.end) {
        sum.before += seen.taxels.before;
        sum.after += seen.taxels.after;
      }
  return sum;
}

// A number of a row; nothing where it isn't known.
template <typename Of>
ColumnOf<GhostRow> figure(
    std::string name, std::string meaning, Of of, std::string unit = {}, int decimals = kDecimals) {
  return finiteColumn<GhostRow>(std::move(name), std::move(unit), std::move(meaning), of, decimals);
}

double matrixFrames(const GhostRow& row) {
  return static_cast<double>(row.report.frames * row.report.matrices.size());
}

// The figures of a row, those of contacts only for emulated frames.
std::vector<ColumnOf<GhostRow>> figureColumns(bool emulated) {
  using Row = GhostRow;
  std::vector<ColumnOf<Row>> columns = {
      figure(
          "false_per_frame",
          "active taxels that nothing touches, per frame",
          [](const Row& row) {
            return per(row.report.total().falseTaxels.before, row.report.frames);
          },
          "taxels"),
      figure(
          "false_per_frame_after",
          "active taxels that nothing touches, per frame, after the filters",
          [](const Row& row) {
            return per(row.report.total().falseTaxels.after, row.report.frames);
          },
          "taxels"),
      figure("false_removed",
             "part of them that the filters remove, 0 to 1",
             [](const Row& row) { return row.report.total().falseTaxels.fractionRemoved(); }),
      figure(
          "scattered_per_frame",
          "the false ones without matrices that are active as a whole, per frame",
          [](const Row& row) {
            return per(row.report.total().scattered.before, row.report.frames);
          },
          "taxels"),
      figure(
          "scattered_per_frame_after",
          "the false ones without matrices that are active as a whole, per frame, after the "
          "filters",
          [](const Row& row) { return per(row.report.total().scattered.after, row.report.frames); },
          "taxels"),
      figure("scattered_removed",
             "part of them that the filters remove, 0 to 1",
             [](const Row& row) { return row.report.total().scattered.fractionRemoved(); }),
      figure(
          "frames_false",
          "part of the frames with a false taxel, 0 to 1",
          [](const Row& row) { return per(row.report.framesWithFalse.before, row.report.frames); }),
      figure(
          "frames_false_after",
          "part of the frames with a false taxel, 0 to 1, after the filters",
          [](const Row& row) { return per(row.report.framesWithFalse.after, row.report.frames); }),
      figure("whole_matrix",
             "part of the matrices of which over a quarter is active, 0 to 1",
             [](const Row& row) {
               return per(static_cast<double>(row.report.total().framesWhole.before),
                          matrixFrames(row));
             }),
      figure("whole_matrix_after",
             "part of the matrices of which over a quarter is active, 0 to 1, after the filters",
             [](const Row& row) {
               return per(static_cast<double>(row.report.total().framesWhole.after),
                          matrixFrames(row));
             })};
  if (!emulated) return columns;
  columns.push_back(figure("touched_removed",
                           "part of the touched taxels that the filters remove, 0 to 1",
                           [](const Row& row) { return row.report.touched.fractionRemoved(); }));
  for (const ContactSize size : kAllContactSizes)
    columns.push_back(figure(std::string(nameOf(size)) + "_removed",
                             "the same of contacts of this size",
                             [size](const Row& row) {
                               return touchedOf(row.source, row.report, size).fractionRemoved();
                             }));
  columns.push_back(figure("touched_sum_change",
                           "change of the sum of the touched taxels, as a part of it",
                           [](const Row& row) {
                             return per(row.report.touchedSumAfter, row.report.touchedSumBefore) -
                                    1.0;
                           }));
  columns.push_back(columnOf<Row>("contacts", "", "number of contacts", [](const Row& row) {
    return row.report.contacts.size();
  }));
  columns.push_back(
      columnOf<Row>("contacts_hidden", "", "contacts that the filters remove", [](const Row& row) {
        return row.report.hidden();
      }));
  columns.push_back(figure(
      "delay_mean_frames",
      "frames by which a contact is seen later, mean",
      [](const Row& row) { return row.report.meanDelayFrames(); },
      "frames"));
  columns.push_back(figure(
      "delay_largest_frames",
      "the largest of these delays",
      [](const Row& row) { return row.report.largestDelayFrames(); },
      "frames",
      0));
  return columns;
}

Json bothJson(const BeforeAfter& counts) {
  return Json::object().set("before", counts.before).set("after", counts.after);
}

Json matrixJson(const MatrixGhosting& matrix) {
  return Json::object()
      .set("false_taxels", bothJson(matrix.falseTaxels))
      .set("scattered", bothJson(matrix.scattered))
      .set("frames_with_false", bothJson(matrix.framesWithFalse))
      .set("frames_whole", bothJson(matrix.framesWhole));
}

Json contactJson(const GhostSource& source, const ContactGhosting& contact) {
  Json json = Json::object();
  for (const NoisyContact& made : source.contacts)
    if (made.matrix == contact.matrix && contact.begin >= made.begin && contact.begin < made.end)
      json.set("size", nameOf(made.size)).set("peak_kpa", made.peakKpa);
  const auto delay = contact.delayFrames();
  return json.set("matrix", contact.matrix)
      .set("begin", contact.begin)
      .set("end", contact.end)
      .set("delay_frames", delay ? Json(*delay) : Json())
      .set("taxels", bothJson(contact.taxels))
      .set("sum_before", contact.sumBefore)
      .set("sum_after", contact.sumAfter);
}

}  // namespace

std::vector<Recipe> ghostCandidates() {
  std::vector<Recipe> candidates(recipePresets().begin(), recipePresets().end());
  for (const std::string text : kCandidates) {
    Recipe recipe = parseRecipe(std::array{text});
    const bool there = std::any_of(candidates.begin(), candidates.end(), [&](const Recipe& other) {
      return recipe.sameSteps(other);
    });
    if (!there) candidates.push_back(std::move(recipe));
  }
  return candidates;
}

std::unique_ptr<ResultTable> ghostTable(bool emulated,
                                        std::function<bool(std::vector<GhostRow>& rows)> more) {
  using Row = GhostRow;
  std::vector<ColumnOf<Row>> columns = {columnOf<Row>(
      "recipe", "", "the filters", [](const Row& row) { return recipeText(row.recipe); })};
  if (emulated)
    columns.push_back(columnOf<Row>("deg_c", "degC", "temperature of the hand", [](const Row& row) {
      return row.source.degC;
    }));
  else
    columns.push_back(
        columnOf<Row>("file", "", "the recording", [](const Row& row) { return row.source.file; }));
  columns.push_back(columnOf<Row>("below_counts",
                                  "counts",
                                  "how far the thresholds are below the noise floor",
                                  [](const Row& row) { return row.source.belowCounts; }));
  columns.push_back(columnOf<Row>(
      "frames", "", "number of frames", [](const Row& row) { return row.report.frames; }));
  for (ColumnOf<Row>& each : figureColumns(emulated)) columns.push_back(std::move(each));
  columns.push_back(
      columnOf<Row>("causal", "", "whether the filters need no later frame", [](const Row& row) {
        return row.recipe.causal();
      }));
  columns.push_back(columnOf<Row>(
      "latency_frames", "frames", "delay of the filters themselves", [](const Row& row) {
        return row.report.latencyFrames;
      }));
  columns.push_back(figure(
      "cost_us",
      "mean time that the filters take per frame",
      [](const Row& row) { return row.report.costUs; },
      "us",
      kCostDecimals));
  return std::make_unique<RowTable<Row>>("ghosts", std::move(columns), std::move(more));
}

Json ghostJson(const GhostRow& row, bool emulated) {
  const auto& [recipe, source, report] = row;
  Json json = Json::object().set("recipe", recipeText(recipe)).set("name", recipe.name);
  if (emulated)
    json.set("deg_c", source.degC);
  else
    json.set("file", source.file);
  json.set("below_counts", source.belowCounts ? Json(*source.belowCounts) : Json())
      .set("frames", report.frames);
  for (const ColumnOf<GhostRow>& each : figureColumns(emulated)) {
    const Cell cell = each.cell(row);
    if (const auto* whole = std::get_if<std::int64_t>(&cell))
      json.set(each.column.name, static_cast<double>(*whole));
    else
      json.set(each.column.name, numberOf(cell));
  }
  json.set("causal", recipe.causal())
      .set("latency_frames", report.latencyFrames ? Json(*report.latencyFrames) : Json())
      .set("cost_us", report.costUs)
      .set("frames_with_false", bothJson(report.framesWithFalse));
  Json matrices = Json::array();
  for (const MatrixGhosting& matrix : report.matrices) matrices.push(matrixJson(matrix));
  json.set("matrices", std::move(matrices));
  if (!emulated) return json;
  Json contacts = Json::array();
  for (const ContactGhosting& contact : report.contacts)
    contacts.push(contactJson(source, contact));
  json.set("contact_list", std::move(contacts));
  return json;
}

}  // namespace palpate
