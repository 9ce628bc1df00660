// One recognition session: the grasps that were made, the class labels the user gave them, the zero
// adjustment of the empty hand, and the session offset estimated from these. Predictions use this
// offset. The recognition of the window keeps one.
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
    // Features, in the order of the model's.
    std::vector<double> values;
    // Host time of its begin [us since 1970].
    std::int64_t timeUs = 0;
    // Class that the user assigned.
    std::optional<int> labelledClass;
  };

  explicit RecognitionSession(TrainedModel model);
  const TrainedModel& model() const noexcept { return model_; }

  // Adds a grasp and returns its index; a grasp with the same time keeps its index. A grasp more
  // than 8 h before or after the previous one starts a new session, which clears all grasps, labels
  // and the zero. Throws std::invalid_argument (another number of
  // features).
  std::size_t add(std::vector<double> values, std::int64_t timeUs);
  const std::vector<Grasp>& grasps() const noexcept { return grasps_; }
  // Sets or clears the label of a grasp. Throws std::out_of_range; Error when the model can't be
  // adapted to a session.
  void setLabel(std::size_t grasp, std::optional<int> classIndex);
  std::size_t numLabelled() const noexcept;
  // Sets the zero of the empty hand. Throws Error when `today` has a problem, or when the model has
  // no zero from its training to compare with.
  void setZero(const EmptyHandZero& today);
  bool hasZero() const noexcept { return zeroOffset_.has_value(); }
  // Selects the source of the offset. Throws Error when the model does not use an offset.
  void choose(const OffsetChoice& choice);
  const OffsetChoice& choice() const noexcept { return choice_; }
  // Clears all grasps, labels and the zero.
  void reset();

  const SessionOffset& offset() const noexcept { return offset_; }
  // Reason why no prediction can be sure, one line; empty if a prediction can be sure.
  const std::string& unsure() const noexcept { return unsure_; }
  // Classifies a grasp, which need not be one of the session. Throws std::invalid_argument.
  Prediction predict(const std::vector<double>& values, std::int64_t timeUs) const;
  // Returns the model adapted to this session, to be saved.
  TrainedModel adapted() const;

 private:
  void renew();
  Eigen::MatrixXd rows(bool labelledOnly) const;

  TrainedModel model_;
  std::vector<Grasp> grasps_;
  std::optional<EmptyHandZero> zero_;
  // Offset that the zero gives.
  std::optional<SessionOffset> zeroOffset_;
  OffsetChoice choice_;
  // The model with the components of this session.
  TrainedModel adapted_;
  SessionOffset offset_ = noOffset();
  bool sameSession_ = false;
  std::string unsure_;
};

}  // namespace palpate
