#include "palpate/recording/recording.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/file_name.h"
#include "palpate/core/number_text.h"
#include "palpate/recording/foreign_file.h"
#include "palpate/recording/recording_lock.h"
#include "palpate/recording/recording_losses.h"

#include "recording/dsa/dsa_xml_stream.h"
#include "recording/format_reader.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void throwNoRecording(const fs::path& path) {
  const std::string foreign = foreignFormatText(path);
  throw FormatError(path,
                    !foreign.empty() ? foreign
                                     : "MAT files are written, not read: open the recording that "
                                       "it was exported from, or import its arrays ('palpate "
                                       "import')");
}

void requireTopicsOf(const fs::path& path, const FormatReader& reader, const ReadOptions& options) {
  if (!options.topics.empty() && !reader.hasTopics)
    throw FileError(path, "has no topics: --topic is for MCAP files of other programs");
}

// The reader of a file that has to be a recording.
const FormatReader& requiredReader(const fs::path& path, const ReadOptions& options) {
  const RecordingFormat* format = recognisedFormat(path);
  requireTopicsOf(path, *(format ? *format : kDsaFormat).reader, options);
  if (!format) throwNoRecording(path);
  return *format->reader;
}

// Adds a note at the first sample that says where the recording comes from, and what is missing.
void addOrigin(Recording& recording, const fs::path& in, const std::string& missing) {
  const Profile& profile = recording.profile;
  std::optional<std::int64_t> firstUs;
  const auto take = [&](std::int64_t us) { firstUs = std::min(us, firstUs.value_or(us)); };
  // At the first frame, where the timeline begins.
  if (profile.numFrames() > 0) {
    take(profile.frameTimeUs(0));
  } else {
    for (std::size_t i = 0; i < profile.series().size(); ++i)
      if (profile.numSamples(i) > 0) take(profile.sampleTimeUs(i, 0));
  }
  if (!firstUs) return;
  Event note;
  note.tUs = note.t1Us = *firstUs;
  note.kind = "note";
  note.text = "Recovered from the damaged file " + in.filename().string() + ": " + missing;
  const auto at =
      std::lower_bound(recording.events.begin(),
                       recording.events.end(),
                       note.tUs,
                       [](const Event& event, std::int64_t us) { return event.tUs < us; });
  recording.events.insert(at, std::move(note));
}

}  // namespace

std::span<const RecordingFormat* const> recordingFormats() noexcept {
  static constexpr const RecordingFormat* kFormats[] = {&kDsaFormat,
                                                        &kPalpateFormat,
                                                        &kCsvFormat,
                                                        &kNpzFormat,
                                                        &kJsonLinesFormat,
                                                        &kHdf5Format,
                                                        &kMatFormat,
                                                        &kMcapFormat};
  return kFormats;
}

std::vector<std::string> recordingEndings() {
  std::vector<std::string> endings;
  for (const RecordingFormat* format : recordingFormats())
    endings.insert(endings.end(), format->endings.begin(), format->endings.end());
  return endings;
}

const RecordingFormat& formatOf(const fs::path& path) {
  const std::string ending = lowerEndingOf(path);
  for (const RecordingFormat* format : recordingFormats())
    if (format->hasEnding(ending)) return *format;
  const std::vector<std::string> endings = recordingEndings();
  std::string list = endings.front();
  for (std::size_t i = 1; i < endings.size(); ++i)
    list += (i + 1 == endings.size() ? " or " : ", ") + endings[i];
  throw FileError(path, "its name must end in " + list);
}

const RecordingFormat* recognisedFormat(const fs::path& path) {
  // Closing a file that this very process writes would drop SQLite's locks on it.
  if (RecordingLock::isHeld(path)) return &kPalpateFormat;
  FileSource source(path);
  std::array<char, 32> first{};
  const std::string_view begin(first.data(), source.read(first));
  const std::string ending = lowerEndingOf(path);
  const auto found = [](const auto& fits) -> const RecordingFormat* {
    for (const RecordingFormat* format : recordingFormats())
      if (format->reader && fits(*format)) return format;
    return nullptr;
  };
  if (const auto* format = found(
          [&](const RecordingFormat& each) { return each.reader->recognises(begin, ending); }))
    return format;
  if (begin.starts_with("MATLAB 5.0 MAT-file")) return nullptr;
  if (const auto* format = found([&](const auto& each) { return each.hasEnding(ending); }))
    return format;
  if (ending == ".mat" || !foreignFormatText(path).empty()) return nullptr;
  return begin.starts_with(kSqliteStart) ? &kPalpateFormat : &kDsaFormat;
}

const FormatReader& readerOf(const fs::path& path) {
  const RecordingFormat* format = recognisedFormat(path);
  return *(format ? *format : kDsaFormat).reader;
}

