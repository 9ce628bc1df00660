// How a grasp under tactile control comes to its limit and keeps it (GraspRequest::keepsLimit).
//
// A pad's reading rises after a stop, because frames come every 32 ms and the rubber has a lag, so
// the velocity at the touch decides how far: reached = limit + rise * velocity. The hand moves at
// GraspRequest::velocityDegPerS only to a margin before the place where it is expected to touch,
// and from there on so slowly that twice the limit is not exceeded, not below kMinGraspDegPerS.
// After the stop it moves by small steps until the reading at rest is 0.8..1.2 times the limit: it
// opens, or follows an object that gave way.
//
// Ratios are close ratios of the preshape, 0 (open) .. 1 (closed). Velocities and margins are those
// of its fastest joint.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <palpate/control/grasp_request.h>

namespace palpate {

// Band of the reading in which a grasp has kept its limit, as multiples of the limit.
constexpr double kKeptFromLimit = 0.8;
constexpr double kKeptToLimit = 1.2;
// From this multiple of the limit on users are warned of the reading that is to be expected.
constexpr double kWarnedLimit = 2.0;
// The slow part of the approach begins this far before the expected touch [deg].
constexpr double kTouchMarginDeg = 1.5;

struct GraspApproach {
  double fastToRatio = 0.0;  // 0: slow from the beginning
  bool touchKnown = false;
  bool touchFelt = false;  // it is known by an earlier grasp, not by the size
  // Rise of the largest reading after a stop, per velocity [counts per deg/s], > 0; and of the
  // force of a finger [N per deg/s], > 0.
  double riseCounts = 0.0;
  double riseN = 0.0;
};

// By how much the fastest joint closes with the ratio from 0 to 1 [deg]; 0: none moves.
double fastestSlopeDeg(const Preshape& preshape);
// `touch`: what is remembered of the object with this preshape; it counts more than its size.
// Without it the rise is that of the hardest object known, and the touch where the request expects
// it.
GraspApproach approachOf(const GraspRequest& request, const std::optional<Touch>& touch);
// The velocity of the slow part, for a limit of all fingers of `limitCounts` (a slip raises it)
// [deg/s]: kMinGraspDegPerS..velocityDegPerS.
double slowDegPerS(const GraspRequest& request, const GraspApproach& approach, int limitCounts);

// What can be said of a grasp under tactile control before it begins.
struct GraspForecast {
  double counts = 0.0;            // largest reading to be expected of a taxel [counts]
  std::optional<double> newtons;  // and of a finger, with a limit in newtons [N]
  // The largest of both as a multiple of its limit.
  double timesLimit = 0.0;
  // Duration until it touches [s]; with touchKnown false: until it has closed without touching.
  double seconds = 0.0;
  bool touchKnown = false;
  bool touchFelt = false;  // otherwise it touches after these seconds at the earliest
};
// `presentDeg`: the joint angles; empty: not known, then it starts open. Meaningless for a plain
// grasp.
GraspForecast forecastOf(const GraspRequest& request,
                         const std::optional<Touch>& touch,
                         const std::vector<double>& presentDeg);
// "expect up to 400 counts, 2.0 times the limit; touches in about 15 s"; by its size alone "..;
// touches in 15 s at the earliest".
std::string describe(const GraspForecast& forecast, const GraspRequest& request);
// The close ratio to which the angles of all joints fit best, 0..1; empty for another number of
// joints, or a preshape that moves none.
std::optional<double> closeRatioOf(const Preshape& preshape, const std::vector<double>& anglesDeg);
// The same for the preshape of a grasp.
std::optional<double> closeRatioOf(const GraspRequest& request,
                                   const std::vector<double>& anglesDeg);

// What grasps have shown, per preshape and name of the object.
class TouchMemory {
 public:
  std::optional<Touch> find(const std::string& preshape, const std::string& object) const;
  // Learns from a grasp that touched a named object; returns whether anything was learnt. Of more
  // than 1000 objects nothing is.
  bool learn(const GraspReport& report);
  bool forget(const std::string& preshape, const std::string& object);
  bool empty() const noexcept { return touches_.empty(); }
  // The names of the objects that are remembered with this preshape, in alphabetical order.
  std::vector<std::string> objects(const std::string& preshape) const;

  // As JSON, "palpate-touches".
  std::string text() const;
  // `file` is named in errors. Throws FormatError.
  static TouchMemory parse(std::string_view text, const std::filesystem::path& file);

 private:
  std::map<std::pair<std::string, std::string>, Touch> touches_;
};

// Whether the hand that is moved is one of rubber and motors or an emulated one: what is remembered
// of an emulated one's objects must not be believed of real ones.
enum class TouchedBy { kHand, kEmulatedHand };
// The file that the window and `palpate grasp` share: touches.json, or touches_emulated.json, in
// userDataFolder(); empty: there is no such folder, and nothing is stored.
std::filesystem::path touchesFile(TouchedBy hand = TouchedBy::kHand);
// Empty when the file doesn't exist. Throws FileError (unreadable) or FormatError (damaged).
TouchMemory loadTouches(const std::filesystem::path& file);
// Makes the folder, and replaces the file. Throws FileError.
void saveTouches(const TouchMemory& touches, const std::filesystem::path& file);

}  // namespace palpate
