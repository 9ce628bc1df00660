// The row of .palpate in the table of formats.
#include <string>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/recording/palpate_reader.h"
#include "palpate/recording/palpate_recovery.h"
#include "palpate/recording/palpate_writer.h"
#include "palpate/recording/recording_format.h"
#include "palpate/recording/recording_losses.h"

#include "recording/format_reader.h"
#include "recording/native/palpate_connection.h"
#include "recording/native/palpate_rows.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

// What is wrong with a native recording; empty when nothing is.
std::string palpateDamageText(const PalpateRecovery& recovery) {
  std::string text;
  const auto add = [&](const std::string& what) { text += (text.empty() ? "" : ", ") + what; };
  const auto addCount = [&](std::size_t count, const char* what) {
    if (count > 0) add(counted(count, what));
  };
  addCount(recovery.lostFrames, "lost frame");
  addCount(recovery.lostAngles, "lost angle sample");
  addCount(recovery.lostTemperatures, "lost temperature sample");
  for (const RecoveredSeries& series : recovery.further)
    if (series.lost > 0) add("lost " + counted(series.lost, itemOf(series.name)));
  addCount(recovery.damagedBlocks, "damaged block");
  if (recovery.blocksFromPages > 0)
    add(counted(recovery.blocksFromPages, "block") + " found outside of the damaged tables");
  addCount(recovery.damagedRows, "damaged row");
  if (recovery.layoutLost) add("the sensor's layout is lost");
  if (recovery.layoutAssumed) add("the sensor's layout is lost: that of the SDH-2 is assumed");
  std::string renamed;
  for (const RecoveredSeries& series : recovery.further)
    if (series.renamed) renamed += (renamed.empty() ? "" : ", ") + series.name;
  if (!renamed.empty()) add("names and columns of series are lost: they are called " + renamed);
  if (!recovery.sqliteError.empty()) add("the tables of the file are damaged");
  return text;
}

std::string palpateCountsText(const PalpateRecovery& recovery) {
  std::string text = countsText(recovery.frames, recovery.angles, recovery.temperatures);
  for (const RecoveredSeries& series : recovery.further)
    text += ", " + counted(series.samples, itemOf(series.name));
  return text;
}

// A recovery would take what lies beside a recording under the name of its journal for damage of
// the recording. Throws FileError.
void requirePalpateJournal(const fs::path& path) {
  std::error_code failure;
  // The journal lies beside the file itself, not beside a link to it.
  const fs::path file = fs::is_symlink(path, failure) ? fs::canonical(path, failure) : path;
  if (!failure) (void)hasHotJournal(file);
}

VerifyReport verifyPalpate(const fs::path& path, std::size_t, const Progress& progress) {
  requirePalpateJournal(path);
  const PalpateRecovery recovery = recoverPalpateProfile(path, progress);
  std::string counts = palpateCountsText(recovery);
  if (recovery.unfinished) counts += "; unfinished: its writer stopped before the end";
  if (recovery.beingWritten) counts += "; still being written";
  if (recovery.whole()) return {VerifyReport::State::kSound, counts};
  if (recovery.profile)
    return {VerifyReport::State::kDamaged, palpateDamageText(recovery) + "; readable: " + counts};
  return {VerifyReport::State::kUnreadable, "no intact block was found; nothing of it can be read"};
}

Recording openPalpate(const fs::path& path, const ReadOptions&, const Progress& progress) {
  return readPalpate(path, progress);
}

Recording savedPalpate(PalpateRecovery& recovery) {
  Recording recording{.profile = std::move(*recovery.profile),
                      .events = std::move(recovery.events),
                      .meta = std::move(recovery.meta)};
  recording.damage.text = palpateDamageText(recovery);
  return recording;
}

Recording openReadablePalpate(const fs::path& path,
                              const ReadOptions& options,
                              const Progress& progress) {
  requirePalpateJournal(path);
  try {
    Recording recording = openPalpate(path, options, partOf(progress, 0.0, 0.5));
    readThrough(recording.profile, partOf(progress, 0.5, 1.0));
    return withEventDamage(std::move(recording));
  } catch (const FormatError&) {
    PalpateRecovery recovery = recoverPalpateProfile(path, progress);
    if (!recovery.profile) throw;
    Recording recording = savedPalpate(recovery);
    recording.damage.text += "; readable: " + palpateCountsText(recovery);
    try {
      const EventsReport inFile = readPalpateEvents(path);
      recording.damage.events = inFile.damaged;
      recording.damage.notInFile = withoutEvents(recording.events, inFile.events);
    } catch (const Error&) {
      // What can be had of them is there.
    }
    return recording;
  }
}

Salvage salvagePalpate(const fs::path& path, const ReadOptions&, const Progress& progress) {
  requirePalpateJournal(path);
  std::error_code failure;
  if (fs::file_size(path, failure) == 0 && !failure && !hasHotJournal(path))
    throw FormatError(path, "is empty");
  PalpateRecovery recovery = recoverPalpateProfile(path, progress);
  if (!recovery.profile) return {.message = "no intact block was found"};
  Salvage salvage{.recording = savedPalpate(recovery), .isWhole = recovery.whole()};
  salvage.message = "saved " + palpateCountsText(recovery);
  if (!salvage.isWhole) {
    salvage.missing = salvage.recording->damage.text;
    salvage.message += "; damage of the file: " + salvage.missing;
  }
  return salvage;
}

RecordingMeta readPalpateMeta(const fs::path& path) {
  return PalpateConnection(path).meta().values;
}

SaveReport savePalpate(const SaveJob& job) {
  const RecordingContent& content = job.content;
  writePalpate(
      content.profile, content.events, job.path, job.overwrite, job.progress, content.meta);
  return {};
}

constexpr const char* kPalpateEndings[] = {".palpate"};
constexpr FormatReader kPalpateReader{// A bag of ROS 2 is a database of SQLite, too.
                                      .recognises =
                                          [](std::string_view begin, const std::string& ending) {
                                            return begin.starts_with(kSqliteStart) &&
                                                   ending != ".db3";
                                          },
                                      .open = &openPalpate,
                                      .openReadable = &openReadablePalpate,
                                      .verify = &verifyPalpate,
                                      .salvage = &salvagePalpate,
                                      .events = &readPalpateEvents,
                                      .meta = &readPalpateMeta,
                                      .saveEvents = &saveEventRows,
                                      .addDetails = &addPalpateDetails,
                                      .seconds = &readPalpateSeconds};

}  // namespace

constinit const RecordingFormat kPalpateFormat{.name = "palpate",
                                               .purpose = "Palpate recording",
                                               .endings = kPalpateEndings,
                                               .holdsFurther = true,
                                               .holdsReadings = true,
                                               .reader = &kPalpateReader,
                                               .save = &savePalpate};

}  // namespace palpate
