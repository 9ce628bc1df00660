#include "palpate/signals/formula.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <deque>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>

#include <muParser.h>

#include "palpate/core/number_text.h"
#include "palpate/model/gap_detector.h"
#include "palpate/model/timing.h"
#include "palpate/signals/resampled_series.h"

namespace palpate {

// The variable that stands for der(..) and the formula inside.
struct Formula::Derivative {
  std::string variable;
  Formula inside;
};

namespace {

constexpr double kFormulaNan = std::numeric_limits<double>::quiet_NaN();
constexpr const char* kTime = "t";
constexpr const char* kDerivativeVariable = "derivative_";

bool ofName(char letter) {
  return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_';
}

[[noreturn]] void refuseFormula(const std::string& text, const std::string& why) {
  throw std::invalid_argument("formula \"" + text + "\": " + why);
}

// The place of the next "der(" from `begin` on.
std::size_t findDerivative(const std::string& text, std::size_t begin) {
  for (std::size_t at = text.find("der", begin); at != std::string::npos;
       at = text.find("der", at + 1)) {
    if (at > 0 && ofName(text[at - 1])) continue;
    std::size_t open = at + 3;
    while (open < text.size() && text[open] == ' ') ++open;
    if (open < text.size() && text[open] == '(') return at;
  }
  return std::string::npos;
}

// muParser would take "a = 1" as an assignment, and "a, b" as two formulas.
void refuseAssignments(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '=') continue;
    const bool before = i > 0 && std::string("=!<>").find(text[i - 1]) != std::string::npos;
    const bool after = i + 1 < text.size() && text[i + 1] == '=';
    if (!before && !after) refuseFormula(text, "= assigns nothing here; == compares");
  }
}

// A parser with its variables.
struct FormulaParser {
  explicit FormulaParser(const std::string& text) {
    parser.SetVarFactory(
        [](const char* name, void* self) {
          auto& storage = static_cast<FormulaParser*>(self)->variables[name];
          return &storage;
        },
        this);
    parser.SetExpr(text);
  }
  mu::Parser parser;
  std::map<std::string, double> variables;
};

// The message of muParser in one line, without its final full stop.
std::string messageOf(const mu::Parser::exception_type& error) {
  std::string message = error.GetMsg();
  while (!message.empty() && (message.back() == '.' || message.back() == '\n')) message.pop_back();
  std::replace(message.begin(), message.end(), '\n', ' ');
  return message;
}

}  // namespace

std::optional<SeriesChoice> signalNamed(const std::string& name, const SensorLayout& layout) {
  const auto numberBehind = [&](const std::string& word) -> std::optional<std::size_t> {
    if (name.rfind(word, 0) != 0) return std::nullopt;
    const auto number = parseInteger(std::string_view(name).substr(word.size()));
    if (!number || *number < 0) return std::nullopt;
    return static_cast<std::size_t>(*number);
  };
  if (const auto axis = numberBehind("angle"))
    return SeriesChoice{.kind = SeriesChoice::Kind::kAngle, .index = *axis};
  if (const auto sensor = numberBehind("temperature"))
    return SeriesChoice{.kind = SeriesChoice::Kind::kTemperature, .index = *sensor};
  const auto underline = name.find('_');
  if (underline == std::string::npos) return std::nullopt;
  const std::string place = name.substr(0, underline), rest = name.substr(underline + 1);
  std::size_t m = layout.numMatrices();
  if (place != "hand") {
    if (place.empty() || place[0] != 'm') return std::nullopt;
    const auto number = parseInteger(std::string_view(place).substr(1));
    if (!number || *number < 0 || *number >= static_cast<std::int64_t>(layout.numMatrices()))
      return std::nullopt;
    m = static_cast<std::size_t>(*number);
  }
  if (const auto signal = signalKindNamed(rest)) return SeriesChoice{.index = m, .signal = *signal};
  const auto second = rest.find("_y");
  if (m == layout.numMatrices() || rest.empty() || rest[0] != 'x' || second == std::string::npos)
    return std::nullopt;
  const auto x = parseInteger(std::string_view(rest).substr(1, second - 1));
  const auto y = parseInteger(std::string_view(rest).substr(second + 2));
  const MatrixLayout& matrix = layout.matrix(m);
  if (!x || !y || *x < 0 || *y < 0 || *x >= matrix.columns || *y >= matrix.rows ||
      !matrix.enabled(static_cast<int>(*y), static_cast<int>(*x)))
    return std::nullopt;
  SeriesChoice choice{.kind = SeriesChoice::Kind::kTaxels, .taxels = TaxelSelection(layout)};
  choice.taxels.toggle(m, static_cast<int>(*y), static_cast<int>(*x));
  return choice;
}

std::vector<double> derivativeOf(std::span<const double> timeS,
                                 std::span<const double> values,
                                 double longestS) {
  if (timeS.size() != values.size())
    throw std::invalid_argument("a derivative needs as many times as values");
  for (std::size_t i = 1; i < timeS.size(); ++i)
    if (!(timeS[i] > timeS[i - 1]))
      throw std::invalid_argument("a derivative needs times that ascend");
  std::vector<double> slopes(values.size(), kFormulaNan);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool left = i > 0 && timeS[i] - timeS[i - 1] <= longestS;
    const bool right = i + 1 < values.size() && timeS[i + 1] - timeS[i] <= longestS;
    const auto slopeTo = [&](std::size_t a, std::size_t b) {
      return (values[b] - values[a]) / (timeS[b] - timeS[a]);
    };
    if (left && right) {
      // The slope of the parabola through three samples.
      const double before = timeS[i] - timeS[i - 1], after = timeS[i + 1] - timeS[i];
      slopes[i] = (after * slopeTo(i - 1, i) + before * slopeTo(i, i + 1)) / (before + after);
    } else if (left || right) {
      slopes[i] = left ? slopeTo(i - 1, i) : slopeTo(i, i + 1);
    }
  }
  return slopes;
}

