#include "palpate/interop/remote_recorder.h"

#include <array>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/time.h"
#include "palpate/interop/remote_file.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {
using RemoteRecorderSteadyTime = std::chrono::steady_clock;
using RemoteRecorderVerb = RemoteRequest::Verb;

constexpr std::chrono::milliseconds kStartRound{5};    // while waiting for the first commit
constexpr std::chrono::milliseconds kUsualRound{200};  // a recording may end by itself

enum class State { kIdle, kStarting, kRecording, kStopping };

constexpr std::array<std::string_view, 4> kStateNames = {
    "idle", "starting", "recording", "stopping"};

}  // namespace

struct RemoteRecorder::Impl {
  struct Job {
    RemoteRequest request;
    Done done;
  };

  Impl(CaptureSession& theSession, RemoteRecorderOptions given)
      : session(theSession),
        options(std::move(given)),
        nameTemplate(options.nameTemplate),
        meta(options.recording.meta) {
    if (const std::string problem = problemOfRemoteName(nameTemplate); !problem.empty())
      throw std::invalid_argument("RemoteRecorderOptions: nameTemplate: " + problem);
    std::error_code ignored;
    if (!fs::is_directory(options.folder, ignored))
      throw FileError(options.folder, "isn't a folder: create it first");
  }

  // The following functions run on the server's thread.

  RemoteAnswer status() const {
    const LinkHealth health = session.health();
    const std::lock_guard lock(mutex);
    RemoteAnswer answer;
    answer.fields.set("state", kStateNames[static_cast<std::size_t>(state)]);
    if (state != State::kIdle) setRecorderFields(answer.fields, health.recorder);
    setLinkFields(answer.fields, health);
    answer.fields.set("folder", options.folder.string()).set("next_file", nextFile());
    const auto freeBytes = freeBytesOf(options.folder);
    answer.fields.set("free_bytes",
                      freeBytes ? Json(static_cast<std::int64_t>(*freeBytes)) : Json());
    return answer;
  }

  // Name for a start without a name; null when there is none.
  Json nextFile() const {
    try {
      return Json(pathOf(nameTemplate).filename().string());
    } catch (const std::exception&) {
      return {};
    }
  }

  fs::path pathOf(const std::string& name) const {
    const auto text = [this](const char* key) {
      const auto found = meta.find(key);
      return found == meta.end() ? std::string() : found->second;
    };
    return remoteRecordingPath(
        options.folder, name, {systemClock().wallUs(), text("operator"), text("object")});
  }

  RemoteAnswer note(const std::string& text) {
    if (current() != State::kRecording || !session.recording())
      return RemoteAnswer::refused("not_recording", "nothing is being recorded: start first");
    Event event;
    event.tUs = event.t1Us = session.nowUs();
    event.kind = text.empty() ? "mark" : "label";
    event.text = text;
    session.note(event);
    RemoteAnswer answer;
    answer.fields.set("time_ms", event.tUs / kUsPerMs);
    return answer;
  }

  RemoteAnswer name(const std::string& text) {
    const std::lock_guard lock(mutex);
    if (!text.empty()) {
      if (const std::string problem = problemOfRemoteName(text); !problem.empty())
        return RemoteAnswer::refused("file_name", problem);
      nameTemplate = text;
    }
    RemoteAnswer answer;
    answer.fields.set("template", nameTemplate).set("next_file", nextFile());
    return answer;
  }

  RemoteAnswer set(const std::string& text) {
    const auto setting = settingFrom(text);
    if (!setting) return RemoteAnswer::refused("malformed", "set operator, object, run or notes");
    const std::lock_guard lock(mutex);
    if (setting->value.empty())
      meta.erase(setting->key);
    else
      meta[setting->key] = setting->value;
    RemoteAnswer answer;
    answer.fields.set(setting->key, setting->value);
    return answer;
  }

  // Executes a request; its answer is given exactly once, whatever fails afterwards.
  void enqueue(const RemoteRequest& request, Done done) {
    Done once = [given = std::make_shared<bool>(false),
                 done = std::move(done)](RemoteAnswer answer) {
      if (!std::exchange(*given, true)) done(std::move(answer));
    };
    const std::lock_guard lock(mutex);
    jobs.push_back({request, std::move(once)});
    wake.notify_one();
  }

  // The following functions run on the thread of this object.

  // To be called in a handler: answers with the current exception.
  static void sayFailed(const Done& done) noexcept {
    try {
      try {
        throw;
      } catch (const std::exception& failure) {
        done(RemoteAnswer::refused("failed", failure.what()));
      } catch (...) {
        done(RemoteAnswer::refused("failed", "an unknown exception"));
      }
    } catch (...) {
      // Most likely out of memory. When no copy of `done` is left, the server answers.
    }
  }

