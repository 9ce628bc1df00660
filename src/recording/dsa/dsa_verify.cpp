#include <new>
#include <string>

#include "palpate/core/error.h"
#include "palpate/recording/dsa_reader.h"
#include "palpate/recording/dsa_recovery.h"

#include "recording/message_text.h"

namespace palpate {
namespace {

std::string describe(const DsaRecovery& saved) {
  std::string text = counted(saved.frames, "frame") + ", " + counted(saved.angles, "angle sample") +
                     " and " + counted(saved.temperatures, "temperature sample") +
                     " can be read (palpate recover saves them)";
  if (saved.blocks > 0)
    text += "; " + std::to_string(saved.intactBlocks) + " of " +
            counted(saved.blocks, "bzip2 block") + " intact";
  if (saved.layoutAssumed)
    text += "; the sensor's layout is lost, that of the SDH-2 is assumed, to which the frames fit";
  return text;
}

// Two passes, one bar: each takes half of it.
Progress half(const Progress& progress, double begin) {
  if (!progress) return {};
  return [&progress, begin](double fraction) { return progress(begin + 0.5 * fraction); };
}

}  // namespace

DsaVerifyReport verifyDsa(const std::filesystem::path& path,
                          const Progress& progress,
                          const DsaReadOptions& options) {
  DsaVerifyReport report;
  try {
    const Profile profile = readDsa(path, half(progress, 0.0), options);
    report.state = DsaVerifyReport::State::kSound;
    report.frames = profile.numFrames();
    report.angles = profile.numAngles();
    report.temperatures = profile.numTemperatures();
    if (progress && !progress(1.0)) throw Cancelled();
    return report;
  } catch (const FileError& error) {
    report.message = error.what();
    return report;
  } catch (const FormatError& error) {
    report.message = error.what();
  }
  try {
    const DsaRecovery saved = recoverDsaProfile(path, half(progress, 0.5), options);
    report.frames = saved.frames;
    report.angles = saved.angles;
    report.temperatures = saved.temperatures;
    if (saved.profile) {
      report.state = DsaVerifyReport::State::kDamaged;
      report.message += "; " + describe(saved);
    } else {
      report.message += "; nothing can be read";
    }
  } catch (const Cancelled&) {
    throw;
  } catch (const std::bad_alloc&) {
    report.message += "; there is not enough memory to search it for intact parts";
  } catch (const Error&) {
    report.message += "; nothing can be read";  // the first message says why
  }
  return report;
}

}  // namespace palpate
