#include "palpate/emulator/faults.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"

namespace palpate {
namespace {

constexpr double kMaxSeconds = 1e6;
constexpr double kMaxJunkBytes = 1e9;

[[noreturn]] void refuse(std::string_view word, const std::string& why) {
  throw std::invalid_argument("fault '" + shortened(word) + "': " + why);
}

double numberIn(std::string_view word, std::string_view text, double most, const char* what) {
  const auto value = parseDouble(text);
  if (!value || *value < 0.0 || *value > most)
    refuse(word, std::string(what) + " must be a number 0.." + numberText(most));
  return *value;
}

Outage outage(std::string_view word, std::string_view text) {
  const std::size_t at = text.find('@');
  if (at == std::string_view::npos) refuse(word, "needs SECONDS@AT, such as 2@10");
  return {.atS = numberIn(word, text.substr(at + 1), kMaxSeconds, "AT"),
          .durationS = numberIn(word, text.substr(0, at), kMaxSeconds, "SECONDS")};
}

void take(Faults& faults, std::string_view word) {
  const std::size_t equals = word.find('=');
  const std::string_view name = word.substr(0, equals);
  const std::string_view text =
      equals == std::string_view::npos ? std::string_view() : word.substr(equals + 1);
  if (name == "crc") {
    faults.crcRate = numberIn(word, text, 1.0, "the rate");
  } else if (name == "drop") {
    faults.dropRate = numberIn(word, text, 1.0, "the rate");
  } else if (name == "insert") {
    faults.insertRate = numberIn(word, text, 1.0, "the rate");
  } else if (name == "stall") {
    faults.stalls.push_back(outage(word, text));
  } else if (name == "unplug") {
    faults.unplugs.push_back(outage(word, text));
  } else if (name == "junk_start") {
    const double bytes = numberIn(word, text, kMaxJunkBytes, "the number of bytes");
    if (bytes != std::floor(bytes)) refuse(word, "the number of bytes must be a whole number");
    faults.junkStartBytes = static_cast<std::size_t>(bytes);
  } else if (name == "boot") {
    faults.bootS = numberIn(word, text, kMaxSeconds, "the time");
  } else {
    refuse(word, "unknown; known are crc, drop, insert, stall, unplug, junk_start, boot");
  }
}

void requireRate(double rate, const char* name) {
  if (!(rate >= 0.0 && rate <= 1.0))
    throw std::invalid_argument(std::string(name) + " rate " + numberText(rate) +
                                " is outside of 0..1");
}

}  // namespace

Faults parseFaults(std::string_view text) {
  Faults faults;
  while (!text.empty()) {
    const std::size_t comma = text.find(',');
    take(faults, text.substr(0, comma));
    if (comma == std::string_view::npos) break;
    text.remove_prefix(comma + 1);
    if (text.empty()) refuse("", "nothing follows the last comma");
  }
  return faults;
}

ByteFaults::ByteFaults(const Faults& faults, std::uint64_t seed)
    : crcRate_(faults.crcRate),
      dropRate_(faults.dropRate),
      insertRate_(faults.insertRate),
      random_(seed) {
  requireRate(crcRate_, "crc");
  requireRate(dropRate_, "drop");
  requireRate(insertRate_, "insert");
  untilDrop_ = untilNext(dropRate_);
  untilInsert_ = untilNext(insertRate_);
}

// Geometric distribution: one random number per fault instead of one per byte.
std::uint64_t ByteFaults::untilNext(double rate) {
  if (rate <= 0.0) return std::numeric_limits<std::uint64_t>::max();
  if (rate >= 1.0) return 0;
  const double u = std::uniform_real_distribution<double>(1e-300, 1.0)(random_);
  return static_cast<std::uint64_t>(std::log(u) / std::log1p(-rate));
}

void ByteFaults::apply(LineMessage& message, FaultCounts& counts) {
  bool damaged = false;
  if (message.checksummed && message.bytes.size() >= 2 && crcRate_ > 0.0 &&
      std::uniform_real_distribution<double>(0.0, 1.0)(random_) < crcRate_) {
    // Changes the checksum by a value that is never zero, so that it is wrong.
    const auto change = std::uniform_int_distribution<unsigned>(1, 0xFFFF)(random_);
    message.bytes[message.bytes.size() - 2] ^= static_cast<std::byte>(change & 0xFFu);
    message.bytes.back() ^= static_cast<std::byte>(change >> 8);
    ++counts.spoiltChecksums;
    damaged = true;
  }
  if (dropRate_ > 0.0 || insertRate_ > 0.0) {
    std::vector<std::byte> sent;
    sent.reserve(message.bytes.size() + 4);
    for (std::size_t i = 0; i < message.bytes.size(); ++i) {
      const bool last = i + 1 == message.bytes.size();
      if (untilDrop_-- == 0) {
        untilDrop_ = untilNext(dropRate_);
        ++counts.droppedBytes;
        damaged = true;
      } else {
        sent.push_back(message.bytes[i]);
      }
      if (untilInsert_-- == 0) {
        untilInsert_ = untilNext(insertRate_);
        sent.push_back(static_cast<std::byte>(random_() & 0xFFu));
        ++counts.insertedBytes;
        damaged = damaged || !last;
      }
    }
    message.bytes = std::move(sent);
  }
  message.damaged = message.damaged || damaged;
  if (message.frame && damaged) ++counts.damagedFrames;
}

std::vector<std::byte> ByteFaults::junk(std::size_t count) {
  std::vector<std::byte> bytes(count);
  for (std::byte& b : bytes) b = static_cast<std::byte>(random_() & 0xFFu);
  return bytes;
}

}  // namespace palpate
