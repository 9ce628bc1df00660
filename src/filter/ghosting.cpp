#include "palpate/filter/ghosting.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <string>

#include "palpate/core/error.h"
#include "palpate/core/progress.h"
#include "palpate/filter/filter_chain.h"

namespace palpate {
namespace {

using GhostingSteadyClock = std::chrono::steady_clock;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kGhostingFramesPerReport = 256;

// Keeps the filtered frames until they are counted, so that counting is not included in the time of
// the chain.
class Outcome final : public FrameSink {
 public:
  // Keeps all values that the filters gave: the report is about the filters themselves, not about
  // what counts as a contact afterwards.
  void take(TactileFrame& frame) override {
    frames_.push_back(std::move(frame.filtered.empty() ? frame.values : frame.filtered));
  }
  std::vector<std::vector<float>>& frames() { return frames_; }

 private:
  std::vector<std::vector<float>> frames_;
};

void checkGhosting(const Profile& profile,
                   std::span<const CellTruthMask> truth,
                   const GhostingOptions& options) {
  OptionCheck{"GhostingOptions"}(
      GhostingOptions::kActiveAboveCounts, "activeAboveCounts", options.activeAboveCounts);
  if (options.minTaxels < 1 ||
      !(options.wholeMatrixFraction >= 0.0 && options.wholeMatrixFraction <= 1.0))
    throw std::invalid_argument("measureGhosting: an option is out of range");
  if (truth.empty()) return;
  if (truth.size() != profile.numFrames())
    throw std::invalid_argument("measureGhosting: truth of " + std::to_string(truth.size()) +
                                " frames for " + std::to_string(profile.numFrames()));
  for (const CellTruthMask& mask : truth)
    if (mask.size() != profile.layout().numCells())
      throw std::invalid_argument("measureGhosting: truth of " + std::to_string(mask.size()) +
                                  " places for " + std::to_string(profile.layout().numCells()));
}

BeforeAfter& operator+=(BeforeAfter& sum, const BeforeAfter& more) {
  sum.before += more.before;
  sum.after += more.after;
  return sum;
}

class Counter {
 public:
  Counter(const Profile& profile,
          std::span<const CellTruthMask> truth,
          const GhostingOptions& options,
          GhostingReport& report)
      : profile_(profile), truth_(truth), options_(options), report_(report) {
    report_.matrices.resize(profile.layout().numMatrices());
    open_.resize(report_.matrices.size());
  }

  // Counts the next filtered frame together with the frame that it was made from.
  void count(const std::vector<float>& filtered) {
    const std::size_t frame = report_.frames++;
    profile_.readFrame(frame, raw_);
    const CellTruthMask* const touch = truth_.empty() ? nullptr : &truth_[frame];
    bool falseBefore = false, falseAfter = false;
    for (std::size_t m = 0; m < report_.matrices.size(); ++m) {
      const BeforeAfter ghosts = countMatrix(m, frame, touch, filtered);
      falseBefore |= ghosts.before > 0;
      falseAfter |= ghosts.after > 0;
    }
    report_.framesWithFalse.before += falseBefore ? 1 : 0;
    report_.framesWithFalse.after += falseAfter ? 1 : 0;
  }

  void finish() {
    for (std::size_t m = 0; m < open_.size(); ++m) close(m, report_.frames);
    std::sort(report_.contacts.begin(), report_.contacts.end(), [](const auto& a, const auto& b) {
      return a.begin != b.begin ? a.begin < b.begin : a.matrix < b.matrix;
    });
  }

 private:
  struct Open {
    ContactGhosting contact;
    bool touching = false, seen = false;
  };
  struct Touched {
    std::uint64_t taxels = 0;
    BeforeAfter active;
    std::uint64_t kept = 0;
    double sumBefore = 0.0, sumAfter = 0.0;
  };

  bool active(float value) const { return static_cast<double>(value) > options_.activeAboveCounts; }

  BeforeAfter countMatrix(std::size_t m,
                          std::size_t frame,
                          const CellTruthMask* touch,
                          const std::vector<float>& filtered) {
    const MatrixLayout& layout = profile_.layout().matrix(m);
    const std::size_t offset = profile_.layout().offset(m);
    BeforeAfter ghosts;
    Touched touched;
    for (std::size_t i = 0; i < layout.numCells(); ++i) {
      if (layout.staticMask[i] == 0 || layout.dynamicMask[i] == 0) continue;
      const float before = raw_.values[offset + i];
      const float after = filtered[offset + i];
      const CellTruth is = touch ? (*touch)[offset + i] : CellTruth::kNothing;
      if (is == CellTruth::kNothing) {
        ghosts.before += active(before) ? 1 : 0;
        ghosts.after += active(after) ? 1 : 0;
      } else if (is == CellTruth::kTouched) {
        ++touched.taxels;
        touched.active.before += active(before) ? 1 : 0;
        touched.active.after += active(after) ? 1 : 0;
        touched.kept += active(before) && active(after) ? 1 : 0;
        touched.sumBefore += static_cast<double>(before);
        touched.sumAfter += static_cast<double>(after);
      }
    }
    add(report_.matrices[m], ghosts, static_cast<double>(layout.numEnabled()));
    follow(m, frame, touched);
    return ghosts;
  }

