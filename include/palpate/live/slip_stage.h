// Live stage that measures how the contact of every matrix moves, and detects slip.
#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include <palpate/live/stage.h>
#include <palpate/model/gap_detector.h>
#include <palpate/model/hand_description.h>
#include <palpate/slip/slip_detector.h>

namespace palpate {

// Options for live use: displacement vector of `centroid`, alarm of the method `contest`
// (docs/notes/slip.md), reference taken when a contact rests.
SlipDetectorOptions liveSlipOptions();

// Fills LiveResults::slip. When the alarm of a matrix begins, an event "slip" marks the moment;
// when it ends, a second event covers the time span (path and rotation as JSON). While the hand
// opens by an order (event "grasp") or by itself there is no alarm: it lets go. Changed sensor
// settings and missing frames reset the detection. All functions except those of Stage may be
// called from any thread; they take effect with the next frame.
class SlipStage final : public Stage {
 public:
  // `hand`: the source's, for its full scale and saturation. Throws std::invalid_argument.
  explicit SlipStage(HandDescription hand, const SlipDetectorOptions& options = liveSlipOptions());

  // Resets the detection. Throws std::invalid_argument.
  void setOptions(const SlipDetectorOptions& options);
  SlipDetectorOptions options() const;
  // The next frame becomes the reference of one matrix or of all matrices; motion is measured
  // against it from the following frame on.
  void setReference(std::optional<std::size_t> matrix = {});

  // Whether the hand opens now though nothing has ordered it; asked for each frame, in the thread
  // of the chain. To be set before the first frame. Empty: it opens on orders only.
  std::function<bool()> opensByItself;

  void reset() override;
  void onFrame(LiveResults& results, std::vector<Event>& out) override;
  void onEvent(const Event& event) override;

 private:
  struct Slipping {
    std::int64_t sinceUs = 0;
    double pathTaxels = 0.0;
    double dx = 0.0, dy = 0.0, turnDeg = 0.0;
  };
  void resetDetection();
  void setOpens(bool opens);
  void applyReferenceRequests(const SensorLayout& layout);
  void emitSlipEvents(std::size_t matrix,
                      const SlipDetection& detection,
                      std::int64_t hostUs,
                      std::vector<Event>& out);

  std::vector<SlipDetector> detectors_;
  std::vector<std::optional<Slipping>> slipping_;
  std::vector<std::optional<std::size_t>> dueRequests_;  // requests for this frame
  std::vector<double> jointsDeg_;
  bool ordered_ = false;  // to open
  bool opens_ = false;

  mutable std::mutex mutex_;  // protects the following members
  const HandDescription hand_;
  SlipDetectorOptions options_;
  bool changed_ = true;
  std::vector<std::optional<std::size_t>> referenceRequests_;
};

}  // namespace palpate
