// The zero of an empty hand: closed until its pads touch, their distance is known to be none, and what the joints say instead is
// what the hand reads wrong today. One such touch on the day of training and one today give the session offset without any
// label or object (preshape "pinch-empty").
//
// On the load plateau of the touch:  zero = D + foam,  foam = foamMm (sqrt(peak1 / 1000) + sqrt(peak2 / 1000))
// (D, foam: kinematics/object_size.h). The model of the foam is crude for flat pads, but only its difference between two
// touches counts: with the same force it cancels. Joints that stand elsewhere than they say don't move pads that touch and pads
// that are apart by exactly the same: that part of the difference is unsure (transferPart).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include <palpate/core/json.h>
#include <palpate/core/progress.h>
#include <palpate/model/profile.h>
#include <palpate/recognition/pinch_hand.h>
#include <palpate/recognition/session_offset.h>

namespace palpate {

struct EmptyHandOptions {
  double foamMm = 0.80;         // [mm] at a peak of 1000 counts, per pad, >= 0
  double foamRelativeSd = 0.5;  // of flat pads against each other, >= 0
  double touchSdMm = 0.25;      // from touch to touch, > 0
  // sd of an object's offset about the touch's, as part of it: the emulated hand's objects of 12 to 76 mm read by up to a
  // quarter more or less than its touch says, by .15 in the mean; >= 0
  double transferPart = 0.15;
  double mostMm =
      12.0;  // a zero further away than this is no touch of pads: something lies between, > 0

  // Throws std::invalid_argument with the field's name.
  void validate() const;
};

struct EmptyHandZero {
  std::string
      trouble;  // why there is none: no touch, no joint angles, something between the pads; else empty
  double mm = 0.0;          // zero, mean of the touches
  double sdMm = 0.0;        // of the mean, without the foam's error
  double foamMm = 0.0;      // mean of what was added for the foam
  std::size_t touches = 0;  // it comes from
  std::size_t leftOut = 0;  // touches without usable data
  std::int64_t timeUs = 0;  // host time of the first touch [us since 1970]; 0: not known
  std::string origin;       // where the touches are from: a recording, a hand; may be empty
  std::string sha256;       // of the recording; empty: there is none

  // "-1.4 mm (+- 0.2 mm, 2 touches, zero.dsa)"
  std::string text() const;
};

// From a recording of one or several touches of an empty hand. Throws Cancelled.
EmptyHandZero emptyHandZero(const Profile& profile,
                            const PinchHand& hand = sdh2PinchHand(),
                            const EmptyHandOptions& options = {},
                            const Progress& progress = {});

// By how much today's hand reads sizes other than the hand of training did. Throws std::invalid_argument: a zero with trouble.
SessionOffset emptyHandOffset(const EmptyHandZero& today,
                              const EmptyHandZero& training,
                              const EmptyHandOptions& options = {},
                              const SessionOffsetOptions& grid = {});

Json emptyHandZeroJson(const EmptyHandZero& zero);
// Throws Error naming what is missing or wrong.
EmptyHandZero emptyHandZeroFrom(const Json& json);

}  // namespace palpate
