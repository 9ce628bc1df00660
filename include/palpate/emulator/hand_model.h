// Interface of the hand behind the two emulated ports: joints that move and matrices that measure.
// The servers of both protocols use only this interface. It is implemented by the physical hand
// (joints, objects, contact, rubber) and by the replay of a recording.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <palpate/emulator/joint_motion.h>
#include <palpate/model/hand_description.h>

namespace palpate {

// Settings that a client made in the tactile controller; the model applies them when it scans.
struct MatrixSetting {
  double sensitivity = 0.5;         // 0..1
  double factorySensitivity = 0.5;  // value after a reset
  int thresholdCounts = 0;          // 0..4095; power-up: 150 proximal, 300 distal
  int factoryThresholdCounts = 0;
  Mask dynamicMask;  // rows * columns; 1 = scanned
};

// Ground truth about one matrix at the time of a scan.
struct MatrixTruth {
  bool contact = false;
  double forceN = 0.0;  // normal force [N]
  // Centre of pressure in the hand's base frame [mm]; valid during contact.
  double xMm = 0.0, yMm = 0.0, zMm = 0.0;
  // Displacement of the object over the matrix since contact began [taxels], x right, y down.
  double slipXTaxels = 0.0;
  double slipYTaxels = 0.0;
  // Rotation of the object about the normal since contact began [deg].
  double turnDeg = 0.0;
  // Force of the object along the surface [N], x right, y down.
  double shearXN = 0.0;
  double shearYN = 0.0;
};

// Not thread-safe: EmulatedHand uses it only in its own thread.
class HandModel {
 public:
  virtual ~HandModel() = default;
  virtual const HandDescription& hand() const = 0;
  // Advances the time to `timeS` [s since start]; an earlier time has no effect.
  virtual void advanceTo(double timeS) = 0;
  virtual double timeS() const = 0;
  virtual JointMotion& joints() = 0;
  virtual std::vector<MatrixSetting>& settings() = 0;  // one per matrix
  // Fills `counts` with what the tactile controller delivers now, with threshold, masks and 12-bit
  // range applied. Size: numCells().
  virtual void scan(std::span<std::uint16_t> counts) = 0;
  virtual std::vector<double> temperatures() = 0;  // one per sensor [deg C]
  // Truth of the last scan, one entry per matrix; empty when it is unknown (a replay).
  virtual std::vector<MatrixTruth> truth() const = 0;
  // What the hand does by itself, without an order: "closing", "holding an object", "closed",
  // "opening", "open". Empty: it moves only on orders.
  virtual std::string_view ownMotion() const { return {}; }
  // Serial number of the tactile controller, where a recorded hand had one.
  virtual std::optional<std::uint32_t> serial() const { return std::nullopt; }
  // True when a replay has ended and has no more frames to scan.
  virtual bool finished() const { return false; }
  // Replay: time from the frame of the last scan() to the next frame [s], 0 before the first one.
  // Empty when the controller's own scan time applies.
  virtual std::optional<double> nextIntervalS() const { return std::nullopt; }
};

}  // namespace palpate
