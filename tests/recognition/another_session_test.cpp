// Tests recognition in another session on the real recordings: 571 grasps of 36 classes from
// September 2014, and 42 grasps of three of these objects 11 weeks later (protocol X). Neither is
// an independent test; docs/notes/recognition.md lists which choices were made on which data.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "palpate/recognition/feature_table.h"
#include "palpate/recognition/plateau_features.h"
#include "palpate/recognition/session_adaptive_classifier.h"
#include "palpate/recognition/session_offset.h"

#include "testing/testing.h"

namespace palpate::another_session_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Samples {
  MatrixXd x;
  std::vector<int> y;

  Samples where(const std::function<bool(std::size_t)>& chosen) const {
    Samples out;
    std::vector<Eigen::Index> rows;
    for (std::size_t i = 0; i < y.size(); ++i)
      if (chosen(i)) {
        rows.push_back(static_cast<Eigen::Index>(i));
        out.y.push_back(y[i]);
      }
    out.x = x(rows, Eigen::all);
    return out;
  }
  Samples of(int c) const {
    return where([&](std::size_t i) { return y[i] == c; });
  }
};

class AnotherDay : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto folder = testing::recordingsFolder();
    PALPATE_NEED(folder);
    const FeatureTable september = extractFeatures({*folder / "grasps_by_class"});
    ASSERT_EQ(september.rows.size(), 571u);
    names_ = september.names;
    classes_ = september.classes();
    ASSERT_EQ(classes_.size(), 36u);
    september_ = samplesOf(september, "");
    std::map<int, int> count, seen;
    for (const int c : september_.y) ++count[c];
    // The names of the recordings contain their frames, so that sorting gives the order in time.
    std::vector<std::pair<std::string, std::size_t>> order;
    early_.assign(september_.y.size(), false);
    for (std::size_t i = 0; i < september.rows.size(); ++i)
      order.emplace_back(september.rows[i].file.string(), i);
    std::sort(order.begin(), order.end());
    for (const auto& [name, i] : order) {
      const int c = september_.y[i];
      early_[i] = seen[c]++ < std::lround(count[c] * 2.0 / 3.0);
    }
    for (const char* file : {"grasps/hockey_ball.dsa", "grasps/foam_ball.dsa"})
      append(november27_, samplesOf(extractFeatures({*folder / file}), file));
    november28_ =
        samplesOf(extractFeatures({*folder / "classification_video/pen_thick.dsa"}), "pen_thick");
    ASSERT_EQ(november27_.y.size() + november28_.y.size(), 42u);
  }

  int classNumber(const std::string& name) const {
    return static_cast<int>(std::lower_bound(classes_.begin(), classes_.end(), name) -
                            classes_.begin());
  }

  Samples samplesOf(const FeatureTable& table, const std::string& file) const {
    Samples out;
    out.x.resize(static_cast<Eigen::Index>(table.rows.size()),
                 static_cast<Eigen::Index>(table.names.size()));
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
      out.x.row(static_cast<Eigen::Index>(i)) =
          VectorXd::Map(table.rows[i].values.data(), out.x.cols()).transpose();
      std::string name = table.rows[i].className;
      if (file.find("hockey") != std::string::npos) name = "hockey ball";
      if (file.find("foam") != std::string::npos) name = "foam ball";
      if (file.find("pen") != std::string::npos) name = "pen thick";
      out.y.push_back(classNumber(name));
    }
    return out;
  }
  static void append(Samples& to, const Samples& more) {
    MatrixXd x(to.x.rows() + more.x.rows(), more.x.cols());
    x << to.x.reshaped(to.x.rows(), more.x.cols()), more.x;
    to.x = x;
    to.y.insert(to.y.end(), more.y.begin(), more.y.end());
  }

  SessionAdaptiveClassifier learn(const Samples& samples) const {
    return SessionAdaptiveClassifier::learn(samples.x, samples.y, classes_, names_);
  }
  // Fits a classifier without one class.
  SessionAdaptiveClassifier learnWithout(const Samples& samples, int without) const {
    Samples rest = samples.where([&](std::size_t i) { return samples.y[i] != without; });
    for (int& c : rest.y) c -= c > without ? 1 : 0;
    auto names = classes_;
    names.erase(names.begin() + without);
    return SessionAdaptiveClassifier::learn(rest.x, rest.y, names, names_);
  }
  Samples early() const {
    return september_.where([&](std::size_t i) { return early_[i]; });
  }
  Samples late() const {
    return september_.where([&](std::size_t i) { return !early_[i]; });
  }

  std::vector<std::string> names_, classes_;
  Samples september_, november27_, november28_;
  // Whether a sample of September is in the first two thirds of its recording.
  std::vector<bool> early_;
};

