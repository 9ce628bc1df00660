// The SDH-2 with its DSA tactile sensor: the hand whose protocols this module speaks. Its
// description is that of data/hands/sdh2, as that of any other hand.
#pragma once

#include <string_view>
#include <vector>

#include <palpate/model/hand_description.h>
#include <palpate/model/preshape.h>
#include <palpate/model/sensor_characteristics.h>

namespace palpate {

// From this value on a taxel of the SDH-2 is saturated [counts]: its reading is only a lower bound
// of the load. The converter has 12 bits, but the amplifier saturates earlier: the largest reading
// in 1052 recordings is 3567.
constexpr float kSdh2SaturationCounts = 3500.0F;

// How far the reading of a taxel, and the force of a finger, rise after a stop, per velocity of the
// joints [counts per deg/s, N per deg/s], and the most that its motors can press at their current
// limits [counts, N]: on the hardest known object, docs/notes/safety.md.
constexpr double kSdh2RiseCounts = 800.0;
constexpr double kSdh2RiseN = 6.5;
constexpr double kSdh2StalledCounts = 3020.0;
constexpr double kSdh2StalledN = 24.0;

// Seven axes [deg]; six matrices: 14x6 proximal (0, 2, 4) and 13x6 distal (1, 3, 5), pitch 3.4 mm,
// 12 bits. Sources: data/hands/sdh2/hand.json.
const HandDescription& sdh2();

// Its preshapes: parallel, cylindrical, centrical, spherical, pinch-parallel, pinch-tilted,
// pinch-empty, calibration.
const std::vector<Preshape>& sdh2Preshapes();
// Finds a preshape by its name. Throws std::invalid_argument that lists all names.
const Preshape& sdh2Preshape(std::string_view name);

// Characteristics of its taxels. Sources:
//   noise: each taxel in the 65-minute recording at threshold 0, and the lines of the maximum
//     (study, 3.4)
//   plane: 54 loading steps (study, 3.3)
//   countsPerMean, thresholdKpa, neighbourFraction: fit of the 24 shared steps (K is met to 28..52
//     counts rms, depending on where the stamp is between taxels, without bias; a single taxel
//     under it reads up to 2700 counts)
//   lag: 63 % of a robot's grasp is reached within 0.19 s
//   creep: median drift of the steps, 2.9 % of K per second
//   release: the contact of a pen falls from 80 to 10 % in 60..90 ms
//   largest reading: 3567 counts were seen
const SensorCharacteristics& sdh2Sensor();

}  // namespace palpate
