// A capture session owns a device, live or replayed, and passes its data to the recorder, to live
// processing and to the display, without ever making the device wait.
//
//   threads of the device and of further series --> CaptureQueue --> recorder's thread --> disk
//       `--> CaptureQueue of each subscriber (live processing)
//       `--> newest frame, angles, temperatures; events (the display fetches them)
//
// All time stamps are those of the device. One thread controls the session; any number of threads
// may fetch data.
#pragma once

#include <atomic>
#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <palpate/capture/capture_queue.h>
#include <palpate/capture/link_health.h>
#include <palpate/capture/recorder.h>
#include <palpate/core/latest_value.h>
#include <palpate/core/option_check.h>
#include <palpate/core/time.h>
#include <palpate/device/device.h>
#include <palpate/device/series_source.h>
#include <palpate/model/rest_span.h>
#include <palpate/model/time_base.h>

namespace palpate {

struct CaptureOptions {
  RecorderOptions recorder;
  HealthOptions health;
  // False: the caller runs the recorder by step().
  bool ownThread = true;
  static constexpr OptionRange kBaselineS{0.1, 60.0, "s"};
  double baselineS = 1.0;  // how long takeBaseline() looks back
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

  // Adds a series that comes from elsewhere, beside those of the device. It is recorded, can't stop
  // anything, and what happens to it does not concern the hand. Throws std::invalid_argument (none,
  // a name that is taken, too many; removed ones count), std::logic_error (a recording is running).
  void addSeries(std::unique_ptr<SeriesSource> source);
  // Ends a series of addSeries() within 2 s; its index is not used again. Throws
  // std::invalid_argument (there is none of this name), std::logic_error (a recording is running).
  void removeSeries(const std::string& name);
  // Those of addSeries(), without the removed ones. Safe from any thread.
  std::vector<std::shared_ptr<SeriesSource>> seriesSources() const;
  // The series beside those of the hand, in the order of their indexes from kHandSeries on; without
  // columns where these are not known yet, without a name where one was removed. Safe from any
  // thread.
  std::vector<SeriesDescription> furtherSeries() const;

  // Starts device and recorder; no effect when started. Resets all stored data and counters of an
  // earlier run.
  void start();
  // Stops the device and finishes a running recording (its report: stopRecording()).
  void stop() noexcept;
  bool started() const noexcept { return started_.load(); }

  // Takes the readings of the last CaptureOptions::baselineS for the readings at rest, of a hand
  // that decides touch by its readings: what follows is seen over them, and the event "baseline"
  // is shown; a recording notes the baseline of its frames. Returns what was taken, in one line.
  // Throws Error where there are fewer than two frames, where they aren't at rest (model/touch.h),
  // and for another hand. Safe from any thread, as the functions below.
  std::string takeBaseline();
  // The baseline before the last one comes back, with the event "baseline". Throws Error where
  // there is none.
  void undoBaseline();
  bool canUndoBaseline() const;
  // The same readings (counts, of a hand that doesn't decide touch) without taking them. Throws
  // Error as takeBaseline().
  Rest restNow() const;

  // As Recorder::start(). The recording also contains the device's properties (serial number,
  // firmware, settings), the program's version and the counters of the connection. The device need
  // not be started: the recording begins with its first frame.
  void startRecording(RecordingOptions options);
  RecordingReport stopRecording();
  // As Recorder::continueIn().
  void continueRecordingIn(const std::filesystem::path& folder) { recorder_.continueIn(folder); }
  bool recording() const { return recorder_.recording(); }
  RecorderStatus recorderStatus() const { return recorder_.status(); }
  // Marks the present moment: with an event "label" of this text (and of a digit key, if given), or
  // with an event "mark" if the text is empty. It is always shown, and recorded during a recording.
  void mark(const std::string& text = {}, std::optional<int> digit = {});

  // Adds an event from a user of this session (begin of a grasp, a note): it is shown, and recorded
  // during a recording. Its stamps are as of nowUs(). Safe from any thread.
  void note(const Event& event);

  LinkHealth health() const;
  PreflightCheck checkPreflight(const std::filesystem::path& folder) const;
  PreflightCheck checkPreflight(const FolderState& folder) const;

  // Adds a consumer with its own queue; it ends when the pointer is released. `consumer` is named
  // in gaps.
  std::shared_ptr<CaptureQueue> subscribe(std::string consumer,
                                          const CaptureQueueOptions& options = {});

  // For the display: the newest item since the last call; null or empty when there is none.
  SharedFrame takeFrame();
  std::optional<Sample> takeAngles();
  std::optional<Sample> takeTemperatures();
  LatestValueStats screenStats() const { return screenFrame_.stats(); }
  // Events since the last call, at most the last 1000.
  std::vector<Event> takeEvents();

  // Runs one round of the recorder, when it has no thread of its own.
  void step() { recorder_.step(); }
  // Present host time in the time of the stamps [us since 1970].
  std::int64_t nowUs() const { return recorder_.nowUs(); }

 private:
  void onFrame(TactileFrame&& frame) override;
  void onSample(Sample&& sample) override;
  void onEvent(Event&& event) override;

  // Takes what the sources of further series deliver.
  struct FurtherSink : DeviceSink {
    explicit FurtherSink(CaptureSession& to) : session(to) {}
    void onFrame(TactileFrame&&) override {}
    void onSample(Sample&& sample) override { session.onSample(std::move(sample)); }
    void onEvent(Event&& event) override {
      session.show(event);
      session.pass(CaptureItem(std::move(event)), /*ofHand=*/false);
    }
    CaptureSession& session;
  };

  void pass(const CaptureItem& item, bool ofHand = true);
  void show(const Event& event);
  void addToClock(std::size_t of, std::int64_t hostUs, std::optional<std::int64_t> deviceUs);
  LinkInputs inputs() const;
  std::map<std::string, std::int64_t> counters() const;
  std::vector<std::string> seriesNames() const;
  void requireNoRecording() const;
  void nameSeries();
  void startSeries(std::size_t place);

  const CaptureOptions options_;
  const Clock& clock_;
  std::unique_ptr<Device> device_;
  FurtherSink furtherSink_{*this};
  mutable std::mutex sourcesMutex_;
  std::vector<std::shared_ptr<SeriesSource>> sources_;  // null: removed; requires sourcesMutex_
  Recorder recorder_;
  LinkMonitor meter_;
  const bool scansItself_;
  // Layout for which the expected rate was set; used only by the thread that delivers frames.
  std::shared_ptr<const SensorLayout> expectedFor_;
  HandDescription hand_;  // of the device when it was started
  std::atomic<bool> started_ = false;

  mutable std::mutex clocksMutex_;
  std::map<std::size_t, ClockMonitor> clocks_;  // by series; of the frames kMaxSeries

  mutable std::mutex baselineMutex_;
  std::shared_ptr<const Baseline> baseline_;
  std::vector<std::shared_ptr<const Baseline>> earlierBaselines_;
  std::deque<SharedFrame> recent_;  // frames of the last baselineS

  LatestValue<SharedFrame> screenFrame_;
  LatestValue<Sample> screenAngles_;
  LatestValue<Sample> screenTemperatures_;
  mutable std::mutex shownMutex_;
  std::deque<Event> shown_;
  std::optional<Sample> lastTemperatures_;

  std::mutex feedsMutex_;
  std::vector<std::shared_ptr<CaptureQueue>> feeds_;
  std::atomic<std::size_t> numFeeds_ = 0;
};

// Looks at the folder: that takes long, or for ever, where its network doesn't answer.
FolderState folderStateOf(const std::filesystem::path& folder);

}  // namespace palpate
