// Discrete Chebyshev (Tchebichef) moments of a small picture, their invariants under shift and
// turn, and the picture that moments describe (the study, section 6.6; Mukundan 2001).
//
// Orthonormal polynomials on x = 0..N-1 with positive leading coefficient:
//   t_0 = 1/sqrt(N),  (n+1) t'_{n+1} = (2n+1)(2x-N+1) t'_n - n (N^2-n^2) t'_{n-1},
//   t_n = t'_n / beta_n,   beta_n^2 = (N+n)! / ((2n+1) (N-n-1)!)
// and moments of a picture f with N x N pixels, x to the right (column), y down (row):
//   T_pq = sum f(x,y) t_p(x) t_q(y).
// Invariants in the direct form: the same sums with polynomials evaluated at moved and turned
// coordinates (the six-fold sums of the study's equations 6.16 and 6.18 give the same numbers, a
// thousand times slower):
//   T''_pq = sum f(x,y) t_p(X cos th + Y sin th) t_q(-X sin th + Y cos th),
//   X = x - cx, Y = y - cy.
// All matrices of moments are (order + 1) x (order + 1), [p][q], p belongs to x.
#pragma once

#include <cstddef>

#include <Eigen/Core>

namespace palpate {

// The polynomials of one picture size.
class ChebyshevPolynomials {
 public:
  // size N: 1..256; order: of the highest polynomial, 0..min(N-1, 32). Throws
  // std::invalid_argument.
  ChebyshevPolynomials(int size, int order);
  int size() const noexcept { return size_; }
  int order() const noexcept { return order_; }
  // t_0(x) .. t_order(x) into `out`, at any real x: orthonormal over 0..N-1, growing like x^p
  // outside.
  void at(double x, double* out) const noexcept;

 private:
  int size_, order_;
  Eigen::VectorXd slope_, back_;  // t_{n+1} = slope_n (2x - N + 1) t_n - back_n t_{n-1}
};

// How the angle of a turned picture is found.
enum class ImageOrientation {
  kNone,   // not turned: invariant to shifts only
  kStudy,  // 1/2 atan(2 mu11 / (mu20 - mu02)): -45..45 deg, the long axis may lie along x or y
  // The long axis along x: 1/2 atan2(2 mu11, mu20 - mu02), and of the two ways to lay it the one in
  // which the picture's longer tail points to rising x (third central moment along the axis >= 0):
  // -180..180 deg.
  kResolved
};

struct ChebyshevInvariants {
  bool empty = true;  // its values sum up to 0: no centroid, all is 0
  // False: the picture has no axis (round, square, a single pixel), the angle is 0 and the
  // invariants are those of the picture as it lies; kResolved: also when both ways are alike.
  bool angleDetermined = false;
  double centroidX = 0.0, centroidY = 0.0;  // [pixels]
  double angleRad = 0.0;
  Eigen::MatrixXd moments;
};

// Pictures: square, `picture(y, x)`, as large as the polynomials. Throw std::invalid_argument:
// another size, values that aren't finite.
Eigen::MatrixXd chebyshevMoments(const Eigen::MatrixXd& picture, const ChebyshevPolynomials& of);
ChebyshevInvariants chebyshevInvariants(const Eigen::MatrixXd& picture,
                                        const ChebyshevPolynomials& of,
                                        ImageOrientation angle);

// The picture that moments describe: sum T_pq t_p(x) t_q(y). With order N-1 the original, with
// fewer the best approximation in the sense of least squares.
Eigen::MatrixXd reconstructImage(const Eigen::MatrixXd& moments, const ChebyshevPolynomials& of);
// Root of sum (picture - approximation)^2 / sum picture^2: 0 none .. 1 nothing of it was found
// (beyond: worse than that). 0 of two empty pictures, infinite of an empty one against another.
double reconstructionError(const Eigen::MatrixXd& picture, const Eigen::MatrixXd& approximation);

// A picture laid into a square of `size` with so many empty rows above and columns to the left.
// Throws std::invalid_argument when it doesn't fit.
Eigen::MatrixXd padToSquare(const Eigen::MatrixXd& picture, int size, int above, int left);

}  // namespace palpate
