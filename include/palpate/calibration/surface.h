// A polynomial z(x, T) fitted by least squares, for the pressure model. It keeps its leave-one-out
// error, its covariance matrix, and the range of its data; outside of that range the value is an
// extrapolation (the study's drift surface has a condition number of 1.3e8).
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace palpate {

// One data point.
struct SurfacePoint {
  double x = 0.0;  // gain or drift
  double t = 0.0;  // temperature [deg C]
  double z = 0.0;  // the value to be predicted
};

// The term x^byX t^byT.
struct SurfaceTerm {
  int byX = 0;
  int byT = 0;
  bool operator==(const SurfaceTerm&) const = default;
};
// All terms up to this degree in each variable, in the study's order: 1, T, .., x, x T, ..:
// c_((degree + 1) i + j) x^i T^j.
std::vector<SurfaceTerm> surfaceTerms(int degree);

// The value of a surface at one point.
struct SurfaceEstimate {
  double value = 0.0;
  // Standard deviation of a single new measurement: error of the surface and scatter about it.
  double sd = 0.0;
  double byX = 0.0;  // derivatives
  double byT = 0.0;
  // Whether the point is in the convex hull of the data (enlarged by 5 % about its middle).
  bool inRange = false;
  // Not in it, but a larger x would be, at this t: the contact is lighter than all that were
  // measured.
  bool tooLight = false;
};

// A fitted surface.
struct Surface {
  std::vector<SurfaceTerm> terms;  // allowed terms, in order
  Eigen::VectorXd c;               // one per term; 0 for terms that were left out
  Eigen::MatrixXd covariance;      // of c
  std::size_t numPoints = 0;
  std::size_t numTerms = 0;  // number of terms that were kept
  double rmse = 0.0;         // sqrt(mean square of the residuals)
  double looRmse = 0.0;      // the same, with each point predicted by a fit without it
  double residualSd = 0.0;   // sqrt(sum of squares / (n - terms)); NaN when n = terms
  // Corners of the convex hull of the data, counter-clockwise; z is unused.
  std::vector<SurfacePoint> hull;
  bool valid = false;
  std::vector<std::string> notes;

  SurfaceEstimate at(double x, double t) const;
};

// How the terms of the polynomial are selected.
enum class SurfaceSelection {
  // Uses all given terms.
  kAllTerms,
  // Tries all subsets that contain the constant, and uses the smallest one whose error is within 1
  // % of the smallest error.
  kLeaveOneOut
};

// Fits the surface. Points with a value that is not finite are left out, with a note. With
// collinear data, subsets that the data do not determine are skipped; with kAllTerms the surface is
// then not valid. Throws std::invalid_argument for no terms or more than 12.
Surface fitSurface(std::span<const SurfacePoint> points,
                   const std::vector<SurfaceTerm>& terms,
                   SurfaceSelection selection);

}  // namespace palpate
