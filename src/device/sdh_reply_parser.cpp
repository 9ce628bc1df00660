#include "palpate/device/sdh_reply_parser.h"

#include <algorithm>
#include <string>
#include <utility>

namespace palpate {
namespace {

constexpr std::size_t kMaxLineBytes = 254;

bool beginsRecord(std::byte b) { return (b & std::byte{0x80}) != std::byte{0}; }
bool isPrintable(char c) { return c >= ' ' && c <= '~'; }

}  // namespace

std::size_t SdhReplyParser::takeRecord(std::span<const std::byte> in, const Sink& sink) {
  const std::size_t size = sdhRecordBytes(checksum_);
  tooLong_ = false;  // the following bytes do not belong to an earlier line
  if (sdhIsRecordStart(in, checksum_)) {
    if (in.size() < size) return 0;
    if (auto record = decodeSdhRecord(in.first(size), checksum_)) {
      ++stats_.records;
      stats_.recordBytes += size;
      sink(std::move(*record));
      return size;
    }
    ++stats_.badChecksums;
  }
  ++stats_.skippedBytes;
  return 1;
}

std::size_t SdhReplyParser::takeLine(std::span<const std::byte> in, const Sink& sink) {
  const auto end = std::find_if(
      in.begin(), in.end(), [](std::byte b) { return b == std::byte{'\n'} || beginsRecord(b); });
  const auto length = static_cast<std::size_t>(end - in.begin());
  const bool ends = end != in.end() && !beginsRecord(*end);
  if (end == in.end() && length <= kMaxLineBytes && !tooLong_) return 0;
  if (!ends) {  // text interrupted by a record, or without an end
    tooLong_ = end == in.end();
    stats_.skippedBytes += length;
    return length;
  }
  std::string line(reinterpret_cast<const char*>(in.data()), length);
  while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
  line.erase(0, line.find_first_not_of(' '));
  if (std::exchange(tooLong_, false) || line.empty() || length > kMaxLineBytes ||
      !std::all_of(line.begin(), line.end(), isPrintable)) {
    stats_.skippedBytes += length + 1;
  } else {
    ++stats_.lines;
    stats_.lineBytes += length + 1;
    sink(parseSdhLine(line));
  }
  return length + 1;
}

void SdhReplyParser::push(std::span<const std::byte> bytes, const Sink& sink) {
  pending_.insert(pending_.end(), bytes.begin(), bytes.end());
  std::size_t at = 0;
  while (at < pending_.size()) {
    const auto in = std::span<const std::byte>(pending_).subspan(at);
    const std::size_t taken = beginsRecord(in[0]) ? takeRecord(in, sink) : takeLine(in, sink);
    if (taken == 0) break;  // wait for the rest
    at += taken;
  }
  pending_.erase(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(at));
}

void SdhReplyParser::reset() {
  stats_.skippedBytes += pending_.size();
  pending_.clear();
  tooLong_ = false;
}

}  // namespace palpate
