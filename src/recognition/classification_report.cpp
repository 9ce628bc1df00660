#include "palpate/recognition/classification_report.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace palpate {
namespace {

constexpr std::size_t kBins = 10;
constexpr double kOneSided95 = 1.6448536269514722;

double ratio(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

BinomialInterval wilsonInterval(std::size_t successes, std::size_t trials, double z) {
  if (successes > trials)
    throw std::invalid_argument("wilsonInterval: " + std::to_string(successes) + " of " +
                                std::to_string(trials));
  if (trials == 0) return {};
  const auto n = static_cast<double>(trials);
  const double p = static_cast<double>(successes) / n, zz = z * z;
  const double centre = (p + zz / (2.0 * n)) / (1.0 + zz / n);
  const double half = z / (1.0 + zz / n) * std::sqrt(p * (1.0 - p) / n + zz / (4.0 * n * n));
  // At the ends, rounding would leave 1e-17 instead of 0 or 1.
  return {successes == 0 ? 0.0 : std::max(0.0, centre - half),
          successes == trials ? 1.0 : std::min(1.0, centre + half)};
}

ConfusionMatrix::ConfusionMatrix(std::vector<std::string> classes)
    : classes_(std::move(classes)), counts_(classes_.size() * (classes_.size() + 1), 0) {}

std::size_t ConfusionMatrix::index(int truth, int called) const {
  const std::size_t n = classes_.size();
  if (truth < 0 || static_cast<std::size_t>(truth) >= n || called < kUnknown ||
      (called >= 0 && static_cast<std::size_t>(called) >= n))
    throw std::out_of_range("ConfusionMatrix: class " + std::to_string(truth) + " called " +
                            std::to_string(called) + " of " + std::to_string(n) + " classes");
  return static_cast<std::size_t>(truth) * (n + 1) +
         (called == kUnknown ? n : static_cast<std::size_t>(called));
}

void ConfusionMatrix::add(int truth, int called) {
  ++counts_[index(truth, called)];
  ++total_;
  if (truth == called) ++right_;
}

void ConfusionMatrix::add(const ConfusionMatrix& other) {
  if (classes_ != other.classes_) throw std::invalid_argument("ConfusionMatrix: of other classes");
  for (std::size_t i = 0; i < counts_.size(); ++i) counts_[i] += other.counts_[i];
  total_ += other.total_;
  right_ += other.right_;
}

std::size_t ConfusionMatrix::at(int truth, int called) const {
  return counts_[index(truth, called)];
}

double ConfusionMatrix::accuracy() const noexcept { return ratio(right_, total_); }

std::vector<ClassMetrics> ConfusionMatrix::classMetrics() const {
  std::vector<ClassMetrics> all;
  for (std::size_t c = 0; c < classes_.size(); ++c) {
    std::size_t are = 0, called = 0;
    for (std::size_t k = 0; k < classes_.size(); ++k) {
      are += counts_[c * (classes_.size() + 1) + k];
      called += counts_[k * (classes_.size() + 1) + c];
    }
    are += counts_[c * (classes_.size() + 1) + classes_.size()];
    const std::size_t both = counts_[c * (classes_.size() + 1) + c];
    all.push_back(
        {classes_[c], ratio(both, called), ratio(both, are), ratio(2 * both, are + called), are});
  }
  return all;
}

Json ConfusionMatrix::classesJson() const {
  return jsonList(classMetrics(), [](const ClassMetrics& one) {
    return Json::object()
        .set("name", one.name)
        .set("precision", one.precision)
        .set("recall", one.recall)
        .set("f", one.f)
        .set("support", one.support);
  });
}

Json ConfusionMatrix::confusionJson() const {
  const std::size_t n = classes_.size();
  bool unknown = false;
  for (std::size_t c = 0; c < n; ++c) unknown = unknown || counts_[c * (n + 1) + n] > 0;
  Json labels = Json::array(), rows = Json::array();
  for (const std::string& name : classes_) labels.push(name);
  if (unknown) labels.push("unknown");
  for (std::size_t c = 0; c < n; ++c) {
    Json row = Json::array();
    for (std::size_t k = 0; k < n + (unknown ? 1 : 0); ++k) row.push(counts_[c * (n + 1) + k]);
    rows.push(std::move(row));
  }
  return Json::object().set("labels", std::move(labels)).set("counts", std::move(rows));
}

std::vector<CoveragePoint> coverageCurve(std::vector<ScoredPrediction> answers) {
  std::sort(answers.begin(), answers.end(), [](const auto& a, const auto& b) {
    return a.confidence > b.confidence;
  });
  std::vector<CoveragePoint> curve;
  std::size_t right = 0;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    right += answers[i].right ? 1 : 0;
    if (i + 1 < answers.size() && answers[i + 1].confidence == answers[i].confidence) continue;
    curve.push_back(
        {answers[i].confidence, ratio(i + 1, answers.size()), ratio(right, i + 1), i + 1});
  }
  return curve;
}

double confidenceThreshold(const std::vector<ScoredPrediction>& answers, double target) {
  double threshold = 2.0;
  for (const CoveragePoint& point : coverageCurve(answers)) {
    const auto right =
        static_cast<std::size_t>(std::llround(point.accuracy * static_cast<double>(point.answers)));
    if (wilsonInterval(right, point.answers, kOneSided95).low >= target)
      threshold = point.confidence;
  }
  return threshold;
}

double expectedCalibrationError(std::span<const ScoredPrediction> answers) {
  std::vector<double> confidence(kBins, 0.0), right(kBins, 0.0);
  for (const ScoredPrediction& answer : answers) {
    const auto bin = std::min(kBins - 1,
                              static_cast<std::size_t>(std::clamp(answer.confidence, 0.0, 1.0) *
                                                       static_cast<double>(kBins)));
    confidence[bin] += answer.confidence;
    right[bin] += answer.right ? 1.0 : 0.0;
  }
  double sum = 0.0;
  for (std::size_t bin = 0; bin < kBins; ++bin) sum += std::abs(confidence[bin] - right[bin]);
  return answers.empty() ? 0.0 : sum / static_cast<double>(answers.size());
}

double auroc(std::span<const double> positive, std::span<const double> negative) {
  if (positive.empty() || negative.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::vector<double> sorted(negative.begin(), negative.end());
  std::sort(sorted.begin(), sorted.end());
  double wins = 0.0;
  for (const double value : positive) {
    const auto [low, high] = std::equal_range(sorted.begin(), sorted.end(), value);
    wins += static_cast<double>(low - sorted.begin()) + 0.5 * static_cast<double>(high - low);
  }
  return wins / static_cast<double>(positive.size()) / static_cast<double>(negative.size());
}

}  // namespace palpate
