// Protocol of remote control: each request is a line of text, each answer a line of JSON. Contains
// no sockets.
//
//   request: start run 7.palpate
//   answer:  {"ok":true,"command":"start","file":"/home/ada/runs/run 7.palpate","frames_on_disk":2}
//   request: label contact
//   answer:  {"ok":false,"command":"label","error":"not_recording","message":"nothing is being .."}
//
// A request is a verb and, behind blanks, its text up to the end of the line (LF, CR LF too):
// UTF-8, at most kMaxRequestBytes. docs/notes/live_streams.md specifies it.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/core/json.h>

namespace palpate {

inline constexpr std::size_t kMaxRequestBytes = 4096;  // without the line end

struct RemoteRequest {
  enum class Verb {
    kStatus,  // state of hand and recording
    kStart,   // begin a recording; text: its file name, empty: the next name of the template
    kStop,    // stop and finish the recording
    kLabel,   // text: add an event "label" now
    kMark,    // add an event "mark" now
    kFile,    // text: set the template of later names; empty: only return it
    // Text: KEY VALUE for later recordings; KEY: operator, object, run, notes.
    kSet,
    kHelp,  // list the verbs
  };
  Verb verb = Verb::kStatus;
  std::string text;
};
std::string_view nameOf(RemoteRequest::Verb verb) noexcept;
const std::vector<RemoteRequest::Verb>& allRemoteVerbs();

// Result of a request. Error codes, for programs: "malformed", "unknown", "too_long", "busy"
// (another request must finish first), "no_hand", "no_frames", "no_space", "file_name",
// "file_exists", "folder", "disk", "already_recording", "not_recording", "stopped",
// "shutting_down", "failed".
struct RemoteAnswer {
  std::string error;    // error code; empty: success
  std::string message;  // one line for the user; may be empty
  Json fields = Json::object();

  bool ok() const noexcept { return error.empty(); }
  static RemoteAnswer refused(std::string code, std::string why);
};
// One line without its end: {"ok":..,"command":..,"error":..,"message":..,FIELDS}. `command` is
// empty if no verb could be read; the key is left out then.
std::string answerLine(const RemoteAnswer& answer, std::string_view command);

// Either a request, or the reason why the line is none. Never throws for invalid text.
struct ReadRequest {
  std::optional<RemoteRequest> request;
  RemoteAnswer refusal;  // set if there is no request
};
ReadRequest readRequest(std::string_view line);

// Splits the bytes of a client into lines. Stores at most kMaxRequestBytes: a longer line is
// dropped up to its end.
class RequestLines {
 public:
  struct Line {
    std::string text;      // without its end
    bool tooLong = false;  // its text was dropped
  };
  void push(std::string_view bytes) { pending_ += bytes; }
  // The next complete line; empty when more bytes are needed.
  std::optional<Line> next();
  std::size_t pendingBytes() const noexcept { return pending_.size(); }

 private:
  std::string pending_;
  bool skipping_ = false;  // inside a line that is too long
};

// KEY VALUE of `set`; empty when KEY is none of operator, object, run, notes. An empty value
// deletes the setting.
struct RemoteSetting {
  std::string key;
  std::string value;
};
std::optional<RemoteSetting> settingFrom(std::string_view text);

// Interface of what executes requests: a window, or a recording without a window.
class RemoteTarget {
 public:
  using Done = std::function<void(RemoteAnswer)>;
  virtual ~RemoteTarget() = default;
  // Called on the server's thread, one request at a time; returns at once. `done` must be called
  // exactly once, from any thread, now or later; it never waits, and has no effect once the server
  // has ended.
  virtual void carryOut(const RemoteRequest& request, Done done) = 0;
};

}  // namespace palpate
