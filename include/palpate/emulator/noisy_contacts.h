// Frames of a hand at high sensitivity, with known truth: contacts of several sizes come, hold and
// go, one after the other, on a sensor whose noise is that of the real one. To measure what filters
// do to ghosts and to contacts.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include <palpate/model/cell_truth.h>
#include <palpate/model/profile.h>
#include <palpate/model/sensor_characteristics.h>

namespace palpate {

enum class ContactSize {
  kPoint,  // a tip above one taxel
  kPair,   // between two taxels
  kPen,    // a line, a taxel wide and four to six long
  kBall,   // round, radius 2 to 3 taxels
  kBroad   // flat, about 4 x 6 taxels
};
inline constexpr std::array kAllContactSizes = {ContactSize::kPoint,
                                                ContactSize::kPair,
                                                ContactSize::kPen,
                                                ContactSize::kBall,
                                                ContactSize::kBroad};
std::string_view nameOf(ContactSize size);  // "point", "pair", "pen", "ball", "broad"

struct NoisyContactsOptions {
  std::uint64_t seed = 1;
  std::size_t frames = 3000;  // 1..1,000,000
  double rateHz = 30.0;       // [Hz], 1..1000
  double degC = 30.0;         // of all sensors [deg C], 0..80
  double sensitivity = 1.0;   // 0..1
  // threshold: the line of the maximum and so many of its RMSE (methods: 3), -20..20
  double noiseMultiple = 3.0;
  double belowCounts = 0.0;  // and so many counts less, -100..100
  bool contacts = true;      // false: nothing touches anything
  // peak pressure of a contact, drawn from a logarithmic scale [kPa], > 0
  double minKpa = 8.0;
  double maxKpa = 60.0;

  // Throws std::invalid_argument with the field's name.
  void validate() const;
};

struct NoisyContact {
  ContactSize size = ContactSize::kPoint;
  std::size_t matrix = 0;
  std::size_t begin = 0,
              end = 0;  // frames from first load to the end of the rest behind it, `end` exclusive
  double peakKpa = 0.0;
};

struct NoisyContacts {
  Profile profile;                     // counts, 12 bit, at 1/rateHz; temperatures once a second
  std::vector<CellTruthMask> truth;    // what presses on each place, per frame
  std::vector<NoisyContact> contacts;  // one after the other, sizes in turn, matrices in turn
  std::vector<int> thresholdCounts;    // per matrix
};

// The same options give the same frames. Throws std::invalid_argument.
NoisyContacts makeNoisyContacts(const NoisyContactsOptions& options = {});

// theta_m(T) of the methods (section 4): line of the maximum, a multiple of its RMSE, less
// `belowCounts`; whole counts, not below 0.
int noiseThresholdCounts(const MatrixCharacteristics& matrix,
                         double degC,
                         double noiseMultiple = 3.0,
                         double belowCounts = 0.0);

}  // namespace palpate
