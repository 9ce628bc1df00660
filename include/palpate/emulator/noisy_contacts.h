// Synthetic frames of a hand at high sensitivity, with known truth: contacts of several sizes
// begin, hold and end, one after the other, on a sensor with the noise of the real one. Used to
// measure how filters change ghosts and contacts.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include <palpate/core/option_check.h>
#include <palpate/model/hand_file.h>
#include <palpate/model/profile.h>
#include <palpate/model/sensor_characteristics.h>
#include <palpate/model/tactile_frame.h>

namespace palpate {

enum class ContactSize {
  kPoint,  // a tip above one taxel
  kPair,   // a tip between two taxels
  kPen,    // a line, one taxel wide and four to six long
  kBall,   // round, radius 2 to 3 taxels
  kBroad   // flat, about 4 x 6 taxels
};
inline constexpr std::array kAllContactSizes = {ContactSize::kPoint,
                                                ContactSize::kPair,
                                                ContactSize::kPen,
                                                ContactSize::kBall,
                                                ContactSize::kBroad};
// Names: "point", "pair", "pen", "ball", "broad".
std::string_view nameOf(ContactSize size);

struct NoisyContactsOptions {
  std::uint64_t seed = 1;
  static constexpr OptionRange kFrames{1, 1e6};
  static constexpr OptionRange kDegC{0.0, 80.0, "deg C"};
  static constexpr OptionRange kBelowCounts{-100.0, 100.0, "counts"};
  std::size_t frames = 3000;
  double rateHz = 30.0;      // [Hz], 1..1000
  double degC = 30.0;        // of all sensors [deg C]
  double sensitivity = 1.0;  // 0..1
  // Threshold as a multiple of the RMSE above the noise line (methods: 3), -20..20.
  double noiseMultiple = 3.0;
  // Amount subtracted from that threshold [counts].
  double belowCounts = 0.0;
  bool contacts = true;  // false: no contacts at all
  // Range of the peak pressure of a contact, drawn on a logarithmic scale [kPa], > 0.
  double minKpa = 8.0;
  double maxKpa = 60.0;
  // The hand whose sensor it is, with the characteristics of its file or assumedCharacteristics().
  HandDescription hand = defaultHand();

  // Throws std::invalid_argument naming the field.
  void validate() const;
};

struct NoisyContact {
  ContactSize size = ContactSize::kPoint;
  std::size_t matrix = 0;
  // Frames from the first load to the end of the following rest; `end` is exclusive.
  std::size_t begin = 0, end = 0;
  double peakKpa = 0.0;
};

struct NoisyContacts {
  // Whole counts up to the hand's full scale, at 1/rateHz; temperatures once a second.
  Profile profile;
  // For every frame and place, whether a contact presses on it.
  std::vector<CellTruthMask> truth;
  // One after the other; sizes and matrices take turns.
  std::vector<NoisyContact> contacts;
  std::vector<int> thresholdCounts;  // per matrix
};

// The same options give the same frames. Throws std::invalid_argument.
NoisyContacts makeNoisyContacts(const NoisyContactsOptions& options = {});

// Threshold theta_m(T) of the methods (section 4): noise line plus a multiple of its RMSE, minus
// `belowCounts`; whole counts, at least 0.
int noiseThresholdCounts(const MatrixCharacteristics& matrix,
                         double degC,
                         double noiseMultiple = 3.0,
                         double belowCounts = 0.0);

}  // namespace palpate
