// Thread of the motion port in LiveHand: delivers joint angles and temperatures, executes motions.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <palpate/device/last_stop.h>
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

  std::vector<int> axisStates() const;  // may be called from any thread
  std::optional<SdhControllerInfo> info() const;

 protected:
  void connect(ByteChannel& channel) override;
  void work() override;
  void disconnected() override;
  void stopBlindly(ByteChannel& channel, const std::string& why) noexcept override;
  void emergencyStop() override;
  void forget() override;
  void closing() override;
  void ended() override;
  CommandAnswer execute(const DeviceCommand& command) override;
  void enqueue(QueuedCommand order) override;

 private:
  bool stopWaits() const;
  void confirmStops();
  void answerStops();
  void openController();
  void pollAngles();
  void pollTemperatures();
  bool statesAreDue() const noexcept { return session_.moving || session_.settling; }
  void pollStates();
  CommandAnswer move(const MoveJoints& move);
  void stopMotion();
  void relaxAnswerLimit();
  void prepareLastStop();
  void countBytes();

  const std::int64_t anglePeriodUs_;
  const std::int64_t temperaturePeriodUs_;
  std::unique_ptr<SdhController> controller_;
  ByteChannel* opened_ = nullptr;  // that of controller_
  // From the first motion of a connection to its end.
  std::optional<LastStop> lastStop_;

  std::optional<SdhControllerInfo> known_;  // requires mutex_
  std::vector<int> states_;                 // requires mutex_

  // A motion controller has answered at this port since start().
  bool answered_ = false;
  // True when the controller was lost during a motion.
  bool stopAfterReconnect_ = false;
  // State of one session, from begin() to finish().
  struct Session {
    bool moving = false;  // a motion begun by us has not ended
    // After a stop or a change of power the states are read until no axis moves.
    bool settling = false;
    // See MoveJoints::answerLimitS.
    bool answersLimited = false;
    bool answersLimitedAtRest = false;
    // Before this time no state "idle" is believed, which old firmware reports too early [monotonic
    // us].
    std::int64_t motionUntilUs = 0;
    std::int64_t stoppedUs = 0;     // when a stop was confirmed last [monotonic us]
    std::int64_t motionFromUs = 0;  // host time
    std::int64_t nextAnglesUs = 0;  // monotonic time
    std::int64_t nextTemperaturesUs = 0;
    std::int64_t nextStatesUs = 0;
    std::int64_t lastAngleStampUs = 0;
    std::int64_t lastTemperatureStampUs = 0;
    int failures = 0;  // consecutive failed exchanges
    bool saidNoLastStop = false;
    SdhStats before;
    std::uint64_t samples = 0;
  };
  Session session_;
  // Stops that were sent; they are answered when the axes are known to be at rest.
  std::vector<QueuedCommand> sentStops_;
};

}  // namespace palpate
