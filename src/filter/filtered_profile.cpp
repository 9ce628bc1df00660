#include "palpate/filter/filtered_profile.h"

#include <algorithm>
#include <array>
#include <deque>
#include <mutex>
#include <optional>

#include "palpate/core/error.h"
#include "palpate/core/progress.h"
#include "palpate/filter/filter_chain.h"
#include "palpate/model/profile_builder.h"
#include "palpate/model/profile_over.h"
#include "palpate/model/rest_span.h"
#include "palpate/model/timing.h"

namespace palpate {
namespace {

constexpr std::size_t kFilteredProfileFramesPerReport = 64;
constexpr std::size_t kFramesForRate = 16;  // number of past frames that the gap rule uses
constexpr std::size_t kCursors = 4;  // for readers at different positions: screen, charts, exports

// Reads the source in order through a chain of filters.
class FilteredProfileCursor final : public FrameSink {
 public:
  FilteredProfileCursor(const Profile& source,
                        const Recipe& recipe,
                        const std::vector<std::int64_t>& restartsUs,
                        std::size_t from)
      : source_(source), restartsUs_(restartsUs), next_(from), chain_(recipe, *this) {}

  void take(TactileFrame& frame) override {
    out_.push_back({pushed_.front(), std::move(frame)});
    pushed_.pop_front();
  }

  // Returns a lower bound of the index of the frame that advance() returns next.
  std::size_t position() const noexcept {
    if (!out_.empty()) return out_.front().index;
    return pushed_.empty() ? next_ : pushed_.front();
  }

  // Returns the next filtered frame up to `last`; nothing when there is none. Frames that cannot be
  // read are skipped, except `wanted`, for which the error is thrown.
  std::optional<std::pair<std::size_t, TactileFrame>> advance(std::size_t last,
                                                              std::size_t wanted) {
    while (out_.empty() && next_ <= last) push(wanted);
    if (out_.empty()) return std::nullopt;
    Filtered filtered = std::move(out_.front());
    out_.pop_front();
    return std::pair{filtered.index, std::move(filtered.frame)};
  }

 private:
  struct Filtered {
    std::size_t index;
    TactileFrame frame;
  };

  void push(std::size_t wanted) {
    const std::size_t index = next_++;
    TactileFrame frame;
    try {
      source_.readFrame(index, frame);
    } catch (const Error&) {
      chain_.restart();
      if (index == wanted) throw;
      return;
    }
    const auto restart = std::upper_bound(restartsUs_.begin(), restartsUs_.end(), frame.hostUs);
    if (lastUs_ && restart != restartsUs_.begin() && *std::prev(restart) > *lastUs_)
      chain_.restart();
    lastUs_ = frame.hostUs;
    pushed_.push_back(index);
    chain_.push(frame);
    if (next_ == source_.numFrames()) chain_.finish();
  }

  const Profile source_;
  const std::vector<std::int64_t>& restartsUs_;
  std::size_t next_;  // next frame of the source
  std::optional<std::int64_t> lastUs_;
  std::deque<std::size_t> pushed_;  // frames that the chain holds
  std::deque<Filtered> out_;
  FilterChain chain_;
};

class ComputedFrames final : public ProfileOver {
 public:
  ComputedFrames(Profile source, Profile frames)
      : ProfileOver(std::move(source)), frames_(std::move(frames)) {}
  void readFrame(std::size_t frame, TactileFrame& out) const override {
    frames_.readFrame(frame, out);
  }

 private:
  const Profile frames_;
};

class FilteredFrames final : public ProfileOver {
 public:
  FilteredFrames(Profile source,
                 Recipe recipe,
                 std::vector<std::int64_t> restartsUs,
                 std::size_t memory)
      : ProfileOver(std::move(source)),
        recipe_(std::move(recipe)),
        restartsUs_(std::move(restartsUs)),
        memory_(memory + kFramesForRate) {}

  void readFrame(std::size_t frame, TactileFrame& out) const override {
    const std::lock_guard lock(mutex_);
    Reader& reader = readerFor(frame);
    reader.usedAt = ++uses_;
    while (!reader.last || reader.last->first < frame) {
      auto next = reader.cursor->advance(source_.numFrames() - 1, frame);
      if (!next) throw Error("frame " + std::to_string(frame) + " was returned by no filter");
      reader.last = std::move(next);
    }
    // The cursor skipped this frame because it could not be read: let the source throw its error.
    if (reader.last->first != frame) return source_.readFrame(frame, out);
    out = reader.last->second;
  }

