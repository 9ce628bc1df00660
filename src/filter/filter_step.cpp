#include "palpate/filter/filter_step.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"

namespace palpate {
namespace {

using FilterStepKind = FilterOption::Kind;

constexpr std::size_t kMaxMatrices = 1024;
constexpr int kMaxMedianValues = 2001;  // number of values of a median; takes some ms per frame
constexpr const char* kMatrices = "matrices";
constexpr const char* kRest = "rest";
constexpr const char* kNoise = "noise";
constexpr float kLargestRest = 1e9F;
constexpr char kBetweenValues = '/';

std::vector<std::string_view> split(std::string_view text, char at) {
  std::vector<std::string_view> parts;
  for (;;) {
    const auto end = text.find(at);
    parts.push_back(trimmed(text.substr(0, end)));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

std::string choicesOf(const FilterOption& option) {
  std::string text;
  for (const std::string& choice : option.choices) text += (text.empty() ? "" : ", ") + choice;
  return text;
}

std::string rangeOf(const FilterOption& option) {
  const std::string range = numberText(option.minimum) + ".." + numberText(option.maximum) +
                            (option.unit.empty() ? "" : " " + option.unit);
  switch (option.kind) {
    case FilterStepKind::kOdd:
      return "an odd number " + range;
    case FilterStepKind::kInteger:
      return "a whole number " + range;
    case FilterStepKind::kFlag:
      return "0 or 1";
    case FilterStepKind::kChoice:
      return "one of " + choicesOf(option);
    case FilterStepKind::kReal:
      break;
  }
  return "a number " + range;
}

[[noreturn]] void refuse(const FilterStep& step,
                         const FilterOption& option,
                         const std::string& is) {
  throw std::invalid_argument(step.name + ": " + option.key + " must be " + rangeOf(option) +
                              ", is " + is);
}

std::string unknownKey(const FilterKind& kind, std::string_view key) {
  return kind.name + ": unknown key \"" + shortened(key) + "\"; there are: " + kind.optionKeys() +
         ", " + kMatrices;
}

bool fits(const FilterOption& option, double value) {
  if (!std::isfinite(value) || value < option.minimum || value > option.maximum) return false;
  if (option.kind == FilterStepKind::kReal) return true;
  if (value != std::floor(value)) return false;
  return option.kind != FilterStepKind::kOdd || std::fmod(value, 2.0) == 1.0;
}

std::vector<std::size_t> parseMatrices(const FilterStep& step, std::string_view text) {
  std::vector<std::size_t> matrices;
  for (const std::string_view part : split(text, '+')) {
    const auto index = parseInteger(part);
    if (!index || *index < 0 || *index >= static_cast<std::int64_t>(kMaxMatrices))
      throw std::invalid_argument(step.name +
                                  ": matrices must be numbers joined by +, such as 1+3, is \"" +
                                  shortened(text) + "\"");
    matrices.push_back(static_cast<std::size_t>(*index));
  }
  std::sort(matrices.begin(), matrices.end());
  matrices.erase(std::unique(matrices.begin(), matrices.end()), matrices.end());
  return matrices;
}

std::vector<float> parseRest(const FilterStep& step, std::string_view key, std::string_view text) {
  std::vector<float> values;
  for (const std::string_view part : split(text, kBetweenValues)) {
    const auto number = parseDouble(part);
    if (!number || !(std::abs(*number) <= static_cast<double>(kLargestRest)))
      throw std::invalid_argument(step.name + ": " + std::string(key) +
                                  " must be numbers joined by /, such as 3/2.5, is \"" +
                                  shortened(text) + "\"");
    values.push_back(static_cast<float>(*number));
  }
  return values;
}

void requireRest(const FilterStep& step) {
  if (!step.rest) return;
  const Baseline& rest = *step.rest;
  const auto refuseRest = [&](const std::string& why) {
    throw std::invalid_argument(step.name + ": " + why);
  };
  if (step.name != "baseline") refuseRest("only the filter baseline has a rest");
  for (const auto& [key, value] : step.explicitOptions)
    if (!step.uses(*step.kind().option(key)))
      refuseRest(key + " has no meaning where the rest is given");
  if (rest.rest.empty()) refuseRest("noise without a rest");
  if (!rest.noise.empty() && rest.noise.size() != rest.rest.size())
    refuseRest("rest has " + std::to_string(rest.rest.size()) + " values, noise " +
               std::to_string(rest.noise.size()));
  for (const float value : rest.rest)
    if (!(std::abs(value) <= kLargestRest)) refuseRest("a value of the rest is not a number");
  for (const float value : rest.noise)
    if (!(value >= 0.0F && value <= kLargestRest)) refuseRest("noise must be 0 or more");
}

double parseValue(const FilterStep& step, const FilterOption& option, std::string_view text) {
  if (option.kind == FilterStepKind::kChoice) {
    const auto at = std::find(option.choices.begin(), option.choices.end(), text);
    if (at == option.choices.end()) refuse(step, option, "\"" + shortened(text) + "\"");
    return static_cast<double>(at - option.choices.begin());
  }
  if (option.automatic() && text == "auto") return option.defaultValue;
  const auto number = parseDouble(text);
  if (!number || !fits(option, *number)) refuse(step, option, "\"" + shortened(text) + "\"");
  return *number;
}

// The lower or upper edge of a band.
double edgeOf(const FilterStep& step, const char* key) {
  return step.kind().option("cutoff") != nullptr ? step.value("cutoff") : step.value(key);
}

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

}  // namespace

void FilterStep::validate() const {
  const FilterKind& kind = this->kind();
  for (const auto& [key, value] : explicitOptions) {
    const FilterOption* option = kind.option(key);
    if (option == nullptr) throw std::invalid_argument(unknownKey(kind, key));
    if (std::isnan(value) && option->automatic()) continue;
    if (!fits(*option, value)) refuse(*this, *option, numberText(value));
  }
  if (!std::is_sorted(matrices.begin(), matrices.end()))
    throw std::invalid_argument(name + ": matrices must be in ascending order");
  const FilterOption* window = kind.option("window");
  if (window != nullptr && valueOrZero("centred") != 0.0 && integer("window") % 2 == 0)
    throw std::invalid_argument(name + ": window must be odd with centred=1, is " +
                                std::to_string(integer("window")));
  if (name == "median3d" &&
      integer("size") * integer("size") * integer("window") > kMaxMedianValues)
    throw std::invalid_argument(
        name + ": size * size * window must be at most " + std::to_string(kMaxMedianValues) +
        ", is " + std::to_string(integer("size") * integer("size") * integer("window")));
  if (const auto butterworth = butterworthOf(*this)) butterworth->validate();
  requireRest(*this);
  if (name == "baseline" && !rest && value("from") >= value("to"))
    throw std::invalid_argument("baseline: from must be below to, " + numberText(value("to")) +
                                " s, is " + numberText(value("from")));
  if (kind.option("order") != nullptr && window != nullptr) {
    if (integer("order") >= integer("window"))
      throw std::invalid_argument(name + ": order must be below the window of " +
                                  std::to_string(integer("window")) + ", is " +
                                  std::to_string(integer("order")));
    if (integer("derivative") > integer("order"))
      throw std::invalid_argument(name + ": derivative " + std::to_string(integer("derivative")) +
                                  " of a polynomial of order " + std::to_string(integer("order")) +
                                  " is 0 everywhere: choose a higher order");
  }
}

void FilterStep::validateForRate(double rateHz) const {
  validate();
  const auto butterworth = butterworthOf(*this);
  if (butterworth && rateHz > 0.0) butterworth->validateForRate(rateHz);
}

double FilterStep::value(std::string_view key) const {
  const FilterKind& kind = this->kind();
  const FilterOption* option = kind.option(key);
  if (option == nullptr) throw std::invalid_argument(unknownKey(kind, key));
  const auto at = explicitOptions.find(key);
  return at == explicitOptions.end() ? option->defaultValue : at->second;
}

double FilterStep::valueOrZero(std::string_view key) const {
  return kind().option(key) == nullptr ? 0.0 : value(key);
}

bool FilterStep::uses(const FilterOption& option) const {
  return !rest || (option.key != "from" && option.key != "to");
}

bool FilterStep::causal() const {
  if (name == "baseline") return rest.has_value();
  if (name == "rts" || valueOrZero("centred") != 0.0) return false;
  if (name != "kelvin-voigt") return true;
  // A missing parameter is estimated from the whole stretch, so that the filter is not causal.
  for (const char* key : {"e", "eta", "q", "r"})
    if (std::isnan(value(key))) return false;
  return true;
}

std::optional<ButterworthOptions> butterworthOf(const FilterStep& step) {
  using Band = ButterworthOptions::Band;
  constexpr std::pair<const char*, Band> kBands[] = {{"low-pass", Band::kLowPass},
                                                     {"high-pass", Band::kHighPass},
                                                     {"band-pass", Band::kBandPass},
                                                     {"band-stop", Band::kBandStop}};
  for (const auto& [name, band] : kBands)
    if (step.name == name)
      return ButterworthOptions{.band = band,
                                .lowHz = edgeOf(step, "low"),
                                .highHz = edgeOf(step, "high"),
                                .order = step.integer("order")};
  return std::nullopt;
}

FilterStep parseFilterStep(std::string_view text) {
  FilterStep step;
  const auto colon = text.find(':');
  step.name = trimmed(text.substr(0, colon));
  if (step.name.empty())
    throw std::invalid_argument("expected a filter, such as \"median:size=3\"; there are: " +
                                filterNames());
  const FilterKind& kind = step.kind();
  if (colon != std::string_view::npos) {
    std::vector<std::string_view> seen;
    for (const std::string_view part : split(text.substr(colon + 1), ',')) {
      const auto equals = part.find('=');
      const std::string_view key = trimmed(part.substr(0, equals));
      if (equals == std::string_view::npos || key.empty())
        throw std::invalid_argument(step.name + ": \"" + shortened(part) +
                                    "\" isn't KEY=VALUE; keys: " + kind.optionKeys() + ", " +
                                    kMatrices);
      if (std::find(seen.begin(), seen.end(), key) != seen.end())
        throw std::invalid_argument(step.name + ": " + std::string(key) + " is given twice");
      seen.push_back(key);
      const std::string_view value = trimmed(part.substr(equals + 1));
      if (key == kMatrices) {
        step.matrices = parseMatrices(step, value);
        continue;
      }
      if (kind.name == "baseline" && (key == kRest || key == kNoise)) {
        if (!step.rest) step.rest.emplace();
        (key == kRest ? step.rest->rest : step.rest->noise) = parseRest(step, key, value);
        continue;
      }
      const FilterOption* option = kind.option(key);
      if (option == nullptr) throw std::invalid_argument(unknownKey(kind, key));
      const double number = parseValue(step, *option, value);
      if (!same(number, option->defaultValue)) step.explicitOptions[std::string(key)] = number;
    }
  }
  step.validate();
  return step;
}

namespace {
enum class RestText { kValues, kSize };
std::string optionsTextOf(const FilterStep& step, bool withDefaults, RestText restText) {
  std::string text = step.name;
  char before = ':';
  for (const FilterOption& option : step.kind().options) {
    const double value = step.value(option.key);
    if (!step.uses(option) || (!withDefaults && same(value, option.defaultValue))) continue;
    text += before + option.key + '=';
    if (std::isnan(value))
      text += "auto";
    else if (option.kind == FilterStepKind::kChoice)
      text += option.choices.at(static_cast<std::size_t>(value));
    else
      appendNumber(text, value);
    before = ',';
  }
  if (!step.matrices.empty()) {
    text += before + std::string(kMatrices) + '=';
    for (std::size_t i = 0; i < step.matrices.size(); ++i)
      text += (i > 0 ? "+" : "") + std::to_string(step.matrices[i]);
    before = ',';
  }
  if (!step.rest) return text;
  if (restText == RestText::kSize)
    return text + before + kRest + '=' + std::to_string(step.rest->rest.size()) + " values";
  for (const auto& [key, values] :
       {std::pair(kRest, &step.rest->rest), std::pair(kNoise, &step.rest->noise)}) {
    for (std::size_t i = 0; i < values->size(); ++i)
      text += (i > 0 ? std::string(1, kBetweenValues) : before + std::string(key) + '=') +
              numberText((*values)[i]);
    before = ',';
  }
  return text;
}
}  // namespace

std::string filterText(const FilterStep& step) {
  return optionsTextOf(step, false, RestText::kValues);
}

std::string fullFilterText(const FilterStep& step) {
  return optionsTextOf(step, true, RestText::kSize);
}

std::string shownFilterText(const FilterStep& step) {
  return optionsTextOf(step, false, RestText::kSize);
}

}  // namespace palpate
