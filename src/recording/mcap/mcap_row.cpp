// The row of .mcap in the table of formats.
#include <string>

#include "palpate/recording/mcap_recording.h"
#include "palpate/recording/recording_format.h"

#include "recording/format_reader.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

// What a file lacks, or what of it could not be used; empty when nothing.
std::string mcapDamageText(const Damage& damage) {
  if (damage.text.empty()) return damage.unused;
  return "the file " + damage.text + (damage.unused.empty() ? "" : "; " + damage.unused);
}

Recording openMcapRecording(const fs::path& path,
                            const ReadOptions& options,
                            const Progress& progress) {
  return readMcap(path, progress, options.threads, options.topics);
}

Recording openReadableMcap(const fs::path& path,
                           const ReadOptions& options,
                           const Progress& progress) {
  Recording recording = recoverMcap(path, progress, options.threads, options.topics);
  std::string& damage = recording.damage.text = mcapDamageText(recording.damage);
  if (!damage.empty()) damage += "; readable: " + countsText(recording.profile);
  return recording;
}

VerifyReport verifyMcap(const fs::path& path, std::size_t threads, const Progress& progress) {
  const Recording recording = openReadableMcap(path, {.threads = threads}, progress);
  const Damage& damage = recording.damage;
  VerifyReport report{VerifyReport::State::kSound, countsText(recording.profile)};
  if (!damage.text.empty()) report = {VerifyReport::State::kDamaged, damage.text};
  if (damage.events > 0) report.message += "; " + mcapEventsLeftOutText(damage.events);
  return report;
}

Salvage salvageMcap(const fs::path& path, const ReadOptions& options, const Progress& progress) {
  Recording recording = recoverMcap(path, progress, 0, options.topics);
  const Profile& profile = recording.profile;
  const Damage& damage = recording.damage;
  std::size_t samples = profile.numFrames();
  for (std::size_t s = 0; s < profile.series().size(); ++s) samples += profile.numSamples(s);
  if (samples == 0 && !damage.text.empty()) return {.message = damage.text};
  Salvage salvage;
  std::string& missing = salvage.missing = mcapDamageText(damage);
  if (damage.events > 0)
    missing += (missing.empty() ? "" : "; ") + mcapEventsLeftOutText(damage.events);
  salvage.isWhole = missing.empty();
  salvage.message = (salvage.isWhole ? "nothing was damaged; saved " : "saved ") +
                    countsText(profile) + (salvage.isWhole ? "" : "; " + missing);
  salvage.recording = std::move(recording);
  return salvage;
}

SaveReport saveMcap(const SaveJob& job) {
  writeMcap(job.content, job.path, job.overwrite, job.progress, job.extras.mcap);
  return {};
}

constexpr const char* kMcapEndings[] = {".mcap"};
constexpr FormatReader kMcapReader{
    .recognises = [](std::string_view begin,
                     const std::string&) { return begin.starts_with("\x89MCAP0\r\n"); },
    .open = &openMcapRecording,
    .openReadable = &openReadableMcap,
    .verify = &verifyMcap,
    .salvage = &salvageMcap,
    .events = &readMcapEvents,
    .meta = &readMcapMeta,
    .kind = "an MCAP file",
    .hasTopics = true};

}  // namespace

constinit const RecordingFormat kMcapFormat{.name = "mcap",
                                            .purpose = "MCAP, for ROS 2 and Foxglove",
                                            .endings = kMcapEndings,
                                            .isExport = true,
                                            .takesSeries = true,
                                            .holdsFurther = true,
                                            .takesMcap = true,
                                            .reader = &kMcapReader,
                                            .save = &saveMcap};

}  // namespace palpate
