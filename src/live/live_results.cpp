#include "palpate/live/live_results.h"

namespace palpate {

TaxelPeak taxelPeak(const TactileFrame& frame) {
  TaxelPeak peak;
  for (std::size_t m = 0; m < frame.layout->numMatrices(); ++m) {
    const ConstMatrixMap values = frame.matrix(m);
    for (Eigen::Index row = 0; row < values.rows(); ++row)
      for (Eigen::Index column = 0; column < values.cols(); ++column)
        if (values(row, column) > peak.counts)
          peak = {m, static_cast<int>(row), static_cast<int>(column), values(row, column)};
  }
  return peak;
}

}  // namespace palpate
