#include "palpate/recording/recording_losses.h"

#include <algorithm>
#include <array>
#include <map>
#include <string_view>

#include "palpate/core/error.h"
#include "palpate/core/json.h"
#include "palpate/core/number_text.h"
#include "palpate/recording/recording_format.h"

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
  return named.isString() && !named.asString().empty() ? named.asString()
                                                       : std::string(kLossStreams[0].name);
}

}  // namespace

std::string itemOf(std::string_view stream) {
  const auto at = std::ranges::find(kLossStreams, stream, &LossStream::name);
  return at == kLossStreams.end() ? std::string(stream) + " sample" : std::string(at->item);
}

std::string RecordingLoss::text() const {
  const std::string item = itemOf(stream);
  const std::string what = lost == 0 && !counted
                               ? item + "s, how many is not known,"
                               : (counted ? "" : "at least ") + palpate::counted(lost, item);
  constexpr int kDecimals = 2;
  return what + " in " + palpate::counted(spans, "span") + ", " + fixedText(seconds, kDecimals) +
         " s";
}

std::vector<RecordingLoss> lossesOf(std::span<const Event> events) {
  std::vector<RecordingLoss> all(kLossStreams.size());
  std::map<std::string, std::size_t, std::less<>> indices;
  for (std::size_t i = 0; i < all.size(); ++i)
    indices.emplace(all[i].stream = kLossStreams[i].name, i);
  for (const Event& event : events) {
    if (event.kind != "gap") continue;
    const Json details = detailsOf(event);
    const Json lost = details.at("lost");
    if (lost.isNumber() && lost.asDouble() == 0.0) continue;  // a silence without a loss
    const std::string stream = streamOf(details);
    const auto [at, isNew] = indices.try_emplace(stream, all.size());
    if (isNew) all.push_back({.stream = stream});
    RecordingLoss& loss = all[at->second];
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

std::string seriesText(const Profile& profile, std::size_t series) {
  const SeriesDescription& description = profile.series().at(series);
  std::string text = counted(profile.numSamples(series), "sample");
  if (const double rateHz = profile.meanSampleRateHz(series); rateHz > 0.0)
    text += ", " + fixedText(rateHz, 1) + " Hz (mean)";
  for (std::size_t i = 0; i < description.columns.size(); ++i) {
    const Column& column = description.columns[i];
    text += (i == 0 ? "; " : ", ") + column.name;
    if (!column.unit.empty()) text += " [" + column.unit + "]";
  }
  if (!description.source.empty()) text += "; from " + description.source;
  return text;
}

std::string leftOutText(const Profile& profile, const std::filesystem::path& path) {
  const RecordingFormat& format = formatOf(path);
  const std::string a = std::string("a ") + format.endings.front();
  std::string text;
  if (profile.givesReadings() && !format.holdsReadings)
    text = a +
           " has no place for the readings of the sensor: it gets what presses, over the "
           "baseline";
  if (format.holdsFurther) return text;
  std::string names;
  std::size_t count = 0;
  for (std::size_t i = kHandSeries; i < profile.series().size(); ++i) {
    if (profile.numSamples(i) == 0) continue;
    names += (count++ == 0 ? "" : ", ") + profile.series()[i].name;
  }
  if (count == 0) return text;
  return text + (text.empty() ? "" : "; ") + a + " has no place for the series " + names +
         (count == 1 ? ": it is left out" : ": they are left out");
}

}  // namespace palpate
