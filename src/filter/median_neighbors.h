// The neighbours of taxels next to masked ones, gathered so that the median networks can be used.
// Each masked neighbour is replaced by an infinity, alternately negative and positive, so that the
// median stays the same (of an even number of values, the lower of the two in the middle).
#pragma once

#include <span>
#include <vector>

#include "filter/lanes.h"
#include "filter/padded_matrix.h"

namespace palpate::detail {

class MedianNeighbors {
 public:
  // Finds all enabled taxels with a masked taxel in their 3x3 window, for `depth` frames.
  MedianNeighbors(const PaddedMatrix& padded, int depth);

  bool empty() const noexcept { return taxels_.empty(); }
  // Gathers the neighbours from `depth` padded matrices.
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
  std::vector<float>
      gathered_;  // all values of a neighbour, then of the next; infinities stay in place
  std::vector<Copy> copies_;
};

}  // namespace palpate::detail
