#include "palpate/signals/formula.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>

#include <muParser.h>

#include "palpate/core/escaped_line.h"
#include "palpate/core/first_where.h"
#include "palpate/core/number_text.h"
#include "palpate/filter/butterworth.h"
#include "palpate/model/gap_detector.h"
#include "palpate/model/timing.h"
#include "palpate/signals/resampled_series.h"
#include "palpate/signals/signal_name.h"

namespace palpate {

// The variable that stands for der(..) or a filter, and the formula inside.
struct Formula::SeriesCall {
  std::string variable;
  Formula inside;
  // Index in kSeriesFunctions.
  std::size_t function = 0;
  // The numbers behind the formula inside.
  std::vector<double> numbers = {};
};

namespace {

constexpr double kFormulaNan = std::numeric_limits<double>::quiet_NaN();
constexpr const char* kTime = "t";
constexpr std::size_t kValuesPerReport = 4096;
constexpr const char* kCallVariable = "_call";  // no signal's name begins so

bool ofName(char letter) {
  return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_';
}

[[noreturn]] void refuseFormula(const std::string& text, const std::string& why) {
  throw std::invalid_argument("formula \"" + shortened(text) + "\": " + why);
}

// A function of a whole series: muParser knows only functions of numbers.
enum class SeriesFunctionKind {
  kDerivative,
  kSmooth,
  kMedian,
  kLowPass,
  kHighPass,
  kBandPass,
  kBandStop
};
struct SeriesFunction {
  std::string_view name;
  SeriesFunctionKind kind;
  std::size_t numNumbers;
  // How it is written.
  const char* form;
};
constexpr std::array kSeriesFunctions = {
    SeriesFunction{"der", SeriesFunctionKind::kDerivative, 0, "der(x)"},
    SeriesFunction{"smooth", SeriesFunctionKind::kSmooth, 1, "smooth(x, samples)"},
    SeriesFunction{"median", SeriesFunctionKind::kMedian, 1, "median(x, samples)"},
    SeriesFunction{"lowpass", SeriesFunctionKind::kLowPass, 1, "lowpass(x, Hz)"},
    SeriesFunction{"highpass", SeriesFunctionKind::kHighPass, 1, "highpass(x, Hz)"},
    SeriesFunction{"bandpass", SeriesFunctionKind::kBandPass, 2, "bandpass(x, low Hz, high Hz)"},
    SeriesFunction{"bandstop", SeriesFunctionKind::kBandStop, 2, "bandstop(x, low Hz, high Hz)"}};

// The next function of a series from `begin` on.
struct FoundFunction {
  std::size_t at = std::string::npos;
  std::size_t open = std::string::npos;  // its bracket
  std::size_t function = 0;
};
FoundFunction findFunction(const std::string& text, std::size_t begin) {
  FoundFunction first;
  for (std::size_t which = 0; which < kSeriesFunctions.size(); ++which) {
    const std::string_view name = kSeriesFunctions[which].name;
    for (std::size_t at = text.find(name, begin); at < first.at; at = text.find(name, at + 1)) {
      if (at > 0 && ofName(text[at - 1])) continue;
      std::size_t open = at + name.size();
      while (open < text.size() && text[open] == ' ') ++open;
      if (open >= text.size() || text[open] != '(') continue;
      first = {at, open, which};
      break;
    }
  }
  return first;
}

ButterworthOptions bandOf(SeriesFunctionKind kind, const std::vector<double>& numbers) {
  using Band = ButterworthOptions::Band;
  if (kind == SeriesFunctionKind::kLowPass)
    return {.band = Band::kLowPass, .highHz = numbers.at(0)};
  if (kind == SeriesFunctionKind::kHighPass)
    return {.band = Band::kHighPass, .lowHz = numbers.at(0)};
  return {.band = kind == SeriesFunctionKind::kBandStop ? Band::kBandStop : Band::kBandPass,
          .lowHz = numbers.at(0),
          .highHz = numbers.at(1)};
}

// Throws std::invalid_argument that says what is wrong with the numbers.
void validateNumbers(SeriesFunctionKind kind, const std::vector<double>& numbers) {
  constexpr double kMaxSamples = 100'001.0;
  if (kind == SeriesFunctionKind::kDerivative) return;
  if (kind != SeriesFunctionKind::kSmooth && kind != SeriesFunctionKind::kMedian)
    return bandOf(kind, numbers).validate();
  const double samples = numbers.at(0);
  if (!(samples >= 1.0 && samples <= kMaxSamples) || std::fmod(samples, 2.0) != 1.0)
    throw std::invalid_argument("needs an odd number of samples, 1 to 100001");
}

// The values of a window that moves along a series, and their mean.
class MovingMean {
 public:
  void add(double value) {
    addToSum(value);
    ++count_;
  }
  void remove(double value) {
    addToSum(-value);
    --count_;
  }
  std::size_t count() const { return count_; }
  double value() const { return (sum_ + rest_) / static_cast<double>(count_); }
  // False after an overflow: values that are removed would not undo it.
  bool isSound() const { return std::isfinite(sum_); }