 private:
  struct Reader {
    std::unique_ptr<FilteredProfileCursor> cursor;
    std::optional<std::pair<std::size_t, TactileFrame>> last;  // the last frame that it returned
    std::uint64_t usedAt = 0;
  };

  // Returns a reader that has the frame or will reach it soon; otherwise a new one, which replaces
  // the reader that was unused for the longest time.
  Reader& readerFor(std::size_t frame) const {
    for (Reader& reader : readers_)
      if (reader.last && reader.last->first == frame) return reader;
    for (Reader& reader : readers_) {
      if (!reader.cursor || (reader.last && reader.last->first > frame)) continue;
      const std::size_t at = reader.cursor->position();
      if (at <= frame && frame - at <= memory_) return reader;
    }
    Reader& reader =
        *std::min_element(readers_.begin(), readers_.end(), [](const Reader& a, const Reader& b) {
          return a.usedAt < b.usedAt;
        });
    reader.last.reset();
    reader.cursor = std::make_unique<FilteredProfileCursor>(
        source_, recipe_, restartsUs_, frame > memory_ ? frame - memory_ : 0);
    return reader;
  }

  const Recipe recipe_;
  const std::vector<std::int64_t> restartsUs_;
  const std::size_t memory_;
  mutable std::mutex mutex_;
  mutable std::array<Reader, kCursors> readers_;
  mutable std::uint64_t uses_ = 0;
};

Profile computedWhole(const Profile& source,
                      const Recipe& recipe,
                      const std::vector<std::int64_t>& restartsUs,
                      const Progress& progress) {
  ProfileBuilder builder(source.hand());
  FilteredProfileCursor cursor(source, recipe, restartsUs, 0);
  const std::size_t numFrames = source.numFrames();
  // No frame comes out before the stretch is complete, so reading is counted as the first half of
  // the work.
  for (std::size_t i = 0; i < numFrames; ++i) {
    reportProgress(progress, i, numFrames, kFilteredProfileFramesPerReport);
    while (const auto next = cursor.advance(i, i)) builder.addFrame(next->second);
  }
  return builder.finish(source.info());
}

}  // namespace

Recipe withRest(const Recipe& recipe,
                const Profile& source,
                const FilteredProfileOptions& options,
                const Progress& progress) {
  Recipe made = recipe;
  for (std::size_t i = 0; i < made.steps.size(); ++i) {
    FilterStep& step = made.steps[i];
    if (!step.enabled || step.name != "baseline" || step.rest) continue;
    Recipe before;
    before.steps.assign(made.steps.begin(), made.steps.begin() + static_cast<std::ptrdiff_t>(i));
    step.rest = restIn(filteredProfile(source, before, options, progress),
                       step.value("from"),
                       step.value("to"),
                       RestOf::kValues)
                    .baseline;
    step.explicitOptions.erase("from");
    step.explicitOptions.erase("to");
  }
  return made;
}

Profile filteredProfile(const Profile& source,
                        const Recipe& given,
                        FilteredProfileOptions options,
                        const Progress& progress) {
  given.validate();
  const Recipe recipe = withRest(given, source, options, progress);
  for (const FilterStep& step : recipe.steps)
    if (step.enabled)
      makeFrameFilter(step, source.hand().layout);  // throws for a matrix that does not exist
  if (recipe.empty()) return source;
  ProfileInfo info = source.info();
  info.valueType = ValueType::kFloat;
  const double rateHz = recipe.dependsOnRate() ? timingOf(source).rateHz : 0.0;
  recipe.validateForRate(rateHz);
  const auto frames = [&]() -> std::shared_ptr<const ProfileStorage> {
    if (const auto memory = filterLengthFrames(recipe, rateHz > 0.0 ? rateHz : kUsualRateHz))
      return std::make_shared<FilteredFrames>(
          source, recipe, std::move(options.restartsUs), *memory);
    return std::make_shared<ComputedFrames>(
        source, computedWhole(source, recipe, options.restartsUs, progress));
  }();
  return Profile(info, source.hand(), frames, source.furtherSeries());
}

}  // namespace palpate
