#include "commands/ghosts_table.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "palpate/core/number_text.h"

namespace palpate::commands {
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

struct Figure {
  std::string name;
  double value = 0.0;
  int decimals = kDecimals;
};

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

std::vector<Figure> figuresOf(const GhostSource& source,
                              const GhostingReport& report,
                              bool emulated) {
  const MatrixGhosting total = report.total();
  const std::uint64_t matrixFrames = report.frames * report.matrices.size();
  std::vector<Figure> figures = {
      {"false_per_frame", per(total.falseTaxels.before, report.frames)},
      {"false_per_frame_after", per(total.falseTaxels.after, report.frames)},
      {"false_removed", total.falseTaxels.fractionRemoved()},
      {"scattered_per_frame", per(total.scattered.before, report.frames)},
      {"scattered_per_frame_after", per(total.scattered.after, report.frames)},
      {"scattered_removed", total.scattered.fractionRemoved()},
      {"frames_false", per(report.framesWithFalse.before, report.frames)},
      {"frames_false_after", per(report.framesWithFalse.after, report.frames)},
      {"whole_matrix", per(total.framesWhole.before, matrixFrames)},
      {"whole_matrix_after", per(total.framesWhole.after, matrixFrames)},
  };
  if (emulated) {
    figures.push_back({"touched_removed", report.touched.fractionRemoved()});
    for (const ContactSize size : kAllContactSizes)
      figures.push_back({std::string(nameOf(size)) + "_removed",
                         touchedOf(source, report, size).fractionRemoved()});
    figures.push_back(
        {"touched_sum_change", per(report.touchedSumAfter, report.touchedSumBefore) - 1.0});
    figures.push_back({"contacts", static_cast<double>(report.contacts.size()), 0});
    figures.push_back({"contacts_hidden", static_cast<double>(report.hidden()), 0});
    figures.push_back({"delay_mean_frames", report.meanDelayFrames()});
    figures.push_back({"delay_largest_frames", report.largestDelayFrames(), 0});
  }
  return figures;
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

std::vector<std::string> ghostHeader(bool emulated) {
  std::vector<std::string> header = {"recipe"};
  header.emplace_back(emulated ? "deg_c" : "file");
  header.insert(header.end(), {"below_counts", "frames"});
  for (const Figure& figure : figuresOf({}, {}, emulated)) header.push_back(figure.name);
  header.insert(header.end(), {"causal", "latency_frames", "cost_us"});
  return header;
}

std::vector<std::string> ghostCells(const Recipe& recipe,
                                    const GhostSource& source,
                                    const GhostingReport& report,
                                    bool emulated) {
  std::vector<std::string> cells = {recipeText(recipe)};
  cells.push_back(emulated ? numberText(source.degC) : source.file);
  cells.push_back(source.belowCounts ? numberText(*source.belowCounts) : "");
  cells.push_back(std::to_string(report.frames));
  for (const Figure& figure : figuresOf(source, report, emulated))
    cells.push_back(std::isnan(figure.value) ? "" : fixedText(figure.value, figure.decimals));
  cells.emplace_back(recipe.causal() ? "1" : "0");
  cells.push_back(report.latencyFrames ? std::to_string(*report.latencyFrames) : "");
  cells.push_back(fixedText(report.costUs, kCostDecimals));
  return cells;
}

Json ghostJson(const Recipe& recipe,
               const GhostSource& source,
               const GhostingReport& report,
               bool emulated) {
  Json json = Json::object().set("recipe", recipeText(recipe)).set("name", recipe.name);
  if (emulated)
    json.set("deg_c", source.degC);
  else
    json.set("file", source.file);
  json.set("below_counts", source.belowCounts ? Json(*source.belowCounts) : Json())
      .set("frames", report.frames);
  for (const Figure& figure : figuresOf(source, report, emulated))
    json.set(figure.name, figure.value);
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

}  // namespace palpate::commands
