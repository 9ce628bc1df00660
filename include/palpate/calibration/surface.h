// Polynomial z(x, T) fitted by least squares, with its leave-one-out error, its covariance matrix,
// and the range of its data; outside of that range the value is an extrapolation (the study's drift
// surface has a condition number of 1.3e8).
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace palpate {

struct SurfacePoint {
  double x = 0.0;  // gain or drift
  double t = 0.0;  // temperature [deg C]
  double z = 0.0;  // what is to be told from them
};

// x^byX t^byT.
struct SurfaceTerm {
  int byX = 0;
  int byT = 0;
  bool operator==(const SurfaceTerm&) const = default;
};
// All terms up to this degree in each variable, in the study's order: 1, T, .., x, x T, ..:
// c_((degree + 1) i + j) x^i T^j.
std::vector<SurfaceTerm> surfaceTerms(int degree);

struct SurfaceEstimate {
  double value = 0.0;
  double sd = 0.0;   // of a single new measurement: of the surface and of what scatters about it
  double byX = 0.0;  // derivatives
  double byT = 0.0;
  bool inRange = false;  // within the convex hull of the data (grown by 5 % about its middle)
};

struct Surface {
  std::vector<SurfaceTerm> terms;  // offered, in order
  Eigen::VectorXd c;               // one per term; 0 where it was left out
  Eigen::MatrixXd covariance;      // of c
  std::size_t numPoints = 0;
  std::size_t numTerms = 0;  // kept
  double rmse = 0.0;         // sqrt(mean square of the residuals)
  double looRmse = 0.0;      // the same, each point told by a fit without it
  double residualSd = 0.0;   // sqrt(sum of squares / (n - terms)); NaN without a degree of freedom
  std::vector<SurfacePoint> hull;  // corners of the data's convex hull, counter-clockwise; z unused
  bool valid = false;
  std::vector<std::string> notes;

  SurfaceEstimate at(double x, double t) const;
};

enum class SurfaceSelection {
  // as given
  kAllTerms,
  // those subsets with the constant are tried; the smallest within 1 % of the least error is taken
  kLeaveOneOut
};

// Points with something that is no number are left out (and noted). Collinear data: subsets that it
// doesn't determine are skipped; with kAllTerms the surface is not valid then. Throws
// std::invalid_argument for no terms or more than 12.
Surface fitSurface(std::span<const SurfacePoint> points,
                   const std::vector<SurfaceTerm>& terms,
                   SurfaceSelection selection);

}  // namespace palpate