struct Score {
  int all = 0, first = 0, three = 0, sure = 0, sureRight = 0;

  void add(const std::vector<OpenSetPrediction>& predictions, const std::vector<int>& y) {
    for (std::size_t i = 0; i < y.size(); ++i) {
      const auto c = static_cast<std::size_t>(y[i]);
      const auto& ranking = predictions[i].ranking;
      ++all;
      first += ranking[0] == c ? 1 : 0;
      three += ranking[0] == c || ranking[1] == c || ranking[2] == c ? 1 : 0;
      sure += predictions[i].sure ? 1 : 0;
      sureRight += predictions[i].sure && ranking[0] == c ? 1 : 0;
    }
  }
  double top1() const { return static_cast<double>(first) / all; }
  double top3() const { return static_cast<double>(three) / all; }
  void print(const char* what) const {
    std::printf("  %-44s top-1 %d/%d = %.3f, top-3 %.3f, sure %d, of these right %d\n",
                what,
                first,
                all,
                top1(),
                top3(),
                sure,
                sureRight);
  }
};

double auroc(const std::vector<double>& known, const std::vector<double>& unknown) {
  double above = 0.0;
  for (const double k : known)
    for (const double u : unknown) above += k > u ? 1.0 : (k == u ? 0.5 : 0.0);
  return above / static_cast<double>(known.size() * unknown.size());
}

TEST_F(AnotherDay, WithinTheDay) {
  const SessionAdaptiveClassifier model = learn(early());
  const Samples tests = late();
  SessionOffset exact = givenOffset(0.0);
  Score score;
  const auto predictions = predictAll(model, tests.x, exact);
  score.add(predictions, tests.y);
  score.print("same day, last third");
  EXPECT_GE(score.top1(), 0.97);
  EXPECT_EQ(score.top3(), 1.0);
  EXPECT_GE(score.sureRight, 0.95 * score.sure);

  std::vector<double> known, unknown;
  for (const OpenSetPrediction& prediction : predictions)
    known.push_back(prediction.logLikelihoodRatio);
  for (int c = 0; c < static_cast<int>(classes_.size()); ++c)
    for (const OpenSetPrediction& prediction :
         predictAll(learnWithout(early(), c), tests.of(c).x, exact))
      unknown.push_back(prediction.logLikelihoodRatio);
  const double found = auroc(known, unknown);
  std::sort(known.begin(), known.end());
  std::sort(unknown.begin(), unknown.end());
  std::printf(
      "  AUROC %.3f; knownness of known ones: 1%% %.2f 3%% %.2f 5%% %.2f 50%% %.2f; of unknown "
      "50%% %.2f 90%% %.2f\n",
      found,
      known[known.size() / 100],
      known[known.size() * 3 / 100],
      known[known.size() / 20],
      known[known.size() / 2],
      unknown[unknown.size() / 2],
      unknown[unknown.size() * 9 / 10]);
  EXPECT_GE(found, 0.97);
}

