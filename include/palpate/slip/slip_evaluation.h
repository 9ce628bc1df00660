// How good alarms of slip are on real recordings: false alarms per hour of contact that doesn't
// slip, slips found, delay.
//
// No slip: recordings of single grasps that are assumed to be free of slip (not verified; some
// alarms may be real settling). Slip: recordings in which an object was pulled through the fingers,
// labelled by a rule: the centroid of a matrix moved by more than 1 taxel in 10 frames of
// uninterrupted contact (spans with at most 5 frames between them are joined). The onset is the
// frame in which it was 0.2 taxel away from its position 10 frames before the first of these. The
// rule favours the centroid method and misses slip below 0.1 taxel per frame.
// Contact: at least 4 active taxels and a load over 400 counts. Settled: 15 frames of it. Quiet:
// settled, and the load within 5 % over 10 frames. Alarms less than 10 frames apart are one. A slip
// is found by an alarm from its onset to its end.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/model/profile.h>
#include <palpate/slip/slip_rule.h>
#include <palpate/slip/slip_windows.h>

namespace palpate {

struct SlipLabel {
  std::size_t matrix = 0;
  std::size_t onset = 0;  // frames, both inclusive
  std::size_t end = 0;
  bool operator==(const SlipLabel&) const = default;
};
// By matrix, then onset.
std::vector<SlipLabel> labelSlips(const Profile& profile);

struct SlipScore {
  // All contact, settled, quiet.
  std::array<double, 3> matrixHours{};
  std::array<std::size_t, 3> falseAlarms{};
  std::size_t slips = 0;
  std::size_t found = 0;
  std::vector<int> delaysFrames;  // of those found, ascending

  double perHour(std::size_t kind) const;  // 0 without hours
  double detectionRate() const;            // 0 without slips
  void add(const SlipScore& other);
};
enum SlipContact : std::size_t { kAllContact, kSettledContact, kQuietContact };

struct ScoredAlarm {
  std::string name;
  SlipScore score;
};

struct SlipEvaluationReport {
  std::size_t noSlipRecordings = 0;
  std::size_t slipRecordings = 0;
  // "centroid-step": the centroid moves over 0.20 per frame, over 3 frames. "centroid-windows":
  // over 0.3 in 3 or 0.5 in 10 frames, twice. "register-windows": the registration instead.
  // "contest": SlipRule as it stands; "contest-joints": told what joints do. "contest-held-out":
  // the better of two folds' settings, scored on the other fold (see kSlipGrid).
  std::vector<ScoredAlarm> alarms;
  std::array<SlipRuleOptions, 2> chosen;  // on fold 0 and 1
};

// Takes recordings in any number and keeps what windows saw, so that many rules can be scored.
class SlipEvaluation {
 public:
  explicit SlipEvaluation(const SlipWindowsOptions& options = {}) : options_(options) {}
  void addNoSlipRecording(const Profile& profile, const Progress& progress = {});
  void addSlipRecording(const Profile& profile, const Progress& progress = {});

  // fold: -1 all, 0 or 1 a half: every second recording of holds; of slips the earlier or later
  // half of each recording's.
  SlipScore score(const SlipRuleOptions& rule, bool joints, int fold = -1) const;
  SlipEvaluationReport report() const;

 private:
  struct FrameEvidence {
    std::size_t frame = 0;
    std::size_t age = 0;  // frames of contact
    bool quiet = false;
    SlipEvidence evidence;
  };
  struct Series {
    bool slip = false;
    int fold = 0;
    double hoursPerFrame = 0.0;
    std::vector<FrameEvidence> seen;
    std::vector<SlipLabel> labels;
    std::vector<int> labelFolds;
  };
  template <typename Alarm>
  SlipScore scoreOf(const Alarm& begin, int fold) const;
  void add(const Profile& profile, bool slip, const Progress& progress);

  SlipWindowsOptions options_;
  std::vector<Series> series_;
  std::size_t holds_ = 0, slips_ = 0;
};

// The settings that the two folds choose from: 72. The best of a fold finds at least 92 % of its
// slips, with the fewest false alarms (settled ones, and a seventh of all).
std::vector<SlipRuleOptions> slipGrid();

}  // namespace palpate
