// Applies a recipe to frames: takes frames as they arrive and passes the filtered ones on. Live
// sources, recordings and the command line use the same class. Its output depends on the stamps and
// values alone, so that all three give the same results bit by bit.
//
// Active taxels are defined by the input frames: a taxel that is 0 in the input is 0 in `values` of
// the output, and its filtered value is in `filtered` (model/tactile_frame.h). A filter can
// therefore shorten a contact, but never create, lengthen or enlarge one. A frame that was filtered
// before is filtered as a whole.
//
// Filters over time restart after a gap (gap_detector.h), when the layout changes (other masks),
// and when the caller asks for it. Filters ignore saturation: a filtered value may be below the
// saturation limit although the taxel was saturated. Saturation is therefore always looked up in
// the unfiltered frames.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <palpate/filter/frame_filter.h>
#include <palpate/filter/recipe.h>
#include <palpate/model/gap_detector.h>

namespace palpate {

// Filters frames by the steps of a recipe.
class FilterChain {
 public:
  // Steps that are disabled are left out. `out` must outlive the chain. Throws
  // std::invalid_argument as Recipe::validate(). A matrix that the layout does not have is found by
  // push(), which then throws std::invalid_argument.
  FilterChain(Recipe recipe, FrameSink& out);
  ~FilterChain();
  FilterChain(const FilterChain&) = delete;
  FilterChain& operator=(const FilterChain&) = delete;

  // Filters the next frame; its values may be moved away. A causal recipe passes it on at once;
  // other recipes hold frames back. push(), restart() and finish() pass on exceptions of the
  // filters and of `out`; frames that were held back are lost then, and the next frame begins a new
  // stretch.
  void push(TactileFrame& frame);
  // Passes on the frames that were held back, and begins a new stretch with the next frame. Call it
  // when settings change the meaning of counts.
  void restart();
  // Passes on the frames that were held back, at the end of a source. A new source may begin then.
  void finish();

  const Recipe& recipe() const noexcept { return recipe_; }
  // Mean time that each step took per frame [us]; 0 for disabled steps and before the first frame.
  // It is measured only when switched on, since measuring costs some tens of ns per step.
  void measureCosts(bool on) noexcept { measuring_ = on; }
  std::vector<double> costsUs() const;

 private:
  class Link;
  class Contact;
  void build(const std::shared_ptr<const SensorLayout>& layout);
  void pass(TactileFrame& frame);
  void endStretch();
  template <typename Work>
  void guarded(const Work& work);

  const Recipe recipe_;
  const std::unique_ptr<Contact> out_;  // takes the frames of the last step
  // The layout that the filters were made for.
  std::shared_ptr<const SensorLayout> layout_;
  GapDetector gaps_;
  std::vector<std::unique_ptr<Link>> links_;  // one per enabled step
  bool measuring_ = false;
  std::vector<double> spentNs_;  // per step of the recipe
  std::size_t frames_ = 0;       // number of measured frames
  friend class Link;
};

// Delay of the chain [frames]: the number of frames until a step of load reaches half of its height
// at the output. Empty if it never does (a derivative). 0 for steps that use future frames. The
// delay of filters with a frequency depends on the rate of the frames [Hz], above 0.
inline constexpr double kUsualRateHz = 1e6 / 30'000.0;
std::optional<int> latencyFrames(const Recipe& recipe, double rateHz = kUsualRateHz);
std::optional<int> latencyFrames(const FilterStep& step, double rateHz = kUsualRateHz);
// Largest number of earlier frames that influence an output frame (length of the impulse response).
// Empty when all earlier frames since the last gap do. The length of filters with a frequency
// depends on the rate of the frames [Hz], above 0.
std::optional<std::size_t> filterLengthFrames(const Recipe& recipe, double rateHz = kUsualRateHz);

}  // namespace palpate
