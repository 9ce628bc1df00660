#include "palpate/recording/recording.h"

#include <array>
#include <string>
#include <string_view>

#include "palpate/core/error.h"
#include "palpate/recording/dsa_reader.h"

#include "recording/byte_source.h"
#include "recording/message_text.h"

namespace palpate {
namespace {

constexpr std::string_view kSqliteStart{"SQLite format 3\0", 16};
constexpr const char* kNativeMessage =
    "is a .palpate recording; this version of the program reads .dsa only";

// Throws FileError.
bool isNative(const std::filesystem::path& path) {
  FileSource source(path);
  std::array<char, kSqliteStart.size()> first{};
  return source.read(first) == first.size() &&
         std::string_view(first.data(), first.size()) == kSqliteStart;
}

}  // namespace

Profile openRecording(const std::filesystem::path& path, const Progress& progress) {
  if (isNative(path)) throw FormatError(path, kNativeMessage);
  return readDsa(path, progress);
}

VerifyReport verifyRecording(const std::filesystem::path& path, const Progress& progress) {
  VerifyReport report;
  try {
    if (isNative(path)) throw FormatError(path, kNativeMessage);
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {
    report.message = error.what();
    return report;
  }
  const DsaVerifyReport dsa = verifyDsa(path, progress);
  report.message = dsa.message;
  switch (dsa.state) {
    case DsaVerifyReport::State::kSound:
      report.state = VerifyReport::State::kSound;
      report.message = counted(dsa.frames, "frame") + ", " + counted(dsa.angles, "angle sample") +
                       ", " + counted(dsa.temperatures, "temperature sample");
      break;
    case DsaVerifyReport::State::kDamaged:
      report.state = VerifyReport::State::kDamaged;
      break;
    case DsaVerifyReport::State::kUnreadable:
      report.state = VerifyReport::State::kUnreadable;
      break;
  }
  return report;
}

}  // namespace palpate
