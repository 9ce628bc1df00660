// A recipe at work: frames go in as they come, filtered ones come out. The same class runs live, on
// recordings and on the command line; it looks at stamps and values alone, so all three give the
// same results bit by bit.
//
// Active taxels are defined by the input frames: a taxel that is 0 in the input is 0 in `values` of
// the output, and its filtered value is in `filtered` (model/tactile_frame.h). A filter can
// therefore shorten a contact, but never create, lengthen or enlarge one. A frame that was filtered
// before is filtered as a whole.
//
// Filters over time restart after a gap (gap_detector.h), where the layout changes (other masks),
// and where the caller says so. What no filter knows: saturation. A filtered value may lie below it
// while the taxel was saturated; saturation is always looked for in the frames as they came.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <palpate/filter/frame_filter.h>
#include <palpate/filter/recipe.h>
#include <palpate/model/gap_detector.h>

namespace palpate {

class FilterChain {
 public:
  // Steps that are off are left out. `out` must outlive the chain. Throws std::invalid_argument as
  // Recipe::validate(); for a matrix that the layout of a frame hasn't, push() does.
  FilterChain(Recipe recipe, FrameSink& out);
  ~FilterChain();
  FilterChain(const FilterChain&) = delete;
  FilterChain& operator=(const FilterChain&) = delete;

  // The next frame; its values may be moved away. Causal recipes hand it on at once. What a filter
  // or `out` throws comes through, here and in the next two; what was held back is lost then, and
  // the next frame begins a new stretch.
  void push(TactileFrame& frame);
  // The next frame begins a new stretch: what was held back comes out now. For settings that change
  // what counts mean.
  void restart();
  // No more frames: what was held back comes out. Then a new source may begin.
  void finish();

  const Recipe& recipe() const noexcept { return recipe_; }
  // Time that each step took for a frame, on average [us]; 0 for steps that are off, or before the
  // first frame. Measured only when asked for: it costs some tens of ns per step.
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
  const std::unique_ptr<Contact> out_;          // behind the last step
  std::shared_ptr<const SensorLayout> layout_;  // that the filters were made for
  GapDetector gaps_;
  std::vector<std::unique_ptr<Link>> links_;  // one per step that is on
  bool measuring_ = false;
  std::vector<double> spentNs_;  // per step of the recipe
  std::size_t frames_ = 0;       // measured
  friend class Link;
};

// Delay of the chain [frames]: the number of frames until a step of load reaches half of its height
// at the output. Empty if it never does (a derivative). 0 for steps that use future frames.
std::optional<int> latencyFrames(const Recipe& recipe);
std::optional<int> latencyFrames(const FilterStep& step);
// Largest number of earlier frames that influence an output frame (length of the impulse response);
// empty: all of its gap-free span.
std::optional<std::size_t> filterLengthFrames(const Recipe& recipe);

}  // namespace palpate
