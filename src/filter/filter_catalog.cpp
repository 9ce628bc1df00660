#include "palpate/filter/filter_catalog.h"

#include <algorithm>
#include <cctype>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "palpate/core/escaped_line.h"
#include "palpate/filter/savitzky_golay.h"

namespace palpate {
namespace {

using FilterCatalogKind = FilterOption::Kind;

constexpr double kAutomatic = std::numeric_limits<double>::quiet_NaN();
constexpr double kFilterCatalogLargestSize = 31;  // taxels
constexpr double kLargestWindow = 1001;           // frames
constexpr double kLargestThreshold = 1e6;         // counts, or the unit of the hand
constexpr double kLargestSecond = 1e7;            // of a recording [s]
constexpr double kLowestEdgeHz = 0.001;
constexpr double kHighestEdgeHz = 10'000;

const char* const kSpatialBorder =
    "the taxel at the border is repeated; masked taxels are neither read nor written";
const char* const kShrinks =
    "the window holds the available frames: fewer after the first frame and after a gap";

FilterOption odd(
    const char* key, double maximum, double defaultValue, const char* unit, const char* purpose) {
  return {key, unit, FilterCatalogKind::kOdd, 1, maximum, defaultValue, {}, purpose};
}
FilterOption size(double defaultValue = 3) {
  return odd("size",
             kFilterCatalogLargestSize,
             defaultValue,
             "taxels",
             "width of the window, 2 radius + 1");
}
FilterOption window(double defaultValue) {
  return odd("window", kLargestWindow, defaultValue, "frames", "frames in the window");
}
FilterOption real(const char* key,
                  double minimum,
                  double maximum,
                  double defaultValue,
                  const char* unit,
                  const char* purpose) {
  return {key, unit, FilterCatalogKind::kReal, minimum, maximum, defaultValue, {}, purpose};
}
FilterOption masked() {
  return {"masked",
          "",
          FilterCatalogKind::kFlag,
          0,
          1,
          0,
          {},
          "keep the original value where the filtered one is above 0, else 0"};
}
FilterOption centred() {
  return {"centred",
          "",
          FilterCatalogKind::kFlag,
          0,
          1,
          0,
          {},
          "a window around the frame, for recordings; else the frames up to now"};
}

std::vector<FilterKind> spatialKinds() {
  return {
      {"box",
       "Box",
       FilterDomain::kSpatial,
       {size(), masked()},
       "Mean of the neighbours: smooths, and smears edges.",
       kSpatialBorder,
       "study 2.3"},
      {"gaussian",
       "Gaussian",
       FilterDomain::kSpatial,
       {size(),
        real("sigma", 0.01, 100, kAutomatic, "taxels", "width; left out: (size + 1) / 2 / 2.3548"),
        masked()},
       "Weighted mean of the neighbours, without the box's side lobes; the base of eq. 3.2.",
       kSpatialBorder,
       "study 2.1.1 and 2.3, kernel exp(-x^2 / 2 sigma^2), normalised"},
      {"median",
       "Median",
       FilterDomain::kSpatial,
       {size(), masked()},
       "Middle value of the neighbours: removes lone taxels, keeps edges.",
       "the taxel at the border is repeated; masked taxels are neither read nor written (of an "
       "even "
       "number the lower middle value)",
       "study 2.3"},
      {"bilateral",
       "Bilateral",
       FilterDomain::kSpatial,
       {odd("diameter", kFilterCatalogLargestSize, 3, "taxels", "diameter of the round window"),
        real("sigma_value",
             0.01,
             10000,
             50,
             "counts",
             "width of the weight over the difference of values"),
        real("sigma_space", 0.01, 1000, 3, "taxels", "width of the weight over the distance"),
        masked()},
       "Gaussian over neighbours of similar value: smooths and keeps edges.",
       kSpatialBorder,
       "Tomasi and Manduchi 1998; study 2.3"},
      {"nlm",
       "Non-local means",
       FilterDomain::kSpatial,
       {odd("patch", 9, 3, "taxels", "width of the compared patches"),
        odd("search", 21, 5, "taxels", "width of the searched region"),
        real("h",
             0.01,
             10000,
             50,
             "counts",
             "width of the weight over the root mean square difference"),
        masked()},
       "Mean of taxels whose surroundings look alike.",
       kSpatialBorder,
       "Buades, Coll and Morel 2005; study 2.3"},
      {"opening",
       "Opening",
       FilterDomain::kSpatial,
       {{"shape",
         "",
         FilterCatalogKind::kChoice,
         0,
         2,
         0,
         {"cross", "rectangle", "ellipse"},
         "structuring element"},
        size(),
        masked()},
       "Erosion, then dilation: removes contacts into which the structuring element doesn't fit.",
       kSpatialBorder,
       "study 2.4"},
      {"threshold",
       "Threshold",
       FilterDomain::kSpatial,
       {real("above", 0, kLargestThreshold, 10, "counts", "values up to this become 0")},
       "Values up to the threshold become 0, others stay: removes the noise of a sensor that has "
       "no threshold.",
       "each taxel separately",
       "what the SDH-2's controller does"},
      {"baseline",
       "Baseline",
       FilterDomain::kSpatial,
       {real("from", 0, kLargestSecond, 0, "s", "where the readings at rest begin"),
        real("to", 0, kLargestSecond, 1, "s", "where they end; from the first frame on"),
        real("sigmas", 0, 100, 5, "", "this many standard deviations of the rest become 0"),
        real("above", 0, kLargestThreshold, 0, "counts", "as do values up to this above the rest"),
        masked()},
       "Subtracts the readings at rest; what doesn't exceed them by more than their noise becomes "
       "0. The rest is the mean of a span of the recording, or the last second of a connected hand "
       "(Baseline).",
       "each taxel separately",
       "what skins and pads need whose readings aren't 0 at rest"},
  };
}

FilterOption edge(const char* key, double defaultValue, const char* purpose) {
  return real(key, kLowestEdgeHz, kHighestEdgeHz, defaultValue, "Hz", purpose);
}
FilterOption butterworthOrder() {
  return {"order",
          "",
          FilterCatalogKind::kInteger,
          1,
          8,
          2,
          {},
          "steepness: 20 dB per decade and order; twice that with centred=1"};
}
FilterOption zeroPhase() {
  FilterOption option = centred();
  option.purpose = "forwards and backwards over the recording, without delay; else up to now";
  return option;
}

// The filters of filter/butterworth.h.
std::vector<FilterKind> butterworthKinds() {
  const char* const border =
      "begins as if the first value had always been there, and again after a gap; centred=1: the "
      "signal continues as its reflection through the end point";
  const char* const source =
      "Butterworth 1930, bilinear transform in sections of second order; as scipy.signal.butter";
  return {
      {"low-pass",
       "Low-pass (Butterworth)",
       FilterDomain::kTemporal,
       {edge("cutoff", 5, "lower frequencies pass; below half the frame rate"),
        butterworthOrder(),
        zeroPhase()},
       "Passes slow changes: a contact without its vibration.",
       border,
       source},
      {"high-pass",
       "High-pass (Butterworth)",
       FilterDomain::kTemporal,
       {edge("cutoff", 0.5, "higher frequencies pass; below half the frame rate"),
        butterworthOrder(),
        zeroPhase()},
       "Passes fast changes, about 0: without drift and resting load.",
       border,
       source},
      {"band-pass",
       "Band-pass (Butterworth)",
       FilterDomain::kTemporal,
       {edge("low", 1, "lower edge of the pass band"),
        edge("high", 5, "upper edge of the pass band; below half the frame rate"),
        butterworthOrder(),
        zeroPhase()},
       "Passes the changes between two frequencies, about 0: slip and roughness.",
       border,
       source},
      {"band-stop",
       "Band-stop, notch (Butterworth)",
       FilterDomain::kTemporal,
       {edge("low", 4, "lower edge of the stop band"),
        edge("high", 6, "upper edge of the stop band; below half the frame rate"),
        butterworthOrder(),
        zeroPhase()},
       "Removes the changes between two frequencies: a vibration of the hand itself.",
       border,
       source},
  };
}

std::vector<FilterKind> temporalKinds() {
  FilterOption anyWindow = window(3);
  anyWindow.kind = FilterCatalogKind::kInteger;
  anyWindow.purpose = "frames in the window; odd with centred=1";
  return {
      {"running-mean",
       "Running mean",
       FilterDomain::kTemporal,
       {window(5), centred()},
       "Mean of the last frames: the least noise for a given steepness of a step.",
       kShrinks,
       "study 2.1.1"},
      {"temporal-gaussian",
       "Temporal Gaussian",
       FilterDomain::kTemporal,
       {window(5),
        real("sigma", 0.01, 1000, 1.5, "frames", "width; causal: of the past half"),
        centred()},
       "Weighted mean of the last frames, the newest the most.",
       kShrinks,
       "study 2.1.1"},
      {"temporal-min",
       "Temporal minimum",
       FilterDomain::kTemporal,
       {anyWindow, centred()},
       "Smallest of the last frames: removes flickering taxels; contacts appear a little later.",
       kShrinks,
       "study 2.4"},
      {"kalman",
       "Kalman, zero order",
       FilterDomain::kTemporal,
       {real("q", 0, 1e6, 0.05, "counts^2", "variance of the process per frame"),
        real("r", 1e-6, 1e6, 0.5, "counts^2", "variance of the measurement"),
        {"centred",
         "",
         FilterCatalogKind::kFlag,
         0,
         1,
         0,
         {},
         "smoothed over the whole recording, as rts; else the frames up to now"}},
       "Assumes that a taxel keeps its value: smooth, with some delay.",
       "begins at the first frame, and again after a gap",
       "study 2.1.2; Q 0.05 and R 0.5 give the steady gain 0.270156"},
      {"kelvin-voigt",
       "Kalman, Kelvin-Voigt",
       FilterDomain::kTemporal,
       {real("m", 1e-9, 1e9, kAutomatic, "force s^2/count", "mass; left out: 1"),
        real("e",
             0,
             1e9,
             kAutomatic,
             "force/count",
             "spring; left out: estimated from the recording"),
        real("eta",
             0,
             1e9,
             kAutomatic,
             "force s/count",
             "damper; left out: estimated from the recording"),
        real("q",
             1e-12,
             1e18,
             kAutomatic,
             "force^2 s",
             "noise of the force; left out: estimated from the recording"),
        real("r",
             1e-9,
             1e9,
             kAutomatic,
             "counts^2",
             "noise; left out: estimated from the recording"),
        {"centred",
         "",
         FilterCatalogKind::kFlag,
         0,
         1,
         0,
         {},
         "smoothed over the whole recording; else the frames up to now"}},
       "Mass, spring and damper driven by noise; parameters that are left out are estimated from "
       "the recording by "
       "expectation-maximisation. The filter kalman is better.",
       "begins at the first frame, and again after a gap",
       "study 2.1.2, eq. 2.1"},
      {"rts",
       "Kalman smoother (RTS)",
       FilterDomain::kTemporal,
       {real("q", 0, 1e6, 0.05, "counts^2", "variance of the process per frame"),
        real("r", 1e-6, 1e6, 0.5, "counts^2", "variance of the measurement")},
       "The filter kalman, forwards and backwards: no delay, for recordings only.",
       "from the first frame to the last, or to a gap",
       "Rauch, Tung and Striebel 1965; study 2.1.2"},
      {"savitzky-golay",
       "Savitzky-Golay",
       FilterDomain::kTemporal,
       {odd("window", kMaxSavitzkyGolayWindow, 5, "frames", "frames in the window"),
        {"order",
         "",
         FilterCatalogKind::kInteger,
         0,
         6,
         2,
         {},
         "degree of the polynomial, below the window"},
        {"derivative",
         "",
         FilterCatalogKind::kInteger,
         0,
         2,
         0,
         {},
         "0: smoothed, 1: slope per frame, 2: curvature per frame^2"},
        centred()},
       "Least-squares polynomial through the window: keeps peaks, gives derivatives.",
       "the polynomial of the first (last) window; of fewer frames the order that fits them",
       "Savitzky and Golay 1964; study 2.2"},
  };
}

std::vector<FilterKind> spatioTemporalKinds() {
  FilterOption anyWindow = window(3);
  anyWindow.kind = FilterCatalogKind::kInteger;
  anyWindow.purpose = "frames of the minimum; odd with centred=1";
  return {
      {"median3d",
       "Median in space and time",
       FilterDomain::kSpatioTemporal,
       {size(), window(3), masked(), centred()},
       "Middle value of the neighbours in space and time: the study's choice against ghosts.",
       "the taxel at the border and the first frame (the last one) are repeated; masked taxels are "
       "neither read nor written",
       "study 2.4, 26 neighbours"},
      {"min-median",
       "Minimum, then median",
       FilterDomain::kSpatioTemporal,
       {anyWindow, size(), masked(), centred()},
       "Smallest of the last frames, then the middle value of the neighbours.",
       "the window holds the available frames; the taxel at the border is repeated; masked taxels "
       "are neither read nor written",
       "study 2.4; called \"3D median\" by the program of the study"},
  };
}

const std::vector<FilterKind>& all() {
  static const std::vector<FilterKind> kinds = [] {
    std::vector<FilterKind> made = spatialKinds();
    for (auto&& more : {temporalKinds(), butterworthKinds(), spatioTemporalKinds()})
      made.insert(made.end(), more.begin(), more.end());
    return made;
  }();
  return kinds;
}

}  // namespace

const FilterOption* FilterKind::option(std::string_view key) const noexcept {
  for (const FilterOption& option : options)
    if (option.key == key) return &option;
  return nullptr;
}

std::string FilterKind::optionKeys() const {
  std::string keys;
  for (const FilterOption& option : options) keys += (keys.empty() ? "" : ", ") + option.key;
  return keys;
}

std::span<const FilterKind> filterKinds() { return all(); }

namespace {
// The letters and digits of a name in lower case: "lowpass" of "Low-Pass".
std::string lettersOf(std::string_view name) {
  std::string letters;
  for (const char letter : name)
    if (std::isalnum(static_cast<unsigned char>(letter)) != 0)
      letters += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return letters;
}

// How many letters must be changed, added or left out to make one word of the other.
std::size_t lettersApart(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t k = 0; k < b.size(); ++k) {
      const std::size_t replaced = diagonal + (a[i] == b[k] ? 0 : 1);
      diagonal = row[k + 1];
      row[k + 1] = std::min({replaced, row[k] + 1, row[k + 1] + 1});
    }
  }
  return row.back();
}

