// The event "gap" of a time without frames, or without rows of a series (device/device.h).
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "palpate/model/event.h"

namespace palpate {

struct Silence {
  std::int64_t fromUs = 0;  // [us since 1970]
  std::int64_t toUs = 0;
  std::optional<std::uint64_t> missing;  // items; empty: not known
  bool estimated = true;
};

// How many items are missing in a time of `us`, when one is due every `periodUs` [us];
// `withoutLast`: one came at its end.
std::uint64_t missingIn(std::int64_t us, double periodUs, bool withoutLast);

// `what`: the items that did not come ("frames", "rows of the series wrist"); `noun`: one of them,
// as it is counted ("frame", "sample"). `stream`: the name of the series; empty: frames.
Event gapEventOf(const Silence& silence,
                 const std::string& what,
                 const std::string& noun,
                 const std::string& stream = {});

}  // namespace palpate
