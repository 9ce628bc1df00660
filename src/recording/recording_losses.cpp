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

std::string streamOf(const Json& details) {
  const Json named = details.at("stream");
  return std::string(named.isString() ? named.asString() : std::string(kLossStreams[0].name));
}

}  // namespace

std::string RecordingLoss::text() const {
  const auto at = std::ranges::find(kLossStreams, std::string_view(stream), &LossStream::name);
  const std::string item = at == kLossStreams.end() ? stream + " sample" : std::string(at->item);
  const std::string what = lost == 0 && !counted
                               ? item + "s, how many is not known,"
                               : (counted ? "" : "at least ") + palpate::counted(lost, item);
  constexpr int kDecimals = 2;
  return what + " in " + palpate::counted(spans, "span") + ", " + fixedText(seconds, kDecimals) +
         " s";
}

std::vector<RecordingLoss> lossesOf(std::span<const Event> events) {
  std::vector<RecordingLoss> all;
  for (const LossStream& known : kLossStreams) all.push_back({.stream = std::string(known.name)});
  for (const Event& event : events) {
    if (event.kind != "gap") continue;
    const Json details = detailsOf(event);
    const Json lost = details.at("lost");
    if (lost.isNumber() && lost.asDouble() == 0.0) continue;  // a silence without a loss
    const std::string stream = streamOf(details);
    auto at = std::ranges::find(all, stream, &RecordingLoss::stream);
    if (at == all.end()) at = all.insert(at, {.stream = stream});
    RecordingLoss& loss = *at;
    ++loss.spans;
    loss.seconds += static_cast<double>(std::max<std::int64_t>(0, event.t1Us - event.tUs)) / 1e6;
    if (lost.isNumber() && lost.asDouble() >= 0.0)
      loss.lost += static_cast<std::uint64_t>(lost.asDouble());
    else
      loss.counted = false;
  }
  std::erase_if(all, [](const RecordingLoss& loss) { return loss.spans == 0; });
  return all;
}

}  // namespace palpate