TEST_F(AnotherDay, ElevenWeeksLater) {
  const SessionAdaptiveClassifier model = learn(september_);
  const auto scoreWith = [&](const auto& offsetOf, const char* what) {
    Score score;
    for (const Samples* day : {&november27_, &november28_}) {
      const SessionOffset offset = offsetOf(*day);
      score.add(predictAll(model, day->x, offset), day->y);
    }
    score.print(what);
    return score;
  };
  const Score none = scoreWith([](const Samples&) { return noOffset(); }, "no offset");
  EXPECT_EQ(none.sure, 0);
  const Score open =
      scoreWith([](const Samples&) { return unknownOffset(); }, "offset unknown, summed over");
  EXPECT_GE(open.top1(), 0.60);
  EXPECT_GE(open.top3(), 0.92);
  EXPECT_EQ(open.sure, 0);
  const Score batch = scoreWith(
      [&](const Samples& day) {
        const SessionOffset offset = offsetFromBatch(model, day.x);
        std::printf("  %s\n", offset.text().c_str());
        return offset;
      },
      "the day's unlabelled batch");
  EXPECT_GE(batch.top1(), 0.90);
  EXPECT_GE(batch.sureRight, 0.95 * batch.sure);

  // One labelled grasp of each present class, drawn at random.
  Score one;
  std::mt19937 random(1);
  for (int turn = 0; turn < 50; ++turn)
    for (const Samples* day : {&november27_, &november28_}) {
      std::map<int, std::vector<std::size_t>> of;
      for (std::size_t i = 0; i < day->y.size(); ++i) of[day->y[i]].push_back(i);
      std::vector<bool> labelled(day->y.size(), false);
      for (const auto& [c, all] : of) labelled[all[random() % all.size()]] = true;
      const Samples today = day->where([&](std::size_t i) { return labelled[i]; });
      const Samples rest = day->where([&](std::size_t i) { return !labelled[i]; });
      SessionAdaptiveClassifier adapted = model;
      const SessionOffset offset = offsetFromReferences(model, today.x, today.y);
      adapted.addSessionComponents(today.x, today.y, offset.mm);
      one.add(predictAll(adapted, rest.x, offset), rest.y);
    }
  one.print("one labelled grasp per class, 50 draws");
  EXPECT_GE(one.top1(), 0.95);
}

// Simulated sessions made from the last thirds of the September recordings: a session offset N(0, 3
// mm), an offset N(0, 1 mm) per object, and a shape error of half a standard deviation per object.
class SimulatedDays {
 public:
  SimulatedDays(const Samples& late, const SessionAdaptiveClassifier& model, int seed)
      : late_(late),
        scatter_(model.data().pooled.diagonal().cwiseSqrt()),
        random_(static_cast<unsigned>(seed)) {}

  Samples day(int objects) {
    std::vector<int> classes(36);
    std::iota(classes.begin(), classes.end(), 0);
    std::shuffle(classes.begin(), classes.end(), random_);
    classes.resize(static_cast<std::size_t>(objects));
    offsetMm = 3.0 * normal_(random_);
    Samples out;
    for (const int c : classes) {
      Samples of = late_.of(c);
      const double sizeMm = offsetMm + normal_(random_);
      VectorXd shape(of.x.cols());
      for (double& value : shape) value = 0.5 * normal_(random_);
      for (Eigen::Index i = 0; i < of.x.rows(); ++i) {
        const double size = sizeZ(distanceOfSizeZ(of.x(i, 0)) + sizeMm);
        of.x.row(i) += (shape.array() * scatter_.array()).matrix().transpose();
        of.x(i, 0) = size;
      }
      MatrixXd all(out.x.rows() + of.x.rows(), of.x.cols());
      if (out.x.rows() > 0) all.topRows(out.x.rows()) = out.x;
      all.bottomRows(of.x.rows()) = of.x;
      out.x = all;
      out.y.insert(out.y.end(), of.y.begin(), of.y.end());
    }
    return out;
  }
  // Offset of the session that was made last [mm].
  double offsetMm = 0.0;

 private:
  const Samples& late_;
  VectorXd scatter_;
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
};

TEST_F(AnotherDay, OnSimulatedDaysConfidenceIsHonest) {
  const SessionAdaptiveClassifier model = learn(early());
  const Samples tests = late();
  for (const int objects : {1, 2, 3, 5}) {
    SimulatedDays days(tests, model, 3);
    Score score;
    int trusted = 0;
    double squares = 0.0;
    constexpr int kDays = 60;
    for (int i = 0; i < kDays; ++i) {
      const Samples day = days.day(objects);
      const SessionOffset offset = offsetFromBatch(model, day.x);
      trusted += offset.trusted ? 1 : 0;
      squares += (offset.mm - days.offsetMm) * (offset.mm - days.offsetMm);
      score.add(predictAll(model, day.x, offset), day.y);
    }
    score.print(("simulated days of " + std::to_string(objects) + " objects, batch").c_str());
    std::printf("    offset trusted on %d of %d days, error %.2f mm rms\n",
                trusted,
                kDays,
                std::sqrt(squares / kDays));
    if (objects == 1) {
      EXPECT_LT(trusted, kDays / 10);
    }
    if (objects > 1) {
      EXPECT_GT(trusted, kDays * 7 / 10);
      EXPECT_GE(score.sureRight, 0.94 * score.sure);
      EXPECT_GE(score.top1(), 0.87);
    }
  }
}

TEST_F(AnotherDay, OnSimulatedDaysTheUnknownIsTold) {
  const Samples training = early(), tests = late();
  SimulatedDays days(tests, learn(training), 5);
  std::vector<double> known, unknown;
  for (int i = 0; i < 60; ++i) {
    const Samples day = days.day(5);
    const int stranger = day.y[0];
    const SessionAdaptiveClassifier model = learnWithout(training, stranger);
    const auto predictions = predictAll(model, day.x, offsetFromBatch(model, day.x));
    for (std::size_t k = 0; k < predictions.size(); ++k)
      (day.y[k] == stranger ? unknown : known).push_back(predictions[k].logLikelihoodRatio);
  }
  const double found = auroc(known, unknown);
  std::printf("  AUROC of a fifth object that is unknown: %.3f (%zu known, %zu unknown grasps)\n",
              found,
              known.size(),
              unknown.size());
  const auto below = [](const std::vector<double>& values, double limit) {
    return static_cast<double>(
               std::count_if(values.begin(), values.end(), [&](double v) { return v < limit; })) /
           static_cast<double>(values.size());
  };
  for (const double limit : {0.0, 1.0, 2.0, 3.0, 4.0})
    std::printf("    called unknown below %.0f: %.3f of the known, %.3f of the unknown\n",
                limit,
                below(known, limit),
                below(unknown, limit));
  EXPECT_GE(found, 0.90);
}

