#include "palpate/signals/first_contact.h"

#include <stdexcept>
#include <string>

#include "palpate/core/error.h"
#include "palpate/core/progress.h"

namespace palpate {
namespace {

constexpr int kMaximum = 1'000'000;
constexpr std::size_t kFirstContactFramesPerReport = 512;

void requireIn(int value, const char* field) {
  if (value < 1 || value > kMaximum)
    throw std::invalid_argument("FirstContactOptions::" + std::string(field) + " = " +
                                std::to_string(value) + ": must be 1..1000000");
}

// Counts consecutive frames with enough active taxels.
class Row {
 public:
  Row(std::span<const std::size_t> gapFrames, const FirstContactOptions& options)
      : gapFrames_(gapFrames), options_(options) {}

  // Takes the frames one after the other, from 0. Returns true when this frame completes the row.
  bool add(std::size_t frame, int active) {
    for (; nextGap_ < gapFrames_.size() && gapFrames_[nextGap_] < frame; ++nextGap_) length_ = 0;
    length_ = active >= options_.taxels ? length_ + 1 : 0;
    return length_ >= options_.frames;
  }
  std::size_t begin(std::size_t frame) const {
    return frame + 1 - static_cast<std::size_t>(options_.frames);
  }

 private:
  std::span<const std::size_t> gapFrames_;
  const FirstContactOptions& options_;
  std::size_t nextGap_ = 0;
  int length_ = 0;
};

int numActive(const TactileFrame& frame) {
  int active = 0;
  for (std::size_t m = 0; m < frame.layout->numMatrices(); ++m) {
    const MatrixLayout& layout = frame.layout->matrix(m);
    const ConstMatrixMap values = frame.matrix(m);
    for (int y = 0; y < layout.rows; ++y)
      for (int x = 0; x < layout.columns; ++x)
        if (isTouched(values(y, x)) && layout.enabled(y, x)) ++active;
  }
  return active;
}

}  // namespace

void FirstContactOptions::validate() const {
  requireIn(frames, "frames");
  requireIn(taxels, "taxels");
}

std::optional<std::size_t> firstContact(std::span<const int> active,
                                        std::span<const std::size_t> gapFrames,
                                        const FirstContactOptions& options) {
  options.validate();
  Row row(gapFrames, options);
  for (std::size_t i = 0; i < active.size(); ++i)
    if (row.add(i, active[i])) return row.begin(i);
  return std::nullopt;
}

std::optional<std::size_t> firstContact(const Profile& profile,
                                        std::span<const std::size_t> gapFrames,
                                        const FirstContactOptions& options,
                                        const Progress& progress,
                                        UnreadableSamples* unreadable) {
  options.validate();
  Row row(gapFrames, options);
  TactileFrame frame;
  const std::size_t numFrames = profile.numFrames();
  for (std::size_t i = 0; i < numFrames; ++i) {
    reportProgress(progress, i, numFrames, kFirstContactFramesPerReport);
    const bool readable = profile.readFrame(i, frame, unreadable);
    if (row.add(i, readable ? numActive(frame) : 0)) return row.begin(i);
  }
  return std::nullopt;
}

}  // namespace palpate
