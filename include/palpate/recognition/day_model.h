// Classes that hold on another day: a heavy-tailed bell (multivariate Student t) per class, widened by what changes from day to
// day, over features of which one (size_z) moves with an unknown offset of the hand (session_offset.h). Beside the classes
// stands a background: what any object of this kind could read, a bell over all class means; what fits it better than
// every class is unknown.
//
//   scatter of class c = ownPart S_c + (1 - ownPart) S_w, off-diagonals times offDiagonal, + diag(day variance)
//   ln p(x | c, o) = ln t_nu(x with D - o; mean_c, scatter_c)
// S_c: covariance of the class, S_w: pooled within classes. Uniform priors. Samples are rows.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <palpate/core/json.h>

namespace palpate {

// Defaults were chosen on the last thirds of the September recordings and sessions simulated from them, the sds of a day taken
// over from earlier work (docs/recognition.md says what that means for the figures).
struct DayModelOptions {
  double ownPart = 0.5;           // 0..1
  double offDiagonal = 1.0;       // 0..1
  double degreesOfFreedom = 8.0;  // nu of the t, > 2; the smaller the heavier the tails
  // Day variance of a feature: this part of its pooled variance, >= 0,
  double dayVariancePart = 1.0;
  // or, where named, this standard deviation.
  std::vector<std::pair<std::string, double>> daySd = {
      {"size_z", 0.225}, {"ln_sum", 0.175}, {"compression_mm", 0.6}};
  std::string sizeFeature =
      "size_z";  // what moves with the offset; where there is no such feature nothing does
  // Few-shot components (addToday): scatter = newScatter (1 + 1/K) S_w; what a class seen today has ahead of one that was not [ln].
  double newScatter = 1.5;  // > 0
  double seenToday = 3.0;   // >= 0

  // Throws std::invalid_argument with the field's name.
  void validate() const;
};

// A bell: ln density by its mean and scatter.
struct DayBell {
  Eigen::VectorXd mean;
  Eigen::MatrixXd scatter;  // symmetric, positive definite
  bool operator==(const DayBell&) const = default;
};

// Of a class, from labelled grasps of today.
struct TodayComponent {
  std::size_t classIndex = 0;
  std::size_t count = 0;  // K, of the grasps it comes from
  DayBell bell;
  bool operator==(const TodayComponent&) const = default;
};

// All a model knows: what a file holds.
struct DayModelData {
  std::vector<std::string> features, classes;
  std::optional<std::size_t> sizeColumn;
  double degreesOfFreedom = 8.0;
  double newScatter = 1.5;
  double seenToday = 3.0;
  std::vector<DayBell> bells;  // per class
  Eigen::MatrixXd pooled;      // S_w
  DayBell background;
  std::vector<TodayComponent> today;
  bool operator==(const DayModelData&) const = default;
};

class DayModel {
 public:
  // From samples x (rows) of classes y (0..classes-1). Throws std::invalid_argument (sizes don't agree, options), Error in
  // one line when nothing can be learnt: values that are no numbers, fewer than two classes, no class with two samples, a class
  // without any.
  static DayModel learn(const Eigen::MatrixXd& x,
                        const std::vector<int>& y,
                        std::vector<std::string> classes,
                        std::vector<std::string> features,
                        const DayModelOptions& options = {});
  // Throws Error naming what doesn't fit together (sizes, a scatter that isn't positive definite, not finite).
  explicit DayModel(DayModelData data);

  const DayModelData& data() const noexcept { return data_; }
  std::size_t numClasses() const noexcept { return data_.classes.size(); }
  std::size_t numFeatures() const noexcept { return data_.features.size(); }
  // What never varied in training, by name: it was given a little scatter, lest any other value be impossible.
  const std::vector<std::string>& constantFeatures() const noexcept { return constant_; }

  // ln p(x | class, offset), one per class, the better of the class's bell and what was seen of it today. Throws
  // std::invalid_argument: another number of features, values that aren't finite.
  Eigen::VectorXd logLikelihoods(const Eigen::VectorXd& x, double offsetMm) const;
  // What a class has ahead of the others beforehand [ln]: seenToday, or 0.
  Eigen::VectorXd logPrior() const;
  // Of the background.
  double logBackground(const Eigen::VectorXd& x, double offsetMm) const;

  // Adds a component per class of labelled grasps of today, whose offset is known or estimated: the grasps are moved by it. A
  // class's older component of today is replaced. Throws std::invalid_argument as learn().
  void addToday(const Eigen::MatrixXd& x, const std::vector<int>& y, double offsetMm);

  // As it would read had the hand no offset.
  Eigen::VectorXd withoutOffset(const Eigen::VectorXd& x, double offsetMm) const;

 private:
  struct Prepared {
    Eigen::VectorXd mean;
    Eigen::MatrixXd
        inverseRoot;        // lower triangular W, |W (x - mean)|^2 = squared Mahalanobis distance
    double constant = 0.0;  // ln of the density at the mean
  };
  Prepared prepare(const DayBell& bell, const std::string& what) const;
  double logDensity(const Prepared& bell, const Eigen::VectorXd& x) const;
  Eigen::VectorXd moved(const Eigen::VectorXd& x, double offsetMm) const;

  DayModelData data_;
  std::vector<Prepared> bells_, today_;
  Prepared background_;
  std::vector<std::string> constant_;
};

Json dayModelJson(const DayModel& model);
// Throws Error naming what is missing or wrong.
DayModel dayModelFrom(const Json& json);

}  // namespace palpate
