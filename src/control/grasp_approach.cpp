#include "palpate/control/grasp_approach.h"

#include <algorithm>
#include <cmath>

#include "palpate/core/json.h"
#include "palpate/core/json_field.h"
#include "palpate/core/number_text.h"
#include "palpate/core/output_file.h"
#include "palpate/core/text_file.h"
#include "palpate/device/sdh2.h"
#include "palpate/model/hand_file.h"
#include "palpate/model/preshape.h"

namespace palpate {
namespace {

// A learnt rise below this part of the hardest object's is not believed.
constexpr double kMinRiseShare = 0.05;
// Part by which a later touch, or a smaller rise, changes what is remembered; an earlier touch or a
// larger rise is remembered at once.
constexpr double kLearningShare = 0.5;
constexpr std::size_t kMaxTouches = 1000;
constexpr std::size_t kMaxTouchBytes = 1000;
constexpr std::int64_t kTouchesVersion = 1;
constexpr std::uint64_t kLargestTouchesFile = 2'000'000;  // [bytes]

int lowestLimit(const GraspRequest& request, int limitCounts) {
  int lowest = limitCounts;
  for (const int limit : request.fingerLimitCounts)
    lowest = std::min(lowest, limitCounts - request.limitCounts + limit);
  return std::max(lowest, kMinGraspLimitCounts);
}

std::optional<double> lowestForce(const GraspRequest& request) {
  if (request.forceLimitsN.empty()) return std::nullopt;
  return *std::min_element(request.forceLimitsN.begin(), request.forceLimitsN.end());
}

}  // namespace

double fastestSlopeDeg(const Preshape& preshape) {
  double fastest = 0.0;
  for (const PreshapeJoint& joint : preshape.joints)
    fastest = std::max(fastest, std::abs(joint.slopeDeg));
  return fastest;
}

GraspApproach approachOf(const GraspRequest& request, const std::optional<Touch>& touch) {
  GraspApproach approach{.riseCounts = kSdh2RiseCounts, .riseN = kSdh2RiseN};
  std::optional<double> ratio = request.touchRatio;
  if (touch) {
    ratio = touch->ratio;
    approach.touchFelt = true;
    const auto learnt = [](double measured, double hardest) {
      return std::clamp(measured, kMinRiseShare * hardest, hardest);
    };
    if (touch->riseCounts) approach.riseCounts = learnt(*touch->riseCounts, kSdh2RiseCounts);
    if (touch->riseN) approach.riseN = learnt(*touch->riseN, kSdh2RiseN);
  }
  approach.touchKnown = ratio.has_value();
  const double slope = fastestSlopeDeg(sdh2Preshape(request.preshape));
  if (ratio && slope > 0.0)
    approach.fastToRatio = std::clamp(*ratio - kTouchMarginDeg / slope, 0.0, request.closeRatio);
  return approach;
}

double slowDegPerS(const GraspRequest& request, const GraspApproach& approach, int limitCounts) {
  // limit + rise * velocity = kWarnedLimit * limit
  double slow = (kWarnedLimit - 1.0) * lowestLimit(request, limitCounts) / approach.riseCounts;
  if (const auto forceN = lowestForce(request))
    slow = std::min(slow, (kWarnedLimit - 1.0) * *forceN / approach.riseN);
  return std::clamp(slow, kMinGraspDegPerS, request.velocityDegPerS);
}

std::optional<double> closeRatioOf(const Preshape& preshape, const std::vector<double>& anglesDeg) {
  if (anglesDeg.size() != preshape.joints.size()) return std::nullopt;
  double along = 0.0, squares = 0.0;
  for (std::size_t axis = 0; axis < anglesDeg.size(); ++axis) {
    const PreshapeJoint& joint = preshape.joints[axis];
    along += joint.slopeDeg * (anglesDeg[axis] - joint.openDeg);
    squares += joint.slopeDeg * joint.slopeDeg;
  }
  if (!(squares > 0.0) || !std::isfinite(along)) return std::nullopt;
  return std::clamp(along / squares, 0.0, 1.0);
}

std::optional<double> closeRatioOf(const GraspRequest& request,
                                   const std::vector<double>& anglesDeg) {
  return closeRatioOf(sdh2Preshape(request.preshape), anglesDeg);
}

GraspForecast forecastOf(const GraspRequest& request,
                         const std::optional<Touch>& touch,
                         const std::vector<double>& presentDeg) {
  const Preshape& preshape = sdh2Preshape(request.preshape);
  const double slope = fastestSlopeDeg(preshape);
  const GraspApproach approach = approachOf(request, touch);
  const bool keeps = keepsLimit(request);
  const double slow =
      keeps ? slowDegPerS(request, approach, request.limitCounts) : request.velocityDegPerS;
  GraspForecast forecast;
  forecast.touchKnown = approach.touchKnown;
  forecast.touchFelt = approach.touchFelt;
  const double present = closeRatioOf(preshape, presentDeg).value_or(0.0);
  const double start = request.startRatio.value_or(present);
  const double fastTo = keeps ? std::max(approach.fastToRatio, start) : start;
  const double end =
      approach.touchKnown && keeps
          ? std::min(fastTo + kTouchMarginDeg / std::max(slope, 1e-9), request.closeRatio)
          : request.closeRatio;
  if (request.startRatio)
    forecast.seconds += std::abs(start - present) * slope / request.velocityDegPerS;
  forecast.seconds += (fastTo - start) * slope / request.velocityDegPerS +
                      std::max(end - fastTo, 0.0) * slope / slow;
  // Motors that press as hard as they can reach no more.
  const auto reached = [](double limit, double rise, double most) {
    return std::max(limit, std::min(limit + rise, most));
  };
  const int limit = lowestLimit(request, request.limitCounts);
  forecast.counts = reached(request.limitCounts, approach.riseCounts * slow, kSdh2StalledCounts);
  forecast.timesLimit = reached(limit, approach.riseCounts * slow, kSdh2StalledCounts) / limit;
  if (const auto forceN = lowestForce(request)) {
    forecast.newtons = reached(*forceN, approach.riseN * slow, kSdh2StalledN);
    // The limit in counts is only the second one then.
    forecast.timesLimit = *forecast.newtons / *forceN;
  }
  return forecast;
}

std::string describe(const GraspForecast& forecast, const GraspRequest& request) {
  std::string text = "expect up to " +
                     (forecast.newtons ? fixedText(*forecast.newtons, 1) + " N"
                                       : fixedText(forecast.counts, 0) + " counts") +
                     ", " + fixedText(forecast.timesLimit, 1) + " times the limit";
  if (!keepsLimit(request)) return text + ", and that it stays so";
  const std::string seconds = fixedText(std::ceil(forecast.seconds), 0) + " s";
  if (forecast.touchFelt) return text + "; touches in about " + seconds;
  if (forecast.touchKnown) return text + "; touches in " + seconds + " at the earliest";
  return text + ". Where it touches isn't known: up to " + seconds +
         (request.object.empty() ? "; give its size or name" : "; later grasps are faster");
}

std::optional<Touch> TouchMemory::find(const std::string& preshape,
                                       const std::string& object) const {
  const auto found = touches_.find({preshape, object});
  if (object.empty() || found == touches_.end()) return std::nullopt;
  return found->second;
}

bool TouchMemory::learn(const GraspReport& report) {
  const GraspRequest& request = report.request;
  if (!report.touch || request.object.empty()) return false;
  if (touches_.size() >= kMaxTouches && !find(request.preshape, request.object)) return false;
  const auto [place, isNew] =
      touches_.try_emplace({request.preshape, request.object}, *report.touch);
  if (isNew) return true;
  Touch& known = place->second;
  const Touch& now = *report.touch;
  known.ratio = std::min(now.ratio, known.ratio + kLearningShare * (now.ratio - known.ratio));
  const auto rise = [](std::optional<double>& is, const std::optional<double>& measured) {
    if (measured)
      is = is ? std::max(*measured, *is + kLearningShare * (*measured - *is)) : *measured;
  };
  rise(known.riseCounts, now.riseCounts);
  rise(known.riseN, now.riseN);
  ++known.grasps;
  return true;
}

bool TouchMemory::forget(const std::string& preshape, const std::string& object) {
  return touches_.erase({preshape, object}) > 0;
}

std::vector<std::string> TouchMemory::objects(const std::string& preshape) const {
  std::vector<std::string> names;
  for (const auto& [key, touch] : touches_)
    if (key.first == preshape) names.push_back(key.second);
  return names;
}

std::string TouchMemory::text() const {
  Json list = Json::array();
  for (const auto& [key, touch] : touches_) {
    Json each = Json::object();
    each.set("preshape", key.first).set("object", key.second).set("ratio", touch.ratio);
    if (touch.riseCounts) each.set("rise_counts_s_per_deg", *touch.riseCounts);
    if (touch.riseN) each.set("rise_n_s_per_deg", *touch.riseN);
    list.push(std::move(each.set("grasps", touch.grasps)));
  }
  Json json = Json::object();
  json.set("format", "palpate-touches").set("version", kTouchesVersion);
  json.set("touches", std::move(list));
  return json.text() + "\n";
}

TouchMemory TouchMemory::parse(std::string_view text, const std::filesystem::path& file) {
  const JsonField root = JsonField::parse(text, file, "the remembered touches");
  if (!root.has("format") || root.at("format").text() != "palpate-touches")
    root.fail("is not a list of touches: 'format' must be \"palpate-touches\"");
  root.required("version").integer(1, kTouchesVersion);
  TouchMemory memory;
  for (const JsonField& each : root.required("touches").items(kMaxTouches)) {
    const std::string preshape = each.required("preshape").text();
    const std::string object = each.required("object").text();
    if (object.empty() || preshape.size() + object.size() > kMaxTouchBytes)
      each.fail("has a name that is empty or too long");
    const auto rise = [&](const char* key) {
      std::optional<double> value;
      if (each.has(key)) value = each.number(key, 0.0, 0.0, 1e6);
      return value;
    };
    memory.touches_[{preshape, object}] = {
        each.required("ratio").number(0.0, 1.0),
        rise("rise_counts_s_per_deg"),
        rise("rise_n_s_per_deg"),
        static_cast<int>(each.required("grasps").integer(1, 1'000'000'000))};
  }
  return memory;
}

std::filesystem::path touchesFile(TouchedBy hand) {
  const std::filesystem::path folder = userDataFolder();
  if (folder.empty()) return {};
  return folder / (hand == TouchedBy::kHand ? "touches.json" : "touches_emulated.json");
}

TouchMemory loadTouches(const std::filesystem::path& file) {
  std::error_code failure;
  if (!std::filesystem::exists(file, failure) && !failure) return {};
  return TouchMemory::parse(readTextFile(file, kLargestTouchesFile), file);
}

void saveTouches(const TouchMemory& touches, const std::filesystem::path& file) {
  std::error_code failure;
  std::filesystem::create_directories(file.parent_path(), failure);  // writing says what is wrong
  OutputFile out(file, Overwrite::kReplace);
  out.write(touches.text());
  out.commit();
}

}  // namespace palpate