  void add(MatrixGhosting& matrix, const BeforeAfter& ghosts, double taxels) const {
    const double whole = options_.wholeMatrixFraction * taxels;
    const bool wholeBefore = static_cast<double>(ghosts.before) > whole;
    matrix.falseTaxels += ghosts;
    if (!wholeBefore) matrix.scattered += ghosts;
    matrix.framesWithFalse += {ghosts.before > 0 ? 1U : 0U, ghosts.after > 0 ? 1U : 0U};
    matrix.framesWhole +=
        {wholeBefore ? 1U : 0U, static_cast<double>(ghosts.after) > whole ? 1U : 0U};
  }

  void follow(std::size_t m, std::size_t frame, const Touched& touched) {
    if (touched.taxels == 0) {
      close(m, frame);
      return;
    }
    Open& open = open_[m];
    ContactGhosting& contact = open.contact;
    if (!open.touching) {
      open = {};
      open.touching = true;
      contact.matrix = m;
      contact.begin = frame;
    }
    const auto least = static_cast<std::uint64_t>(options_.minTaxels);
    if (!open.seen && touched.active.before >= least) {
      open.seen = true;
      contact.firstBefore = frame;
    }
    if (!contact.firstAfter && touched.active.after >= least) contact.firstAfter = frame;
    contact.taxels += {touched.active.before, touched.kept};
    contact.sumBefore += touched.sumBefore;
    contact.sumAfter += touched.sumAfter;
    report_.touched += {touched.active.before, touched.kept};
    report_.touchedSumBefore += touched.sumBefore;
    report_.touchedSumAfter += touched.sumAfter;
  }

  void close(std::size_t m, std::size_t frame) {
    Open& open = open_[m];
    if (open.touching && open.seen) {
      open.contact.end = frame;
      report_.contacts.push_back(open.contact);
    }
    open = {};
  }

  const Profile& profile_;
  const std::span<const CellTruthMask> truth_;
  const GhostingOptions& options_;
  GhostingReport& report_;
  std::vector<Open> open_;  // per matrix
  TactileFrame raw_;
};

}  // namespace

double BeforeAfter::fractionRemoved() const noexcept {
  if (before == 0) return kNone;
  return 1.0 - static_cast<double>(after) / static_cast<double>(before);
}

std::optional<std::int64_t> ContactGhosting::delayFrames() const {
  if (!firstAfter) return std::nullopt;
  return static_cast<std::int64_t>(*firstAfter) - static_cast<std::int64_t>(firstBefore);
}

MatrixGhosting GhostingReport::total() const {
  MatrixGhosting sum;
  for (const MatrixGhosting& matrix : matrices) {
    sum.falseTaxels += matrix.falseTaxels;
    sum.scattered += matrix.scattered;
    sum.framesWithFalse += matrix.framesWithFalse;
    sum.framesWhole += matrix.framesWhole;
  }
  return sum;
}

std::uint64_t GhostingReport::hidden() const {
  return static_cast<std::uint64_t>(std::count_if(
      contacts.begin(), contacts.end(), [](const auto& contact) { return !contact.firstAfter; }));
}

double GhostingReport::meanDelayFrames() const {
  double sum = 0.0;
  std::size_t number = 0;
  for (const ContactGhosting& contact : contacts) {
    if (const auto delay = contact.delayFrames()) {
      sum += static_cast<double>(*delay);
      ++number;
    }
  }
  return number == 0 ? kNone : sum / static_cast<double>(number);
}

double GhostingReport::largestDelayFrames() const {
  double largest = kNone;
  for (const ContactGhosting& contact : contacts)
    if (const auto delay = contact.delayFrames())
      // fmax() of a NaN and a number is the number.
      largest = std::fmax(largest, static_cast<double>(*delay));
  return largest;
}

GhostingReport measureGhosting(const Profile& profile,
                               const Recipe& recipe,
                               std::span<const CellTruthMask> truth,
                               const GhostingOptions& options,
                               const Progress& progress) {
  checkGhosting(profile, truth, options);
  GhostingReport report;
  Outcome outcome;
  FilterChain chain(recipe, outcome);
  Counter counter(profile, truth, options, report);
  TactileFrame frame;
  double spentUs = 0.0;
  auto restart = options.restartsUs.begin();
  const auto timed = [&](auto&& work) {
    const auto from = GhostingSteadyClock::now();
    work();
    spentUs += std::chrono::duration<double, std::micro>(GhostingSteadyClock::now() - from).count();
    for (const std::vector<float>& filtered : outcome.frames()) counter.count(filtered);
    outcome.frames().clear();
  };
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    reportProgress(progress, i, profile.numFrames(), kGhostingFramesPerReport);
    profile.readFrame(i, frame);
    if (restart != options.restartsUs.end() && frame.hostUs >= *restart) {
      timed([&] { chain.restart(); });
      restart = std::upper_bound(restart, options.restartsUs.end(), frame.hostUs);
    }
    timed([&] { chain.push(frame); });
  }
  timed([&] { chain.finish(); });
  counter.finish();
  report.latencyFrames = latencyFrames(recipe);
  if (report.frames > 0) report.costUs = spentUs / static_cast<double>(report.frames);
  return report;
}

}  // namespace palpate
