// Means over the neighbours of each taxel with weights that are the same in both directions: the
// weight of taxel j for taxel i is that of i for j. Each weight is therefore computed once, for the
// one of the two steps that leads downwards or to the right, and used by both taxels. The filters
// "bilateral" and "nlm" use it.
#pragma once

#include <vector>

#include "filter/lanes.h"
#include "filter/padded_matrix.h"

namespace palpate::detail {

// The weights of one matrix. Each is exp(exponent); a masked taxel, which must have the value 0 in
// the padded matrix, has no weight.
class PairWeights {
 public:
  // The pairs of taxels that lie `dy` rows and `dx` columns apart. Their exponents form a plane of
  // its own, with one entry for the upper or left taxel of each pair. The plane also covers the
  // repeated border, because a taxel of the border counts as a neighbour, too.
  struct Step {
    int dy = 0;
    int dx = 0;
    int inPadded = 0;     // distance of the two taxels in the padded matrix
    int firstColumn = 0;  // the first row is -dy
    int width = 0;        // entries per row, a multiple of kLanes
    int begin = 0;        // of the plane, among the exponents
    int at(int y, int x) const noexcept { return begin + (y + dy) * width + x - firstColumn; }
  };

  // `isNeighbor(dy, dx)` tells which taxels within `radius` rows and columns are neighbours; it
  // must give the same answer for (-dy, -dx). The taxel itself always counts, with the weight 1.
  template <typename IsNeighbor>
  PairWeights(const PaddedMatrix& padded, int radius, const IsNeighbor& isNeighbor)
      : rows_(padded.rows()), columns_(padded.columns()) {
    for (int dy = 0; dy <= radius; ++dy)
      for (int dx = dy == 0 ? 1 : -radius; dx <= radius; ++dx)
        if (isNeighbor(dy, dx)) addStep(padded, dy, dx);
    exclude(padded);
  }

  const std::vector<Step>& steps() const noexcept { return steps_; }
  // Calls exponentsOf(i, k) for the blocks of the plane of `step`: `i` is the index of the first
  // upper or left taxel of the block in the padded matrix, `k` the index of its exponent.
  template <typename ExponentsOf>
  void setExponents(const Step& step, const ExponentsOf& exponentsOf, const PaddedMatrix& padded) {
    for (int y = -step.dy; y < rows_; ++y) {
      const int i = padded.at(y, step.firstColumn);
      const int k = step.at(y, step.firstColumn);
      for (int x = 0; x < step.width; x += kLanes)
        store(weights_.data() + k + x, exponentsOf(i + x, k + x) + load(excluded_.data() + k + x));
    }
  }
  // Writes the weighted mean of each taxel and its neighbours to `out`, which has the memory order
  // of padded.data(). All exponents must have been set; they are replaced by the weights.
  void average(const PaddedMatrix& padded, std::vector<float>& out);

 private:
  void addStep(const PaddedMatrix& padded, int dy, int dx);
  void exclude(const PaddedMatrix& padded);

  int rows_ = 0;
  int columns_ = 0;
  std::vector<Step> steps_;
  std::vector<float> weights_;   // the planes of the steps, one after the other
  std::vector<float> excluded_;  // added to the exponents; far below 0 for a masked taxel
};

}  // namespace palpate::detail
