#include "palpate/interop/datagrams.h"

#include <utility>

namespace palpate {
namespace {

struct Member {
  std::string_view text;
  std::span<const JsonMember> inside;  // its own members or values
};

// The members of an object, or values of an array, that is a part of `object`.
std::vector<Member> membersOf(const Member& whole, std::string_view object) {
  std::vector<Member> members;
  const auto end =
      static_cast<std::size_t>(whole.text.data() - object.data()) + whole.text.size() - 1;
  for (std::size_t i = 0, next = 0; i < whole.inside.size(); i = next) {
    const auto& [depth, begin] = whole.inside[i];
    for (next = i + 1; next < whole.inside.size() && whole.inside[next].depth > depth;) ++next;
    const std::size_t memberEnd = next < whole.inside.size() ? whole.inside[next].begin - 1 : end;
    members.push_back(
        {object.substr(begin, memberEnd - begin), whole.inside.subspan(i + 1, next - i - 1)});
  }
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
  // The next member begins another part.
  void next() {
    if (part_.size() > head_.size()) finish();
  }
  std::vector<std::string> take() {
    next();
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
void addValues(ObjectParts& parts, const Member& member, std::string_view object) {
  const std::string key(member.text.substr(0, member.text.find("\":")));  // without its last quote
  std::size_t index = 0;
  for (const Member& value : membersOf(member, object)) {
    if (value.text != "null")
      parts.add(key + "[" + std::to_string(index) + "]\":" + std::string(value.text));
    ++index;
  }
}

// Divides `member`, "series":{"wrist":{..},..}, into objects of the same keys: between series, and
// within one that is too long for a part of its own.
void addSeries(ObjectParts& parts, const Member& member, std::string_view object) {
  const std::string begin(member.text.substr(0, member.text.find('{') + 1));
  std::string chunk;  // of whole series, or the beginning of one, without its end
  const auto fits = [&](const std::string& text) { return parts.fits(begin + text + "}}"); };
  bool isFirst = true;
  const auto finish = [&](const char* end) {
    if (chunk.empty()) return;
    if (!std::exchange(isFirst, false)) parts.next();  // a key stands once in an object
    parts.add(begin + chunk + end);
    chunk.clear();
  };
  for (const Member& series : membersOf(member, object)) {
    const std::string whole = (chunk.empty() ? "" : ",") + std::string(series.text);
    if (fits(chunk + whole)) {
      chunk += whole;
      continue;
    }
    finish("}");
    if (fits(std::string(series.text))) {
      chunk = series.text;
      continue;
    }
    const std::string name(series.text.substr(0, series.text.find('{') + 1));
    for (const Member& column : membersOf(series, object)) {
      const std::string text(column.text);
      if (!chunk.empty() && !fits(chunk + "," + text)) finish("}}");
      chunk += (chunk.empty() ? name : ",") + text;
    }
    finish("}}");
  }
  finish("}");
}

}  // namespace

std::vector<std::string> signalDatagrams(std::string_view object,
                                         std::span<const JsonMember> members,
                                         std::size_t maxBytes) {
  if (object.size() <= maxBytes) return {std::string(object)};
  const std::vector<Member> all = membersOf({object, members}, object);
  const auto isInAll = [](const Member& member) {
    return member.text.starts_with("\"t\":") || member.text.starts_with("\"sequence\":");
  };
  std::string head = "{";
  for (const Member& member : all)
    if (isInAll(member)) head += (head.size() > 1 ? "," : "") + std::string(member.text);
  ObjectParts parts(std::move(head), maxBytes);
  for (const bool arrays : {true, false}) {
    for (const Member& member : all) {
      if (isInAll(member) || member.text.ends_with(']') != arrays) continue;
      if (arrays && !parts.fits(member.text))
        addValues(parts, member, object);
      else if (member.text.starts_with("\"series\":") && !parts.fits(member.text))
        addSeries(parts, member, object);
      else
        parts.add(member.text);
    }
  }
  return parts.take();
}

}  // namespace palpate
