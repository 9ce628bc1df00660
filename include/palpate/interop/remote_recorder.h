// Carries out remote control on a capture session without a window: recordings begin and end as
// others ask. It waits idle until then, and answers when what was asked has happened: a start when
// frames are on disk, a stop when the file is closed.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include <palpate/capture/capture_session.h>
#include <palpate/interop/remote_fields.h>
#include <palpate/interop/remote_protocol.h>

namespace palpate {

struct RemoteRecorderOptions {
  std::filesystem::path folder;                      // where recordings go, and nowhere else
  std::string nameTemplate = "{date}_{time}_{run}";  // of a start without a name
  // What every recording begins with: `path` is not used; of `meta`, operator, object, run and
  // notes can be set.
  RecordingOptions recording;
  StartLimits limits;
  // Told of every recording that ended; on the recorder's own thread. May be empty.
  std::function<void(const RecordingReport&)> onFinished;
};

class RemoteRecorder final : public RemoteTarget {
 public:
  // While it lives nobody else starts or stops recordings of the session, which must outlive it.
  // Throws std::invalid_argument (a template that can't be one), FileError (no such folder).
  RemoteRecorder(CaptureSession& session, RemoteRecorderOptions options);
  // A recording that runs is finished.
  ~RemoteRecorder() override;
  RemoteRecorder(const RemoteRecorder&) = delete;
  RemoteRecorder& operator=(const RemoteRecorder&) = delete;

  void carryOut(const RemoteRequest& request, Done done) override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate
