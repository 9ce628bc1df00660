// `palpate record --remote`: runs a hand without a window; other programs start and stop the
// recordings.
#pragma once

#include "palpate/core/interruption.h"
#include <palpate/capture/capture_session.h>
#include <palpate/capture/recorder.h>

#include "commands/command_line.h"

namespace palpate::commands {

// The options --remote and --socket PATH.
OptionSpec remoteOption();
OptionSpec socketOption();
// The named socket, or the default one. Throws Error when there is no default.
std::filesystem::path remoteSocketOf(const CommandLine& given);

// Runs the session until it is interrupted; -o is a folder, or a folder with a template for names.
// Prints "remote=SOCKET" when it is ready, then one line for each recording (with --json the same
// object as the answer to stop). Returns the exit code.
int recordRemotely(const CommandLine& given,
                   CaptureSession& session,
                   Interruption& interruption,
                   RecordingOptions each);

}  // namespace palpate::commands
