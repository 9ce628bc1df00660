#include "palpate/filter/savitzky_golay.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace palpate {
namespace {

using Real = long double;  // keeps high orders exact; speed does not matter here

void validate(int window, int order, int derivative, double position) {
  const auto fail = [](const std::string& field, const std::string& range, const std::string& is) {
    throw std::invalid_argument("savitzky-golay: " + field + " must be " + range + ", is " + is);
  };
  if (window < 1 || window > kMaxSavitzkyGolayWindow)
    fail("window", "1.." + std::to_string(kMaxSavitzkyGolayWindow), std::to_string(window));
  if (order < 0 || order >= window)
    fail(
        "order", "0.." + std::to_string(window - 1) + " (below the window)", std::to_string(order));
  if (derivative < 0 || derivative > order)
    fail("derivative", "0.." + std::to_string(order) + " (the order)", std::to_string(derivative));
  if (!(position >= 0.0 && position <= window - 1))
    fail("position", "0.." + std::to_string(window - 1), std::to_string(position));
}

// A polynomial, represented by its values on the grid and its derivatives at the position.
struct Polynomial {
  std::vector<Real> onGrid;
  std::vector<Real> derivatives;  // 0th, 1st, ..

  void subtract(Real factor, const Polynomial& other) {
    for (std::size_t i = 0; i < onGrid.size(); ++i) onGrid[i] -= factor * other.onGrid[i];
    for (std::size_t d = 0; d < derivatives.size(); ++d)
      derivatives[d] -= factor * other.derivatives[d];
  }
  void scale(Real factor) {
    for (Real& value : onGrid) value *= factor;
    for (Real& value : derivatives) value *= factor;
  }
};

Real product(const Polynomial& a, const Polynomial& b) {
  Real sum = 0.0L;
  for (std::size_t i = 0; i < a.onGrid.size(); ++i) sum += a.onGrid[i] * b.onGrid[i];
  return sum;
}

// Returns the next orthonormal polynomial: x times the last one, minus its components along all
// earlier ones. They are subtracted twice because of rounding errors.
Polynomial next(const std::vector<Polynomial>& basis, const std::vector<Real>& grid, Real at) {
  Polynomial p = basis.back();
  for (std::size_t i = 0; i < grid.size(); ++i) p.onGrid[i] *= grid[i];
  for (std::size_t d = p.derivatives.size(); d-- > 0;) {
    p.derivatives[d] *= at;
    if (d > 0) p.derivatives[d] += static_cast<Real>(d) * basis.back().derivatives[d - 1];
  }
  for (int pass = 0; pass < 2; ++pass)
    for (const Polynomial& other : basis) p.subtract(product(p, other), other);
  p.scale(1.0L / std::sqrt(product(p, p)));
  return p;
}

}  // namespace

std::vector<double> savitzkyGolayWeights(int window, int order, int derivative, double position) {
  validate(window, order, derivative, position);
  const auto size = static_cast<std::size_t>(window);
  // The grid runs from -1 to 1.
  const Real half = window > 1 ? static_cast<Real>(window - 1) / 2.0L : 1.0L;
  const Real middle = static_cast<Real>(window - 1) / 2.0L;
  std::vector<Real> grid(size);
  for (std::size_t i = 0; i < size; ++i) grid[i] = (static_cast<Real>(i) - middle) / half;
  const Real at = (static_cast<Real>(position) - middle) / half;

  std::vector<Polynomial> basis(1);
  const auto numDerivatives = static_cast<std::size_t>(derivative) + 1;
  basis[0].onGrid.assign(size, 1.0L / std::sqrt(static_cast<Real>(window)));
  basis[0].derivatives.assign(numDerivatives, 0.0L);
  basis[0].derivatives[0] = basis[0].onGrid[0];
  while (basis.size() <= static_cast<std::size_t>(order)) basis.push_back(next(basis, grid, at));

  const Real perSample = std::pow(half, -static_cast<Real>(derivative));
  std::vector<double> weights(size);
  for (std::size_t i = 0; i < size; ++i) {
    Real sum = 0.0L;
    for (const Polynomial& p : basis) sum += p.onGrid[i] * p.derivatives.back();
    weights[i] = static_cast<double>(sum * perSample);
  }
  return weights;
}

}  // namespace palpate
