// The neighbours of taxels that have masked ones around them, gathered so that the median networks
// can be used: each masked neighbour is replaced by an infinity, in turn a low and a high one, so
// that the middle stays the middle (of an even number the lower middle value).
#pragma once

#include <span>
#include <vector>

#include "filter/lanes.h"
#include "filter/padded_matrix.h"

namespace palpate::detail {

class MedianNeighbors {
 public:
  // Of all enabled taxels with a masked one within a 3x3 window, in `depth` frames.
  MedianNeighbors(const PaddedMatrix& padded, int depth);

  bool empty() const noexcept { return taxels_.empty(); }
  // Gathers from `depth` padded matrices.
  void gather(std::span<const float* const> planes);
  std::size_t numBlocks() const noexcept { return numPadded_ / kFour; }
  // The values of neighbour `index` (plane by plane, row by row) of the four taxels of a block.
  FourLanes lanes(std::size_t index, std::size_t block) const;
  // Puts the results of a block into a plane.
  void scatter(FourLanes results, std::size_t block, std::vector<float>& plane) const;

 private:
  struct Copy {
    std::size_t to;    // in gathered_
    std::size_t from;  // in the padded matrix
    std::size_t plane;
  };
  std::vector<std::size_t> taxels_;  // padded index
  std::size_t numPadded_ = 0;        // taxels, rounded up to blocks
  std::vector<float> gathered_;      // neighbour after neighbour; infinities stay in their places
  std::vector<Copy> copies_;
};

}  // namespace palpate::detail
