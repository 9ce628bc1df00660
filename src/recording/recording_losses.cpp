#include "palpate/recording/recording_losses.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "palpate/core/error.h"
#include "palpate/core/json.h"
#include "palpate/core/number_text.h"

namespace palpate {
namespace {

struct LossStream {
  std::string_view name, item;
};
constexpr std::array<LossStream, 4> kLossStreams{{{"tactile", "frame"},
                                                  {"angles", "angle sample"},
                                                  {"temperatures", "temperature sample"},
                                                  {"events", "event"}}};

Json detailsOf(const Event& event) {
  if (event.json.empty()) return {};
  try {
    return Json::parse(event.json);
  } catch (const Error&) {
    return {};
  }
}

std::size_t streamOf(const Json& details) {
  const Json named = details.at("stream");
  if (!named.isString()) return 0;
  const auto at =
      std::ranges::find(kLossStreams, std::string_view(named.asString()), &LossStream::name);
  return at == kLossStreams.end() ? 0 : static_cast<std::size_t>(at - kLossStreams.begin());
}

}  // namespace

std::string RecordingLoss::text() const {
  const auto at = std::ranges::find(kLossStreams, std::string_view(stream), &LossStream::name);
  const std::string item(at == kLossStreams.end() ? std::string_view("item") : at->item);
  const std::string what = lost == 0 && !counted
                               ? item + "s, how many is not known,"
                               : (counted ? "" : "at least ") + palpate::counted(lost, item);
  constexpr int kDecimals = 2;
  return what + " in " + palpate::counted(spans, "span") + ", " + fixedText(seconds, kDecimals) +
         " s";
}

std::vector<RecordingLoss> lossesOf(std::span<const Event> events) {
  std::array<RecordingLoss, kLossStreams.size()> all;
  for (const Event& event : events) {
    if (event.kind != "gap") continue;
    const Json details = detailsOf(event);
    const Json lost = details.at("lost");
    if (lost.isNumber() && lost.asDouble() == 0.0) continue;  // a silence without a loss
    RecordingLoss& loss = all.at(streamOf(details));
    ++loss.spans;
    loss.seconds += static_cast<double>(std::max<std::int64_t>(0, event.t1Us - event.tUs)) / 1e6;
    if (lost.isNumber() && lost.asDouble() >= 0.0)
      loss.lost += static_cast<std::uint64_t>(lost.asDouble());
    else
      loss.counted = false;
  }
  std::vector<RecordingLoss> losses;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].spans == 0) continue;
    all[i].stream = kLossStreams[i].name;
    losses.push_back(all[i]);
  }
  return losses;
}

}  // namespace palpate
