#include "device/silence.h"

#include <algorithm>
#include <cmath>

#include "palpate/core/json.h"
#include "palpate/core/number_text.h"
#include "palpate/core/time.h"

namespace palpate {

std::uint64_t missingIn(std::int64_t us, double periodUs, bool withoutLast) {
  const double periods = std::round(static_cast<double>(us) / periodUs);
  return static_cast<std::uint64_t>(std::max(periods - (withoutLast ? 1.0 : 0.0), 0.0));
}

Event gapEventOf(const Silence& silence,
                 const std::string& what,
                 const std::string& noun,
                 const std::string& stream) {
  const double seconds = static_cast<double>(silence.toUs - silence.fromUs) / kUsPerS;
  Json json = Json::object();
  if (!stream.empty()) json.set("stream", stream);
  json.set("seconds", seconds);
  std::string text =
      "no " + what + " for " + numberText(std::round(seconds * kMsPerS) / kMsPerS) + " s";
  if (const auto missing = silence.missing) {
    json.set("lost", static_cast<std::int64_t>(*missing)).set("estimated", silence.estimated);
    text += *missing == 0
                ? std::string(", none is missing")
                : std::string(silence.estimated ? ", about " : ", ") + counted(*missing, noun) +
                      (*missing == 1 ? " is missing" : " are missing");
  }
  return {silence.fromUs, silence.toUs, "gap", {}, text, json.text(-1)};
}

}  // namespace palpate
