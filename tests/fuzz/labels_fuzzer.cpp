// Fuzzes tables of labels: what is taken lies in the recording, keeps the limits and reads back as
// it was written.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "palpate/core/csv_rows.h"
#include "palpate/core/error.h"
#include "palpate/emulator/synthetic_profile.h"
#include "palpate/recording/label_table.h"

namespace {

using namespace palpate;

void require(bool condition) {
  if (!condition) std::abort();
}

const Profile& recording() {
  static const Profile profile = synthesize({.durationS = 2.0, .grasps = 1});
  return profile;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const Profile& profile = recording();
  try {
    const LabelTable table = readLabelTable({reinterpret_cast<const char*>(data), size}, profile);
    require(table.events.size() <= kMaximumLabels);
    require(table.problems.size() <= kMaximumTableProblems + 1);
    for (const Event& event : table.events) {
      require(event.tUs >= profile.frameTimeUs(0) - 1 && event.t1Us >= event.tUs);
      require(event.t1Us <= profile.frameTimeUs(profile.numFrames() - 1) + 1);
    }
    require(newLabels(table, table.events).empty());
    std::string csv;
    writeTableText(*labelRows(table.events, profile), {}, [&](const auto& text) { csv += text; });
    readLabelTable(csv, profile);
  } catch (const Error&) {
  }
  return 0;
}
