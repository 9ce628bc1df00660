#include "gui/window_state/formula_curves.h"

#include <QStringList>
#include <algorithm>

#include <palpate/core/error.h>
#include <palpate/core/time.h>
#include <palpate/recording/crop.h>
#include <palpate/signals/formula.h>

namespace palpate::gui {
namespace {

constexpr const char* kFormulaCurvesKey = "plotted/formula_curves";
constexpr QChar kBetweenParts = '\t';

}  // namespace

SeriesChoice FormulaCurve::choice() const {
  return {.kind = SeriesChoice::Kind::kFormula, .formula = formula.toStdString()};
}

FormulaCurves::FormulaCurves(QSettings& settings, QObject* parent)
    : QObject(parent), settings_(settings) {
  for (const QString& text : settings_.value(kFormulaCurvesKey).toStringList()) {
    const QStringList parts = text.split(kBetweenParts);
    if (parts.size() == 3 && !parts[0].isEmpty() && !parts[1].isEmpty() && kept_.size() < kMaximum)
      kept_.push_back({parts[0], parts[1], parts[2]});
  }
}

std::optional<FormulaCurve> FormulaCurves::named(const QString& name) const {
  for (const FormulaCurve& each : kept_)
    if (each.name == name) return each;
  return std::nullopt;
}

bool FormulaCurves::keep(const FormulaCurve& curve) {
  const FormulaCurve clean{curve.name.simplified().left(kMaxNameLength),
                           curve.formula.simplified(),
                           curve.unit.simplified().left(kMaxNameLength)};
  if (clean.name.isEmpty() || clean.formula.isEmpty()) return false;
  std::erase_if(kept_, [&](const FormulaCurve& each) { return each.name == clean.name; });
  if (kept_.size() >= kMaximum) return false;
  kept_.push_back(clean);
  std::sort(kept_.begin(), kept_.end(), [](const FormulaCurve& a, const FormulaCurve& b) {
    return a.name < b.name;
  });
  store();
  return true;
}

void FormulaCurves::forget(const QString& name) {
  if (std::erase_if(kept_, [&](const FormulaCurve& each) { return each.name == name; }) > 0)
    store();
}

void FormulaCurves::store() {
  QStringList texts;
  for (const FormulaCurve& each : kept_)
    texts.append(QStringList{each.name, each.formula, each.unit}.join(kBetweenParts));
  settings_.setValue(kFormulaCurvesKey, texts);
  emit changed();
}

QString problemOf(const QString& formula, const Profile* profile) {
  if (formula.simplified().isEmpty()) return "Type a formula.";
  try {
    const Formula parsed(formula.simplified().toStdString());
    if (!profile || profile->numFrames() == 0) return {};
    // A few frames tell whether it can be computed: filters need frequencies below half the rate.
    constexpr std::size_t kTriedFrames = 200;
    // Cropped, so that a recording of hours is tried as quickly.
    const std::size_t last = std::min(profile->numFrames() - 1, kTriedFrames);
    const double toS =
        static_cast<double>(profile->frameTimeUs(last) - profile->frameTimeUs(0)) / kUsPerS;
    const Profile beginning = cropped(*profile, 0, last);
    // A further series may begin later, and a computed one isn't there: it can't be tried.
    const SeriesChoice choice{.kind = SeriesChoice::Kind::kFormula, .formula = parsed.text()};
    if (!hasSeries(beginning, choice)) {
      if (hasSeries(*profile, choice)) return {};
      (void)formulaSeries(*profile, parsed, 0.0, 0.0);  // throws: it names what is missing
    }
    (void)formulaSeries(beginning, parsed, 0.0, toS);
    return {};
  } catch (const Error&) {
    return {};  // the beginning is damaged: it can't be tried there
  } catch (const std::exception& error) {
    // "formula "..": " only repeats what stands in the field.
    const std::string message = error.what();
    const std::string before = "\": ";
    const auto begin =
        message.rfind("formula \"", 0) == 0 ? message.find(before) : std::string::npos;
    return QString::fromStdString(
        begin == std::string::npos ? message : message.substr(begin + before.size()));
  }
}

}  // namespace palpate::gui
