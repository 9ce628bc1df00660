#include "palpate/recording/recording.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/file_name.h"
#include "palpate/core/number_text.h"
#include "palpate/recording/dsa_reader.h"
#include "palpate/recording/dsa_recovery.h"
#include "palpate/recording/dsa_writer.h"
#include "palpate/recording/hdf5_recording.h"
#include "palpate/recording/mat_export.h"
#include "palpate/recording/mcap_recording.h"
#include "palpate/recording/palpate_reader.h"
#include "palpate/recording/palpate_recovery.h"
#include "palpate/recording/palpate_writer.h"
#include "palpate/recording/table_export.h"
#include "palpate/recording/tactile_sensor_json.h"

#include "recording/dsa/dsa_xml_stream.h"
#include "recording/event_sidecar.h"
#include "recording/foreign_file.h"
#include "recording/native/palpate_connection.h"
#include "recording/native/palpate_rows.h"

namespace palpate {
namespace {

constexpr std::string_view kSqliteStart{"SQLite format 3\0", 16};
constexpr std::string_view kMcapStart{"\x89MCAP0\r\n", 8};
constexpr std::string_view kMatStart = "MATLAB 5.0 MAT-file";

// What a file holds, as its first bytes tell, and where they are those of no recording (damaged)
// the ending of its name.
enum class Container { kDsa, kNative, kHdf5, kMcap, kOther };
Container containerOf(const std::filesystem::path& path) {
  // Closing a file that this very process writes would drop SQLite's locks on it.
  if (RecordingLock::isHeld(path)) return Container::kNative;
  FileSource source(path);
  std::array<char, 32> first{};
  const std::string_view start(first.data(), source.read(first));
  const std::string ending = lowerEndingOf(path);
  if (start.starts_with(kSqliteStart) && ending != ".db3") return Container::kNative;
  if (startsLikeHdf5(start)) return Container::kHdf5;
  if (start.starts_with(kMatStart)) return Container::kOther;
  if (start.starts_with(kMcapStart)) return Container::kMcap;
  if (start.starts_with("BZh") || start.starts_with('<')) return Container::kDsa;
  if (ending == ".palpate") return Container::kNative;
  if (ending == ".h5" || ending == ".hdf5") return Container::kHdf5;
  if (ending == ".mcap") return Container::kMcap;
  if (ending == ".dsa") return Container::kDsa;
  if (ending == ".mat" || !foreignFormatText(path).empty()) return Container::kOther;
  return start.starts_with(kSqliteStart) ? Container::kNative : Container::kDsa;
}

[[noreturn]] void throwNoRecording(const std::filesystem::path& path) {
  const std::string foreign = foreignFormatText(path);
  throw FormatError(path,
                    !foreign.empty() ? foreign
                                     : "MAT files are written, not read: open the recording that "
                                       "it was exported from, or import its arrays ('palpate "
                                       "import')");
}

std::string countsText(std::size_t frames, std::size_t angles, std::size_t temperatures) {
  return counted(frames, "frame") + ", " + counted(angles, "angle sample") + ", " +
         counted(temperatures, "temperature sample");
}

// A message without the name of its file, which the caller prints in front of it.
std::string withoutName(const std::filesystem::path& path, const std::string& message) {
  const std::string name = path.string() + ": ";
  return message.starts_with(name) ? message.substr(name.size()) : message;
}

// What is wrong with a native recording; empty when nothing is.
std::string damageText(const PalpateRecovery& recovery) {
  std::string text;
  const auto add = [&](std::size_t count, const char* what) {
    if (count > 0) text += (text.empty() ? "" : ", ") + counted(count, what);
  };
  add(recovery.lostFrames, "lost frame");
  add(recovery.lostAngles, "lost angle sample");
  add(recovery.lostTemperatures, "lost temperature sample");
  add(recovery.damagedBlocks, "damaged block");
  if (recovery.blocksFromPages > 0)
    text += (text.empty() ? "" : ", ") + counted(recovery.blocksFromPages, "block") +
            " found outside of the damaged tables";
  add(recovery.damagedRows, "damaged row");
  if (recovery.layoutLost)
    text += (text.empty() ? "" : ", ") + std::string("the sensor's layout is lost");
  if (recovery.layoutAssumed)
    text += (text.empty() ? "" : ", ") +
            std::string("the sensor's layout is lost: that of the SDH-2 is assumed");
  if (!recovery.sqliteError.empty())
    text += (text.empty() ? "" : ", ") + std::string("the tables of the file are damaged");
  return text;
}

// Adds a note at the first sample that says where the recording comes from, and what is missing.
std::vector<RecordingEvent> withOrigin(std::vector<RecordingEvent> events,
                                       const Profile& profile,
                                       const std::filesystem::path& in,
                                       const std::string& missing) {
  std::optional<std::int64_t> firstUs;
  const auto take = [&](std::int64_t us) { firstUs = std::min(us, firstUs.value_or(us)); };
  // At the first frame, where the timeline begins.
  if (profile.numFrames() > 0) {
    take(profile.frameTimeUs(0));
  } else {
    if (profile.numAngles() > 0) take(profile.angleTimeUs(0));
    if (profile.numTemperatures() > 0) take(profile.temperatureTimeUs(0));
  }
  if (!firstUs) return events;
  RecordingEvent note;
  note.tUs = note.t1Us = *firstUs;
  note.kind = "note";
  note.text = "Recovered from the damaged file " + in.filename().string() + ": " + missing;
  const auto at = std::lower_bound(
      events.begin(), events.end(), note.tUs, [](const RecordingEvent& event, std::int64_t us) {
        return event.tUs < us;
      });
  events.insert(at, std::move(note));
  return events;
}

// A recovery would take what lies beside a recording under the name of its journal for damage of
// the recording. Throws FileError.
void requireReadableJournal(const std::filesystem::path& path) {
  std::error_code failure;
  // The journal lies beside the file itself, not beside a link to it.
  const std::filesystem::path file =
      std::filesystem::is_symlink(path, failure) ? std::filesystem::canonical(path, failure) : path;
  if (!failure) (void)hasHotJournal(file);
}

VerifyReport verifyNative(const std::filesystem::path& path, const Progress& progress) {
  requireReadableJournal(path);
  const PalpateRecovery recovery = recoverPalpateProfile(path, progress);
  VerifyReport report;
  report.message = countsText(recovery.frames, recovery.angles, recovery.temperatures);
  if (recovery.unfinished) report.message += "; unfinished: its writer stopped before the end";
  if (recovery.beingWritten) report.message += "; still being written";
  if (recovery.whole()) {
    report.state = VerifyReport::State::kSound;
  } else {
    report.state =
        recovery.profile ? VerifyReport::State::kDamaged : VerifyReport::State::kUnreadable;
    report.message = recovery.profile ? damageText(recovery) + "; readable: " + report.message
                                      : "no intact block was found; nothing of it can be read";
  }
  return report;
}

RecoverReport recoverNative(const std::filesystem::path& in,
                            const std::filesystem::path& out,
                            Overwrite overwrite,
                            const Progress& progress) {
  requireReadableJournal(in);
  std::error_code failure;
  if (std::filesystem::file_size(in, failure) == 0 && !failure && !hasHotJournal(in))
    throw FormatError(in, "is empty");
  const PalpateRecovery recovery = recoverPalpateProfile(in, progress);
  RecoverReport report;
  if (!recovery.profile) {
    report.message = "nothing can be saved: no intact block was found";
    return report;
  }
  SaveExtras extras;
  extras.meta = recovery.meta;
  saveRecording(*recovery.profile,
                recovery.whole()
                    ? recovery.events
                    : withOrigin(recovery.events, *recovery.profile, in, damageText(recovery)),
                out,
                overwrite,
                progress,
                extras);
  report.state = recovery.whole() ? RecoverReport::State::kWhole : RecoverReport::State::kPart;
  report.message = "saved " + countsText(recovery.frames, recovery.angles, recovery.temperatures);
  if (!recovery.whole()) report.message += "; damage of the file: " + damageText(recovery);
  return report;
}

// What an MCAP file lacks, or what of it could not be used; empty when nothing.
std::string mcapDamageText(const McapRecording& recording) {
  if (recording.damage.empty()) return recording.lost;
  return "the file " + recording.damage + (recording.lost.empty() ? "" : "; " + recording.lost);
}

RecoverReport recoverMcapFile(const std::filesystem::path& in,
                              const std::filesystem::path& out,
                              Overwrite overwrite,
                              const Progress& progress,
                              const std::vector<std::string>& topics) {
  const McapRecording recording = recoverMcap(in, progress, 0, topics);
  const Profile& profile = recording.profile;
  RecoverReport report;
  if (profile.numFrames() + profile.numAngles() + profile.numTemperatures() == 0 &&
      !recording.damage.empty()) {
    report.message = "nothing can be saved: " + recording.damage;
    return report;
  }
  SaveExtras extras;
  extras.meta = recording.meta;
  std::string missing = mcapDamageText(recording);
  if (recording.eventsLeftOut > 0)
    missing += (missing.empty() ? "" : "; ") + mcapEventsLeftOutText(recording.eventsLeftOut);
  const bool whole = missing.empty();
  saveRecording(profile,
                whole ? recording.events : withOrigin(recording.events, profile, in, missing),
                out,
                overwrite,
                progress,
                extras);
  report.state = whole ? RecoverReport::State::kWhole : RecoverReport::State::kPart;
  report.message = (whole ? "nothing was damaged; saved " : "saved ") +
                   countsText(profile.numFrames(), profile.numAngles(), profile.numTemperatures()) +
                   (whole ? "" : "; " + missing);
  return report;
}

// Notes beside a damaged .dsa; that they are damaged, too, is no reason to save nothing.
std::vector<RecordingEvent> readEventsOf(const std::filesystem::path& path, std::string& lost) {
  try {
    return readEventSidecar(path).events;
  } catch (const Error& error) {
    lost = error.what();
    return {};
  }
}

RecoverReport recoverDsa(const std::filesystem::path& in,
                         const std::filesystem::path& out,
                         Overwrite overwrite,
                         const Progress& progress) {
  const DsaVerifyReport checked = verifyDsa(in, progress);
  RecoverReport report;
  std::string lostNotes;
  const std::vector<RecordingEvent> events = readEventsOf(in, lostNotes);
  if (checked.state == DsaVerifyReport::State::kSound) {
    saveRecording(readDsa(in, progress), events, out, overwrite, progress);
    report.state = RecoverReport::State::kWhole;
    report.message = "nothing was damaged; saved " +
                     countsText(checked.frames, checked.angles, checked.temperatures);
  } else {
    const DsaRecovery recovery = recoverDsaProfile(in, progress);
    if (!recovery.profile) {
      report.message = "nothing can be saved: " + withoutName(in, checked.message);
      return report;
    }
    std::string lost = "the rest is lost";
    if (recovery.blocks > 0)
      lost += ": " + std::to_string(recovery.intactBlocks) + " of " +
              counted(recovery.blocks, "bzip2 block") + " could be read, " +
              counted(recovery.cutSamples, "sample") + " at the edge of a lost block not";
    if (!recovery.lossText.empty()) lost += "; " + recovery.lossText;
    std::vector<RecordingEvent> all = events;
    all.insert(all.end(), recovery.losses.begin(), recovery.losses.end());
    std::stable_sort(
        all.begin(), all.end(), [](const auto& a, const auto& b) { return a.tUs < b.tUs; });
    saveRecording(*recovery.profile,
                  withOrigin(std::move(all), *recovery.profile, in, lost),
                  out,
                  overwrite,
                  progress);
    report.state = RecoverReport::State::kPart;
    report.message = "saved " +
                     countsText(recovery.frames, recovery.angles, recovery.temperatures) + "; " +
                     lost;
  }
  if (!lostNotes.empty()) {
    report.state = RecoverReport::State::kPart;
    report.message += "; its notes are lost (" + lostNotes + ")";
  }
  return report;
}

}  // namespace

namespace {

DsaReadOptions dsaOptions(std::size_t threads) {
  DsaReadOptions options;
  options.threads = threads;
  return options;
}

}  // namespace

bool isNativeRecording(const std::filesystem::path& path) {
  return containerOf(path) == Container::kNative;
}

bool isHdf5Recording(const std::filesystem::path& path) {
  return containerOf(path) == Container::kHdf5;
}

bool isMcapRecording(const std::filesystem::path& path) {
  return containerOf(path) == Container::kMcap;
}

Profile openRecording(const std::filesystem::path& path,
                      const Progress& progress,
                      std::size_t threads) {
  switch (containerOf(path)) {
    case Container::kNative:
      return readPalpate(path, progress);
    case Container::kHdf5:
      return readHdf5(path).profile;
    case Container::kMcap:
      return readMcap(path, progress, threads).profile;
    case Container::kOther:
      throwNoRecording(path);
    case Container::kDsa:
      break;
  }
  return readDsa(path, progress, dsaOptions(threads));
}

namespace {

void requireMcapForTopics(const std::filesystem::path& path,
                          const std::vector<std::string>& topics) {
  if (!topics.empty() && containerOf(path) != Container::kMcap)
    throw FileError(path, "has no topics: --topic is for MCAP files of other programs");
}

}  // namespace

std::string lostText(const Profile& profile) {
  for (const std::string& warning : profile.info().warnings)
    if (warning.starts_with(kLostWarning)) return warning.substr(kLostWarning.size());
  return "";
}

Profile openTopics(const std::filesystem::path& path,
                   const std::vector<std::string>& topics,
                   const Progress& progress,
                   std::size_t threads) {
  if (topics.empty()) return openRecording(path, progress, threads);
  requireMcapForTopics(path, topics);
  return readMcap(path, progress, threads, topics).profile;
}

namespace {

// Opens every block once: the samples of a native recording are read when they are asked for.
void readThrough(const Profile& profile, const Progress& progress) {
  constexpr std::size_t kSamplesPerReport = 4096;
  const std::size_t all = profile.numFrames() + profile.numAngles() + profile.numTemperatures();
  std::size_t read = 0;
  const auto report = [&] {
    if (read++ % kSamplesPerReport == 0 && progress &&
        !progress(static_cast<double>(read) / static_cast<double>(all + 1)))
      throw Cancelled();
  };
  TactileFrame frame;
  for (std::size_t i = 0; i < profile.numFrames(); ++i, report()) profile.readFrame(i, frame);
  for (std::size_t i = 0; i < profile.numAngles(); ++i, report()) profile.angles(i);
  for (std::size_t i = 0; i < profile.numTemperatures(); ++i, report()) profile.temperatures(i);
}

// Of a .dsa the notes beside it.
void addNotes(const std::filesystem::path& path, ReadableRecording& recording) {
  try {
    EventsReport report = readEventSidecar(path);
    if (report.damaged > 0) recording.damage = counted(report.damaged, "damaged row");
    recording.events = std::move(report.events);
    recording.damagedEvents = report.damaged;
  } catch (const FormatError& error) {
    recording.damage = error.what();
  } catch (const FileError& error) {  // notes that may not be read, or are no file
    recording.damage = error.what();
  }
}

ReadableRecording readableHdf5(const std::filesystem::path& path, const Progress& progress) {
  Hdf5Recording recording = readHdf5(path);
  readThrough(recording.profile, progress);
  return {.profile = std::move(recording.profile),
          .events = std::move(recording.events),
          .meta = std::move(recording.meta)};
}

ReadableRecording readableMcap(const std::filesystem::path& path,
                               const Progress& progress,
                               std::size_t threads,
                               const std::vector<std::string>& topics = {}) {
  McapRecording recording = recoverMcap(path, progress, threads, topics);
  const Profile& profile = recording.profile;
  std::string damage = mcapDamageText(recording);
  if (!damage.empty())
    damage += "; readable: " +
              countsText(profile.numFrames(), profile.numAngles(), profile.numTemperatures());
  return {.profile = std::move(recording.profile),
          .events = std::move(recording.events),
          .damage = std::move(damage),
          .damagedEvents = recording.eventsLeftOut,
          .meta = std::move(recording.meta)};
}

ReadableRecording openReadable(const std::filesystem::path& path,
                               const Progress& progress,
                               std::size_t threads) {
  if (!isNativeRecording(path)) {
    ReadableRecording recording{.profile = readDsa(path, progress, dsaOptions(threads))};
    addNotes(path, recording);
    return recording;
  }
  PalpateContent content = readPalpateContent(path, progress);
  std::string damage = std::move(content.eventsFault);
  if (content.events.damaged > 0) damage = counted(content.events.damaged, "damaged row");
  return {.profile = std::move(content.profile),
          .events = std::move(content.events.events),
          .damage = std::move(damage),
          .damagedEvents = content.events.damaged,
          .meta = std::move(content.meta)};
}

// Nothing where nothing can be read.
std::optional<ReadableRecording> recoveredDsa(const std::filesystem::path& path,
                                              const Progress& progress) {
  DsaRecovery recovery = recoverDsaProfile(path, progress);
  if (!recovery.profile) return std::nullopt;
  ReadableRecording recording{.profile = std::move(*recovery.profile)};
  addNotes(path, recording);
  recording.events.insert(recording.events.end(), recovery.losses.begin(), recovery.losses.end());
  std::stable_sort(recording.events.begin(),
                   recording.events.end(),
                   [](const auto& a, const auto& b) { return a.tUs < b.tUs; });
  recording.notInFile = std::move(recovery.losses);
  recording.damage =
      "damaged; readable: " + countsText(recovery.frames, recovery.angles, recovery.temperatures);
  if (!recovery.lossText.empty()) recording.damage += "; " + recovery.lossText;
  return recording;
}

std::optional<ReadableRecording> recoveredPalpate(const std::filesystem::path& path,
                                                  const Progress& progress) {
  PalpateRecovery recovery = recoverPalpateProfile(path, progress);
  if (!recovery.profile) return std::nullopt;
  ReadableRecording recording{
      .profile = std::move(*recovery.profile),
      .events = std::move(recovery.events),
      .damage = damageText(recovery) + "; readable: " +
                countsText(recovery.frames, recovery.angles, recovery.temperatures),
      .meta = recovery.meta};
  try {
    PalpateConnection access(path);
    const EventsReport inFile = readEventRows(access.database());
    recording.damagedEvents = inFile.damaged;
    recording.notInFile = withoutEvents(recording.events, inFile.events);
  } catch (const FormatError&) {
    // What can be had of them is there.
  }
  return recording;
}

}  // namespace

ReadableRecording readableRecording(const std::filesystem::path& path,
                                    const Progress& progress,
                                    std::size_t threads) {
  const Container container = containerOf(path);
  if (container == Container::kHdf5) return readableHdf5(path, progress);
  if (container == Container::kMcap) return readableMcap(path, progress, threads);
  if (container == Container::kOther) throwNoRecording(path);
  if (isNativeRecording(path)) requireReadableJournal(path);
  // From 0 to 1 once, also where a second way has to be taken.
  double reached = 0.0;
  const auto partOf = [&](double begin, double share) -> Progress {
    if (!progress) return {};
    return [&progress, &reached, begin, share](double fraction) {
      reached = std::max(reached, begin + share * fraction);
      return progress(reached);
    };
  };
  try {
    if (!isNativeRecording(path)) return openReadable(path, partOf(0.0, 1.0), threads);
    ReadableRecording recording = openReadable(path, partOf(0.0, 0.5), threads);
    readThrough(recording.profile, partOf(0.5, 0.5));
    return recording;
  } catch (const FormatError&) {
    auto recording =
        (isNativeRecording(path) ? recoveredPalpate : recoveredDsa)(path, partOf(0.0, 1.0));
    if (!recording) throw;
    return std::move(*recording);
  }
}

ReadableRecording readableTopics(const std::filesystem::path& path,
                                 const std::vector<std::string>& topics,
                                 const Progress& progress,
                                 std::size_t threads) {
  if (topics.empty()) return readableRecording(path, progress, threads);
  requireMcapForTopics(path, topics);
  return readableMcap(path, progress, threads, topics);
}

VerifyReport verifyRecording(const std::filesystem::path& path,
                             const Progress& progress,
                             std::size_t threads) {
  VerifyReport report;
  try {
    switch (containerOf(path)) {
      case Container::kNative:
        return verifyNative(path, progress);
      case Container::kHdf5: {
        const Profile profile = readHdf5(path).profile;
        readThrough(profile, progress);
        report.state = VerifyReport::State::kSound;
        report.message =
            countsText(profile.numFrames(), profile.numAngles(), profile.numTemperatures());
        return report;
      }
      case Container::kMcap: {
        const ReadableRecording mcap = readableMcap(path, progress, threads);
        report.state =
            mcap.damage.empty() ? VerifyReport::State::kSound : VerifyReport::State::kDamaged;
        report.message = mcap.damage.empty() ? countsText(mcap.profile.numFrames(),
                                                          mcap.profile.numAngles(),
                                                          mcap.profile.numTemperatures())
                                             : mcap.damage;
        if (mcap.damagedEvents > 0)
          report.message += "; " + mcapEventsLeftOutText(mcap.damagedEvents);
        return report;
      }
      case Container::kOther:
        throwNoRecording(path);
      case Container::kDsa:
        break;
    }
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {
    report.message = withoutName(path, error.what());
    return report;
  }
  const DsaVerifyReport dsa = verifyDsa(path, progress, dsaOptions(threads));
  report.message = dsa.message;
  switch (dsa.state) {
    case DsaVerifyReport::State::kSound:
      report.state = VerifyReport::State::kSound;
      report.message = countsText(dsa.frames, dsa.angles, dsa.temperatures);
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

std::span<const RecordingForm> recordingForms() noexcept {
  static constexpr RecordingForm kForms[] = {
      {RecordingFormat::kDsa, ".dsa", "DSA recording"},
      {RecordingFormat::kPalpate, ".palpate", "Palpate recording"},
      {RecordingFormat::kCsv, ".csv", "CSV, a row per active taxel"},
      {RecordingFormat::kNpz, ".npz", "NumPy"},
      {RecordingFormat::kJsonLines, ".jsonl", "JSON lines, schunk_sdh/TactileSensor"},
      {RecordingFormat::kHdf5, ".h5", "HDF5"},
      {RecordingFormat::kHdf5, ".hdf5", "HDF5"},
      {RecordingFormat::kMat, ".mat", "MATLAB, MAT 5"},
      {RecordingFormat::kMcap, ".mcap", "MCAP, for ROS 2 and Foxglove"}};
  return kForms;
}

RecordingFormat formatOf(const std::filesystem::path& path) {
  const std::string ending = lowerEndingOf(path);
  std::string list;
  for (const RecordingForm& form : recordingForms()) {
    if (ending == form.ending) return form.format;
    const bool last = &form == &recordingForms().back();
    list += (list.empty() ? "" : last ? " or " : ", ") + std::string(form.ending);
  }
  throw FileError(path, "its name must end in " + list);
}

EventsReport readEvents(const std::filesystem::path& path) {
  if (isHdf5Recording(path)) return {readHdf5(path).events, 0};
  if (isMcapRecording(path)) return readMcapEvents(path);
  return isNativeRecording(path) ? readPalpateEvents(path) : readEventSidecar(path);
}

std::map<std::string, std::string> readRecordingMeta(const std::filesystem::path& path) {
  if (isHdf5Recording(path)) return readHdf5(path).meta;
  if (isMcapRecording(path)) return readMcapMeta(path);
  if (!isNativeRecording(path)) return {};
  const PalpateConnection access(path);
  return access.meta().values;
}

void requireOther(const std::filesystem::path& in, const std::filesystem::path& out) {
  std::error_code ignored;
  if (std::filesystem::equivalent(in, out, ignored))
    throw FileError(out, "is the input itself; give another name");
}

SaveReport saveRecording(const Profile& profile,
                         std::span<const RecordingEvent> events,
                         const std::filesystem::path& path,
                         Overwrite overwrite,
                         const Progress& progress,
                         const SaveExtras& extras) {
  SaveReport report;
  switch (formatOf(path)) {
    case RecordingFormat::kDsa: {
      // Checked first: a .dsa must not come to notes that were made for another one.
      const EventSidecar notes(path, events, overwrite);
      report.movedStamps = writeDsa(profile, path, overwrite, progress).movedStamps;
      notes.commit();
      break;
    }
    case RecordingFormat::kPalpate:
      writePalpate(profile, events, path, overwrite, progress, extras.meta);
      break;
    case RecordingFormat::kCsv:
      writeCsv(profile, path, overwrite, progress, extras.unitsRow);
      break;
    case RecordingFormat::kNpz:
      writeNpz(profile, events, path, overwrite, progress);
      break;
    case RecordingFormat::kJsonLines:
      writeTactileSensorLines(profile, path, overwrite, progress);
      break;
    case RecordingFormat::kHdf5:
      writeHdf5({profile, events, extras.meta, extras.exported}, path, overwrite, progress);
      break;
    case RecordingFormat::kMat:
      writeMat(profile, events, extras.meta, extras.exported, path, overwrite, progress);
      break;
    case RecordingFormat::kMcap:
      writeMcap(
          {profile, events, extras.meta, extras.exported}, path, overwrite, progress, extras.mcap);
      break;
  }
  return report;
}

RecoverReport recoverRecording(const std::filesystem::path& in,
                               const std::filesystem::path& out,
                               Overwrite overwrite,
                               const Progress& progress,
                               const std::vector<std::string>& topics) {
  formatOf(out);  // before the work, not after it
  requireOther(in, out);
  requireWritable(out, overwrite);
  requireMcapForTopics(in, topics);
  if (isHdf5Recording(in))
    throw FileError(in,
                    "is an HDF5 file; if it is damaged, nothing of it can be recovered: use the "
                    "recording that it was exported from");
  if (isMcapRecording(in)) return recoverMcapFile(in, out, overwrite, progress, topics);
  return isNativeRecording(in) ? recoverNative(in, out, overwrite, progress)
                               : recoverDsa(in, out, overwrite, progress);
}

}  // namespace palpate
