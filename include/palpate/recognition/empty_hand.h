// Zero adjustment of the hand without an object. The empty hand closes until its own finger pads
// touch, so that their true distance is 0; the distance computed from the joint angles is then the
// size error of this session. The difference of two such measurements, one made when the model was
// trained and one of this session, is the session offset (preshape "pinch-empty"). No labelled
// grasp and no object is needed.
//
// On the load plateau of the contact: zero = D + foam, with foam = foamMm (sqrt(peak1 / 1000) +
// sqrt(peak2 / 1000)) [mm], peaks in counts (D and foam: kinematics/object_size.h). The foam model
// is inaccurate for flat pads, but the error cancels in the difference of two contacts with the
// same force. An error of the joint zeros moves touching pads and pads that are apart by different
// amounts; transferSdFraction is the resulting uncertainty.
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
  // Indentation of the foam of one pad at a peak of 1000 counts [mm], >= 0.
  double foamMm = 0.80;
  // Relative standard deviation of the foam indentation when two flat pads press on each other, >=
  // 0.
  double foamRelativeSd = 0.5;
  // Standard deviation from one contact to the next [mm], > 0.
  double touchSdMm = 0.25;
  // Standard deviation of an object's offset about the offset of the empty hand, as a fraction of
  // that offset, >= 0. In the emulated hand, objects of 12 to 76 mm had offsets that differ by up
  // to 25 % from it, on average by 15 %.
  double transferSdFraction = 0.15;
  // Largest plausible zero [mm], > 0. A larger value means that an object lies between the
  // pads.
  double maxZeroMm = 12.0;

  // Throws std::invalid_argument with the field's name.
  void validate() const;
};

struct EmptyHandZero {
  // Reason why there is no zero (no touch, no joint angles, an object between the pads); empty if
  // there is one.
  std::string problem;
  // Zero: mean over the touches [mm].
  double mm = 0.0;
  // Standard error of the mean zero [mm], without the error of the foam model.
  double sdMm = 0.0;
  // Mean foam correction that was added [mm].
  double foamMm = 0.0;
  // Number of contacts that `mm` is the mean of.
  std::size_t touches = 0;
  // Number of touches without usable data.
  std::size_t leftOut = 0;
  // Host time of the first touch [us since 1970]; 0: not known.
  std::int64_t timeUs = 0;
  // Where the touches come from: the name of a recording or of a hand; may be empty.
  std::string origin;
  // Hash of the recording; empty if there is none.
  std::string sha256;

  // "-1.4 mm (+- 0.2 mm, 2 touches, zero.dsa)"
  std::string text() const;
};

// Computes the zero from a recording of one or several touches of an empty hand. Throws Cancelled.
EmptyHandZero emptyHandZero(const Profile& profile,
                            const EmptyHandOptions& options = {},
                            const Progress& progress = {});

// Returns the difference between the size errors of this session and of the training session.
// Throws std::invalid_argument if `today` has no valid zero.
SessionOffset emptyHandOffset(const EmptyHandZero& today,
                              const EmptyHandZero& training,
                              const EmptyHandOptions& options = {},
                              const SessionOffsetOptions& grid = {});

Json emptyHandZeroJson(const EmptyHandZero& zero);
// Reads a zero from JSON. Throws Error naming what is missing or wrong.
EmptyHandZero emptyHandZeroFrom(const Json& json);

}  // namespace palpate
