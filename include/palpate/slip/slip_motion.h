// How the contact on one matrix moved: what every method reports, frame by frame.
#pragma once

#include <palpate/slip/rotation_tracker.h>

namespace palpate {

// Taxels of the pitch (3.4 mm), x right, y down; angles from x towards y [deg].
struct SlipMotion {
  int active = 0;     // taxels > 0
  int saturated = 0;  // at or above saturation: motion reads too small there
  double sum = 0.0;   // [counts]
  double x = 0.0;     // centroid [taxels]; 0 without contact
  double y = 0.0;

  // From the frame before to this one. Not valid: without contact (fewer than two active taxels) in
  // one of them, frames are missing between, or the method found no match. 0 then.
  bool valid = false;
  double dx = 0.0;
  double dy = 0.0;
  // Since the reference. Not valid: no reference, no contact, or no match. 0 then.
  bool refValid = false;
  double refDx = 0.0;
  double refDy = 0.0;

  SlipRotation rotation;
  // Weighted squared residual per taxel, 1 for the expected noise (register); 1 - correlation (ncc,
  // phase); 0 for centroids.
  double residual = 0.0;
  // 0..1, a score: how much of the load speaks for the reading (centroid: what isn't saturated or
  // at an edge of the matrix, where the contact may go on unseen; ncc, phase: the correlation;
  // register: overlap over the misfit).
  double confidence = 0.0;
  // register: directions in which the contact looks the same (a bar along its own axis). Motion
  // along them cannot be measured and is given as 0. 0: none, 1: along (degenerateX, degenerateY),
  // 2: all.
  int degenerate = 0;
  double degenerateX = 0.0;
  double degenerateY = 0.0;
  double gain = 1.0;  // register: load against the key frame

  bool touched = false;   // first frame of a contact
  bool afterGap = false;  // frames are missing before this one
  bool newKey = false;    // register: begins a new key frame
};

}  // namespace palpate
