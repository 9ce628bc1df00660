// Discrete Chebyshev (Tchebichef) moments of a small image, their invariants under translation and
// rotation, and the reconstruction of an image from its moments (the study, section 6.6; Mukundan
// 2001). The study's features (study_features.h) use the invariants.
//
// The orthonormal polynomials on x = 0..N-1, with positive leading coefficient, are
//   t_0 = 1/sqrt(N),  (n+1) t'_{n+1} = (2n+1)(2x-N+1) t'_n - n (N^2-n^2) t'_{n-1},
//   t_n = t'_n / beta_n,   beta_n^2 = (N+n)! / ((2n+1) (N-n-1)!)
// and the moments of an image f with N x N pixels, x to the right (column), y down (row), are
//   T_pq = sum f(x,y) t_p(x) t_q(y).
// The invariants are computed in the direct form: the same sums with polynomials evaluated at
// translated and rotated coordinates. (The six-fold sums of the study's equations 6.16 and 6.18
// give the same numbers, a thousand times slower.)
//   T''_pq = sum f(x,y) t_p(X cos th + Y sin th) t_q(-X sin th + Y cos th),
//   X = x - cx, Y = y - cy.
// All matrices of moments are (order + 1) x (order + 1), [p][q]; p belongs to x.
#pragma once

#include <cstddef>

#include <Eigen/Core>

namespace palpate {

// The polynomials of one image size.
class ChebyshevPolynomials {
 public:
  // size: N, 1..256. order: order of the highest polynomial, 0..min(N-1, 32). Throws
  // std::invalid_argument.
  ChebyshevPolynomials(int size, int order);
  int size() const noexcept { return size_; }
  int order() const noexcept { return order_; }
  // Writes t_0(x) .. t_order(x) to `out`, at any real x. The polynomials are orthonormal over
  // 0..N-1 and grow like x^p outside.
  void at(double x, double* out) const noexcept;

 private:
  int size_, order_;
  // t_{n+1} = slope_n (2x - N + 1) t_n - back_n t_{n-1}
  Eigen::VectorXd slope_, back_;
};

// How the orientation of an image is determined.
enum class ImageOrientation {
  // No rotation is removed: the moments are invariant to translation only.
  kNone,
  // 1/2 atan(2 mu11 / (mu20 - mu02)): -45..45 deg. The long axis may become x or y.
  kStudy,
  // The long axis becomes x: 1/2 atan2(2 mu11, mu20 - mu02). Of the two possible directions, the
  // one is chosen in which the longer tail of the image points to rising x (third central moment
  // along the axis >= 0): -180..180 deg.
  kResolved
};

struct ChebyshevInvariants {
  // True if the values sum to 0: there is no centroid, and all other values are 0.
  bool empty = true;
  // False if the image has no axis (round, square, a single pixel): the angle is 0 and the
  // invariants are those of the unrotated image. With kResolved also false when both directions are
  // alike.
  bool angleDetermined = false;
  double centroidX = 0.0, centroidY = 0.0;  // [pixels]
  double angleRad = 0.0;
  Eigen::MatrixXd moments;
};

// Moments and invariants of a square image `picture(y, x)` of the size of the polynomials. Both
// throw std::invalid_argument (another size, values that are not finite).
Eigen::MatrixXd chebyshevMoments(const Eigen::MatrixXd& picture, const ChebyshevPolynomials& of);
ChebyshevInvariants chebyshevInvariants(const Eigen::MatrixXd& picture,
                                        const ChebyshevPolynomials& of,
                                        ImageOrientation angle);

// Reconstructs the image sum T_pq t_p(x) t_q(y). With order N-1 it is the original, with a lower
// order the best least-squares approximation.
Eigen::MatrixXd reconstructImage(const Eigen::MatrixXd& moments, const ChebyshevPolynomials& of);
// Square root of sum (picture - approximation)^2 / sum picture^2: 0 for no error, 1 when nothing of
// the image is reproduced; it may exceed 1. It is 0 for two empty images and infinite for an empty
// image against another one.
double reconstructionError(const Eigen::MatrixXd& picture, const Eigen::MatrixXd& approximation);

// Pads an image to a square of `size` with `above` empty rows above and `left` empty columns to its
// left. Throws std::invalid_argument when it does not fit.
Eigen::MatrixXd padToSquare(const Eigen::MatrixXd& picture, int size, int above, int left);

}  // namespace palpate