// The filter that is meant by a name that none has; empty: it can't be told.
std::string meantBy(std::string_view name) {
  const std::string letters = lettersOf(name);
  for (const char* word : {"notch", "bandreject", "bandrejection"})
    if (letters == word) return "band-stop";
  if (letters == "butterworth" || letters == "butter") return "low-pass";
  for (const FilterKind& kind : all())
    if (lettersOf(kind.name) == letters) return kind.name;
  // A slip of the fingers: one letter of a short word, two of a long one.
  constexpr std::size_t kLongWord = 6;
  std::size_t least = letters.size() < kLongWord ? 2 : 3;
  std::string nearest;
  for (const FilterKind& kind : all()) {
    const std::size_t apart = lettersApart(letters, lettersOf(kind.name));
    if (apart >= least) continue;
    least = apart;
    nearest = kind.name;
  }
  return nearest;
}
}  // namespace

const FilterKind& filterKind(std::string_view name) {
  for (const FilterKind& kind : all())
    if (kind.name == name) return kind;
  const std::string meant = meantBy(name);
  throw std::invalid_argument("unknown filter \"" + shortened(name) + "\"" +
                              (meant.empty() ? std::string() : " (did you mean " + meant + "?)") +
                              "; there are: " + filterNames());
}

std::string filterNames() {
  std::string names;
  for (const FilterKind& kind : all()) names += (names.empty() ? "" : ", ") + kind.name;
  return names;
}

}  // namespace palpate
