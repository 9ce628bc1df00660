// Sensor characteristics of an emulated hand whose description has none.
#pragma once

#include <palpate/model/hand_description.h>
#include <palpate/model/sensor_characteristics.h>

namespace palpate {

// Pressure at which a taxel reaches its full scale where the description says nothing [kPa].
constexpr double kAssumedFullScaleKpa = 200.0;

// Returns assumptions, in relation to the full scale F of the hand: values are proportional to the
// pressure, up to F at kAssumedFullScaleKpa (in a hand with the unit kPa they are the pressure);
// an unloaded taxel reads 0.2 % of F with a noise of 0.1 %, and the largest value of an unloaded
// matrix is 0.5 %; a taxel passes 5 % of its pressure on to each neighbour; lags of 20 and 5 ms,
// creep of 5 % within 5 s, release within 20 ms; sensitivity 1, no threshold. A matrix with a full
// scale of its own has its noise in relation to that; where the unit is counts it reaches its own
// full scale at the same pressure.
SensorCharacteristics assumedCharacteristics(const HandDescription& hand);

}  // namespace palpate
