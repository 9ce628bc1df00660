#include "palpate/interop/datagrams.h"

#include "palpate/recording/tactile_sensor_json.h"

namespace palpate {
namespace {

// What stands between the commas of an object or array, `text` without its brackets.
std::vector<std::string_view> membersOf(std::string_view text) {
  std::vector<std::string_view> members;
  std::size_t begin = 0;
  int depth = 0;
  bool inText = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (inText) {
      if (c == '\\') ++i;
      inText = c != '"';
    } else if (c == '"') {
      inText = true;
    } else if (c == '{' || c == '[') {
      ++depth;
    } else if (c == '}' || c == ']') {
      --depth;
    } else if (c == ',' && depth == 0) {
      members.push_back(text.substr(begin, i - begin));
      begin = i + 1;
    }
  }
  if (begin < text.size()) members.push_back(text.substr(begin));
  return members;
}

// Collects members into objects that all begin with the same ones.
class ObjectParts {
 public:
  ObjectParts(std::string head, std::size_t maxBytes)
      : head_(std::move(head)), maxBytes_(maxBytes), part_(head_) {}

  void add(std::string_view member) {
    if (part_.size() > head_.size() && part_.size() + 1 + member.size() + 1 > maxBytes_) finish();
    part_ += ',';
    part_ += member;
  }
  std::vector<std::string> take() {
    if (part_.size() > head_.size()) finish();
    return std::move(parts_);
  }
  // Whether a member fits into a part of its own.
  bool fits(std::string_view member) const {
    return head_.size() + 1 + member.size() + 1 <= maxBytes_;
  }

 private:
  void finish() {
    parts_.push_back(part_ + "}");
    part_ = head_;
  }

  const std::string head_;  // "{" and the first members
  const std::size_t maxBytes_;
  std::string part_;
  std::vector<std::string> parts_;
};

// The values of `member`, "key":[..], as members of their own.
void addValues(ObjectParts& parts, std::string_view member, std::size_t colon) {
  const std::string_view key = member.substr(0, colon - 1);  // without its last quote
  const std::string_view array = member.substr(colon + 2, member.size() - colon - 3);
  std::size_t index = 0;
  for (const std::string_view value : membersOf(array)) {
    if (value != "null")
      parts.add(std::string(key) + "[" + std::to_string(index) + "]\":" + std::string(value));
    ++index;
  }
}

// Divides `member`, "series":{"wrist":{..},..}, into objects of the same keys: between series, and
// within one that is too long for a part of its own.
void addSeries(ObjectParts& parts, std::string_view member, std::size_t colon) {
  const std::string begin = std::string(member.substr(0, colon + 1)) + "{";
  std::string chunk;  // of whole series, or the beginning of one, without its end
  const auto fits = [&](const std::string& text) { return parts.fits(begin + text + "}}"); };
  const auto finish = [&](const char* end) {
    if (!chunk.empty()) parts.add(begin + chunk + end);
    chunk.clear();
  };
  for (const std::string_view series :
       membersOf(member.substr(colon + 2, member.size() - colon - 3))) {
    const std::string whole = (chunk.empty() ? "" : ",") + std::string(series);
    if (fits(chunk + whole)) {
      chunk += whole;
      continue;
    }
    finish("}");
    if (fits(std::string(series))) {
      chunk = series;
      continue;
    }
    const std::size_t open = series.find(":{") + 2;
    const std::string name(series.substr(0, open));
    for (const std::string_view column : membersOf(series.substr(open, series.size() - open - 1))) {
      if (!chunk.empty() && !fits(chunk + "," + std::string(column))) finish("}}");
      chunk += (chunk.empty() ? name : ",") + std::string(column);
    }
    finish("}}");
  }
  finish("}");
}

}  // namespace

std::vector<std::string> signalDatagrams(std::string_view object, std::size_t maxBytes) {
  if (object.size() <= maxBytes || object.size() < 2) return {std::string(object)};
  const std::vector<std::string_view> members = membersOf(object.substr(1, object.size() - 2));
  std::string head = "{";
  for (const std::string_view member : members)
    if (member.starts_with("\"t\":") || member.starts_with("\"sequence\":"))
      head += (head.size() > 1 ? "," : "") + std::string(member);
  ObjectParts parts(std::move(head), maxBytes);
  for (const bool arrays : {true, false}) {
    for (const std::string_view member : members) {
      if (member.starts_with("\"t\":") || member.starts_with("\"sequence\":")) continue;
      const std::size_t colon = member.find("\":") + 1;
      if (member.substr(colon + 1).starts_with('[') != arrays) continue;
      if (arrays && !parts.fits(member))
        addValues(parts, member, colon);
      else if (member.starts_with("\"series\":") && !parts.fits(member))
        addSeries(parts, member, colon);
      else
        parts.add(member);
    }
  }
  return parts.take();
}

std::vector<std::string> tactileDatagrams(const TactileFrame& frame,
                                          std::uint64_t sequence,
                                          std::size_t maxBytes) {
  return tactileSensorMessages(frame, sequence, maxBytes);
}

}  // namespace palpate
