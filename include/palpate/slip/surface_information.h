// What the readings so far say about the spline coefficients of a contact's surface, and the most
// probable coefficients (MostProbableSurface).
//
// The coefficients c on a grid of half taxels are a Gaussian random field with mean 0 before any
// reading. A reading F = gain w c + noise, w the 4 x 4 weights of the cubic B-spline around its
// source, adds gain^2 w w^T / variance to the information matrix A and gain F w / variance to the
// right side b. A couples only coefficients that are at most three places apart, so that it is
// stored as 7 x 7 values per coefficient. A c = b is solved by conjugate gradients (Hestenes,
// Stiefel 1952) with the diagonal of A as preconditioner, from the coefficients found before.
//
// Prior: contacts have edges. A field of areas with and without load, divided by random straight
// lines that are 3 taxels apart on average, has the covariance exp(-r / 3) (a Poisson line mosaic;
// Switzer 1965), thus the spectrum 2 pi 9 / (1 + 9 k^2)^1.5, k in radians per taxel. A soft cover
// that blurs an edge by 0.4 taxel (sd) and the mean over a taxel's square (variance 1/12) multiply
// it by exp(-k^2 (0.4^2 + 1/12)). Its inverse is approximated by the polynomial
// 0.01 + 0.4 k^2 + 0.24 k^6 (rms factor 1.5 for wavelengths over 1.2 taxels), k^2 the
// negative Laplacian on the grid. So A is sparse before any reading, too.
#pragma once

#include <vector>

namespace palpate {

class SurfaceInformation {
 public:
  // The outermost coefficients that are never solved for; they are boundary values.
  static constexpr int kReach = 3;
  static constexpr double kKnotTaxels = 0.5;

  // Size of the grid of coefficients, row by row. Throws std::invalid_argument when there is
  // nothing inside of the boundary.
  SurfaceInformation(int rows, int columns);

  // Forgets all readings. sd: standard deviation of the surface before any reading [counts], > 0.
  void begin(double sd) noexcept;
  // Adds a reading [counts] with its variance [counts^2]. corner: index of the first of the 4 x 4
  // coefficients that it depends on; weightsX, weightsY: four weights each. coefficients: those
  // that solve() left, or the first ones after begin().
  void add(const float* coefficients,
           int corner,
           const float* weightsX,
           const float* weightsY,
           float gain,
           float reading,
           float variance) noexcept;
  // Multiplies the information of all readings so far by kept, 0..1. coefficients: as for add().
  void fade(const float* coefficients, float kept) noexcept;
  // Improves the coefficients that a reading depends on, by at most this number of iterations. The
  // others stay as they are. Allocates nothing.
  void solve(float* coefficients, int iterations) noexcept;

 private:
  // Values of a coefficient's row of A: seven lines of seven, each followed by a 0.
  static constexpr int kLine = 8;
  static constexpr int kRow = 7 * kLine;

  float diagonal(int place) const noexcept;
  void multiply(const float* in, float* out) const noexcept;
  // Computes b - A c anew.
  void findResidual(const float* coefficients) noexcept;

  int rows_ = 0;
  int columns_ = 0;
  // Row of A before any reading, for a surface of standard deviation 1.
  std::vector<float> prior_;
  float priorScale_ = 1.0F;
  std::vector<float> information_;
  std::vector<float> right_;
  // b - A c, kept up to date by add() and solve().
  std::vector<float> residual_;
  // Whether coefficients were added that residual_ does not include yet.
  bool isResidualOld_ = false;
  // Of the conjugate gradients.
  std::vector<float> direction_;
  std::vector<float> product_;
  // Range of the coefficients that readings depend on.
  int left_ = 0;
  int last_ = -1;
  int top_ = 0;
  int bottom_ = -1;
};

}  // namespace palpate
