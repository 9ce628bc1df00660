// Lines whose values have labels: "A0:1,A1:2", all of a frame in a line, or a line for each. The
// labels say which values they are; where they don't, the order of the first frame does.
#include <algorithm>
#include <array>
#include <numeric>
#include <string>

#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/device/stream_lines.h"

#include "device/line_tokens.h"

namespace palpate {
namespace {

using namespace line_tokens;

constexpr std::size_t kLongestLabel = 64;
// Of other values between those of a frame with a line for each.
constexpr std::size_t kMaxOtherLabels = 16;

// "A" of "A12".
std::string_view wordOfLabel(std::string_view label) {
  return label.substr(0, label.find_last_not_of("0123456789") + 1);
}

// The unit that the label of a time names; empty: it is no time.
std::optional<StreamTime> timeOfLabel(std::string_view label) {
  constexpr std::array<std::pair<std::string_view, StreamTime>, 10> kTimes{
      {{"t", StreamTime::kAuto},
       {"time", StreamTime::kAuto},
       {"timestamp", StreamTime::kAuto},
       {"s", StreamTime::kSeconds},
       {"seconds", StreamTime::kSeconds},
       {"ms", StreamTime::kMilliseconds},
       {"millis", StreamTime::kMilliseconds},
       {"time_ms", StreamTime::kMilliseconds},
       {"us", StreamTime::kMicroseconds},
       {"micros", StreamTime::kMicroseconds}}};
  for (const auto& [name, unit] : kTimes)
    if (label == name) return unit;
  return std::nullopt;
}

}  // namespace

// Reads "LABEL:VALUE, .." into lineLabels_ and numbers_. Returns false when it was refused.
bool StreamLineParser::readPairs(std::string_view line) {
  lineLabels_.clear();
  const char* at = line.data();
  const char* const end = at + line.size();
  while (at != end) {
    const std::string_view token = tokenAt(at, end);
    const std::size_t colon = token.find(':');
    const std::string_view label = token.substr(0, colon);
    if (colon == std::string_view::npos || label.empty() || label.size() > kLongestLabel) {
      const bool isItem = lineLabels_.empty() && (token == "angles" || token == "temperatures");
      refuse(inQuotes(token) + (isItem ? " are read without labels, in the order of the hand's"
                                       : " has no label, as the other values have"));
      return false;
    }
    double value = 0.0;
    const char* const number = skipBlanks(at + colon + 1, end);
    const char* const stop = readNumber(number, end, value);
    if (stop == nullptr) {
      refuse("the value of " + inQuotes(label) + " is " + inQuotes(tokenAt(number, end)) +
             ", not a number");
      return false;
    }
    if (lineLabels_.empty()) firstNumber_ = {number, static_cast<std::size_t>(stop - number)};
    if (lineLabels_.size() < numbers_.size()) numbers_[lineLabels_.size()] = value;
    lineLabels_.push_back(label);
    at = skipBlanks(stop, end);
    if (at != end && (*at == ',' || *at == ';')) at = skipBlanks(at + 1, end);
  }
  return true;
}

void StreamLineParser::readLabelled(std::string_view line, const Sink& sink) {
  if (!readPairs(line)) return;
  const std::size_t count = lineLabels_.size();
  constexpr auto kFrame = StreamItemKind::kFrame;
  StreamItem item;
  const bool withTime = hasTime(shape_.fits(kFrame, count), shape_.fits(kFrame, count - 1));
  if (!shape_.fits(kFrame, count - (withTime ? 1 : 0)))
    return refuse(counted(count, "value") + " with labels instead of " + shape_.expected(kFrame));
  if (!hasUsualLength(labelledLength_, count)) return;
  if (withTime) {
    const std::optional<StreamTime> unit = timeOfLabel(lineLabels_.front());
    if (!unit)
      return refuse("one value more than the hand has, and the first is " +
                    inQuotes(lineLabels_.front()) + "; a time is called t, time, s, ms or us");
    const StreamTime chosen = options_.time == StreamTime::kAuto ? *unit : options_.time;
    if (!readTime(chosen, count, /*beginsFrame=*/true, item)) return;
  }
  const std::size_t from = withTime ? 1 : 0;
  if (!labelsLearned_) {
    labels_.assign(lineLabels_.begin() + static_cast<std::ptrdiff_t>(from), lineLabels_.end());
    if (!learnLabels(false)) return;
  }
  if (!isOfFrames(labels_.front(), labelsNamed_, /*mayWait=*/false, sink)) return;
  takeLabelled(from, item, sink);
}

// Takes labels_ as those of the values, if they can be. Where the first lines may lack the
// beginning of a frame only the labels themselves say the places, and a frame begins with the first
// one.
bool StreamLineParser::learnLabels(bool mayBeInside) {
  placeOf_.clear();
  std::string why;
  for (std::size_t i = 0; i < labels_.size() && why.empty(); ++i)
    if (!placeOf_.emplace(labels_[i], i).second)
      why = "the label " + inQuotes(labels_[i]) + " is there twice";
  if (why.empty()) labelsNamed_ = findPlacesOfLabels(labels_, valueOf_);
  if (why.empty() && !labelsNamed_ && mayBeInside)
    why = "the order of the values is not known: send all of a frame in one line";
  if (why.empty() && !labelsNamed_ && options_.placesOfLabels)
    note("the labels (" + inQuotes(labels_.front()) + " to " + inQuotes(labels_.back()) +
         ") don't say which taxel each is: they are taken in the order of the first frame; send "
         "names of the matrices and numbers");
  if (!why.empty()) {
    forgetLabels();
    refuse(why);
    return false;
  }
  knownLabels_.clear();
  for (std::size_t i = 0; i < labels_.size(); ++i) knownLabels_.emplace(labels_[i], valueOf_[i]);
  if (mayBeInside) orderByNumbers();
  labelsLearned_ = true;
  labelSeen_.assign(labels_.size(), false);
  numLabelsSeen_ = 0;
  return true;
}

// A frame begins with the label of its first value.
void StreamLineParser::orderByNumbers() {
  for (auto& [label, i] : placeOf_) labels_[i = valueOf_[i]] = label;
  std::iota(valueOf_.begin(), valueOf_.end(), 0);
}

// Finds the value that each label stands for. Returns whether the labels themselves say it: then
// the reversed order has the same places. Labels that were there before keep their places.
bool StreamLineParser::findPlacesOfLabels(const std::vector<std::string>& labels,
                                          std::vector<std::size_t>& places) {
  places.clear();
  std::vector<std::string> guessed;
  if (options_.placesOfLabels) {
    std::vector<std::string> ignored;
    places = options_.placesOfLabels(labels, guessed);
    std::vector<std::size_t> reversed =
        options_.placesOfLabels({labels.rbegin(), labels.rend()}, ignored);
    std::ranges::reverse(reversed);
    if (places.size() == labels.size() && places == reversed) {
      for (const std::string& text : guessed) note(text);
      return true;
    }
  }
  if (knownLabels_.size() == labels.size() && std::ranges::all_of(labels, [&](const auto& label) {
        return knownLabels_.contains(label);
      })) {
    places.clear();
    for (const std::string& label : labels) places.push_back(knownLabels_.at(label));
    return true;
  }
  if (places.size() == labels.size()) return false;
  places.resize(labels.size());
  std::iota(places.begin(), places.end(), 0);
  return false;
}

std::optional<std::size_t> StreamLineParser::placeOfLabel(std::string_view label,
                                                          std::size_t likely) const {
  if (likely < labels_.size() && labels_[likely] == label) return likely;
  const auto found = placeOf_.find(label);
  if (found == placeOf_.end()) return std::nullopt;
  return found->second;
}

void StreamLineParser::forgetLabels() {
  labels_.clear();
  placeOf_.clear();
}

// Delivers the frame of a line; its first value is that of label `from`.
void StreamLineParser::takeLabelled(std::size_t from, StreamItem& item, const Sink& sink) {
  const std::size_t count = lineLabels_.size() - from;
  if (count != labels_.size())
    return refuse(counted(count, "value") + " with labels instead of " +
                  std::to_string(labels_.size()) + ", as before");
  labelSeen_.assign(count, false);
  numLabelsSeen_ = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string_view label = lineLabels_[from + i];
    const auto place = placeOfLabel(label, i);
    if (!place || labelSeen_[*place])
      return refuse("the label " + inQuotes(label) +
                    (place ? " is there twice" : " was not in the first frame"));
    labelSeen_[*place] = true;
    values_[valueOf_[*place]] = static_cast<float>(numbers_[from + i]);
  }
  labelSeen_.assign(count, false);
  deliverFrame(item, count, sink);
}

