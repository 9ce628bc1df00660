#include "testing/punctuality.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "testing/time_limit.h"

namespace palpate::testing {
namespace {

double milliseconds(std::int64_t us) { return static_cast<double>(us) / 1e3; }

bool excused(const TimedAnswer& answer, std::int64_t limitUs) {
  return answer.tookUs - answer.standstillUs <= limitUs;
}

}  // namespace

PunctualityReport punctualityOf(const std::vector<TimedAnswer>& answers,
                                const PunctualityLimits& limits) {
  PunctualityReport report;
  report.answers = answers.size();
  if (answers.empty()) {
    report.faults = "nothing was measured";
    return report;
  }
  std::vector<std::int64_t> took;
  for (const TimedAnswer& answer : answers) {
    took.push_back(answer.tookUs);
    report.late += answer.tookUs > limits.usualUs;
    report.lateUnexcused += answer.tookUs > limits.usualUs && !excused(answer, limits.usualUs);
    report.tooLateUnexcused += answer.tookUs > limits.worstUs && !excused(answer, limits.worstUs);
  }
  std::sort(took.begin(), took.end());
  const auto quantile = [&](double share) {
    const double place = std::ceil(share * static_cast<double>(took.size())) - 1.0;
    return milliseconds(took[static_cast<std::size_t>(std::max(place, 0.0))]);
  };
  report.medianMs = quantile(0.5);
  report.p99Ms = quantile(0.99);
  report.worstMs = milliseconds(took.back());
  report.lateAllowed = static_cast<std::size_t>(
      std::floor((1.0 - limits.share) * static_cast<double>(took.size()) + 1e-9));
  if (report.lateUnexcused > report.lateAllowed)
    report.faults += std::to_string(report.lateUnexcused) + " of " +
                     std::to_string(report.answers) + " were late while the machine ran, " +
                     std::to_string(report.lateAllowed) + " may be";
  if (report.tooLateUnexcused > 0)
    report.faults += (report.faults.empty() ? "" : "; ") + std::to_string(report.tooLateUnexcused) +
                     " took longer than any may, while the machine ran";
  return report;
}

Punctuality::Punctuality(std::string name, PunctualityLimits limits)
    : name_(std::move(name)), limits_(limits) {}

void Punctuality::took(std::int64_t beginUs, std::int64_t endUs) {
  const TimedAnswer answer{endUs - beginUs, heartbeat_.standstillUs(beginUs, endUs)};
  if (answer.tookUs > limits_.usualUs)
    std::printf("%s: number %zu took %.2f ms, the machine stood still for %.2f ms of it: %s\n",
                name_.c_str(),
                answers_.size(),
                milliseconds(answer.tookUs),
                milliseconds(answer.standstillUs),
                excused(answer, limits_.usualUs) ? "excused" : "late");
  answers_.push_back(answer);
}

void Punctuality::lost(std::int64_t beginUs,
                       std::int64_t endUs,
                       std::int64_t forUs,
                       const std::string& why) {
  const std::int64_t standstillUs = heartbeat_.standstillUs(beginUs, endUs);
  ++lost_;
  std::printf("%s: nothing measured: %s; the machine stood still for %.2f ms\n",
              name_.c_str(),
              why.c_str(),
              milliseconds(standstillUs));
  if (judgesTime()) {
    EXPECT_GE(standstillUs, forUs) << name_ << ": " << why << ", while the machine ran";
  }
}

PunctualityReport Punctuality::judge(const std::string& moreJson) {
  const PunctualityReport report = punctualityOf(answers_, limits_);
  std::printf(
      "measured {\"name\": \"%s\", \"answers\": %zu, \"median_ms\": %.2f, \"p99_ms\": %.2f, "
      "\"worst_ms\": %.2f, \"limit_ms\": %g, \"late\": %zu, \"late_excused\": %zu, \"lost\": "
      "%zu%s%s}\n",
      name_.c_str(),
      report.answers,
      report.medianMs,
      report.p99Ms,
      report.worstMs,
      milliseconds(limits_.usualUs),
      report.late,
      report.late - report.lateUnexcused,
      lost_,
      moreJson.empty() ? "" : ", ",
      moreJson.c_str());
  if (judgesTime()) {
    EXPECT_EQ(report.faults, "") << name_;
  }
  return report;
}

}  // namespace palpate::testing
