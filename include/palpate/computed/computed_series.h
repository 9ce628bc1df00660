// What is computed of the frames of a recording as further series of it, with a sample at every
// frame: forces and pressures, centroids of the contacts, the sphere around them, slip. Their
// columns are signals like those that were recorded: charts plot them, and formulas use their names
// (signals/signal_name.h). N is the number of a matrix.
//   hand_force_n, mN_force_n                  force [N]
//   mN_pressure_kpa, mN_pressure_max_kpa      pressure of the contact, and of its taxel with the
//                                             largest [kPa]
//   mN_centroid_x_mm, mN_centroid_y_mm        contact centroid on the unrolled surface, from the
//                                             centre of taxel (0, 0) [mm]
//   hand_sphere_diameter_mm, .._x_mm, .._y_mm, .._z_mm
//                                             smallest sphere around all active taxels and its
//                                             centre in the hand's base frame [mm]
//   mN_slip_speed_mm_s, mN_slip_mm            speed of the contact over the matrix [mm/s], and its
//                                             distance from where it was at the reference [mm]
// A value that isn't known is NaN: a force or pressure of a contact outside the measured range, a
// force where the area of the indenter isn't known; a centroid, a sphere or slip without contact.
// Values are those of force_series.h, contact_geometry.h and slip_series.h, as float.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <palpate/calibration/pressure_map.h>
#include <palpate/calibration/tare.h>
#include <palpate/model/profile.h>
#include <palpate/slip/slip_series.h>

namespace palpate {

enum class ComputedKind : std::uint8_t { kForce, kPressure, kCentroid, kSphere, kSlip };

struct ComputedOptions {
  // Without one there are no forces and pressures.
  std::optional<Calibration> calibration = {};
  PressureMapOptions pressure = {};
  std::optional<Tare> tare = {};
  // The same frames in counts where those of the profile are filtered: forces are computed of them.
  std::optional<Profile> counts = {};
  SlipSeriesOptions slip = {};
};

struct ComputedSeries {
  SeriesDescription description;  // its role is kComputedRole (model/series.h)
  ComputedKind kind = ComputedKind::kForce;
  std::size_t matrix = 0;             // the number of matrices: of the whole hand
  std::vector<std::string> captions;  // of the columns, for people: "largest pressure"
  // What the series needs and the recording lacks, and the remedy, in one line; empty: nothing.
  std::string missing = {};
};

// All series that can be computed of recordings of this hand.
std::vector<ComputedSeries> computedSeries(const Profile& profile, const ComputedOptions& options);

// The profile with these series behind its own; one that the recording has by the same name keeps
// its place, and the computed one is left out. Those with something missing have no samples, and
// `source` says why. Nothing is computed here: a pass over the frames computes all series of a kind
// when the first of them is wanted (Profile::prepare()), and their values stay in memory. Frames
// that can't be read are NaN.
Profile withComputedSeries(const Profile& profile, const ComputedOptions& options);

}  // namespace palpate