// Takes one of the values of a frame with a line for each.
void StreamLineParser::takeLabel(std::string_view label, double value, const Sink& sink) {
  if (label.size() > kLongestLabel) return refuse("a label is longer than 64 bytes");
  if (!labelsLearned_ && !endsFirstLabels(label, sink)) {
    if (labels_.size() == shape_.numPlaces() + kMaxOtherLabels) return dropLabels();
    partValues_.resize(shape_.numPlaces() + kMaxOtherLabels);
    partValues_[labels_.size()] = static_cast<float>(value);
    placeOf_.emplace(label, labels_.size());
    labels_.emplace_back(label);
    return;
  }
  partValues_.resize(shape_.numPlaces());
  const std::optional<std::size_t> place = placeOfLabel(label, numLabelsSeen_);
  if (!place) return refuse("the label " + inQuotes(label) + " was not in the first frame");
  if (numLabelsSeen_ > 0 && (*place == 0 || labelSeen_[*place])) {
    refuse("a frame of " + counted(numLabelsSeen_, "value") + " with labels instead of " +
           std::to_string(labels_.size()));
    labelSeen_.assign(labels_.size(), false);
    numLabelsSeen_ = 0;
  }
  if (numLabelsSeen_ == 0 && *place != 0) {
    // The end of the frame that was being sent when the port was opened is no fault.
    if (stats_.items > 0) refuse(inQuotes(label) + " came before the first value of its frame");
    return;
  }
  labelSeen_[*place] = true;
  partValues_[valueOf_[*place]] = static_cast<float>(value);
  if (++numLabelsSeen_ < labels_.size()) return;
  labelSeen_.assign(labels_.size(), false);
  numLabelsSeen_ = 0;
  values_ = partValues_;
  StreamItem item;
  deliverFrame(item, labels_.size(), sink);
}

