#include "palpate/recording/dsa_reader.h"

#include <functional>
#include <new>
#include <string>
#include <string_view>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/core/progress.h"
#include "palpate/core/xml.h"
#include "palpate/recording/dsa_recovery.h"

#include "recording/dsa/bzip2_decoder.h"
#include "recording/dsa/dsa_document.h"
#include "recording/dsa/dsa_xml_stream.h"

namespace palpate {
namespace {

constexpr std::uint64_t kBytesPerReport = 256u << 10;  // of XML, between two calls of Progress
// A bzip2 block holds at most 900 kB, which its first run-length code can stretch 51 times.
constexpr std::uint64_t kDsaReaderMaxBlockBytes = 46u << 20;

// Wrong data of a damaged bzip2 block comes out before the block's checksum: nonsense in the text
// may be only the echo of that. Reads on to the end of the block; throws when it is damaged.
void blameContainer(DsaXmlStream& text) {
  if (!text.compressed()) return;
  for (std::uint64_t bytes = 0; bytes <= kDsaReaderMaxBlockBytes;) {
    const std::size_t size = text.next().size();
    if (size == 0) return;
    bytes += size;
  }
}

Profile readDocument(ByteSource& source,
                     const std::filesystem::path& path,
                     const Progress& progress,
                     const DsaReadOptions& options) {
  std::function<void()> report;
  DsaXmlStream text(source, path, options.threads, [&] { report(); });
  report = [&] {
    if (progress && !progress(text.fraction())) throw Cancelled();
  };
  const std::uint64_t maxBytes = boundFor(options.freeBytes, options.maxRatio, source.numBytes());
  DsaDocument document(options, memoryBound(options, text.compressed(), source.numBytes()));
  XmlParser parser(document);
  std::uint64_t bytes = 0;
  std::uint64_t reported = 0;
  report();
  try {
    for (std::string_view chunk = text.next(); !chunk.empty(); chunk = text.next()) {
      bytes += chunk.size();
      if (bytes > maxBytes)
        throw FormatError(path,
                          "expands to more than " + std::to_string(maxBytes >> 20) +
                              " MB, far more than a recording of its size",
                          bytes);
      parser.push(chunk);
      if (bytes - reported >= kBytesPerReport) {
        reported = bytes;
        report();
      }
    }
    parser.finish();
    Profile profile = document.finish();
    report();
    return profile;
  } catch (const XmlError& error) {
    blameContainer(text);
    throw FormatError(path, std::string("is not well-formed XML: ") + error.what(), error.offset());
  } catch (const FileError&) {
    throw;
  } catch (const FormatError&) {
    throw;
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {  // of the document: it knows neither path nor place
    blameContainer(text);
    throw FormatError(path, error.what(), parser.offset());
  } catch (const std::bad_alloc&) {
    throw FormatError(path, "needs more memory than there is");
  }
}

std::string describe(const DsaRecovery& saved) {
  std::string text = counted(saved.frames, "frame") + ", " + counted(saved.angles, "angle sample") +
                     " and " + counted(saved.temperatures, "temperature sample") +
                     " can be read ('palpate recover' saves them)";
  if (saved.blocks > 0)
    text += "; " + std::to_string(saved.intactBlocks) + " of " +
            counted(saved.blocks, "bzip2 block") + " can be read";
  if (!saved.lossText.empty()) text += "; " + saved.lossText;
  if (saved.layoutAssumed)
    text += "; the sensor's layout is lost: that of the SDH-2 is assumed, which fits the frames";
  return text;
}

}  // namespace

Profile readDsa(const std::filesystem::path& path,
                const Progress& progress,
                const DsaReadOptions& options) {
  FileSource source(path);
  return readDocument(source, path, progress, options);
}

Profile readDsaBytes(std::span<const std::byte> bytes,
                     const std::filesystem::path& name,
                     const DsaReadOptions& options) {
  MemorySource source(bytes);
  return readDocument(source, name, {}, options);
}

DsaVerifyReport verifyDsa(const std::filesystem::path& path,
                          const Progress& progress,
                          const DsaReadOptions& options) {
  DsaVerifyReport report;
  try {
    const Profile profile = readDsa(path, partOf(progress, 0.0, 0.5), options);
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
    // The hint is added again below if recovery is possible.
    const std::size_t hint = report.message.find(kDsaRecoverHint);
    if (hint != std::string::npos)
      report.message.erase(hint, std::string_view(kDsaRecoverHint).size());
  }
  const auto addNothing = [&] {
    const std::string_view nothing = "nothing of it can be read";
    if (report.message.find(nothing) == std::string::npos)
      report.message += "; " + std::string(nothing);
  };
  try {
    const DsaRecovery saved = recoverDsaProfile(path, partOf(progress, 0.5, 1.0), options);
    report.frames = saved.frames;
    report.angles = saved.angles;
    report.temperatures = saved.temperatures;
    if (saved.profile) {
      report.state = DsaVerifyReport::State::kDamaged;
      report.message += "; " + describe(saved);
    } else {
      addNothing();
    }
  } catch (const Cancelled&) {
    throw;
  } catch (const std::bad_alloc&) {
    report.message += "; there is not enough memory to search it for intact parts";
  } catch (const Error&) {
    addNothing();  // the first message says why
  }
  return report;
}

}  // namespace palpate