  void run(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      std::optional<Job> job;
      {
        std::unique_lock lock(mutex);
        wake.wait_for(
            lock, stop, starting ? kStartRound : kUsualRound, [this] { return !jobs.empty(); });
        if (!jobs.empty()) {
          job = std::move(jobs.front());
          jobs.pop_front();
        }
      }
      try {
        if (job && job->request.verb == RemoteRecorderVerb::kStart)
          start(job->request.text, job->done);
        else if (job)
          stopRecording(job->done);
      } catch (...) {
        // The process that moves a hand continues; the waiting client receives an error.
        if (job) sayFailed(job->done);
      }
      try {
        look();
      } catch (...) {
        // Checked again in the next round; the request of this round is not affected.
      }
    }
    if (starting) starting->done(RemoteAnswer::refused("shutting_down", "remote control ends"));
    if (current() != State::kIdle) finish();
  }

  State current() const {
    const std::lock_guard lock(mutex);
    return state;
  }
  void become(State next) {
    const std::lock_guard lock(mutex);
    state = next;
  }

  void start(const std::string& text, const Done& done) {
    if (starting) return done(RemoteAnswer::refused("busy", "a recording is being started"));
    if (current() == State::kRecording) {
      RemoteAnswer answer =
          RemoteAnswer::refused("already_recording", "a recording runs: stop it first");
      answer.fields.set("file", session.recorderStatus().path.string());
      return done(answer);
    }
    if (const auto refusal = noHand(session.health(), options.limits)) return done(*refusal);
    if (const auto refusal = noSpace(freeBytesOf(options.folder))) return done(*refusal);
    RecordingOptions recording = options.recording;
    try {
      {
        const std::lock_guard lock(mutex);
        recording.path = pathOf(text.empty() ? nameTemplate : text);
        recording.meta = meta;
      }
      std::error_code ignored;
      if (fs::exists(fs::symlink_status(recording.path, ignored)))
        return done(RemoteAnswer::refused(
            "file_exists",
            recording.path.string() + " exists already; a recording is never replaced"));
      session.startRecording(std::move(recording));
    } catch (const std::invalid_argument& problem) {
      return done(RemoteAnswer::refused("file_name", problem.what()));
    } catch (const FileError& error) {
      return done(RemoteAnswer::refused("folder", error.what()));
    } catch (const std::exception& error) {
      return done(RemoteAnswer::refused("failed", error.what()));
    }
    starting = Starting{done, RemoteRecorderSteadyTime::now()};
    endedByItself.reset();
    become(State::kStarting);
  }

  void stopRecording(const Done& done) {
    if (starting) {
      starting->done(RemoteAnswer::refused("stopped", "it was stopped before a frame was on disk"));
      starting.reset();
    } else if (endedByItself) {
      return done(stopAnswer(*std::exchange(endedByItself, std::nullopt)));
    } else if (current() == State::kIdle) {
      return done(RemoteAnswer::refused("not_recording", "nothing is being recorded"));
    }
    done(stopAnswer(finish()));
  }

  // Closes the file; waits for the disk.
  RecordingReport finish() {
    become(State::kStopping);
    RecordingReport report;
    try {
      report = session.stopRecording();
    } catch (...) {
      become(State::kIdle);
      throw;
    }
    become(State::kIdle);
    try {
      if (options.onFinished) options.onFinished(report);
    } catch (...) {
      // The callback may fail: the recording is finished nevertheless.
    }
    return report;
  }

  void look() {
    if (!starting) {
      if (current() == State::kRecording && !session.recording()) endedByItself = finish();
      return;
    }
    const double waitedS =
        std::chrono::duration<double>(RemoteRecorderSteadyTime::now() - starting->sinceMono)
            .count();
    // Read in this order, so that the state on disk stays correct if the recording ends in between.
    const bool recording = session.recording();
    const auto detection =
        startResult(session.recorderStatus(), recording, waitedS, options.limits);
    if (!detection) return;
    const Done done = std::exchange(starting, std::nullopt)->done;
    try {
      if (detection->ok())
        become(State::kRecording);
      else
        finish();
    } catch (...) {
      return sayFailed(done);
    }
    done(*detection);
  }

  struct Starting {
    Done done;
    RemoteRecorderSteadyTime::time_point sinceMono;
  };

  CaptureSession& session;
  const RemoteRecorderOptions options;
  std::optional<Starting> starting;              // used by the own thread only, as the next member
  std::optional<RecordingReport> endedByItself;  // not yet reported by a stop
  mutable std::mutex mutex;                      // protects the following members
  std::condition_variable_any wake;
  std::deque<Job> jobs;
  State state = State::kIdle;
  std::string nameTemplate;
  RecordingMeta meta;
  std::jthread thread;
};

RemoteRecorder::RemoteRecorder(CaptureSession& session, RemoteRecorderOptions options)
    : impl_(std::make_unique<Impl>(session, std::move(options))) {
  impl_->thread =
      std::jthread([impl = impl_.get()](const std::stop_token& stop) { impl->run(stop); });
}

RemoteRecorder::~RemoteRecorder() = default;

void RemoteRecorder::carryOut(const RemoteRequest& request, Done done) {
  switch (request.verb) {
    case RemoteRecorderVerb::kStart:
    case RemoteRecorderVerb::kStop:
      return impl_->enqueue(request, std::move(done));
    case RemoteRecorderVerb::kLabel:
      return done(impl_->note(request.text));
    case RemoteRecorderVerb::kMark:
      return done(impl_->note({}));
    case RemoteRecorderVerb::kFile:
      return done(impl_->name(request.text));
    case RemoteRecorderVerb::kSet:
      return done(impl_->set(request.text));
    case RemoteRecorderVerb::kStatus:
    case RemoteRecorderVerb::kHelp:  // answered by the server itself
      return done(impl_->status());
  }
}

}  // namespace palpate
