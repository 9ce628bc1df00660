// Motion of the contact on one matrix in one frame: the result of every slip method.
#pragma once

#include <palpate/slip/rotation_tracker.h>

namespace palpate {

// Lengths are in taxels (x right, y down; the pitch is 3.4 mm for the SDH-2), angles from x towards
// y [deg]. Where taxels aren't square, no rotation is measured (it is not valid), and the lengths
// of the principal axis are in distances of columns.
struct SlipMotion {
  // Number of active taxels (value > 0).
  int active = 0;
  // Number of taxels at or above saturation; they make the measured motion too small.
  int saturated = 0;
  // Load: sum of all taxels [counts].
  double sum = 0.0;
  // Centroid [taxels]; 0 without contact.
  double x = 0.0;
  double y = 0.0;

  // Motion from the previous frame to this one [taxels]. Not valid, and 0, if one of the two frames
  // has no contact (fewer than two active taxels), if frames are missing between them, or if the
  // method found no match.
  bool valid = false;
  double dx = 0.0;
  double dy = 0.0;
  // register: standard deviations of dx and dy [taxels], from the estimated noise of the readings
  // and the uncertainty of the surface; 0 where they are not estimated.
  double sdX = 0.0;
  double sdY = 0.0;
  // Motion since the reference [taxels]. Not valid, and 0, without a reference, without contact or
  // without a match.
  bool refValid = false;
  double refDx = 0.0;
  double refDy = 0.0;

  SlipRotation rotation;
  // Weighted squared residual per taxel, 1 for the expected noise (register); 1 - correlation (ncc,
  // phase); 0 for centroids.
  double residual = 0.0;
  // Confidence score, 0..1: the fraction of the load that supports the measured motion. Centroid:
  // the load that is not saturated and not at an edge of the matrix, where the contact may continue
  // unseen. ncc, phase: the correlation. register: overlap divided by misfit.
  double confidence = 0.0;
  // register: directions in which the contact looks the same (a bar along its own axis). Motion
  // along them cannot be measured and is given as 0. 0: none, 1: along (degenerateX, degenerateY),
  // 2: all.
  int degenerate = 0;
  double degenerateX = 0.0;
  double degenerateY = 0.0;
  // register: load relative to the key frame.
  double gain = 1.0;

  // Whether this is the first frame of a contact.
  bool touched = false;
  // Whether frames are missing before this one.
  bool afterGap = false;
  // register: whether this frame begins a new key frame.
  bool newKey = false;
};

}  // namespace palpate
