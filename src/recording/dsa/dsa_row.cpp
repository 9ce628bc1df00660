// The row of .dsa in the table of formats.
#include <algorithm>
#include <string>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/recording/dsa_reader.h"
#include "palpate/recording/dsa_recovery.h"
#include "palpate/recording/dsa_writer.h"
#include "palpate/recording/recording_format.h"

#include "recording/event_sidecar.h"
#include "recording/format_reader.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

DsaReadOptions dsaOptions(std::size_t threads) {
  DsaReadOptions options;
  options.threads = threads;
  return options;
}

// The notes beside a .dsa.
void addNotes(const fs::path& path, Recording& recording) {
  try {
    EventsReport report = readEventSidecar(path);
    recording.events = std::move(report.events);
    recording.damage.events = report.damaged;
  } catch (const Error&) {  // damaged, may not be read, or no file
    recording.damage.eventsError = std::current_exception();
  }
}

Recording openDsa(const fs::path& path, const ReadOptions& options, const Progress& progress) {
  Recording recording{.profile = readDsa(path, progress, dsaOptions(options.threads))};
  addNotes(path, recording);
  return recording;
}

// The samples that were saved, with the notes and the gaps that the losses leave.
Recording savedDsa(const fs::path& path, DsaRecovery& recovery) {
  Recording recording{.profile = std::move(*recovery.profile)};
  addNotes(path, recording);
  recording.events.insert(recording.events.end(), recovery.losses.begin(), recovery.losses.end());
  std::stable_sort(recording.events.begin(),
                   recording.events.end(),
                   [](const auto& a, const auto& b) { return a.tUs < b.tUs; });
  recording.damage.notInFile = std::move(recovery.losses);
  return recording;
}

std::string dsaCountsText(const DsaRecovery& recovery) {
  return countsText(recovery.frames, recovery.angles, recovery.temperatures);
}

Recording openReadableDsa(const fs::path& path,
                          const ReadOptions& options,
                          const Progress& progress) {
  try {
    return withEventDamage(openDsa(path, options, progress));
  } catch (const FormatError&) {
    DsaRecovery recovery = recoverDsaProfile(path, progress);
    if (!recovery.profile) throw;
    Recording recording = savedDsa(path, recovery);
    recording.damage.text = "damaged; readable: " + dsaCountsText(recovery);
    if (!recovery.lossText.empty()) recording.damage.text += "; " + recovery.lossText;
    return recording;
  }
}

VerifyReport verifyDsaRecording(const fs::path& path,
                                std::size_t threads,
                                const Progress& progress) {
  const DsaVerifyReport dsa = verifyDsa(path, progress, dsaOptions(threads));
  if (dsa.state == DsaVerifyReport::State::kSound)
    return {VerifyReport::State::kSound, countsText(dsa.frames, dsa.angles, dsa.temperatures)};
  return {dsa.state == DsaVerifyReport::State::kDamaged ? VerifyReport::State::kDamaged
                                                        : VerifyReport::State::kUnreadable,
          dsa.message};
}

Salvage salvageDsa(const fs::path& path, const ReadOptions& options, const Progress& progress) {
  const DsaVerifyReport checked = verifyDsa(path, progress);
  Salvage salvage;
  if (checked.state == DsaVerifyReport::State::kSound) {
    salvage.recording = openDsa(path, options, progress);
    salvage.isWhole = true;
    salvage.message = "nothing was damaged; saved " +
                      countsText(checked.frames, checked.angles, checked.temperatures);
  } else {
    DsaRecovery recovery = recoverDsaProfile(path, progress);
    if (!recovery.profile) {
      salvage.message = withoutName(path, checked.message);
      return salvage;
    }
    std::string& lost = salvage.missing = "the rest is lost";
    if (recovery.blocks > 0)
      lost += ": " + std::to_string(recovery.intactBlocks) + " of " +
              counted(recovery.blocks, "bzip2 block") + " could be read, " +
              counted(recovery.cutSamples, "sample") + " at the edge of a lost block not";
    if (!recovery.lossText.empty()) lost += "; " + recovery.lossText;
    salvage.message = "saved " + dsaCountsText(recovery) + "; " + lost;
    salvage.recording = savedDsa(path, recovery);
  }
  // Damaged notes are no reason to save nothing.
  if (const std::string why = salvage.recording->damage.eventsFault(); !why.empty()) {
    salvage.isWhole = false;
    salvage.message += "; its notes are lost (" + why + ")";
  }
  return salvage;
}

SaveReport saveDsa(const SaveJob& job) {
  // Checked first: a .dsa must not be paired with the notes of another recording.
  const EventSidecar notes(job.path, job.content.events, job.overwrite);
  const SaveReport report{
      writeDsa(job.content.profile, job.path, job.overwrite, job.progress).movedStamps};
  notes.commit();
  return report;
}

constexpr const char* kDsaEndings[] = {".dsa"};
constexpr FormatReader kDsaReader{.recognises =
                                      [](std::string_view begin, const std::string&) {
                                        return begin.starts_with("BZh") || begin.starts_with('<');
                                      },
                                  .open = &openDsa,
                                  .openReadable = &openReadableDsa,
                                  .verify = &verifyDsaRecording,
                                  .salvage = &salvageDsa,
                                  .events = &readEventSidecar,
                                  .meta = [](const fs::path&) { return RecordingMeta(); },
                                  .saveEvents = &saveEventSidecar,
                                  .eventsBeside = true};

}  // namespace

constinit const RecordingFormat kDsaFormat{.name = "dsa",
                                           .purpose = "DSA recording",
                                           .endings = kDsaEndings,
                                           .reader = &kDsaReader,
                                           .save = &saveDsa};

}  // namespace palpate