 private:
  // With the rounding error of each sum (Knuth's two-sum), so that the result does not depend on
  // what has left the window.
  void addToSum(double value) {
    const double sum = sum_ + value;
    const double added = sum - sum_;
    rest_ += (sum_ - (sum - added)) + (value - added);
    sum_ = sum;
  }

  double sum_ = 0.0;
  double rest_ = 0.0;
  std::size_t count_ = 0;
};

// The same for the median: the lower half of the values, which has the middle one, and the upper.
class MovingMedian {
 public:
  void add(double value) {
    (lower_.empty() || value <= *lower_.rbegin() ? lower_ : upper_).insert(value);
    balance();
  }
  void remove(double value) {
    auto& half = value <= *lower_.rbegin() ? lower_ : upper_;
    half.erase(half.find(value));
    balance();
  }
  std::size_t count() const { return lower_.size() + upper_.size(); }
  double value() const {
    const double middle = *lower_.rbegin();
    return lower_.size() > upper_.size() ? middle : (middle + *upper_.begin()) / 2.0;
  }
  bool isSound() const { return true; }

 private:
  void balance() {
    if (lower_.size() > upper_.size() + 1)
      upper_.insert(lower_.extract(std::prev(lower_.end())));
    else if (upper_.size() > lower_.size())
      lower_.insert(upper_.extract(upper_.begin()));
  }

