// The end of a .dsa recording: what was odd, and the profile.
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"

#include "recording/dsa_document.h"
#include "recording/message_text.h"

namespace palpate {

void DsaDocument::compareCount(const Series& series, std::size_t found) {
  if (!series.seen) {
    warnings_.push_back("no element " + std::string(series.element));
    return;
  }
  const std::string name = series.counter;
  if (!series.declared)
    warnings_.push_back("no " + name + "; found " + std::to_string(found));
  else if (parseInteger(*series.declared) != static_cast<std::int64_t>(found))
    warnings_.push_back(name + " says " + inQuotes(*series.declared) + ", found " +
                        std::to_string(found));
}

void DsaDocument::addCountedWarnings() {
  const auto warn = [&](std::uint64_t count, const std::string& text) {
    if (count > 0) warnings_.push_back(text);
  };
  for (const Series* series : {&frames_, &temperatures_, &angles_}) {
    const std::string name = inQuotes(series->sample);
    warn(series->movedStamps,
         counted(series->movedStamps, "time stamp") + " of " + name +
             " not later than the one before: moved 1 ms behind it");
    warn(
        series->badIndices,
        name + ": " + counted(series->badIndices, "index attribute") + " out of sequence, ignored");
  }
  warn(foreignValues_,
       counted(foreignValues_, "value") + " at places without a taxel (static_mask): taken as 0");
  warn(unknownElements_,
       counted(unknownElements_, "unknown element") + " skipped, the first " + firstUnknown_);
  warn(unknownAttributes_, counted(unknownAttributes_, "unknown attribute") + " skipped");
  warn(strayTexts_, counted(strayTexts_, "piece") + " of text between elements skipped");
}

Profile DsaDocument::handOver() {
  addCountedWarnings();
  ProfileInfo info;
  info.format = "dsa";
  info.serial = sensor_.serial();
  info.firmware = sensor_.firmware();
  info.sensorRevision = sensor_.firmware();
  info.warnings = sensor_.warnings();
  info.warnings.insert(info.warnings.end(), warnings_.begin(), warnings_.end());
  return builder_->finish(std::move(info));
}

Profile DsaDocument::finish() {
  if (!layout_) throw Error("no element sensor");
  if (!frames_.seen) throw Error("no element data");
  compareCount(frames_, numFrames());
  compareCount(temperatures_, numTemperatures());
  compareCount(angles_, numAngles());
  return handOver();
}

Profile DsaDocument::finishFragments() {
  // Which samples are missing is said elsewhere; indices and counts mean nothing here.
  for (Series* series : {&frames_, &temperatures_, &angles_}) series->badIndices = 0;
  return handOver();
}

}  // namespace palpate