Formula::Formula(const std::string& text) : text_(text) {
  if (text.size() > kLongest)
    throw std::invalid_argument("a formula has at most " + std::to_string(kLongest) + " letters");
  refuseAssignments(text);
  std::set<std::string> names;
  std::size_t begin = 0;
  for (std::size_t at = findDerivative(text, 0); at != std::string::npos;
       at = findDerivative(text, begin)) {
    const std::size_t open = text.find('(', at);
    std::size_t close = open, depth = 0;
    for (; close < text.size(); ++close) {
      if (text[close] == '(') ++depth;
      if (text[close] == ')' && --depth == 0) break;
    }
    if (close == text.size()) refuseFormula(text, "the bracket of der( isn't closed");
    Derivative derivative{kDerivativeVariable + std::to_string(derivatives_.size()),
                          Formula(text.substr(open + 1, close - open - 1))};
    parsed_ += text.substr(begin, at - begin) + derivative.variable;
    names.insert(derivative.inside.names_.begin(), derivative.inside.names_.end());
    derivatives_.push_back(std::move(derivative));
    begin = close + 1;
  }
  parsed_ += text.substr(begin);
  try {
    FormulaParser parser(parsed_);
    parser.parser.Eval();
    if (parser.parser.GetNumResults() != 1) refuseFormula(text, "a comma makes two formulas of it");
    for (const auto& [name, value] : parser.variables)
      if (name != kTime && name.rfind(kDerivativeVariable, 0) != 0) names.insert(name);
  } catch (const mu::Parser::exception_type& error) {
    refuseFormula(text, messageOf(error));
  }
  names_.assign(names.begin(), names.end());
}

Formula::~Formula() = default;
Formula::Formula(const Formula& other) = default;
Formula& Formula::operator=(const Formula& other) = default;

std::vector<double> Formula::evaluate(std::span<const double> timeS,
                                      const std::vector<std::vector<double>>& values,
                                      double longestS) const {
  if (values.size() != names_.size())
    throw std::invalid_argument("formula \"" + text_ + "\": " + std::to_string(values.size()) +
                                " signals of " + std::to_string(names_.size()));
  std::map<std::string, std::vector<double>> series;
  for (std::size_t i = 0; i < names_.size(); ++i) {
    if (values[i].size() != timeS.size())
      throw std::invalid_argument("formula \"" + text_ + "\": " + names_[i] + " has " +
                                  std::to_string(values[i].size()) + " values at " +
                                  std::to_string(timeS.size()) + " times");
    series[names_[i]] = values[i];
  }
  for (const Derivative& derivative : derivatives_) {
    std::vector<std::vector<double>> inside;
    for (const std::string& name : derivative.inside.names_) inside.push_back(series.at(name));
    series[derivative.variable] =
        derivativeOf(timeS, derivative.inside.evaluate(timeS, inside, longestS), longestS);
  }
  series[kTime].assign(timeS.begin(), timeS.end());
  std::vector<double> result;
  result.reserve(timeS.size());
  try {
    FormulaParser parser(parsed_);
    parser.parser.Eval();  // makes the variables
    std::vector<std::pair<double*, const std::vector<double>*>> bound;
    for (auto& [name, value] : parser.variables) bound.emplace_back(&value, &series.at(name));
    for (std::size_t i = 0; i < timeS.size(); ++i) {
      for (const auto& [variable, of] : bound) *variable = (*of)[i];
      result.push_back(parser.parser.Eval());
    }
  } catch (const mu::Parser::exception_type& error) {
    refuseFormula(text_, messageOf(error));
  }
  return result;
}

Series derivedSeries(const Profile& profile,
                     const Formula& formula,
                     double fromS,
                     double toS,
                     const Progress& progress) {
  if (profile.numFrames() == 0) throw std::invalid_argument("there are no frames");
  std::vector<SeriesChoice> choices;
  for (const std::string& name : formula.names()) {
    const auto choice = signalNamed(name, profile.layout());
    if (!choice)
      throw std::invalid_argument("formula \"" + formula.text() + "\": there is no signal \"" +
                                  name +
                                  "\"; there are m0_mean, m0_sum, .., hand_max, m0_x2_y9, angle0, "
                                  "temperature0, t");
    if (!hasSeries(profile, *choice))
      throw std::invalid_argument("formula \"" + formula.text() + "\": the recording has no " +
                                  name);
    choices.push_back(*choice);
  }
  const double parts = static_cast<double>(choices.size()) + 1.0;
  const auto part = [&](std::size_t which) -> Progress {
    if (!progress) return {};
    return [&progress, which, parts](double done) {
      return progress((static_cast<double>(which) + done) / parts);
    };
  };
  const TimingReport timing = timingOf(profile);
  const double longestS = gapThresholdS(timing.rateHz > 0.0 ? 1.0 / timing.rateHz : 0.0);
  Series derived;
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    const double timeS = static_cast<double>(profile.frameTimeUs(i) - profile.frameTimeUs(0)) / 1e6;
    if (timeS >= fromS && timeS <= toS) derived.timeS.push_back(timeS);
  }
  std::vector<std::vector<double>> values;
  for (std::size_t i = 0; i < choices.size(); ++i)
    values.push_back(resampled(readSeries(profile, choices[i], fromS, toS, part(i)),
                               derived.timeS,
                               std::numeric_limits<double>::infinity()));
  derived.values = formula.evaluate(derived.timeS, values, longestS);
  return derived;
}

}  // namespace palpate