  std::multiset<double> lower_, upper_;
};

// Mean or median of the finite values within half a window on either side of each sample, but not
// beyond a gap; NaN where there is none.
template <typename Window>
std::vector<double> windowed(std::span<const double> values,
                             std::span<const std::size_t> gapSamples,
                             std::size_t samples,
                             const Progress& progress) {
  const std::size_t half = samples / 2;
  std::vector<double> result(values.size(), kFormulaNan);
  std::size_t begin = 0;
  for (std::size_t stretch = 0; stretch <= gapSamples.size(); ++stretch) {
    const std::size_t end = stretch < gapSamples.size() ? gapSamples[stretch] + 1 : values.size();
    Window window;
    std::size_t next = begin;  // the first one that was not added
    const auto addFrom = [&](std::size_t first, std::size_t behind) {
      for (next = first; next < behind; ++next)
        if (std::isfinite(values[next])) window.add(values[next]);
    };
    for (std::size_t i = begin; i < end; ++i) {
      reportProgress(progress, i, values.size(), kValuesPerReport);
      addFrom(next, std::min(end, i + half + 1));
      if (i > begin + half && std::isfinite(values[i - half - 1]))
        window.remove(values[i - half - 1]);
      if (!window.isSound()) {
        window = {};
        addFrom(i - std::min(half, i - begin), next);
      }
      if (window.count() > 0) result[i] = window.value();
    }
    begin = end;
  }
  return result;
}

// The progress of one of `count` steps of equal weight.
Progress progressOfStep(const Progress& progress, std::size_t step, std::size_t count) {
  if (!progress) return {};
  return [&progress, step, count](double done) {
    return progress((static_cast<double>(step) + done) / static_cast<double>(count));
  };
}

double medianIntervalOf(std::span<const double> timeS) {
  if (timeS.size() < 2) return 0.0;
  std::vector<double> intervals;
  for (std::size_t i = 1; i < timeS.size(); ++i) intervals.push_back(timeS[i] - timeS[i - 1]);
  const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
  std::nth_element(intervals.begin(), middle, intervals.end());
  return *middle;
}

std::vector<double> appliedTo(std::span<const double> timeS,
                              const std::vector<double>& values,
                              double longestS,
                              SeriesFunctionKind kind,
                              const std::vector<double>& numbers,
                              const Progress& progress) {
  if (kind == SeriesFunctionKind::kDerivative) return derivativeOf(timeS, values, longestS);
  std::vector<std::size_t> gapSamples;
  for (std::size_t i = 0; i + 1 < timeS.size(); ++i)
    if (timeS[i + 1] - timeS[i] > longestS) gapSamples.push_back(i);
  if (kind == SeriesFunctionKind::kSmooth || kind == SeriesFunctionKind::kMedian)
    return (kind == SeriesFunctionKind::kSmooth
                ? windowed<MovingMean>
                : windowed<MovingMedian>)(values,
                                          gapSamples,
                                          static_cast<std::size_t>(numbers.at(0)),
                                          progress);
  const bool any =
      std::any_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
  if (!any || values.size() < 2) return values;
  const ButterworthOptions options = bandOf(kind, numbers);
  options.validateForRate(1.0 / medianIntervalOf(timeS));
  return butterworthZeroPhase(timeS, values, options, gapSamples);
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
  if (const auto at = message.find(error.GetToken()); at != std::string::npos)
    message.replace(at, error.GetToken().size(), shortened(error.GetToken()));
  while (!message.empty() && (message.back() == '.' || message.back() == '\n')) message.pop_back();
  std::replace(message.begin(), message.end(), '\n', ' ');
  return message;
}

// muParser would only report an unexpected parenthesis. `parsed`: without the functions of series.
void refuseUnknownFunctions(const std::string& text, const std::string& parsed) {
  const mu::funmap_type known = mu::Parser().GetFunDef();
  for (std::size_t open = parsed.find('('); open != std::string::npos;
       open = parsed.find('(', open + 1)) {
    std::size_t end = open;
    while (end > 0 && parsed[end - 1] == ' ') --end;
    std::size_t begin = end;
    while (begin > 0 && ofName(parsed[begin - 1])) --begin;
    const std::string name = parsed.substr(begin, end - begin);
    // Skip numeric literals.
    if (name.empty() || std::isdigit(static_cast<unsigned char>(name.front())) != 0 ||
        known.contains(name))
      continue;
    std::string ours;
    for (const SeriesFunction& function : kSeriesFunctions)
      ours += (ours.empty() ? "" : ", ") + std::string(function.name);
    refuseFormula(text,
                  "there is no function " + shortened(name) + "; functions of signals are " + ours +
                      ", functions of numbers abs, sqrt, min, max, exp, ln, sin and others");
  }
}

// The times of the last sample before a run of samples that can't be read and of the first one
// behind it, from the first frame [s].
TimeSpan readableAround(const Profile& profile,
                        const SeriesChoice& choice,
                        const UnreadableSamples::Run& run) {
  const auto column = columnOf(profile, choice);
  const std::size_t count = column ? profile.numSamples(column->series) : profile.numFrames();
  const auto timeS = [&](std::size_t sample) {
    const std::int64_t us =
        column ? profile.sampleTimeUs(column->series, sample) : profile.frameTimeUs(sample);
    return static_cast<double>(us - profile.frameTimeUs(0)) / 1e6;
  };
  constexpr double kForever = std::numeric_limits<double>::infinity();
  return {run.first > 0 ? timeS(run.first - 1) : -kForever,
          run.last + 1 < count ? timeS(run.last + 1) : kForever};
}

}  // namespace

std::vector<std::string> splitAtCommas(const std::string& text) {
  std::vector<std::string> parts(1);
  int depth = 0;
  for (const char letter : text) {
    if (letter == '(') ++depth;
    if (letter == ')') --depth;
    if (letter == ',' && depth == 0)
      parts.emplace_back();
    else
      parts.back() += letter;
  }
  return parts;
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

Formula::Formula(const std::string& given) : text_(given) {
  const std::string text = withSignalNames(given);
  if (given.size() > kLongest)
    throw std::invalid_argument("a formula has at most " + std::to_string(kLongest) + " letters");
  refuseAssignments(text);
  std::set<std::string> names;
  std::size_t begin = 0;
  for (FoundFunction found = findFunction(text, 0); found.at != std::string::npos;
       found = findFunction(text, begin)) {
    const SeriesFunction& function = kSeriesFunctions[found.function];
    std::size_t close = found.open, depth = 0;
    for (; close < text.size(); ++close) {
      if (text[close] == '(') ++depth;
      if (text[close] == ')' && --depth == 0) break;
    }
    if (close == text.size())
      refuseFormula(given, "the bracket of " + std::string(function.name) + "( isn't closed");
    const std::vector<std::string> parts =
        splitAtCommas(text.substr(found.open + 1, close - found.open - 1));
    if (parts.size() != function.numNumbers + 1)
      refuseFormula(given, "it is written " + std::string(function.form));
    SeriesCall call{
        kCallVariable + std::to_string(calls_.size()), Formula(parts.front()), found.function};
    for (std::size_t i = 1; i < parts.size(); ++i) {
      const auto first = parts[i].find_first_not_of(' '), last = parts[i].find_last_not_of(' ');
      const auto number = first == std::string::npos
                              ? std::nullopt
                              : parseDouble(parts[i].substr(first, last - first + 1));
      if (!number)
        refuseFormula(
            given,
            std::string(function.form) + " takes a number, not \"" + shortened(parts[i]) + "\"");
      call.numbers.push_back(*number);
    }
    try {
      validateNumbers(function.kind, call.numbers);
    } catch (const std::invalid_argument& error) {
      refuseFormula(given, std::string(function.form) + ": " + error.what());
    }
    parsed_ += text.substr(begin, found.at - begin) + call.variable;
    names.insert(call.inside.names_.begin(), call.inside.names_.end());
    calls_.push_back(std::move(call));
    begin = close + 1;
  }
  parsed_ += text.substr(begin);
  try {
    FormulaParser parser(parsed_);
    parser.parser.Eval();
    if (parser.parser.GetNumResults() != 1)
      refuseFormula(text, "a comma would make it two formulas");
    for (const auto& [name, value] : parser.variables)
      if (name != kTime && name.rfind(kCallVariable, 0) != 0) names.insert(name);
  } catch (const mu::Parser::exception_type& error) {
    refuseUnknownFunctions(text, parsed_);
    refuseFormula(text, messageOf(error));
  }
  names_.assign(names.begin(), names.end());
}

Formula::~Formula() = default;
Formula::Formula(const Formula& other) = default;
Formula& Formula::operator=(const Formula& other) = default;

std::vector<double> Formula::evaluate(std::span<const double> timeS,
                                      const std::vector<std::vector<double>>& values,
                                      double longestS,
                                      const Progress& progress) const {
  // The series functions, each after what is inside, and then the formula itself.
  const auto part = [&](std::size_t step) {
    return progressOfStep(progress, step, 2 * calls_.size() + 1);
  };
  if (values.size() != names_.size())
    throw std::invalid_argument("formula \"" + shortened(text_) +
                                "\": " + std::to_string(values.size()) + " signals of " +
                                std::to_string(names_.size()));
  std::map<std::string, std::vector<double>> series;
  for (std::size_t i = 0; i < names_.size(); ++i) {
    if (values[i].size() != timeS.size())
      throw std::invalid_argument("formula \"" + shortened(text_) + "\": " + shortened(names_[i]) +
                                  " has " + std::to_string(values[i].size()) + " values at " +
                                  std::to_string(timeS.size()) + " times");
    series[names_[i]] = values[i];
  }
  for (std::size_t d = 0; d < calls_.size(); ++d) {
    const SeriesCall& call = calls_[d];
    std::vector<std::vector<double>> inside;
    for (const std::string& name : call.inside.names_) inside.push_back(series.at(name));
    try {
      series[call.variable] = appliedTo(timeS,
                                        call.inside.evaluate(timeS, inside, longestS, part(2 * d)),
                                        longestS,
                                        kSeriesFunctions[call.function].kind,
                                        call.numbers,
                                        part(2 * d + 1));
    } catch (const std::invalid_argument& error) {
      refuseFormula(text_, error.what());
    }
  }
  series[kTime].assign(timeS.begin(), timeS.end());
  std::vector<double> result;
  result.reserve(timeS.size());
  try {
    FormulaParser parser(parsed_);
    parser.parser.Eval();  // makes the variables
    std::vector<std::pair<double*, const std::vector<double>*>> bound;
    for (auto& [name, value] : parser.variables) bound.emplace_back(&value, &series.at(name));
    const Progress last = part(2 * calls_.size());
    for (std::size_t i = 0; i < timeS.size(); ++i) {
      reportProgress(last, i, timeS.size(), kValuesPerReport);
      for (const auto& [variable, of] : bound) *variable = (*of)[i];
      result.push_back(parser.parser.Eval());
    }
  } catch (const mu::Parser::exception_type& error) {
    refuseFormula(text_, messageOf(error));
  }
  return result;
}

std::size_t Formula::reach(double rateHz) const {
  // A frequency filter is computed from gap to gap (hasFrequencyFilter()).
  constexpr double kLongestFilter = 20'000.0;
  double samples = 0.0;
  for (const SeriesCall& call : calls_) {
    const SeriesFunctionKind kind = kSeriesFunctions[call.function].kind;
    double own = 1.0;
    if (kind == SeriesFunctionKind::kSmooth || kind == SeriesFunctionKind::kMedian)
      own = call.numbers.at(0) / 2.0;
    else if (kind != SeriesFunctionKind::kDerivative && rateHz > 0.0)
      own = std::min(butterworthLength(bandOf(kind, call.numbers), rateHz), kLongestFilter);
    samples = std::max(samples, own + static_cast<double>(call.inside.reach(rateHz)));
  }
  return static_cast<std::size_t>(std::ceil(samples));
}

bool Formula::hasFrequencyFilter() const {
  return std::any_of(calls_.begin(), calls_.end(), [](const SeriesCall& call) {
    const SeriesFunctionKind kind = kSeriesFunctions[call.function].kind;
    return (kind != SeriesFunctionKind::kDerivative && kind != SeriesFunctionKind::kSmooth &&
            kind != SeriesFunctionKind::kMedian) ||
           call.inside.hasFrequencyFilter();
  });
}

Series formulaSeries(const Profile& profile,
                     const Formula& formula,
                     double fromS,
                     double toS,
                     const Progress& progress,
                     UnreadableSamples* unreadable) {
  if (profile.numFrames() == 0) throw std::invalid_argument("there are no frames");
  std::vector<SeriesChoice> choices;
  for (const std::string& name : formula.names()) {
    const auto choice = signalNamed(name, profile);
    if (!choice) {
      std::string further;
      for (std::size_t i = kHandSeries; i < profile.series().size(); ++i) {
        const SeriesDescription& series = profile.series()[i];
        // Of those of each matrix one stands for all.
        if (series.role == kComputedRole && !series.name.starts_with("hand_")) continue;
        further += nameOf({.kind = SeriesChoice::Kind::kColumn,
                           .series = series.name,
                           .column = series.columns.front().name},
                          profile.layout()) +
                   ", ";
      }
      throw std::invalid_argument("formula \"" + shortened(formula.text()) +
                                  "\": there is no signal \"" + shortened(name) +
                                  "\"; there are m0_mean, m0_sum, .., hand_max, m0_x2_y9, angle0, "
                                  "temperature0, " +
                                  further + "t");
    }
    if (!hasSeries(profile, *choice)) {
      const std::string why = whyMissing(profile, *choice);
      throw std::invalid_argument("formula \"" + shortened(formula.text()) +
                                  "\": the recording has no " + shortened(name) +
                                  (why.empty() ? "" : ": " + why));
    }
    choices.push_back(*choice);
  }
  const auto part = [&](std::size_t which) {
    return progressOfStep(progress, which, choices.size() + 1);
  };
  const TimingReport timing = timingOf(profile);
  const double longestS = gapThresholdS(timing.rateHz > 0.0 ? 1.0 / timing.rateHz : 0.0);
  const auto frameS = [&](std::size_t frame) {
    return static_cast<double>(profile.frameTimeUs(frame) - profile.frameTimeUs(0)) / 1e6;
  };
  const std::size_t first =
      firstWhere(profile.numFrames(), [&](std::size_t frame) { return frameS(frame) >= fromS; });
  const std::size_t end =
      firstWhere(profile.numFrames(), [&](std::size_t frame) { return frameS(frame) > toS; });
  if (first >= end) return {};
  // Slopes and filters need the samples around the span, too.
  const std::size_t reach = formula.reach(timing.rateHz);
  std::size_t begin = first - std::min(first, reach);
  std::size_t last = std::min(profile.numFrames() - 1, end - 1 + reach);
  if (formula.hasFrequencyFilter()) {
    const auto isGap = [&](std::size_t after) {
      return frameS(after) - frameS(after - 1) > longestS;
    };
    while (begin > 0 && !isGap(begin)) --begin;
    while (last + 1 < profile.numFrames() && !isGap(last + 1)) ++last;
  }
  std::vector<double> timeS;
  for (std::size_t i = begin; i <= last; ++i) timeS.push_back(frameS(i));
  std::vector<std::vector<double>> values;
  std::vector<TimeSpan> lost;  // without their ends
  std::string fault;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    UnreadableSamples ofSignal;
    const Series series = readSeries(profile,
                                     choices[i],
                                     timeS.front(),
                                     timeS.back(),
                                     part(i),
                                     unreadable ? &ofSignal : nullptr);
    if (fault.empty()) fault = ofSignal.firstFault;
    for (const UnreadableSamples::Run& run : ofSignal.runs)
      lost.push_back(readableAround(profile, choices[i], run));
    values.push_back(choices[i].kind == SeriesChoice::Kind::kColumn ? heldAt(series, timeS)
                                                                    : resampled(series, timeS));
  }
  const std::vector<double> computed =
      formula.evaluate(timeS, values, longestS, part(choices.size()));
  Series derived;
  for (std::size_t i = first; i < end; ++i) {
    const bool isLost = std::any_of(lost.begin(), lost.end(), [&](const TimeSpan& span) {
      return timeS[i - begin] > span.fromS && timeS[i - begin] < span.toS;
    });
    if (isLost) unreadable->add(i, fault.c_str());
    derived.timeS.push_back(timeS[i - begin]);
    derived.values.push_back(isLost ? std::numeric_limits<double>::quiet_NaN()
                                    : computed[i - begin]);
  }
  return derived;
}

}  // namespace palpate
