// The language of remote control: a line of text asks, a line of JSON answers. No sockets here.
//
//   request: start run 7.palpate
//   answer:  {"ok":true,"command":"start","file":"/home/ada/runs/run 7.palpate","frames_on_disk":2}
//   request: label contact
//   answer:  {"ok":false,"command":"label","error":"not_recording","message":"nothing is being .."}
//
// A request is a verb and, behind blanks, its text up to the end of the line (LF, CR LF too):
// UTF-8, at most kMaxRequestBytes. docs/interop.md is the manual.
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
    kStatus,  // what goes on
    kStart,   // a recording; text: its file name, empty: the next of the template
    kStop,    // and finish it
    kLabel,   // text: an event "label" at this moment
    kMark,    // an event "mark"
    kFile,    // text: the template of coming names; empty: only asks
    kSet,     // text: KEY VALUE of coming recordings; KEY: operator, object, run, notes
    kHelp,    // the verbs
  };
  Verb verb = Verb::kStatus;
  std::string text;
};
std::string_view nameOf(RemoteRequest::Verb verb) noexcept;
const std::vector<RemoteRequest::Verb>& allRemoteVerbs();

// What a request came to. Error codes, for programs: "malformed", "unknown", "too_long", "busy"
// (for others to finish), "no_hand", "no_frames", "no_space", "file_name", "file_exists", "folder",
// "disk", "already_recording", "not_recording", "stopped", "shutting_down", "failed".
struct RemoteAnswer {
  std::string error;    // a code; empty: done
  std::string message;  // one line for a person, where there is something to say
  Json fields = Json::object();

  bool ok() const noexcept { return error.empty(); }
  static RemoteAnswer refused(std::string code, std::string why);
};
// One line without its end: {"ok":..,"command":..,"error":..,"message":..,FIELDS}. `command` is
// empty where no verb could be read: its key is left out then.
std::string answerLine(const RemoteAnswer& answer, std::string_view command);

// Either a request, or why it is none. Never throws for bad text.
struct ReadRequest {
  std::optional<RemoteRequest> request;
  RemoteAnswer refusal;  // where there is no request
};
ReadRequest readRequest(std::string_view line);

// Cuts what comes from a client into lines. Holds kMaxRequestBytes at most: of a longer line only
// its end is waited for.
class RequestLines {
 public:
  struct Line {
    std::string text;      // without its end
    bool tooLong = false;  // its text is gone
  };
  void push(std::string_view bytes) { pending_ += bytes; }
  // The next whole line; nothing: more must come first.
  std::optional<Line> next();
  std::size_t pendingBytes() const noexcept { return pending_.size(); }

 private:
  std::string pending_;
  bool skipping_ = false;  // within a line that is too long
};

// KEY VALUE of `set`; nothing when KEY is none of operator, object, run, notes. An empty value
// forgets it.
struct RemoteSetting {
  std::string key;
  std::string value;
};
std::optional<RemoteSetting> settingFrom(std::string_view text);

// Who carries requests out: a window, a headless recording.
class RemoteTarget {
 public:
  using Done = std::function<void(RemoteAnswer)>;
  virtual ~RemoteTarget() = default;
  // Called on the server's thread, one request at a time; returns at once. `done` must be called
  // exactly once, from any thread, now or later; it never waits, and does nothing once the server
  // is gone.
  virtual void carryOut(const RemoteRequest& request, Done done) = 0;
};

}  // namespace palpate
