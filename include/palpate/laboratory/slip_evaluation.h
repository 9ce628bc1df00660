// Evaluates slip alarms on real recordings: false alarms per hour of contact without slip, fraction
// of slips that are found, and delay.
//
// No slip: recordings of single grasps that are assumed to be free of slip (not verified; some
// alarms may be real settling). Slip: recordings in which an object was pulled through the fingers,
// labelled by a rule: the centroid of a matrix moved by more than 1 taxel in 10 frames of
// uninterrupted contact (spans with at most 5 frames between them are joined). The onset is the
// frame in which the centroid was 0.2 taxel away from its position 10 frames before the first of
// these frames. The rule favours the centroid method and misses slip below 0.1 taxel per frame.
// Contact: at least 4 active taxels and a load over 400 counts. Settled: at least 15 frames of
// contact. Quiet: settled, and the load within 5 % over 10 frames. Alarms less than 10 frames apart
// count as one. A slip is found if there is an alarm between its onset and its end.
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
  // First and last frame of the slip, both inclusive.
  std::size_t onset = 0;
  std::size_t end = 0;
  bool operator==(const SlipLabel&) const = default;
};
// Finds the slips of a recording by the rule above, sorted by matrix, then onset.
std::vector<SlipLabel> labelSlips(const Profile& profile);

// Counts of one alarm over recordings.
struct SlipScore {
  // Hours of contact, summed over the matrices, and false alarms in them; indices: SlipContact.
  std::array<double, 3> matrixHours{};
  std::array<std::size_t, 3> falseAlarms{};
  std::size_t slips = 0;
  std::size_t found = 0;
  // Delays of the slips that were found, from the onset [frames], ascending.
  std::vector<int> delaysFrames;

  // False alarms per hour of contact of one kind; 0 when there is no such contact.
  double perHour(std::size_t kind) const;
  // Fraction of the slips that were found; 0 when there are no slips.
  double detectionRate() const;
  void add(const SlipScore& other);
};
enum SlipContact : std::size_t { kAllContact, kSettledContact, kQuietContact };

// A named alarm with its score.
struct ScoredAlarm {
  std::string name;
  SlipScore score;
};

struct SlipEvaluationReport {
  std::size_t noSlipRecordings = 0;
  std::size_t slipRecordings = 0;
  // "centroid-step": the centroid moves by more than 0.20 taxel per frame, over 3 frames.
  // "centroid-windows": it moves by more than 0.3 taxel in 3 frames or 0.5 in 10, in two frames in
  // a row. "register-windows": the same with the motion of the registration. "contest": SlipRule
  // with its default options; "contest-joints": the same, with joint angles. "contest-held-out":
  // the sequential test fitted to each of two folds and scored on the other fold, folds as
  // SlipFolds::kSlipHalves; "contest-held-out-recordings": the same, folds as kRecordings.
  std::vector<ScoredAlarm> alarms;
  // Settings fitted to fold 0 and to fold 1 of kRecordings.
  std::array<SlipRuleOptions, 2> chosen;
};

// How the data are divided into two folds. Every second recording without slip belongs to fold 1.
enum class SlipFolds {
  // The later half of the slips of each recording belongs to fold 1.
  kSlipHalves,
  // All slips of every second recording belong to fold 1.
  kRecordings,
};

// Collects recordings and keeps the evidence of their windows, so that many rules can be scored
// without reading the recordings again.
class SlipEvaluation {
 public:
  explicit SlipEvaluation(const SlipWindowsOptions& options = {}) : options_(options) {}
  void addNoSlipRecording(const Profile& profile, const Progress& progress = {});
  void addSlipRecording(const Profile& profile, const Progress& progress = {});

  // Scores a rule, with or without joint angles. fold: -1 for all, 0 or 1 for one of the folds.
  SlipScore score(const SlipRuleOptions& rule,
                  bool joints,
                  int fold = -1,
                  SlipFolds folds = SlipFolds::kSlipHalves) const;
  // Fits the weights of the sequential test to one fold (-1: to all): a logistic regression of the
  // frames of its slips, from the frame after the onset to the 12th or the end, against all frames
  // without slip; ridge of 100 on standardised features, joint angles not used. The slips weigh a
  // fifth of the other frames, or one each if that is more, and the bias is raised by 1. The
  // threshold is the smallest with which the fold has no more false alarms than the windows have
  // without the test, times 1.05. Returns the default rule if the fold has no slips or no contact
  // without slip.
  SlipRuleOptions fitSlipSequence(int fold, SlipFolds folds) const;
  SlipEvaluationReport report() const;

 private:
  struct FrameEvidence {
    std::size_t frame = 0;
    // Number of frames since the contact began.
    std::size_t age = 0;
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
    // Fold by SlipFolds::kRecordings.
    int recordingFold = 0;
  };
  template <typename Alarm>
  SlipScore scoreOf(const Alarm& begin, int fold, SlipFolds folds) const;
  static int foldOf(const Series& series, std::size_t label, SlipFolds folds);
  void add(const Profile& profile, bool slip, const Progress& progress);

  SlipWindowsOptions options_;
  std::vector<Series> series_;
  std::size_t holds_ = 0, slips_ = 0;
};

}  // namespace palpate
