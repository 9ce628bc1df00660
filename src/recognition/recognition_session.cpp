#include "palpate/recognition/recognition_session.h"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <utility>

#include "palpate/core/error.h"

namespace palpate {
namespace {

constexpr std::int64_t kPauseUs = 8LL * 3600 * 1'000'000;

}  // namespace

RecognitionSession::RecognitionSession(TrainedModel model)
    : model_(std::move(model)), adapted_(model_) {
  renew();
}

std::size_t RecognitionSession::add(std::vector<double> values, std::int64_t timeUs) {
  if (values.size() != model_.features.size())
    throw std::invalid_argument("a grasp has " + std::to_string(values.size()) +
                                " features, the model " + std::to_string(model_.features.size()));
  if (!grasps_.empty() && std::abs(timeUs - grasps_.back().timeUs) > kPauseUs) reset();
  const auto same = std::find_if(
      grasps_.begin(), grasps_.end(), [&](const Grasp& grasp) { return grasp.timeUs == timeUs; });
  const auto place = static_cast<std::size_t>(same - grasps_.begin());
  if (same == grasps_.end())
    grasps_.push_back({std::move(values), timeUs, std::nullopt});
  else
    same->values = std::move(values);
  renew();
  return place;
}

void RecognitionSession::setLabel(std::size_t grasp, std::optional<int> classIndex) {
  if (!model_.adaptsToSession()) throw Error("this model can't be adapted to a session");
  if (classIndex &&
      (*classIndex < 0 || static_cast<std::size_t>(*classIndex) >= model_.classes.size()))
    throw std::out_of_range("class " + std::to_string(*classIndex));
  grasps_.at(grasp).labelledClass = classIndex;
  renew();
}

std::size_t RecognitionSession::numLabelled() const noexcept {
  return static_cast<std::size_t>(
      std::count_if(grasps_.begin(), grasps_.end(), [](const Grasp& grasp) {
        return grasp.labelledClass.has_value();
      }));
}

void RecognitionSession::setZero(const EmptyHandZero& today) {
  zeroOffset_ = offsetOfEmptyHand(model_, today);
  zero_ = today;
  renew();
}

void RecognitionSession::choose(const OffsetChoice& choice) {
  if (!model_.adaptsToSession() &&
      (choice.kind == OffsetChoice::Kind::kBatch || choice.kind == OffsetChoice::Kind::kGiven))
    throw Error("this model has no session offset");
  choice_ = choice;
  renew();
}

void RecognitionSession::reset() {
  grasps_.clear();
  zero_.reset();
  zeroOffset_.reset();
  renew();
}

Eigen::MatrixXd RecognitionSession::rows(bool labelledOnly) const {
  Eigen::MatrixXd x(static_cast<Eigen::Index>(labelledOnly ? numLabelled() : grasps_.size()),
                    static_cast<Eigen::Index>(model_.features.size()));
  Eigen::Index i = 0;
  for (const Grasp& grasp : grasps_)
    if (!labelledOnly || grasp.labelledClass)
      x.row(i++) = Eigen::Map<const Eigen::RowVectorXd>(grasp.values.data(), x.cols());
  return x;
}

void RecognitionSession::renew() {
  adapted_ = model_;
  std::vector<std::int64_t> times;
  for (const Grasp& grasp : grasps_) times.push_back(grasp.timeUs);
  const bool known = zeroOffset_.has_value() || numLabelled() > 0;
  const bool batch = choice_.kind == OffsetChoice::Kind::kBatch;
  const bool given = choice_.kind == OffsetChoice::Kind::kGiven;
  const SessionContext use =
      sessionFor(model_, rows(false), times, known && batch ? OffsetChoice() : choice_);
  sameSession_ = use.sameSession;
  offset_ = use.offset;
  if (known && !given) {
    offset_ = zeroOffset_.value_or(unknownOffset());
    SessionAdaptiveClassifier& classifier = *adapted_.pipeline.sessionAdaptive;
    if (numLabelled() > 0) {
      std::vector<int> y;
      for (const Grasp& grasp : grasps_)
        if (grasp.labelledClass) y.push_back(*grasp.labelledClass);
      const Eigen::MatrixXd x = rows(true);
      offset_ = offsetFromReferences(classifier, x, y, offset_);
      classifier.addSessionComponents(x, y, offset_.mm);
    }
    if (batch && grasps_.size() > numLabelled())
      offset_ = offsetFromBatch(*adapted_.pipeline.sessionAdaptive, rows(false), offset_);
  }
  if (zero_ && !given) adapted_.sessionZero = zero_;
  // A model that nothing was learnt of in this session is saved as it was.
  const bool notAdapted =
      offset_.origin == OffsetSource::kUnknown && choice_.kind == OffsetChoice::Kind::kModel;
  adapted_.offset = notAdapted ? model_.offset : offset_;
  const bool assumed = offset_.origin == OffsetSource::kNone || notAdapted;
  unsure_.clear();
  if (!model_.adaptsToSession() && !sameSession_ && !grasps_.empty())
    unsure_ = "not the session of the training: no answer is sure with this model";
  else if (model_.adaptsToSession() && assumed && !sameSession_ && !grasps_.empty())
    unsure_ =
        "not the session of the training: no answer is sure until the model is adapted to today";
  else if (model_.adaptsToSession() && !assumed && !offset_.trusted)
    unsure_ = offset_.objects < 2 && offset_.grasps > 0
                  ? "no answer is sure: today's grasps are of one object only"
                  : "no answer is sure yet: confirm more grasps of today";
}

Prediction RecognitionSession::predict(const std::vector<double>& values,
                                       std::int64_t timeUs) const {
  if (values.size() != model_.features.size())
    throw std::invalid_argument("a grasp has " + std::to_string(values.size()) +
                                " features, the model " + std::to_string(model_.features.size()));
  const Eigen::MatrixXd x =
      Eigen::Map<const Eigen::RowVectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  if (!grasps_.empty()) return classifyRows(adapted_, x, offset_, sameSession_).front();
  // No grasp of the session has told yet which session it is.
  const bool same = model_.sameSession(timeUs);
  const bool assumed = offset_.origin == OffsetSource::kNone && !same && !model_.inputs.empty();
  return classifyRows(adapted_, x, assumed ? unknownOffset() : offset_, same).front();
}

TrainedModel RecognitionSession::adapted() const {
  TrainedModel model = adapted_;
  for (const Grasp& grasp : grasps_)
    if (grasp.labelledClass) {
      ModelInput input;
      input.file = "of the day";
      input.className = model.classes[static_cast<std::size_t>(*grasp.labelledClass)];
      input.grasps = 1;
      input.firstUs = input.lastUs = grasp.timeUs;
      model.adaptedFrom.push_back(std::move(input));
    }
  return model;
}

}  // namespace palpate