std::string countsText(std::size_t frames, std::size_t angles, std::size_t temperatures) {
  return counted(frames, "frame") + ", " + counted(angles, "angle sample") + ", " +
         counted(temperatures, "temperature sample");
}

std::string countsText(const Profile& profile) {
  std::string text =
      countsText(profile.numFrames(), profile.numAngles(), profile.numTemperatures());
  for (std::size_t i = kHandSeries; i < profile.series().size(); ++i)
    text += ", " + counted(profile.numSamples(i), itemOf(profile.series()[i].name));
  return text;
}

std::string withoutName(const fs::path& path, const std::string& message) {
  const std::string name = path.string() + ": ";
  return message.starts_with(name) ? message.substr(name.size()) : message;
}

void readThrough(const Profile& profile, const Progress& progress) {
  constexpr std::size_t kSamplesPerReport = 4096;
  std::size_t all = profile.numFrames();
  for (std::size_t s = 0; s < profile.series().size(); ++s) all += profile.numSamples(s);
  std::size_t read = 0;
  const auto report = [&] { reportProgress(progress, read++, all + 1, kSamplesPerReport); };
  TactileFrame frame;
  for (std::size_t i = 0; i < profile.numFrames(); ++i, report()) profile.readFrame(i, frame);
  for (std::size_t s = 0; s < profile.series().size(); ++s)
    for (std::size_t i = 0; i < profile.numSamples(s); ++i, report()) profile.sample(s, i);
}

Recording withEventDamage(Recording recording) {
  Damage& damage = recording.damage;
  damage.text = damage.events > 0 ? counted(damage.events, "damaged row") : damage.eventsFault();
  return recording;
}

Recording readRecording(const fs::path& path,
                        const ReadOptions& options,
                        const Progress& progress) {
  return requiredReader(path, options).open(path, options, progress);
}

Profile openRecording(const fs::path& path, const Progress& progress, std::size_t threads) {
  return readRecording(path, {.threads = threads}, progress).profile;
}

std::string lostText(const Profile& profile) {
  for (const std::string& warning : profile.info().warnings)
    if (warning.starts_with(kLostWarning)) return warning.substr(kLostWarning.size());
  return "";
}

Recording readableRecording(const fs::path& path,
                            const ReadOptions& options,
                            const Progress& progress) {
  // From 0 to 1 once, also where a second way has to be taken.
  double reached = 0.0;
  Progress forward;
  if (progress)
    forward = [&](double fraction) { return progress(reached = std::max(reached, fraction)); };
  return requiredReader(path, options).openReadable(path, options, forward);
}

VerifyReport verifyRecording(const fs::path& path, const Progress& progress, std::size_t threads) {
  try {
    return requiredReader(path, {}).verify(path, threads, progress);
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {
    return {VerifyReport::State::kUnreadable, withoutName(path, error.what())};
  }
}

EventsReport readEvents(const fs::path& path) { return readerOf(path).events(path); }

RecordingMeta readRecordingMeta(const fs::path& path) { return readerOf(path).meta(path); }

void requireOther(const fs::path& in, const fs::path& out) {
  std::error_code ignored;
  if (fs::equivalent(in, out, ignored))
    throw FileError(out, "is the input itself; give another name");
}

SaveReport saveRecording(const Profile& profile,
                         std::span<const Event> events,
                         const fs::path& path,
                         Overwrite overwrite,
                         const Progress& progress,
                         const SaveExtras& extras) {
  return formatOf(path).save(
      {{profile, events, extras.meta, extras.exported}, path, overwrite, progress, extras});
}

RecoverReport recoverRecording(const fs::path& in,
                               const fs::path& out,
                               Overwrite overwrite,
                               const Progress& progress,
                               const ReadOptions& options) {
  formatOf(out);  // before the work, not after it
  requireOther(in, out);
  requireWritable(out, overwrite);
  const FormatReader& reader = readerOf(in);
  requireTopicsOf(in, reader, options);
  if (!reader.salvage) throw FileError(in, reader.cantRecover);
  Salvage salvage = reader.salvage(in, options, progress);
  if (!salvage.recording)
    return {RecoverReport::State::kNothing, "nothing can be saved: " + salvage.message};
  Recording& recording = *salvage.recording;
  if (!salvage.missing.empty()) addOrigin(recording, in, salvage.missing);
  SaveExtras extras;
  extras.meta = recording.meta;
  const std::string leftOut = leftOutText(recording.profile, out);
  if (!leftOut.empty()) salvage.message += "; " + leftOut;
  saveRecording(recording.profile, recording.events, out, overwrite, progress, extras);
  return {salvage.isWhole ? RecoverReport::State::kWhole : RecoverReport::State::kPart,
          salvage.message};
}

}  // namespace palpate
