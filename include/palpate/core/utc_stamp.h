// The time at which a file was made, as models and calibrations store it.
#pragma once

#include <string>

#include <palpate/core/time.h>

namespace palpate {

// Returns the wall clock in whole seconds: "2014-11-28T10:36:11Z".
inline std::string utcStamp(const Clock& clock = systemClock()) {
  const std::string text = utcText(clock.wallUs());
  return text.substr(0, 10) + "T" + text.substr(11, 8) + "Z";
}

}  // namespace palpate
