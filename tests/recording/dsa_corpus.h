// Recordings made on the spot for tests: small right ones, and every kind of damage.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace palpate::testing {

// The example of docs/notes/dsa_format.md: one matrix of 2 rows and 3 columns, two frames (all
// zero; 0 0 100 / 0 1000 0), one temperature sample, one angle sample.
std::string exampleXml();
// `text` with the first `from` replaced. Throws std::logic_error when there is none.
std::string replaced(std::string text, std::string_view from, std::string_view to);

// A document with one matrix and frames 32 ms apart, each with the given text as frame_data.
std::string framesXml(int rows, int columns, const std::vector<std::string>& frameTexts);
// A long SDH-2 document of several bzip2 blocks (pseudo-random values, the same for a seed).
std::string longXml(std::size_t numFrames, std::size_t numAngles, std::uint32_t seed);
// The value that longXml() writes.
float longXmlValue(std::size_t frame, std::size_t place, std::uint32_t seed);

std::string compressed(std::string_view text, int level = 9);
std::string decompressed(std::string_view bytes);  // by bzip2's own simple interface

// A damaged recording, and what its message must name.
struct DamagedCase {
  std::string name;
  std::function<std::string()> bytes;  // made when asked for: every test is a process of its own
  std::vector<std::string> messageParts;
};
inline void PrintTo(const DamagedCase& damaged, std::ostream* out) { *out << damaged.name; }
std::vector<DamagedCase> damagedCases();

// Writes `count` times `piece`, compressed, without holding it in memory.
void writeBomb(const std::filesystem::path& path,
               std::string_view begin,
               std::string_view piece,
               std::size_t count);

}  // namespace palpate::testing
