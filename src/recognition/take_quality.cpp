#include "palpate/recognition/take_quality.h"

#include <algorithm>
#include <stdexcept>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/model/timing.h"
#include "palpate/recognition/grasp_segments.h"

namespace palpate {
namespace {

constexpr std::size_t kFramesPerProgress = 256;

void requireTakeOption(bool right, const char* rule) {
  if (!right) throw std::invalid_argument(std::string("TakeCheckOptions: ") + rule);
}

// Frames with a saturated taxel.
std::size_t saturatedFrames(const Profile& part, const Progress& progress) {
  std::size_t saturated = 0;
  TactileFrame frame;
  for (std::size_t i = 0; i < part.numFrames(); ++i) {
    reportProgress(progress, i, part.numFrames(), kFramesPerProgress);
    part.readFrame(i, frame);
    if (numSaturated(part.hand(), frame) > 0) ++saturated;
  }
  return saturated;
}

void findTakeProblems(TakeQuality& take, const TakeCheckOptions& options) {
  if (!take.touched) take.problems.emplace_back("nothing was touched");
  if (take.durationS < options.leastS)
    take.problems.push_back("only " + fixedText(take.durationS, 1) + " s long, not " +
                            fixedText(options.leastS, 1) + " s");
  if (take.gaps > 0)
    take.problems.push_back(counted(take.gaps, "gap") + " of " + fixedText(take.gapsS, 1) + " s");
  if (take.lost > options.mostLost)
    take.problems.push_back(counted(static_cast<std::uint64_t>(take.lost), "frame") + " lost");
  if (take.saturated > options.mostSaturated)
    take.problems.push_back("saturated in " + fixedText(100.0 * take.saturated, 0) +
                            " % of the frames");
  if (!(options.leastQuality > 0.0) || take.graspQuality.value_or(0.0) >= options.leastQuality)
    return;
  if (!take.graspQuality)
    take.problems.emplace_back("no grasp");
  else
    take.problems.push_back("quality " + fixedText(*take.graspQuality, 2) + ", not " +
                            fixedText(options.leastQuality, 2));
}

}  // namespace

void TakeCheckOptions::validate() const {
  contact.validate();
  requireTakeOption(leastS >= 0.0 && leastS <= 1e9, "leastS must be 0..1e9");
  requireTakeOption(mostLost >= 0, "mostLost must be 0 or more");
  requireTakeOption(mostSaturated >= 0.0 && mostSaturated <= 1.0, "mostSaturated must be 0..1");
  requireTakeOption(leastQuality >= 0.0 && leastQuality <= 1.0, "leastQuality must be 0..1");
}

bool TakeCheckOptions::operator==(const TakeCheckOptions& other) const noexcept {
  return contact.frames == other.contact.frames && contact.taxels == other.contact.taxels &&
         leastS == other.leastS && mostLost == other.mostLost &&
         mostSaturated == other.mostSaturated && leastQuality == other.leastQuality;
}

std::string TakeQuality::problem() const {
  std::string line;
  for (const std::string& each : problems) line += (line.empty() ? "" : "; ") + each;
  return line;
}

TakeQuality checkTake(std::span<const Profile> parts,
                      std::int64_t lost,
                      const TakeCheckOptions& options,
                      const Progress& progress) {
  options.validate();
  TakeQuality take;
  take.lost = lost;
  std::size_t saturated = 0;
  for (const Profile& part : parts) {
    const TimingReport timing = timingOf(part);
    take.durationS += timing.durationS;
    take.frames += part.numFrames();
    take.gaps += timing.gaps.size();
    std::vector<std::size_t> gapFrames;
    for (const Gap& gap : timing.gaps) {
      take.gapsS += gap.seconds;
      gapFrames.push_back(gap.frame);
    }
    take.touched =
        take.touched || firstContact(part, gapFrames, options.contact, progress).has_value();
    saturated += saturatedFrames(part, progress);
    if (!take.touched) continue;
    for (const GraspSegment& grasp : findGrasps(part, {}, progress))
      take.graspQuality = std::max(take.graspQuality.value_or(0.0), grasp.quality);
  }
  if (take.frames > 0)
    take.saturated = static_cast<double>(saturated) / static_cast<double>(take.frames);
  findTakeProblems(take, options);
  return take;
}

}  // namespace palpate
