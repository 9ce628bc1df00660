#include "palpate/recognition/empty_hand.h"

#include <cmath>
#include <stdexcept>
#include <vector>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/recognition/grasp_features.h"
#include "palpate/recognition/plateau_features.h"

namespace palpate {
namespace {

constexpr double kCountsOfFoamMm = 1000.0;

double emptyHandNumberIn(const Json& json, const char* key) {
  const Json value = json.at(key);
  if (!value.isNumber() || !std::isfinite(value.asDouble()))
    throw Error(std::string("a damaged zero of the empty hand: '") + key + "'");
  return value.asDouble();
}

std::string textIn(const Json& json, const char* key) {
  if (!json.contains(key)) return {};
  const Json value = json.at(key);
  if (!value.isString())
    throw Error(std::string("a damaged zero of the empty hand: '") + key + "'");
  return value.asString();
}

}  // namespace

void EmptyHandOptions::validate() const {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw std::invalid_argument(std::string("EmptyHandOptions: ") + what);
  };
  require(foamMm >= 0.0 && std::isfinite(foamMm), "foamMm must be >= 0");
  require(foamRelativeSd >= 0.0 && std::isfinite(foamRelativeSd), "foamRelativeSd must be >= 0");
  require(touchSdMm > 0.0 && std::isfinite(touchSdMm), "touchSdMm must be > 0");
  require(transferSdFraction >= 0.0 && std::isfinite(transferSdFraction),
          "transferSdFraction must be >= 0");
  require(maxZeroMm > 0.0 && std::isfinite(maxZeroMm), "maxZeroMm must be > 0");
}

EmptyHandZero emptyHandZero(const Profile& profile,
                            const EmptyHandOptions& options,
                            const Progress& progress) {
  options.validate();
  EmptyHandZero out;
  const auto hand = pinchHandOf(profile.hand());
  out.problem = hand ? hand->mismatch(profile) : withoutPinchText(profile.hand());
  if (!out.problem.empty()) return out;
  // Only the two pads of the hand itself are used.
  PinchHand pinch = *hand;
  pinch.otherPads.clear();
  std::vector<double> zeros;
  for (const GraspSegment& touch : findPinches(profile, FeatureSet::kBest, progress)) {
    const PlateauFeatures found = plateauFeatures(profile, touch, pinch);
    if (!found.problem.empty()) {
      ++out.leftOut;
      out.problem = found.problem;
      continue;
    }
    double foam = 0.0;
    for (const PlateauPad& pad : found.pads)
      foam += options.foamMm * std::sqrt(std::exp(pad.lnPeak) / kCountsOfFoamMm);
    const double zero = found.distanceMm + foam;
    if (std::abs(zero) > options.maxZeroMm) {
      ++out.leftOut;
      out.problem = "the pads seem to be " + fixedText(zero, 1) +
                    " mm apart while they touch: the hand isn't empty, or its joints are far off";
      continue;
    }
    if (zeros.empty()) out.timeUs = profile.frameTimeUs(touch.begin);
    zeros.push_back(zero);
    out.foamMm += foam;
  }
  out.touches = zeros.size();
  if (zeros.empty()) {
    if (out.problem.empty())
      out.problem = "no touch: the pads never touch for more than 20 frames in a row";
    return out;
  }
  out.problem.clear();
  const auto count = static_cast<double>(zeros.size());
  out.foamMm /= count;
  for (const double zero : zeros) out.mm += zero / count;
  double squares = 0.0;
  for (const double zero : zeros) squares += (zero - out.mm) * (zero - out.mm);
  // The scatter of a few touches is uncertain, so that it is at least the known standard deviation
  // of touches.
  const double scatter = zeros.size() > 1 ? std::sqrt(squares / (count - 1.0)) : 0.0;
  out.sdMm = std::max(scatter, options.touchSdMm) / std::sqrt(count);
  return out;
}

SessionOffset emptyHandOffset(const EmptyHandZero& today,
                              const EmptyHandZero& training,
                              const EmptyHandOptions& options,
                              const SessionOffsetOptions& grid) {
  options.validate();
  for (const EmptyHandZero* zero : {&today, &training})
    if (!zero->problem.empty() || zero->touches == 0)
      throw std::invalid_argument("emptyHandOffset: a zero that isn't there");
  const double mm = today.mm - training.mm;
  const double foamSd = options.foamRelativeSd * (today.foamMm - training.foamMm);
  const double transferSd = options.transferSdFraction * mm;
  SessionOffset out =
      measuredOffset(mm,
                     std::sqrt(today.sdMm * today.sdMm + training.sdMm * training.sdMm +
                               foamSd * foamSd + transferSd * transferSd),
                     OffsetSource::kEmptyHand,
                     grid);
  out.grasps = today.touches;
  return out;
}

std::string EmptyHandZero::text() const {
  return fixedText(mm, 1) + " mm (+- " + fixedText(sdMm, 1) + " mm, " + std::to_string(touches) +
         (touches == 1 ? " touch" : " touches") + (origin.empty() ? "" : ", " + origin) + ")";
}

Json emptyHandZeroJson(const EmptyHandZero& zero) {
  return Json::object()
      .set("mm", zero.mm)
      .set("sd_mm", zero.sdMm)
      .set("foam_mm", zero.foamMm)
      .set("touches", zero.touches)
      .set("time_us", zero.timeUs)
      .set("origin", zero.origin)
      .set("sha256", zero.sha256);
}

EmptyHandZero emptyHandZeroFrom(const Json& json) {
  EmptyHandZero out;
  out.mm = emptyHandNumberIn(json, "mm");
  out.sdMm = emptyHandNumberIn(json, "sd_mm");
  out.foamMm = emptyHandNumberIn(json, "foam_mm");
  const double touches = emptyHandNumberIn(json, "touches");
  if (!(out.sdMm > 0.0) || !(touches >= 1.0 && touches <= 1e6))
    throw Error("a damaged zero of the empty hand: its error or its touches");
  out.touches = static_cast<std::size_t>(touches);
  // Zeros in models of format 1 have no time and origin.
  if (json.contains("time_us"))
    out.timeUs = static_cast<std::int64_t>(emptyHandNumberIn(json, "time_us"));
  out.origin = textIn(json, "origin");
  out.sha256 = textIn(json, "sha256");
  return out;
}

}  // namespace palpate
