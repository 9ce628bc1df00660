// Fuzzes the .dsa reader and the salvage with bytes of any kind, bzip2 or plain XML. Beyond not
// crashing: what is read is finite and strictly ordered, text reads the same compressed, and a
// recording that reads is saved whole.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <span>
#include <string>

#include <bzlib.h>

#include "palpate/core/error.h"
#include "palpate/recording/dsa_reader.h"
#include "palpate/recording/dsa_recovery.h"

namespace {

using palpate::Profile;

// Small bounds: many inputs a second, and the bounds themselves are met.
palpate::DsaReadOptions smallOptions() {
  palpate::DsaReadOptions options;
  options.freeBytes = 1u << 20;
  options.freeMemoryBytes = 1u << 20;
  options.maxPlaces = 4096;
  return options;
}

void require(bool condition) {
  if (!condition) std::abort();
}

void requireSane(const Profile& profile) {
  palpate::TactileFrame frame;
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    profile.readFrame(i, frame);
    require(frame.values.size() == profile.layout().numCells());
    for (const float value : frame.values) require(std::isfinite(value) && value >= 0.0F);
    require(i == 0 || profile.frameTimeUs(i) > profile.frameTimeUs(i - 1));
  }
  for (std::size_t i = 0; i < profile.numAngles(); ++i)
    for (const double deg : profile.angles(i).values) require(std::isfinite(deg));
  for (std::size_t i = 0; i < profile.numTemperatures(); ++i)
    for (const double degC : profile.temperatures(i).values) require(std::isfinite(degC));
}

void requireSame(const Profile& a, const Profile& b) {
  require(a.layout() == b.layout() && a.info().warnings == b.info().warnings);
  require(a.numFrames() == b.numFrames() && a.numAngles() == b.numAngles() &&
          a.numTemperatures() == b.numTemperatures());
  for (std::size_t i = 0; i < a.numFrames(); ++i)
    require(a.frameTimeUs(i) == b.frameTimeUs(i) && a.frame(i).values == b.frame(i).values);
  for (std::size_t i = 0; i < a.numAngles(); ++i)
    require(a.angleTimeUs(i) == b.angleTimeUs(i) && a.angles(i).values == b.angles(i).values);
}

std::optional<Profile> readOrRefuse(std::span<const std::byte> bytes) {
  try {
    Profile profile = palpate::readDsaBytes(bytes, "input", smallOptions());
    requireSane(profile);
    return profile;
  } catch (const palpate::FormatError&) {
    return std::nullopt;
  }
}

std::string compressed(std::span<const std::byte> bytes) {
  std::string out(bytes.size() + bytes.size() / 100 + 600, '\0');
  auto size = static_cast<unsigned>(out.size());
  std::string copy(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  require(BZ2_bzBuffToBuffCompress(
              out.data(), &size, copy.data(), static_cast<unsigned>(copy.size()), 1, 0, 0) ==
          BZ_OK);
  out.resize(size);
  return out;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  const std::optional<Profile> profile = readOrRefuse(bytes);
  try {
    const palpate::DsaRecovery saved =
        palpate::recoverDsaProfileBytes(bytes, "input", {}, smallOptions());
    if (saved.profile) requireSane(*saved.profile);
  } catch (const palpate::FormatError&) {
    require(!profile);
  }
  if (size > 1 && data[0] == '<' && data[1] != '?') {
    // With a comment in front expat reads what is else scanned directly.
    const std::string commented =
        "<!---->" + std::string(reinterpret_cast<const char*>(data), size);
    const std::optional<Profile> other =
        readOrRefuse(std::as_bytes(std::span(commented.data(), commented.size())));
    require(other.has_value() == profile.has_value());
    if (profile) requireSame(*profile, *other);
  }
  if (size > 0 && data[0] == '<') {
    const std::string packed = compressed(bytes);
    const std::optional<Profile> other =
        readOrRefuse(std::as_bytes(std::span(packed.data(), packed.size())));
    require(other.has_value() == profile.has_value());
    if (profile) requireSame(*profile, *other);
  }
  return 0;
}
