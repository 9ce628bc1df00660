// The command `palpate remote` sends a request to a running palpate with remote control and prints
// the answer.
#include <chrono>
#include <cstdio>
#include <string>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/json.h"
#include "palpate/core/time.h"
#include "palpate/interop/remote_client.h"
#include "palpate/interop/remote_server.h"

#include "commands/command_line.h"
#include "commands/commands.h"

namespace palpate::commands {
namespace {

std::string remoteRequestOf(const CommandLine& given) {
  std::string request;
  for (const std::string& word : given.words()) request += (request.empty() ? "" : " ") + word;
  const ReadRequest read = readRequest(request);
  if (!read.request) throw UsageError(read.refusal.message);
  return request;
}

// Whether the answer reports an incomplete recording, although it was stopped as requested.
bool isPart(const Json& answer) {
  return answer.contains("complete") && !answer.at("complete").asBool();
}

}  // namespace

int remoteCommand(const Arguments& words) {
  double waitS = 60.0;  // a stop waits for the disk
  const CommandLine given(
      {.synopsis = "palpate remote [--socket PATH] REQUEST [TEXT]",
       .purpose =
           "Controls a palpate on this machine that was started with --remote, or in whose window "
           "Remote control is switched on. Waits until the request is done, and prints the answer "
           "as a line of JSON. REQUEST: status, start [NAME] (done when frames are on disk), stop "
           "(done when the file is closed), label TEXT, mark, file [TEMPLATE], set KEY [TEXT] "
           "(operator, object, run, notes), help. Exit code 1: the request was refused; 3: "
           "stopped, but something is missing in the recording.",
       .options = {{"socket",
                    "PATH",
                    "socket at which it listens; default $XDG_RUNTIME_DIR/palpate-remote"},
                   bound("wait", "S", "give up without an answer", waitS, {0.01, 1e5, "s"})},
       .example = "palpate remote start pen_{run}",
       .minArguments = 1},
      words);
  if (given.helpShown()) return kDone;
  const std::string request = remoteRequestOf(given);
  const auto socket = given.text("socket");
  RemoteClient client(socket ? std::filesystem::path(*socket) : usualRemoteSocket());
  const std::string line =
      client.ask(request, std::chrono::milliseconds(static_cast<std::int64_t>(waitS * kMsPerS)));
  const Json answer = Json::parse(line);
  std::printf("%s\n", escapedLine(line).c_str());
  const std::string message = answer.contains("message") ? answer.at("message").asString() : "";
  if (!answer.at("ok").asBool())
    throw Error("refused (" + answer.at("error").asString() + "): " + message);
  if (!isPart(answer)) return kDone;
  sayLine(message);
  return kPartlyDone;
}

}  // namespace palpate::commands
