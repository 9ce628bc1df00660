// What an emulated hand does behind its two ports: joints that move, matrices that feel. The
// servers of the two protocols know only this. Implemented by the physical hand (joints, objects,
// contact, rubber) and by a recording that is played.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <palpate/emulator/joint_motion.h>
#include <palpate/model/hand_description.h>

namespace palpate {

// What a client set in the tactile controller; the model reads it when it scans.
struct MatrixSetting {
  double sensitivity = 0.5;         // 0..1
  double factorySensitivity = 0.5;  // what a reset gives
  int thresholdCounts = 0;          // 0..4095; power-up: 150 proximal, 300 distal
  int factoryThresholdCounts = 0;
  Mask dynamicMask;  // rows * columns; 1 = scanned
};

// The truth about one matrix at the moment of a scan.
struct MatrixTruth {
  bool contact = false;
  double forceN = 0.0;                     // normal force [N]
  double xMm = 0.0, yMm = 0.0, zMm = 0.0;  // centre of pressure, hand base frame [mm]; with contact
  double slipXTaxels = 0.0;  // motion of the object over the matrix since contact began,
  double slipYTaxels = 0.0;  // [taxels], x right, y down
  double turnDeg = 0.0;      // rotation of the object about the normal since then [deg]
};

// Not thread-safe: the emulated hand holds a mutex around it.
class HandModel {
 public:
  virtual ~HandModel() = default;
  virtual const HandDescription& hand() const = 0;
  // Lets time pass up to `timeS` [s since start]; never goes back (an earlier time does nothing).
  virtual void advanceTo(double timeS) = 0;
  virtual double timeS() const = 0;
  virtual JointMotion& joints() = 0;
  virtual std::vector<MatrixSetting>& settings() = 0;  // one per matrix
  // What the tactile controller delivers now: threshold, masks and 12 bit applied. Size:
  // numCells().
  virtual void scan(std::span<std::uint16_t> counts) = 0;
  virtual std::vector<double> temperatures() = 0;  // one per sensor [deg C]
  // Of the last scan, one per matrix; empty when nothing is known (a replay).
  virtual std::vector<MatrixTruth> truth() const = 0;
  // A finished replay has nothing more to scan.
  virtual bool finished() const { return false; }
  // Replay: time from the frame of the last scan() to the next one [s], 0 ahead of the first.
  // Nothing: the controller's own scan time.
  virtual std::optional<double> nextIntervalS() const { return std::nullopt; }
};

}  // namespace palpate
