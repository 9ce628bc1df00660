// Opens and checks a recording of any form: the one door for commands and windows.
#pragma once

#include <filesystem>
#include <string>

#include <palpate/core/progress.h>
#include <palpate/model/profile.h>

namespace palpate {

// Reads a recording; its form is told by its first bytes, never by its name (a .dsa is bzip2 or
// XML). Throws FileError, FormatError, Cancelled; what() is one line that says what to do.
Profile openRecording(const std::filesystem::path& path, const Progress& progress = {});

struct VerifyReport {
  enum class State { kSound, kDamaged, kUnreadable };
  State state = State::kUnreadable;
  std::string message;  // one line: counts when sound, else what is wrong and how much can be read
};
// Every byte checked. Never throws for a bad file; throws Cancelled.
VerifyReport verifyRecording(const std::filesystem::path& path, const Progress& progress = {});

}  // namespace palpate
