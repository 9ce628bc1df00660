#include "gui/calibrate/calibration_facts.h"

#include <algorithm>
#include <cmath>

#include <palpate/core/number_text.h>

#include "gui/appearance/captions.h"
#include "gui/widgets/notes_label.h"

namespace palpate::gui {
namespace {

QString powerOf(const QString& name, int power) {
  if (power == 0) return {};
  return " " + name + (power == 1 ? "" : power == 2 ? "²" : "^" + QString::number(power));
}

// The measured range as text: "12.5 to 431 counts, 27.1 to 38.9 °C"
QString calibrationFactsRangeOf(const Surface& surface) {
  if (surface.hull.empty()) return "none";
  const auto [leastX, mostX] = std::minmax_element(
      surface.hull.begin(), surface.hull.end(), [](auto& a, auto& b) { return a.x < b.x; });
  const auto [leastT, mostT] = std::minmax_element(
      surface.hull.begin(), surface.hull.end(), [](auto& a, auto& b) { return a.t < b.t; });
  return "K " + figure(leastX->x, 0) + " to " + figure(mostX->x, 0) + " counts, " +
         figure(leastT->t, 1) + " to " + figure(mostT->t, 1) + " °C, inside the area of the points";
}

void addSurface(std::vector<Fact>& facts,
                const Surface& surface,
                const QString& name,
                const QString& x) {
  if (!surface.valid) {
    facts.push_back({name, "not determined", true});
  } else {
    facts.push_back({name, formulaOf(surface, x)});
    facts.push_back({name + " has an error of",
                     figure(surface.rmse, 2) + " kPa rmse, " + figure(surface.looRmse, 2) +
                         " kPa leave-one-out; " + numberOf(surface.numPoints, "step") + ", " +
                         numberOf(surface.numTerms, "term")});
  }
  for (const std::string& note : surface.notes)
    facts.push_back({name + ", note", QString::fromStdString(note), true});
}

QString textIn(const Json& json, const char* key) {
  const Json value = json.at(key);
  return value.isString() ? QString::fromStdString(value.asString()) : QString();
}

}  // namespace

QString notCalibratable(const HandDescription& hand) {
  if (hand.unit == "counts") return {};
  return "The values of this hand are " + QString::fromStdString(hand.unit) +
         " already: there is nothing to calibrate.";
}

QString formulaOf(const Surface& surface, const QString& x) {
  constexpr int kDigits = 4;
  QString text;
  for (std::size_t i = 0; i < surface.terms.size(); ++i) {
    const double c = surface.c[static_cast<Eigen::Index>(i)];
    if (c == 0.0) continue;
    text += text.isEmpty() ? (c < 0.0 ? "−" : "") : (c < 0.0 ? " − " : " + ");
    text += QString::number(std::abs(c), 'g', kDigits);
    text += powerOf(x, surface.terms[i].byX) + powerOf("T", surface.terms[i].byT);
  }
  return text.isEmpty() ? "0" : text;
}

std::vector<Fact> calibrationFacts(const Calibration& calibration) {
  const PressureModel& model = calibration.pressure;
  std::vector<Fact> facts;
  addSurface(facts, model.gain, "P(K, T) [kPa]", "K");
  facts.push_back({"measured", calibrationFactsRangeOf(model.gain), model.gain.hull.empty()});
  addSurface(facts, model.drift, "P(m, T) [kPa]", "m");
  facts.push_back({"temperature",
                   model.options.study ? QString("as in the study")
                                       : QString("of the motor nearest to the matrix")});
  facts.push_back({"without temperature",
                   figure(model.options.assumedDegC, 0) + " ± " +
                       figure(model.options.assumedSdDegC, 0) + " °C assumed"});
  facts.push_back({"fraction of the active area",
                   model.options.indenterAreaMm2 > 0.0
                       ? figure(model.areaFraction, 2) + " ± " + figure(model.areaFractionSd, 2) +
                             " (indenter of " + figure(model.options.indenterAreaMm2, 2) + " mm²)"
                       : QString("not known: the whole area of every active taxel is used"),
                   model.options.indenterAreaMm2 <= 0.0});
  if (model.steadyS > 0.0) facts.push_back({"steady after", figure(model.steadyS, 2) + " s"});
  if (model.creepMeasuredS > 0.0)
    facts.push_back({"creep measured for", figure(model.creepMeasuredS, 1) + " s"});
  facts.push_back({"sensor's settings",
                   "sensitivity " + figure(calibration.settings.sensitivity, 2) + ", threshold " +
                       figure(calibration.settings.thresholdCounts, 0) + " counts" +
                       (calibration.settings.assumed ? " (entered by hand)" : "")});
  facts.push_back({"measured on",
                   QString::fromStdString(calibration.hand) + ", matrix " +
                       QString::number(calibration.matrix)});
  facts.push_back({"made",
                   QString::fromStdString(calibration.madeAt) + " by palpate " +
                       QString::fromStdString(calibration.programVersion)});
  if (const QString table = textIn(calibration.options, "table"); !table.isEmpty())
    facts.push_back({"table", table});
  if (const QString hash = textIn(calibration.options, "table_sha256"); !hash.isEmpty())
    facts.push_back({"its SHA-256", hash});
  const auto used = std::count_if(calibration.samples.begin(),
                                  calibration.samples.end(),
                                  [](const auto& each) { return each.used; });
  facts.push_back({"steps",
                   QString::number(used) + " of " + QString::number(calibration.samples.size()) +
                       " used; each with its file's SHA-256",
                   used < static_cast<std::ptrdiff_t>(calibration.samples.size())});
  for (const std::string& note : model.notes)
    facts.push_back({"note", QString::fromStdString(note), true});
  return facts;
}

TextTable sampleTable(const ShownCalibrationPtr& now) {
  return {.header = {"file",
                     "sha256",
                     "pressure_kpa",
                     "K [counts]",
                     "m [counts/s]",
                     "temperature_c",
                     "told_kpa",
                     "told_sd_kpa",
                     "in_range",
                     "used",
                     "notes"},
          .numRows = now->calibration.samples.size(),
          .row = [now](std::size_t row) {
            const PressureSample& sample = now->calibration.samples[row];
            const PressureModel& model = now->calibration.pressure;
            const auto& degC = model.options.study ? sample.studyDegC : sample.nearestDegC;
            const bool known = model.valid() && sample.staticResponseCounts > 0.0;
            const PressureEstimate estimate =
                known ? model.pressureAt(sample.staticResponseCounts, degC) : PressureEstimate{};
            const auto given = [](bool there, double value) {
              return there ? numberText(value) : std::string();
            };
            return std::vector<std::string>{
                sample.file,
                sample.sha256,
                numberText(sample.pressureKpa),
                numberText(sample.staticResponseCounts),
                numberText(sample.driftCountsPerS),
                given(degC.has_value(), degC.value_or(0.0)),
                given(known, estimate.kpa),
                given(known, estimate.sdKpa),
                known && estimate.inRange ? "1" : "0",
                sample.used ? "1" : "0",
                linesOf(sample.notes).replace('\n', "; ").toStdString()};
          }};
}

TextTable factTable(const std::vector<Fact>& facts) {
  return {.header = {"what", "value"}, .numRows = facts.size(), .row = [facts](std::size_t row) {
            return std::vector<std::string>{facts[row].name.toStdString(),
                                            facts[row].value.toStdString()};
          }};
}

}  // namespace palpate::gui
