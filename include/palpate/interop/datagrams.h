// Divides what is sent for one frame into datagrams that no network has to cut in pieces
// (IP fragments): at most 1400 bytes each, below the 1472 bytes of payload that fit into one
// Ethernet frame.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/interop/signal_json.h>

namespace palpate {

constexpr std::size_t kMaxDatagramBytes = 1400;

// Divides the object of signal_json.h. Each part is a whole JSON object: "t" and "sequence", and
// some of the other keys, each with its whole value: first the arrays, then the others in their
// order. Only two are divided where they do not fit into one datagram. The values of an array are
// then keys of their own, "angles_deg[0]", "angles_deg[1]", .. (the names that PlotJuggler gives to
// values of an array); null has no key. "series" comes in several objects, each with some of the
// series, or some columns of one. An object that fits is returned as it is. `object` and
// `members` are those of appendSignalJson(). Any other key makes a part of its own where it is
// longer than `maxBytes`; those of a frame are at most about 900 bytes long.
std::vector<std::string> signalDatagrams(std::string_view object,
                                         std::span<const JsonMember> members,
                                         std::size_t maxBytes = kMaxDatagramBytes);

}  // namespace palpate
