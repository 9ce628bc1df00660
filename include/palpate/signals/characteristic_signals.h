// Characteristic signals of a matrix: numbers that each describe the whole matrix in one frame
// (study, chapter 3; the filtered mean is its eq. 3.2). Charts, tables and the calibration use
// them. A taxel is active when its value is above 0.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/core/text_table.h>
#include <palpate/model/hand_description.h>
#include <palpate/model/profile.h>
#include <palpate/model/tactile_frame.h>

namespace palpate {

// The signals of one matrix in one frame; all are zero when no taxel is active.
struct CharacteristicSignals {
  double mean = 0.0;  // of the active taxels [counts]
  double filteredMean =
      0.0;               // mean of the active taxels of the Gaussian-filtered (3x3) matrix [counts]
  double minimum = 0.0;  // of the active taxels [counts]
  double maximum = 0.0;  // [counts]
  double sum = 0.0;      // [counts]
  int active = 0;        // number of active taxels
  double areaMm2 = 0.0;  // active * taxel area [mm^2]
  // x, y and z of the readings over their baseline (forceAt()), summed over all scanned taxels
  // [unit of the readings]. 0 where the sensor sends no readings; NaN of a filtered frame, and of
  // the whole hand, since each matrix has axes of its own.
  std::array<double, 3> force = {};
};

// Names one of the characteristic signals.
enum class SignalKind {
  kMean,
  kFilteredMean,
  kMaximum,
  kMinimum,
  kSum,
  kActive,
  kArea,
  // The components of `force`, and its length.
  kX,
  kY,
  kZ,
  kNorm
};
// Those that every hand has.
inline constexpr std::array kAllSignalKinds = {SignalKind::kMean,
                                               SignalKind::kFilteredMean,
                                               SignalKind::kMaximum,
                                               SignalKind::kMinimum,
                                               SignalKind::kSum,
                                               SignalKind::kActive,
                                               SignalKind::kArea};
// Whether only matrices with readings have it: kX, kY, kZ, kNorm.
constexpr bool isComponent(SignalKind kind) noexcept { return kind >= SignalKind::kX; }
// The signals of matrices with or without readings (Profile::givesReadings()), in the order of the
// enumeration: kAllSignalKinds, with readings also the components.
std::span<const SignalKind> signalKinds(bool withComponents) noexcept;
double valueOf(const CharacteristicSignals& values, SignalKind which);
// Name in tables, files and options: "mean", "filtered_mean", "max", "min", "sum", "active",
// "area_mm2", "x", "y", "z", "norm".
std::string_view signalName(SignalKind kind);
std::optional<SignalKind> signalKindNamed(std::string_view name);

CharacteristicSignals characteristicSignals(const Eigen::Ref<const MatrixValues>& values,
                                            const MatrixLayout& layout);
// The signals of every matrix of a frame, in wire order.
std::vector<CharacteristicSignals> characteristicSignals(const TactileFrame& frame);
// The signals of one matrix of a frame. In a filtered frame the means are over the active taxels
// and those that hold a filtered value of at least 1 % of the largest one of the matrix: the value
// of a filter over time outlasts the contact of a taxel. All other signals are over the active
// ones. Throws std::out_of_range for a matrix that does not exist.
CharacteristicSignals characteristicSignals(const TactileFrame& frame, std::size_t matrix);
// The signals of the whole frame: mean, minimum and maximum over the active taxels of all matrices
// (each taxel has the same weight); filteredMean likewise over all filtered matrices.
CharacteristicSignals wholeFrameSignals(const TactileFrame& frame);
// Computes both: one row per matrix, and the whole frame last. `rows` is overwritten.
void allSignals(const TactileFrame& frame, std::vector<CharacteristicSignals>& rows);
// Whether a taxel is saturated in a frame of a hand, by the rows of allSignals().
bool isSaturated(std::span<const CharacteristicSignals> rows, const HandDescription& hand);

// The signals of all frames of a profile, one row per frame and matrix.
class SignalTable {
 public:
  SignalTable() = default;
  // Takes rows that were computed before, frame after frame, matrix after matrix. Throws
  // std::invalid_argument when the last frame is incomplete.
  SignalTable(std::size_t numMatrices, std::vector<CharacteristicSignals> rows);
  // Computes the signals of all frames. Throws Cancelled.
  static SignalTable of(const Profile& profile, const Progress& progress = {});
  std::size_t numFrames() const noexcept { return numFrames_; }
  std::size_t numMatrices() const noexcept { return numMatrices_; }
  const CharacteristicSignals& at(std::size_t frame, std::size_t matrix) const;
  // Index of the frame with the largest sum over all matrices (the first of equal ones); 0 when the
  // table is empty.
  std::size_t frameOfLargestSum() const;

 private:
  std::size_t numFrames_ = 0;
  std::size_t numMatrices_ = 0;
  std::vector<CharacteristicSignals> rows_;
};

// Makes one row per matrix, with its name in the hand's description, and a last row for the whole
// frame. Values are in counts unless the header names a unit.
TextTable signalTextTable(const TactileFrame& frame, const HandDescription& hand);

}  // namespace palpate
