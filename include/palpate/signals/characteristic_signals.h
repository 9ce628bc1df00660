// Characteristic signals of a matrix: one number per frame that stands for the whole matrix
// (study, chapter 3; the filtered mean is its eq. 3.2). Active taxel: value > 0.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/model/profile.h>
#include <palpate/model/tactile_frame.h>

namespace palpate {

// Of one matrix in one frame; a matrix without an active taxel is all zero.
struct CharacteristicSignals {
  double mean = 0.0;          // of the active taxels [counts]
  double filteredMean = 0.0;  // mean of the Gaussian-filtered (3x3) matrix over ITS active taxels
  double minimum = 0.0;       // of the active taxels [counts]
  double maximum = 0.0;       // [counts]
  double sum = 0.0;           // [counts]
  int active = 0;             // number of active taxels
  double areaMm2 = 0.0;       // active * taxel area [mm^2]
};

enum class SignalKind { kMean, kFilteredMean, kMaximum, kMinimum, kSum, kActive, kArea };
inline constexpr std::array kAllSignalKinds = {SignalKind::kMean,
                                               SignalKind::kFilteredMean,
                                               SignalKind::kMaximum,
                                               SignalKind::kMinimum,
                                               SignalKind::kSum,
                                               SignalKind::kActive,
                                               SignalKind::kArea};
double valueOf(const CharacteristicSignals& values, SignalKind which);
// The name in tables, files and options: "mean", "filtered_mean", "max", "min", "sum", "active",
// "area_mm2".
std::string_view signalName(SignalKind kind);
std::optional<SignalKind> signalKindNamed(std::string_view name);

CharacteristicSignals characteristicSignals(const Eigen::Ref<const MatrixValues>& values,
                                            const MatrixLayout& layout);
// Of every matrix of a frame, in wire order.
std::vector<CharacteristicSignals> characteristicSignals(const TactileFrame& frame);
// Of the whole frame: mean, minimum, maximum over the active taxels of all matrices (the mean of
// taxels, not of matrices); filteredMean likewise over all filtered matrices.
CharacteristicSignals wholeFrameSignals(const TactileFrame& frame);
// Both in one: a row per matrix, the whole last. `rows` is filled anew.
void allSignals(const TactileFrame& frame, std::vector<CharacteristicSignals>& rows);

// One row per frame of a profile, matrix after matrix: signals(frame, matrix). Throws Cancelled.
class SignalTable {
 public:
  SignalTable() = default;
  // From rows computed before, frame after frame, matrix after matrix. Throws std::invalid_argument
  // where they are no whole frames.
  SignalTable(std::size_t numMatrices, std::vector<CharacteristicSignals> rows);
  static SignalTable of(const Profile& profile, const Progress& progress = {});
  std::size_t numFrames() const noexcept { return numFrames_; }
  std::size_t numMatrices() const noexcept { return numMatrices_; }
  const CharacteristicSignals& at(std::size_t frame, std::size_t matrix) const;
  // The frame with the largest sum over all matrices (the first of equals); 0 when empty.
  std::size_t frameOfLargestSum() const;

 private:
  std::size_t numFrames_ = 0;
  std::size_t numMatrices_ = 0;
  std::vector<CharacteristicSignals> rows_;
};

}  // namespace palpate
