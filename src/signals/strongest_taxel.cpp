#include "palpate/signals/strongest_taxel.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "palpate/core/error.h"
#include "palpate/core/progress.h"

namespace palpate {

std::optional<TaxelPlace> strongestTaxel(const Profile& profile,
                                         std::size_t maxFrames,
                                         const Progress& progress) {
  if (maxFrames == 0) throw std::invalid_argument("strongestTaxel: no frames to look at");
  const SensorLayout& layout = profile.layout();
  const std::size_t numFrames = profile.numFrames();
  const std::size_t looks = std::min(maxFrames, numFrames);
  std::vector<double> sums(layout.numCells(), 0.0);
  TactileFrame frame;
  for (std::size_t i = 0; i < looks; ++i) {
    reportProgress(progress, i, looks);
    profile.readFrame(i * numFrames / looks, frame);
    for (std::size_t place = 0; place < sums.size(); ++place)
      sums[place] += static_cast<double>(frame.values[place]);
  }
  std::optional<TaxelPlace> strongest;
  double largest = 0.0;
  for (std::size_t m = 0; m < layout.numMatrices(); ++m) {
    const MatrixLayout& matrix = layout.matrix(m);
    std::size_t place = layout.offset(m);
    for (int y = 0; y < matrix.rows; ++y)
      for (int x = 0; x < matrix.columns; ++x, ++place)
        if (matrix.enabled(y, x) && sums[place] > largest) {
          largest = sums[place];
          strongest = TaxelPlace{m, y, x};
        }
  }
  return strongest;
}

}  // namespace palpate
