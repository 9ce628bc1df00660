#include "gui/link/remote_controller.h"

#include <stdexcept>
#include <utility>

#include <palpate/core/error.h>
#include <palpate/core/time.h>
#include <palpate/interop/remote_file.h>

#include "gui/source/abandonable.h"

namespace palpate::gui {
namespace fs = std::filesystem;
namespace {
using Verb = RemoteRequest::Verb;

constexpr int kRemoteDeskLookMs = 10;

// Reads folders: must not run in the window's thread.
void addNames(RemoteAnswer& answer, const RecordingSettings& settings) {
  const NextRecording next = previewNextPath(settings, systemClock().wallUs());
  answer.fields.set("folder", folderFromText(settings.folder).toStdString());
  answer.fields.set("next_file",
                    next.problem.isEmpty() ? Json(next.path.filename().string()) : Json());
  const auto freeBytes = freeBytesOf(next.folderWillBeMade ? next.path.parent_path().parent_path()
                                                           : next.path.parent_path());
  answer.fields.set("free_bytes", freeBytes ? Json(static_cast<std::int64_t>(*freeBytes)) : Json());
}

// The path of a recording that another program starts. Throws when that is not possible; `code` is
// then the error code.
fs::path pathFor(const RecordingSettings& settings, const std::string& name, std::string& code) {
  const std::int64_t nowUs = systemClock().wallUs();
  // Also creates the folder.
  const fs::path next = nextPath(settings, nowUs);
  if (const auto refusal = noSpace(freeBytesOf(next.parent_path()))) {
    code = refusal->error;
    throw Error(refusal->message);
  }
  if (name.empty()) return next;
  fs::path path;
  try {
    path = remoteRecordingPath(
        next.parent_path(),
        name,
        {nowUs, settings.operatorName.toStdString(), settings.object.toStdString()});
  } catch (const std::invalid_argument& problem) {
    code = "file_name";
    throw Error(problem.what());
  }
  std::error_code ignored;
  if (fs::exists(fs::symlink_status(path, ignored))) {
    code = "file_exists";
    throw FileError(path, "exists already; a recording is never replaced");
  }
  return path;
}

}  // namespace

RemoteController::RemoteController(LiveController& live,
                                   std::function<RecordingSettings()> settings,
                                   QObject* parent)
    : QObject(parent), live_(live), settings_(std::move(settings)) {
  timer_.setInterval(kRemoteDeskLookMs);
  connect(&timer_, &QTimer::timeout, this, &RemoteController::look);
  connect(&live_, &LiveController::recordingStarted, this, [this] {
    if (starting_) starting_->begun = std::chrono::steady_clock::now();
  });
  connect(&live_, &LiveController::recordingFailed, this, [this](const QString& message) {
    if (starting_) failStart(starting_->problem->code, message.toStdString());
  });
  connect(&live_, &LiveController::recordingEnded, this, [this](const RecordingReport& report) {
    if (starting_) failStart("stopped", "it was stopped before a frame was on disk");
    for (const Done& done : std::exchange(stopping_, {})) done(stopAnswer(report));
  });
  connect(&live_, &LiveController::leaving, this, [this] {
    if (starting_) failStart("no_hand", "the hand was disconnected");
  });
}

void RemoteController::carryOut(const RemoteRequest& request, Done done) {
  QMetaObject::invokeMethod(
      this,
      [this, request, done = std::move(done)] { handle(request, done); },
      Qt::QueuedConnection);
}

void RemoteController::handle(const RemoteRequest& request, const Done& done) {
  switch (request.verb) {
    case Verb::kStart:
      return start(request.text, done);
    case Verb::kStop:
      return stop(done);
    case Verb::kLabel:
      return note(request.text, done);
    case Verb::kMark:
      return note({}, done);
    case Verb::kFile: {
      if (!request.text.empty()) {
        if (const std::string problem = problemOfRemoteName(request.text); !problem.empty())
          return done(RemoteAnswer::refused("file_name", problem));
        nameTemplate_ = QString::fromStdString(request.text);
      }
      RemoteAnswer answer;
      answer.fields.set("template", settingsNow().nameTemplate.toStdString());
      return answerWithNames(std::move(answer), done);
    }
    case Verb::kSet: {
      const auto setting = settingFrom(request.text);
      if (!setting) return done(RemoteAnswer::refused("malformed", "set operator, object, .."));
      if (setting->value.empty())
        meta_.erase(setting->key);
      else
        meta_[setting->key] = setting->value;
      RemoteAnswer answer;
      answer.fields.set(setting->key, setting->value);
      return done(std::move(answer));
    }
    case Verb::kStatus:
    case Verb::kHelp:
      return answerWithNames(status(), done);
  }
}

RecordingSettings RemoteController::settingsNow() const {
  RecordingSettings settings = settings_();
  const auto take = [this](const char* key, QString& value) {
    const auto found = meta_.find(key);
    if (found != meta_.end()) value = QString::fromStdString(found->second);
  };
  take("operator", settings.operatorName);
  take("object", settings.object);
  take("notes", settings.notes);
  // When a recording ends is decided by who started it.
  settings.limits.stopAfterS.reset();
  settings.startOnContact = false;
  settings.stopWithoutContactS.reset();
  if (!nameTemplate_.isEmpty()) settings.nameTemplate = nameTemplate_;
  return settings;
}

void RemoteController::answerWithNames(RemoteAnswer answer, const Done& done) const {
  if (!Abandonable::run([answer = std::move(answer), settings = settingsNow(), done]() mutable {
        addNames(answer, settings);
        done(std::move(answer));
      }))
    done(RemoteAnswer::refused("busy", "the folder of the recordings doesn't answer"));
}

RemoteAnswer RemoteController::status() const {
  RemoteAnswer answer;
  const bool connected = live_.state() == LiveController::State::kConnected;
  const LinkHealth health = connected ? live_.health() : LinkHealth{};
  answer.fields.set("state",
                    !live_.recording()   ? "idle"
                    : !stopping_.empty() ? "stopping"
                    : starting_          ? "starting"
                                         : "recording");
  answer.fields.set("source",
                    connected ? Json(describe(live_.connection()).toStdString()) : Json());
  const LiveSource* source = live_.source();
  std::optional<ExplainedCondition> condition;
  if (source && source->control && source->session->device().status().motion)
    condition = source->control->condition();
  answer.fields.set("hand", condition ? Json(nameOf(condition->condition)) : Json())
      .set("hand_text", condition ? Json(condition->sentence) : Json());
  if (live_.recording()) setRecorderFields(answer.fields, health.recorder);
  setLinkFields(answer.fields, health);
  return answer;
}

void RemoteController::start(const std::string& name, const Done& done) {
  if (starting_ || !stopping_.empty())
    return done(RemoteAnswer::refused("busy", "a recording is being started or finished"));
  LiveSource* source = live_.source();
  if (!source) return done(RemoteAnswer::refused("no_hand", "no hand is connected in the window"));
  if (live_.recording()) {
    RemoteAnswer answer =
        RemoteAnswer::refused("already_recording", "a recording runs: stop it first");
    answer.fields.set("file", source->session->recorderStatus().path.string());
    return done(std::move(answer));
  }
  if (const auto refusal = noHand(source->session->health(), limits_)) return done(*refusal);
  if (!name.empty())
    if (const std::string problem = problemOfRemoteName(name); !problem.empty())
      return done(RemoteAnswer::refused("file_name", problem));
  starting_ = Starting{done, std::make_shared<Problem>(), {}};
  timer_.start();
  const auto run = meta_.find("run");
  live_.startRecording([name,
                        settings = settingsNow(),
                        run = run == meta_.end() ? std::string() : run->second,
                        problem = starting_->problem] {
    RecordingOptions options = recordingOptions(settings, pathFor(settings, name, problem->code));
    if (!run.empty()) options.meta["run"] = run;
    return options;
  });
}

// Runs until the first commit is on disk; the controller's own updates are too infrequent for that.
void RemoteController::look() {
  LiveSource* source = live_.source();
  if (!starting_ || !source) return timer_.stop();
  if (!starting_->begun) return;
  const double waitedS =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - *starting_->begun).count();
  const bool recording = source->session->recording();
  const auto result = startResult(source->session->recorderStatus(), recording, waitedS, limits_);
  if (!result) return;
  if (!result->ok()) {
    failStart(result->error, result->message);
    return live_.stopRecording();
  }
  timer_.stop();
  std::exchange(starting_, std::nullopt)->done(*result);
}

void RemoteController::failStart(const std::string& code, const std::string& message) {
  timer_.stop();
  std::exchange(starting_, std::nullopt)->done(RemoteAnswer::refused(code, message));
}

void RemoteController::stop(const Done& done) {
  if (!live_.recording())
    return done(RemoteAnswer::refused("not_recording", "nothing is being recorded"));
  stopping_.push_back(done);
  live_.stopRecording();
}

void RemoteController::note(const std::string& text, const Done& done) {
  LiveSource* source = live_.source();
  if (!source || starting_ || !source->session->recording())
    return done(RemoteAnswer::refused("not_recording", "nothing is being recorded: start first"));
  Event event;
  event.tUs = event.t1Us = source->session->nowUs();
  event.kind = text.empty() ? "mark" : "label";
  event.text = text;
  source->session->note(event);
  RemoteAnswer answer;
  answer.fields.set("time_ms", event.tUs / kUsPerMs);
  done(std::move(answer));
}

}  // namespace palpate::gui
