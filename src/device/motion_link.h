// The thread of the motion port: joint angles and temperatures out, motion in.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <palpate/device/sdh_controller.h>

#include "device/port_link.h"

namespace palpate {

class MotionLink : public PortLink {
 public:
  MotionLink(const std::string& port,
             Open open,
             double angleHz,
             double temperatureHz,
             const HostTime& time,
             const Clock& clock);
  ~MotionLink() override;

  std::vector<int> axisStates() const;  // any thread
  std::optional<SdhFacts> facts() const;

 protected:
  void connect(ByteChannel& channel) override;
  void work() override;
  void disconnected() override;
  void closing() override;
  CommandAnswer execute(const DeviceCommand& command) override;
  void enqueue(Order order) override;

 private:
  bool stopWaits() const;
  void pollAngles();
  void pollTemperatures();
  void pollStates();
  CommandAnswer move(const MoveJoints& move);
  void stopMotion();
  void countBytes();

  const std::int64_t anglePeriodUs_;
  const std::int64_t temperaturePeriodUs_;
  std::unique_ptr<SdhController> controller_;

  std::optional<SdhFacts> known_;  // under mutex_
  std::vector<int> states_;        // under mutex_

  bool moving_ = false;  // a motion that we began hasn't ended
  bool stopAfterReturn_ = false;
  std::int64_t motionFromUs_ = 0;  // host time
  std::int64_t nextAnglesUs_ = 0;  // monotonic
  std::int64_t nextTemperaturesUs_ = 0;
  std::int64_t nextStatesUs_ = 0;
  std::int64_t lastAngleStampUs_ = 0;
  std::int64_t lastTemperatureStampUs_ = 0;
  int failures_ = 0;  // exchanges in a row that failed
  SdhStats before_;
  std::uint64_t samples_ = 0;
};

}  // namespace palpate