// Whether this label was there before, so that those between are the labels of a frame. Then the
// first frame is delivered.
bool StreamLineParser::endsFirstLabels(std::string_view label, const Sink& sink) {
  if (!placeOfLabel(label, 0)) return false;
  if (!shape_.fits(StreamItemKind::kFrame, labels_.size()) && !leaveOutOtherLabels()) {
    dropLabels();
    return false;
  }
  if (!learnLabels(options_.startsInside)) return false;
  if (labelsNamed_) noteOwnFrames();
  if (options_.startsInside || beginsInside()) return true;
  for (std::size_t i = 0; i < labels_.size(); ++i) values_[valueOf_[i]] = partValues_[i];
  StreamItem item;
  deliverFrame(item, labels_.size(), sink);
  return true;
}

// Leaves out the labels that stand alone, as "temp" does among "A0" to "A5", if the others are as
// many as a frame has values.
bool StreamLineParser::leaveOutOtherLabels() {
  std::map<std::string_view, std::size_t> numOfWord;
  for (const std::string& label : labels_) ++numOfWord[wordOfLabel(label)];
  const auto isAlone = [&](const std::string& label) { return numOfWord[wordOfLabel(label)] == 1; };
  const auto numAlone = static_cast<std::size_t>(std::ranges::count_if(labels_, isAlone));
  if (!shape_.fits(StreamItemKind::kFrame, labels_.size() - numAlone)) return false;
  std::vector<std::string> kept;
  placeOf_.clear();
  for (std::size_t i = 0; i < labels_.size(); ++i) {
    if (isAlone(labels_[i])) {
      refuse("the label " + inQuotes(labels_[i]) + " is not one of those of the frame");
      continue;
    }
    partValues_[kept.size()] = partValues_[i];
    placeOf_.emplace(labels_[i], kept.size());
    kept.push_back(labels_[i]);
  }
  labels_ = std::move(kept);
  return true;
}

// Whether the labels of the first frame show that the input began within one, as a pipe from a port
// does: they count from another value than the first one to the last one, and then from the first
// one on. Then a frame begins with its first value, and the part before it is refused.
bool StreamLineParser::beginsInside() {
  const std::size_t count = labels_.size();
  const std::size_t first = valueOf_.front();
  if (first == 0 || !labelsNamed_) return false;
  for (std::size_t i = 0; i < count; ++i)
    if (valueOf_[i] != (first + i) % count) return false;
  refuse("a frame of " + counted(count - first, "value") + " with labels instead of " +
         std::to_string(count));
  std::rotate(partValues_.begin(),
              partValues_.begin() + static_cast<std::ptrdiff_t>(count - first),
              partValues_.begin() + static_cast<std::ptrdiff_t>(count));
  orderByNumbers();
  numLabelsSeen_ = first;
  std::fill_n(labelSeen_.begin(), first, true);
  return true;
}

// Refuses the labels that were collected: they are not as many as a frame has values.
void StreamLineParser::dropLabels() {
  if (labelsLearned_ || labels_.empty()) return;
  refuse(counted(labels_.size(), "value") + " with labels instead of " +
         shape_.expected(StreamItemKind::kFrame));
  forgetLabels();
}

}  // namespace palpate
