#include "palpate/signals/linear_relation.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace palpate {

LinearRelation linearRelation(std::span<const double> x, std::span<const double> y) {
  if (x.size() != y.size())
    throw std::invalid_argument("a relation needs as many values of y as of x");
  LinearRelation relation;
  double sumX = 0.0, sumY = 0.0;
  const auto both = [&](std::size_t i) { return std::isfinite(x[i]) && std::isfinite(y[i]); };
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!both(i)) continue;
    ++relation.count;
    sumX += x[i];
    sumY += y[i];
  }
  if (relation.count < 2) return relation;
  const auto count = static_cast<double>(relation.count);
  const double meanX = sumX / count, meanY = sumY / count;
  double xx = 0.0, yy = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!both(i)) continue;
    xx += (x[i] - meanX) * (x[i] - meanX);
    yy += (y[i] - meanY) * (y[i] - meanY);
    xy += (x[i] - meanX) * (y[i] - meanY);
  }
  if (!(xx > 0.0)) return relation;
  relation.slope = xy / xx;
  relation.intercept = meanY - relation.slope * meanX;
  if (yy > 0.0) relation.correlation = std::clamp(xy / std::sqrt(xx * yy), -1.0, 1.0);
  if (relation.count > 2)
    relation.residualSd = std::sqrt(std::max(0.0, yy - relation.slope * xy) / (count - 2.0));
  return relation;
}

}  // namespace palpate
