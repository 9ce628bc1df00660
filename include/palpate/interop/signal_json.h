// Live results of one frame as one JSON object on one line, in the form that PlotJuggler's UDP
// server reads: nested keys become the tree of curves, and "t" is the field to choose as time
// stamp. docs/notes/live_streams.md lists the fields.
//
// Unknown values have no key: there is neither null nor a number that means "none". Flags are 0 and
// 1.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <palpate/capture/link_health.h>
#include <palpate/live/live_results.h>

namespace palpate {

// Where a member of the object begins, at its key, or a value of an array, counted from the `{` of
// the object.
struct JsonMember {
  int depth = 0;  // 0: a member of the object itself, 1: of one of its members, ..
  std::size_t begin = 0;
};

// Appends the object without a line end; about 2 kB for an SDH-2. `sequence` counts the objects, so
// that receivers can detect dropped ones. A null `link` leaves out the fields of the connection.
// `members` receives all members and values in their order, for datagrams.h; it may be null.
void appendSignalJson(std::string& out,
                      const LiveResults& results,
                      std::uint64_t sequence,
                      const LinkHealth* link = nullptr,
                      std::vector<JsonMember>* members = nullptr);

}  // namespace palpate
