// A capture session (a "frame manager"): owns a device, live or replayed, and hands what it
// delivers to the recorder, to live processing and to the screen, without ever making the device
// wait.
//
//   device's threads --> CaptureQueue --> recorder's thread --> disk
//                   `--> CaptureQueue of each subscriber (live processing)
//                   `--> newest frame, angles, temperatures; events (the screen pulls them)
//
// Stamps are the device's; nothing is stamped anew. One controlling thread, any number of pullers.
#pragma once

#include <atomic>
#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <palpate/capture/capture_queue.h>
#include <palpate/capture/link_health.h>
#include <palpate/capture/recorder.h>
#include <palpate/core/latest_value.h>
#include <palpate/core/time.h>
#include <palpate/device/device.h>

namespace palpate {

struct CaptureOptions {
  RecorderOptions recorder;
  HealthOptions health;
  bool ownThread = true;  // false: the caller makes the recorder's rounds by step()
};

class CaptureSession : private DeviceSink {
 public:
  // The clock must outlive the session. Throws std::invalid_argument (no device, options).
  explicit CaptureSession(std::unique_ptr<Device> device,
                          CaptureOptions options = {},
                          const Clock& clock = systemClock());
  ~CaptureSession() override;  // stops
  CaptureSession(const CaptureSession&) = delete;
  CaptureSession& operator=(const CaptureSession&) = delete;

  Device& device() noexcept { return *device_; }
  const Device& device() const noexcept { return *device_; }

  // Starts device and recorder; does nothing when started. What was kept, counted and shown before
  // is forgotten.
  void start();
  // Stops the device, finishes a running recording (its report: stopRecording()).
  void stop() noexcept;
  bool started() const noexcept { return started_.load(); }

  // As Recorder::start; what the device says about itself (serial number, firmware, settings) and
  // the program's version are noted in the recording, the link's counters too. The device need not
  // be started: the recording begins with its first frame.
  void startRecording(RecordingOptions options);
  RecordingReport stopRecording();
  bool recording() const { return recorder_.recording(); }
  RecorderStatus recorderStatus() const { return recorder_.status(); }
  // Marks the moment: an event "label" with this text (not empty; of a digit key: its label), or,
  // when empty, an event "mark". Recorded when something is, shown in any case.
  void mark(const std::string& text = {}, std::optional<int> digit = {});

  // An event of whoever works on this session (a grasp that began, a person's note): shown,
  // recorded when something is. Stamps as nowUs() has them. Safe from any thread.
  void note(const RecordingEvent& event);

  LinkHealth health() const;
  PreflightCheck checkPreflight(const std::filesystem::path& folder) const;

  // A consumer of its own from now on; ends when the pointer is let go. `consumer` is named in
  // gaps.
  std::shared_ptr<CaptureQueue> subscribe(std::string consumer,
                                          const CaptureQueueOptions& options = {});

  // For the screen: what is newer than at the last call, null or nothing when there is nothing new.
  SharedFrame takeFrame();
  std::optional<JointAngles> takeAngles();
  std::optional<Temperatures> takeTemperatures();
  LatestValueStats screenStats() const { return screenFrame_.stats(); }
  // Events since the last call, the last 1000 at most.
  std::vector<RecordingEvent> takeEvents();

  // One round of the recorder, when it has no thread of its own.
  void step() { recorder_.step(); }
  // Host time as stamps have it [us since 1970].
  std::int64_t nowUs() const { return recorder_.nowUs(); }

 private:
  void onFrame(TactileFrame&& frame) override;
  void onAngles(JointAngles&& angles) override;
  void onTemperatures(Temperatures&& temperatures) override;
  void onEvent(DeviceEvent&& event) override;

  void pass(const CaptureItem& item);
  void show(const RecordingEvent& event);
  LinkInputs inputs() const;

  const CaptureOptions options_;
  const Clock& clock_;
  std::unique_ptr<Device> device_;
  Recorder recorder_;
  LinkMonitor meter_;
  const bool scansItself_;
  std::shared_ptr<const SensorLayout> expectedFor_;  // of the thread that delivers frames
  std::atomic<float> saturationCounts_;
  std::atomic<bool> started_ = false;

  LatestValue<SharedFrame> screenFrame_;
  LatestValue<JointAngles> screenAngles_;
  LatestValue<Temperatures> screenTemperatures_;
  mutable std::mutex shownMutex_;
  std::deque<RecordingEvent> shown_;
  std::optional<Temperatures> lastTemperatures_;

  std::mutex feedsMutex_;
  std::vector<std::shared_ptr<CaptureQueue>> feeds_;
  std::atomic<std::size_t> numFeeds_ = 0;
};

}  // namespace palpate
