#include "palpate/interop/remote_protocol.h"

#include <algorithm>
#include <array>
#include <utility>

#include "palpate/core/escaped_line.h"

namespace palpate {
namespace {
using RemoteProtocolVerb = RemoteRequest::Verb;

constexpr std::string_view kBlanks = " \t";
constexpr std::size_t kMaxQuoted = 60;  // part of an invalid request quoted in an answer

struct VerbSpec {
  RemoteProtocolVerb verb;
  std::string_view name;
  bool hasText;
};
// In the order of RemoteRequest::Verb.
constexpr std::array<VerbSpec, 8> kVerbs = {{{RemoteProtocolVerb::kStatus, "status", false},
                                             {RemoteProtocolVerb::kStart, "start", true},
                                             {RemoteProtocolVerb::kStop, "stop", false},
                                             {RemoteProtocolVerb::kLabel, "label", true},
                                             {RemoteProtocolVerb::kMark, "mark", false},
                                             {RemoteProtocolVerb::kFile, "file", true},
                                             {RemoteProtocolVerb::kSet, "set", true},
                                             {RemoteProtocolVerb::kHelp, "help", false}}};

ReadRequest refuse(std::string code, std::string why) {
  return {std::nullopt, RemoteAnswer::refused(std::move(code), std::move(why))};
}

std::string quoted(std::string_view text) {
  return "'" + shortened(beginningOf(text, kMaxQuoted)) + "'";
}

}  // namespace

std::string_view nameOf(RemoteProtocolVerb verb) noexcept {
  return kVerbs[static_cast<std::size_t>(verb)].name;
}

const std::vector<RemoteProtocolVerb>& allRemoteVerbs() {
  static const std::vector<RemoteProtocolVerb> all = [] {
    std::vector<RemoteProtocolVerb> verbs;
    for (const VerbSpec& spec : kVerbs) verbs.push_back(spec.verb);
    return verbs;
  }();
  return all;
}

RemoteAnswer RemoteAnswer::refused(std::string code, std::string why) {
  RemoteAnswer answer;
  answer.error = std::move(code);
  answer.message = std::move(why);
  return answer;
}

std::string answerLine(const RemoteAnswer& answer, std::string_view command) {
  Json json = Json::object().set("ok", answer.ok());
  if (!command.empty()) json.set("command", command);
  if (!answer.ok()) json.set("error", answer.error);
  if (!answer.message.empty()) json.set("message", escapedLine(answer.message));
  for (const std::string& key : answer.fields.keys()) json.set(key, answer.fields.at(key));
  return json.text(-1);
}

ReadRequest readRequest(std::string_view line) {
  if (line.size() > kMaxRequestBytes)
    return refuse("too_long",
                  "a request has at most " + std::to_string(kMaxRequestBytes) + " bytes");
  // A line that escapedLine() would change is not a text: control characters, invalid UTF-8. Tabs
  // count as blanks.
  std::string plain(line);
  std::replace(plain.begin(), plain.end(), '\t', ' ');
  if (escapedLine(plain) != plain)
    return refuse("malformed", "a request is one line of UTF-8 without control characters");
  const std::string_view text = trimmed(plain);
  if (text.empty()) return refuse("malformed", "an empty request; 'help' lists the requests");
  const std::string_view word = text.substr(0, text.find_first_of(kBlanks));
  const auto spec = std::find_if(
      kVerbs.begin(), kVerbs.end(), [&](const VerbSpec& each) { return each.name == word; });
  if (spec == kVerbs.end())
    return refuse("unknown", quoted(word) + " isn't a request; 'help' lists them");
  RemoteRequest request{spec->verb, std::string(trimmed(text.substr(word.size())))};
  if (!request.text.empty() && !spec->hasText)
    return refuse("malformed", std::string(word) + " takes no text");
  if (request.text.empty() && spec->verb == RemoteProtocolVerb::kLabel)
    return refuse("malformed", "label needs its text: label TEXT");
  if (spec->verb == RemoteProtocolVerb::kSet && !settingFrom(request.text))
    return refuse("malformed",
                  "set operator TEXT, object, run or notes; without TEXT it is forgotten");
  return {std::move(request), {}};
}

std::optional<RequestLines::Line> RequestLines::next() {
  const auto end = pending_.find('\n');
  if (end == std::string::npos) {
    if (pending_.size() > kMaxRequestBytes + 1) {  // a CR may precede the end
      pending_.clear();
      skipping_ = true;
    }
    return std::nullopt;
  }
  Line line{pending_.substr(0, end), false};
  pending_.erase(0, end + 1);
  if (line.text.ends_with('\r')) line.text.pop_back();
  if (std::exchange(skipping_, false) || line.text.size() > kMaxRequestBytes)
    line = {std::string(), true};
  return line;
}

std::optional<RemoteSetting> settingFrom(std::string_view text) {
  constexpr std::array<std::string_view, 4> kKeys = {"operator", "object", "run", "notes"};
  const std::string_view key = text.substr(0, text.find_first_of(kBlanks));
  if (std::find(kKeys.begin(), kKeys.end(), key) == kKeys.end()) return std::nullopt;
  return RemoteSetting{std::string(key), std::string(trimmed(text.substr(key.size())))};
}

}  // namespace palpate
