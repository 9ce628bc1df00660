#include "palpate/recording/recording.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <string_view>

#include "palpate/core/error.h"
#include "palpate/recording/dsa_reader.h"
#include "palpate/recording/dsa_salvage.h"
#include "palpate/recording/dsa_writer.h"
#include "palpate/recording/palpate_reader.h"
#include "palpate/recording/palpate_salvage.h"
#include "palpate/recording/palpate_writer.h"
#include "palpate/recording/table_export.h"

#include "recording/byte_source.h"
#include "recording/message_text.h"

namespace palpate {
namespace {

constexpr std::string_view kSqliteStart{"SQLite format 3\0", 16};

// Throws FileError.
bool isNative(const std::filesystem::path& path) {
  FileSource source(path);
  std::array<char, kSqliteStart.size()> first{};
  return source.read(first) == first.size() &&
         std::string_view(first.data(), first.size()) == kSqliteStart;
}

std::string countsText(std::size_t frames, std::size_t angles, std::size_t temperatures) {
  return counted(frames, "frame") + ", " + counted(angles, "angle sample") + ", " +
         counted(temperatures, "temperature sample");
}

// What is wrong with a native recording; empty when nothing is.
std::string damageText(const PalpateSalvage& salvage) {
  std::string text;
  const auto add = [&](std::size_t count, const char* what) {
    if (count > 0) text += (text.empty() ? "" : ", ") + counted(count, what);
  };
  add(salvage.lostFrames, "lost frame");
  add(salvage.lostAngles, "lost angle sample");
  add(salvage.lostTemperatures, "lost temperature sample");
  add(salvage.damagedBlocks, "damaged block");
  add(salvage.blocksFromPages, "block found in the raw pages");
  add(salvage.damagedRows, "damaged row");
  if (salvage.layoutAssumed) text += (text.empty() ? "" : ", ") + std::string("layout assumed");
  if (!salvage.sqliteError.empty())
    text += (text.empty() ? "" : ", ") + std::string("SQLite gave up");
  return text;
}

VerifyReport verifyNative(const std::filesystem::path& path, const Progress& progress) {
  const PalpateSalvage salvage = salvagePalpate(path, progress);
  VerifyReport report;
  report.message = countsText(salvage.frames, salvage.angles, salvage.temperatures);
  if (salvage.unfinished) report.message += "; unfinished: its writer stopped before the end";
  if (salvage.whole()) {
    report.state = VerifyReport::State::kSound;
  } else {
    report.state =
        salvage.profile ? VerifyReport::State::kDamaged : VerifyReport::State::kUnreadable;
    report.message = damageText(salvage) + "; readable: " + report.message;
  }
  return report;
}

RecoverReport recoverNative(const std::filesystem::path& in,
                            const std::filesystem::path& out,
                            Overwrite overwrite,
                            const Progress& progress) {
  const PalpateSalvage salvage = salvagePalpate(in, progress);
  RecoverReport report;
  if (!salvage.profile) {
    report.message = "nothing can be saved: no intact block was found";
    return report;
  }
  saveRecording(*salvage.profile, out, overwrite, progress);
  report.state = salvage.whole() ? RecoverReport::State::kWhole : RecoverReport::State::kPart;
  report.message = "saved " + countsText(salvage.frames, salvage.angles, salvage.temperatures);
  if (!salvage.whole()) report.message += "; " + damageText(salvage);
  return report;
}

RecoverReport recoverDsa(const std::filesystem::path& in,
                         const std::filesystem::path& out,
                         Overwrite overwrite,
                         const Progress& progress) {
  const DsaVerifyReport checked = verifyDsa(in, progress);
  RecoverReport report;
  if (checked.state == DsaVerifyReport::State::kSound) {
    saveRecording(readDsa(in, progress), out, overwrite, progress);
    report.state = RecoverReport::State::kWhole;
    report.message = "nothing was damaged; saved " +
                     countsText(checked.frames, checked.angles, checked.temperatures);
    return report;
  }
  const DsaSalvage salvage = salvageDsa(in, progress);
  if (!salvage.profile) {
    report.message = "nothing can be saved: " + checked.message;
    return report;
  }
  saveRecording(*salvage.profile, out, overwrite, progress);
  report.state = RecoverReport::State::kPart;
  report.message = "saved " + countsText(salvage.frames, salvage.angles, salvage.temperatures) +
                   "; lost: the rest (" + std::to_string(salvage.intactBlocks) + " of " +
                   counted(salvage.blocks, "bzip2 block") + " intact, " +
                   counted(salvage.cutSamples, "sample") + " cut)";
  return report;
}

}  // namespace

Profile openRecording(const std::filesystem::path& path, const Progress& progress) {
  return isNative(path) ? readPalpate(path, progress) : readDsa(path, progress);
}

VerifyReport verifyRecording(const std::filesystem::path& path, const Progress& progress) {
  VerifyReport report;
  try {
    if (isNative(path)) return verifyNative(path, progress);
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

RecordingForm formOf(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char letter) {
    return static_cast<char>(std::tolower(letter));
  });
  if (ending == ".dsa") return RecordingForm::kDsa;
  if (ending == ".palpate") return RecordingForm::kPalpate;
  if (ending == ".csv") return RecordingForm::kCsv;
  if (ending == ".npz") return RecordingForm::kNpz;
  throw FileError(path, "its name must end in .dsa, .palpate, .csv or .npz");
}

void saveRecording(const Profile& profile,
                   const std::filesystem::path& path,
                   Overwrite overwrite,
                   const Progress& progress) {
  switch (formOf(path)) {
    case RecordingForm::kDsa:
      return writeDsa(profile, path, overwrite, progress);
    case RecordingForm::kPalpate:
      return writePalpate(profile, path, overwrite, progress);
    case RecordingForm::kCsv:
      return writeCsv(profile, path, overwrite, progress);
    case RecordingForm::kNpz:
      return writeNpz(profile, path, overwrite, progress);
  }
}

RecoverReport recoverRecording(const std::filesystem::path& in,
                               const std::filesystem::path& out,
                               Overwrite overwrite,
                               const Progress& progress) {
  formOf(out);  // before the work, not after it
  requireWritable(out, overwrite);
  return isNative(in) ? recoverNative(in, out, overwrite, progress)
                      : recoverDsa(in, out, overwrite, progress);
}

}  // namespace palpate