// Sessions of one object, which is unknown to the model: with the offset assumed to be 0, not
// known, and estimated from the unknown object's own grasps.
TEST_F(AnotherDay, OnSimulatedDaysWithNothingKnownFewKnownObjectsAreCalledUnknown) {
  const Samples training = early(), tests = late();
  const SessionAdaptiveClassifier whole = learn(training);
  SimulatedDays days(tests, whole, 7);
  constexpr std::size_t kOffsets = 3;
  struct Counts {
    std::vector<double> known, unknown;
    int right = 0, calledUnknown = 0, saidKnown = 0;
  };
  std::array<Counts, kOffsets> counts;
  for (int i = 0; i < 72; ++i) {
    const Samples day = days.day(1);
    const SessionAdaptiveClassifier without = learnWithout(training, day.y[0]);
    const std::array<SessionOffset, kOffsets> forKnown = {
        noOffset(), unknownOffset(), offsetFromBatch(whole, day.x)};
    const std::array<SessionOffset, kOffsets> forUnknown = {
        noOffset(), unknownOffset(), offsetFromBatch(without, day.x)};
    for (std::size_t k = 0; k < kOffsets; ++k) {
      for (const OpenSetPrediction& one : predictAll(whole, day.x, forKnown[k])) {
        counts[k].known.push_back(one.logLikelihoodRatio);
        const bool best = one.ranking[0] == static_cast<std::size_t>(day.y[0]);
        counts[k].right += best && !one.unknown ? 1 : 0;
        counts[k].calledUnknown += one.unknown ? 1 : 0;
      }
      for (const OpenSetPrediction& one : predictAll(without, day.x, forUnknown[k])) {
        counts[k].unknown.push_back(one.logLikelihoodRatio);
        counts[k].saidKnown += one.membership == Membership::kKnown ? 1 : 0;
      }
    }
  }
  const char* names[] = {"assumed to be 0", "not known", "from its own grasps"};
  for (std::size_t k = 0; k < kOffsets; ++k) {
    const auto all = static_cast<double>(counts[k].known.size());
    std::printf(
        "  offset %-20s right %.3f, called unknown %.3f; unknown objects: AUROC %.3f, "
        "said to be known %.3f\n",
        names[k],
        counts[k].right / all,
        counts[k].calledUnknown / all,
        auroc(counts[k].known, counts[k].unknown),
        counts[k].saidKnown / all);
    if (k == 0) continue;
    EXPECT_LE(counts[k].calledUnknown / all, 0.05);
    EXPECT_LE(counts[k].saidKnown / all, 0.05);
    EXPECT_GT(counts[k].right, counts[0].right);
    EXPECT_GE(auroc(counts[k].known, counts[k].unknown),
              auroc(counts[1].known, counts[1].unknown) - 0.01);
  }
}

// Each of the three objects of 11 weeks later is removed from the model in turn. If the offset of
// the session is known (here estimated from the same grasps with the whole model, as a touch of the
// empty hand would give it), unknown objects are detected. If the offset is estimated from the
// unknown objects themselves, it makes them similar to a neighbouring class.
TEST_F(AnotherDay, ElevenWeeksLaterTheUnknownIsToldWhereTheOffsetIsKnown) {
  const SessionAdaptiveClassifier model = learn(september_);
  std::vector<double> known, unknown, unknownInBatch;
  for (const Samples* day : {&november27_, &november28_}) {
    const SessionOffset estimated = offsetFromBatch(model, day->x);
    const SessionOffset offset =
        measuredOffset(estimated.mm, estimated.sdMm, OffsetSource::kEmptyHand);
    for (const OpenSetPrediction& prediction : predictAll(model, day->x, offset))
      known.push_back(prediction.logLikelihoodRatio);
    std::vector<int> present = day->y;
    std::sort(present.begin(), present.end());
    present.erase(std::unique(present.begin(), present.end()), present.end());
    for (const int c : present) {
      const SessionAdaptiveClassifier without = learnWithout(september_, c);
      const MatrixXd x = day->of(c).x;
      std::vector<double> own;
      for (const OpenSetPrediction& prediction : predictAll(without, x, offset))
        own.push_back(prediction.logLikelihoodRatio);
      std::printf(
          "  %s: AUROC %.3f\n", classes_[static_cast<std::size_t>(c)].c_str(), auroc(known, own));
      unknown.insert(unknown.end(), own.begin(), own.end());
      for (const OpenSetPrediction& prediction :
           predictAll(without, x, offsetFromBatch(without, day->x)))
        unknownInBatch.push_back(prediction.logLikelihoodRatio);
    }
  }
  std::printf("  AUROC %.3f, with the offset from the batch itself %.3f\n",
              auroc(known, unknown),
              auroc(known, unknownInBatch));
  EXPECT_GE(auroc(known, unknown), 0.90);
}

}  // namespace
}  // namespace palpate::another_session_test
