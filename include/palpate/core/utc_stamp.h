// When a file was made, as the file says it.
#pragma once

#include <string>

#include <palpate/core/time.h>

namespace palpate {

// The wall clock in whole seconds: "2014-11-28T10:36:11Z".
inline std::string utcStamp(const Clock& clock = systemClock()) {
  const std::string text = utcText(clock.wallUs());
  return text.substr(0, 10) + "T" + text.substr(11, 8) + "Z";
}

}  // namespace palpate
