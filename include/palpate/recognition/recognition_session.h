// One recognition session: the grasps that were made, the class labels the user gave them, the zero
// adjustment of the empty hand, and the session offset estimated from these. Predictions use this
// offset.
//
// The offset comes from the best source that is available, in this order: a value entered by the
// user; the zero adjustment combined with the labelled grasps; the unlabelled grasps of the
// session, if selected, combined with a zero adjustment; the offset stored in the model.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <palpate/recognition/empty_hand.h>
#include <palpate/recognition/model_evaluation.h>
#include <palpate/recognition/trained_model.h>

namespace palpate {

class RecognitionSession {
 public:
  struct Grasp {
    std::vector<double> values;        // features, as the model's
    std::int64_t timeUs = 0;           // host time of its begin
    std::optional<int> labelledClass;  // class a person named
  };

  explicit RecognitionSession(TrainedModel model);
  const TrainedModel& model() const noexcept { return model_; }

  // Adds a grasp and returns its index; a grasp with the same time keeps its index. A grasp more
  // than 8 h before or after the previous one starts a new session, which clears all grasps, labels
  // and the zero. Throws std::invalid_argument (another number of
  // features).
  std::size_t add(std::vector<double> values, std::int64_t timeUs);
  const std::vector<Grasp>& grasps() const noexcept { return grasps_; }
  // Throw std::out_of_range; Error: the model can't adapt.
  void setLabel(std::size_t grasp, std::optional<int> classIndex);
  std::size_t numLabelled() const noexcept;
  // Throws Error: trouble in it, or the model keeps no zero of its own to compare with.
  void setZero(const EmptyHandZero& today);
  bool hasZero() const noexcept { return zeroOffset_.has_value(); }
  void choose(const OffsetChoice& choice);  // throws Error: the model knows no offset
  const OffsetChoice& choice() const noexcept { return choice_; }
  void reset();  // grasps, names, zero

  const SessionOffset& offset() const noexcept { return offset_; }
  // Reason why no prediction can be sure, one line; empty if a prediction can be sure.
  const std::string& unsure() const noexcept { return unsure_; }
  // Of a grasp that needn't be one of the day's. Throws std::invalid_argument.
  Prediction predict(const std::vector<double>& values, std::int64_t timeUs) const;
  // The model with all that is known of today: to be saved.
  TrainedModel adapted() const;

 private:
  void renew();
  Eigen::MatrixXd rows(bool labelledOnly) const;

  TrainedModel model_;
  std::vector<Grasp> grasps_;
  std::optional<EmptyHandZero> zero_;
  std::optional<SessionOffset> zeroOffset_;  // by it
  OffsetChoice choice_;
  TrainedModel adapted_;  // the model with today's components
  SessionOffset offset_ = noOffset();
  bool sameSession_ = false;
  std::string unsure_;
};

}  // namespace palpate
