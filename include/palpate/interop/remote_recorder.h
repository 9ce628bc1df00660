// Executes remote-control requests on a capture session without a window, which records only on
// request. It answers when the request is completed: a start when frames are on disk, a stop when
// the file is closed.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include <palpate/capture/capture_session.h>
#include <palpate/interop/remote_fields.h>
#include <palpate/interop/remote_protocol.h>

namespace palpate {

struct RemoteRecorderOptions {
  std::filesystem::path folder;                      // folder of all recordings
  std::string nameTemplate = "{date}_{time}_{run}";  // used by a start without a name
  // Options of every recording: `path` is not used; requests can set operator, object, run and
  // notes in `meta`.
  RecordingOptions recording;
  StartLimits limits;
  // Called with the report of every recording that ended, on a thread of this object. May be empty.
  std::function<void(const RecordingReport&)> onFinished;
};

class RemoteRecorder final : public RemoteTarget {
 public:
  // While this object exists, it alone may start and stop recordings of the session, which must
  // outlive it. Throws std::invalid_argument (invalid template), FileError (no such folder).
  RemoteRecorder(CaptureSession& session, RemoteRecorderOptions options);
  // Finishes a running recording.
  ~RemoteRecorder() override;
  RemoteRecorder(const RemoteRecorder&) = delete;
  RemoteRecorder& operator=(const RemoteRecorder&) = delete;

  void carryOut(const RemoteRequest& request, Done done) override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate
