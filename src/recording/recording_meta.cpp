#include "palpate/recording/recording_meta.h"

#include "recording/native/palpate_access.h"
#include "recording/recording_form.h"

namespace palpate {

std::map<std::string, std::string> readRecordingMeta(const std::filesystem::path& path) {
  if (!isNativeRecording(path)) return {};
  const PalpateAccess access(path);
  return access.meta().values;
}

}  // namespace palpate
