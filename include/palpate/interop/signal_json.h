// What live processing found in a frame as one JSON object on one line, the way PlotJuggler's UDP
// server reads it: nested keys become the tree of curves, "t" is the time to choose as time stamp.
// docs/interop.md lists the fields.
//
// What isn't known has no key: there is no null among the values, and no number that stands for
// "none". Flags are 0 and 1.
#pragma once

#include <cstdint>
#include <string>

#include <palpate/capture/link_health.h>
#include <palpate/live/live_results.h>

namespace palpate {

// Appends the object without a line end; about 2 kB of an SDH-2. `sequence` counts the objects, so
// that whoever receives them knows what was dropped. `link`: null leaves the figures of the link
// out.
void appendSignalJson(std::string& out,
                      const LiveResults& results,
                      std::uint64_t sequence,
                      const LinkHealth* link = nullptr);

}  // namespace palpate
