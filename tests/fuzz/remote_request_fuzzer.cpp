// Fuzzes what clients of remote control send: lines are cut the same whatever pieces they come in,
// little is held in memory, and each line is a request or one line of JSON that says why it is
// none.
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "palpate/interop/remote_protocol.h"

namespace {

using namespace palpate;

void require(bool condition) {
  if (!condition) std::abort();
}

std::vector<std::string> linesOf(std::string_view text, std::size_t piece) {
  RequestLines cutter;
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size(); at += piece) {
    cutter.push(text.substr(at, piece));
    while (const auto line = cutter.next())
      lines.push_back(line->tooLong ? "too long" : line->text);
    require(cutter.pendingBytes() <= kMaxRequestBytes + piece);
  }
  return lines;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const std::vector<std::string> lines = linesOf(text, text.size() + 1);
  require(lines == linesOf(text, 1) && lines == linesOf(text, 7));
  for (const std::string& line : lines) {
    const ReadRequest read = readRequest(line);
    if (read.request) continue;
    require(!read.refusal.ok());
    const std::string answer = answerLine(read.refusal, "");
    require(answer.find('\n') == std::string::npos && !Json::parse(answer).at("ok").asBool());
  }
  return 0;
}
