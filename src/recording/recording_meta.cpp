#include "palpate/recording/recording_meta.h"

#include "recording/native/palpate_connection.h"
#include "recording/recording_format.h"

namespace palpate {

std::map<std::string, std::string> readRecordingMeta(const std::filesystem::path& path) {
  if (!isNativeRecording(path)) return {};
  const PalpateConnection access(path);
  return access.meta().values;
}

}  // namespace palpate
