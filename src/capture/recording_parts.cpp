#include "capture/recording_parts.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/json.h"
#include "palpate/core/number_text.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

constexpr std::int64_t kRetryUs = 100'000;
constexpr std::size_t kMaxHeld = 32'768;  // items that wait for a file: 64 MB of frames
constexpr std::int64_t kHeldWithoutFrameUs = 60'000'000;
constexpr std::size_t kMaxDirty = 4096;  // items of one commit
constexpr std::int64_t kCountersUs = 1'000'000;
// Without further frames, the end of the recording is detected after this time.
constexpr std::int64_t kEndGraceUs = 1'000'000;

constexpr int kMaxRelocations = 3;  // in a row, and into the folder in which it was
// Between two copies of a whole part; doubled from one to the next.
constexpr std::int64_t kFirstRestUs = 1'000'000;
constexpr std::int64_t kLongestRestUs = 60'000'000;
// Longer than finishing is tried: a copy that fails there is not made again.
constexpr std::int64_t kRestAtEndUs = 8'000'000;
constexpr std::uint64_t kFreeBeside = 64u << 20;  // bytes that a copy leaves free

bool isThere(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(fs::symlink_status(path, ignored));
}

// The path, or one like it in the same folder, for which `taken` is false.
template <typename Taken>
fs::path freePathLike(const fs::path& path, Taken taken) {
  fs::path free = path;
  for (int i = 1; taken(free); ++i) {
    free = path.parent_path() / path.stem();
    free += "_continued" + (i == 1 ? std::string() : std::to_string(i));
    free += path.extension();
  }
  return free;
}

// Where a recording goes on when its folder is gone or can't be written.
std::vector<fs::path> usualEmergencyFolders() {
  std::vector<fs::path> folders;
  if (const char* home = std::getenv("HOME"); home && *home) folders.emplace_back(home);
  std::error_code none;
  if (const fs::path temporary = fs::temp_directory_path(none); !none) folders.push_back(temporary);
  return folders;
}

// Nobody but the recorder can have what is in it.
bool isLost(const PalpateWriter& part) { return part.isGone() || part.isUnreadable(); }

std::int64_t microseconds(double seconds) {
  return static_cast<std::int64_t>(std::llround(seconds * 1e6));
}

}  // namespace

bool isReservedMeta(std::string_view key) noexcept {
  constexpr std::array<std::string_view, 9> kReserved{"format",
                                                      "finished",
                                                      "value_type",
                                                      "frames",
                                                      "angle_samples",
                                                      "temperature_samples",
                                                      "seconds",
                                                      "part",
                                                      "part_of"};
  return std::find(kReserved.begin(), kReserved.end(), key) != kReserved.end();
}

RecordingParts::RecordingParts(RecordingOptions options,
                               const RecorderOptions& recorder,
                               RoundTime start,
                               const Clock& clock,
                               Notice notice)
    : options_(std::move(options)),
      commitIntervalUs_(static_cast<std::int64_t>(recorder.commitIntervalMs * 1000.0)),
      vfs_(recorder.vfs),
      emergencyFolders_(recorder.emergencyFolders.empty() ? usualEmergencyFolders()
                                                          : recorder.emergencyFolders),
      freeBytes_(recorder.freeBytes ? recorder.freeBytes : freeBytesOf),
      start_(start),
      clock_(clock),
      notice_(std::move(notice)),
      base_(options_.path),
      folder_(base_.has_parent_path() ? base_.parent_path() : fs::path(".")),
      contact_(options_.contact),
      armed_(options_.startOnContact) {
  if (options_.mcap) mcap_ = std::make_unique<McapMirror>(*options_.mcap, options_.mcapQueueItems);
}

// Keeps the items of the time before a contact, with which the recording then begins.
void RecordingParts::awaitContact(const CaptureItem& item, RoundTime time) {
  if (!leavesRoom(item, before_.size(), kMaxHeld)) return;
  before_.push_back(item);
  const auto* frame = std::get_if<SharedFrame>(&item);
  // A contact from before the request counts if it is still there.
  if (frame && (*frame)->hostUs >= start_.nowUs) contact_->add(**frame);
  if (const auto contactUs = contact_->firstContactUs()) {
    armed_ = false;
    start_ = {time.monoUs, *contactUs, time.sinceMonoUs};
    contact_.emplace(options_.contact);
    for (const CaptureItem& waiting : std::exchange(before_, {})) add(waiting, time);
    return;
  }
  const std::int64_t fromUs =
      std::min(stampOf(item), contact_->touchingSinceUs().value_or(INT64_MAX)) -
      microseconds(options_.preTriggerS);
  while (stampOf(before_.front()) < fromUs || before_.size() > kMaxHeld) before_.pop_front();
}

// Sets the end when nothing has been touched for long enough.
void RecordingParts::endAfterRelease(const TactileFrame& frame) {
  contact_->add(frame);
  const auto releasedUs = contact_->releasedUs();
  if (!releasedUs) return;
  const std::int64_t endUs = *releasedUs + microseconds(*options_.stopWithoutContactS);
  if (frame.hostUs >= endUs) endUs_ = endUs_ ? std::min(*endUs_, endUs) : endUs;
}

// True if the item is between the begin of the pre-trigger time and the end; detects the end.
bool RecordingParts::belongs(const CaptureItem& item) {
  const std::int64_t stampUs = stampOf(item);
  if (ended_ || stampUs < start_.nowUs - microseconds(options_.preTriggerS)) return false;
  const bool isFrame = streamOf(item) == CaptureStream::kTactile;
  if (isFrame && stampUs >= start_.nowUs && framesSinceStart_ == 0 && options_.stopAfterS)
    endUs_ = stampUs + microseconds(*options_.stopAfterS);
  if (isFrame && stampUs >= start_.nowUs && options_.stopWithoutContactS)
    endAfterRelease(*std::get<SharedFrame>(item));
  if (endUs_ && stampUs >= *endUs_) {
    ended_ = isFrame;  // items of the other port may be ahead
    return false;
  }
  if (isFrame && stampUs >= start_.nowUs) {
    ++framesSinceStart_;
    // This frame is the last one.
    if (options_.stopAfterFrames && framesSinceStart_ == *options_.stopAfterFrames)
      endUs_ = stampUs + 1;
  }
  return true;
}

void RecordingParts::add(const CaptureItem& item, RoundTime time) {
  if (armed_) return awaitContact(item, time);
  if (!belongs(item)) return;
  const auto* frame = std::get_if<SharedFrame>(&item);
  if (!writer_) {
    hold(item);
    if (frame && time.monoUs >= nextTryMonoUs_) open(time);
    return;
  }
  take(item, time);
}

// Adds the item to its part, which is a new one when the open part is full or has another layout.
void RecordingParts::take(const CaptureItem& item, RoundTime time) {
  if (const auto* frame = std::get_if<SharedFrame>(&item)) {
    if (splitDue(**frame)) split(**frame, time);
    // A part describes which taxels are scanned, so it can't contain a frame of another layout.
    if (isOfOtherLayout(**frame)) return recordLoss(item);
  }
  write(item, time);
}

void RecordingParts::hold(const CaptureItem& item) {
  if (!leavesRoom(item, held_.size(), kMaxHeld)) {
    if (frameHeld_) recordLoss(item);
    return;
  }
  frameHeld_ = frameHeld_ || streamOf(item) == CaptureStream::kTactile;
  held_.push_back(item);
  // Before the first frame nothing is recorded yet: old angles may be dropped.
  while (!frameHeld_ && stampOf(held_.front()) < stampOf(item) - kHeldWithoutFrameUs)
    held_.pop_front();
  if (held_.size() <= kMaxHeld) return;
  recordLoss(held_.front());
  held_.pop_front();
}

std::unique_ptr<PalpateWriter> RecordingParts::makeWriter(
    const std::shared_ptr<const SensorLayout>& layout) {
  RecordingMeta meta = options_.meta;
  if (options_.describe)
    for (const auto& [key, value] : options_.describe())
      if (!isReservedMeta(key)) meta.insert_or_assign(key, value);
  // An existing file is skipped: nothing is ever replaced.
  while (isThere(partPath(base_, nextPart_)) ||
         (mcap_ && isThere(mcapPathOf(partPath(base_, nextPart_)))))
    ++nextPart_;
  const fs::path path = partPath(base_, nextPart_);
  if (!paths_.empty()) {
    meta["part"] = std::to_string(paths_.size() + 1);
    meta["part_of"] = paths_.front().filename().string();
  }
  PalpateWriterOptions writerOptions;
  writerOptions.commitIntervalUs = INT64_MAX;  // this class commits by itself, by the clock
  writerOptions.vfs = vfs_;
  writerOptions.notesBaselines = true;
  auto writer = std::make_unique<PalpateWriter>(path, layout, meta, writerOptions);
  ++nextPart_;
  paths_.push_back(path);
  if (mcap_) mcap_->begin(mcapPathOf(path), layout, meta);
  for (const std::size_t index : inFile_) {
    writer->addSeries(further_[index].description);
    if (mcap_) mcap_->addSeries(kHandSeries + index, further_[index].description);
  }
  return writer;
}

// Adds the series whose columns are known by now to the open part, and so to those that follow.
void RecordingParts::learnSeries() {
  if (!options_.series) return;
  const std::vector<SeriesDescription> all = options_.series();
  if (further_.size() < all.size()) further_.resize(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    FurtherSeries& series = further_[i];
    if (series.indexInFile) continue;
    series.description = all[i];
    if (all[i].columns.empty()) continue;
    try {
      series.indexInFile = writer_->addSeries(all[i]);
    } catch (const std::invalid_argument& error) {  // its samples are refused
      refusedWhy_ = error.what();
      continue;
    }
    inFile_.push_back(i);
    if (mcap_) mcap_->addSeries(kHandSeries + i, all[i]);
  }
}

// Opens a part with the layout of the first waiting frame.
void RecordingParts::open(RoundTime time) {
  const auto first = std::find_if(held_.begin(), held_.end(), [](const CaptureItem& item) {
    return streamOf(item) == CaptureStream::kTactile;
  });
  if (first == held_.end()) return;
  const std::shared_ptr<const SensorLayout> layout = std::get<SharedFrame>(*first)->layout;
  const fs::path base = base_, folder = folder_;
  std::string failure;
  for (auto next = emergencyFolders_.begin(); !writer_; ++next) {
    try {
      writer_ = makeWriter(layout);
    } catch (const std::exception& error) {  // of the disk, or a sensor that can't be recorded
      if (failure.empty()) failure = error.what();
      if (isThere(folder) || next == emergencyFolders_.end()) {
        base_ = base;
        folder_ = folder;
        return onCommitFailed(failure, time);
      }
      leaveFolder(*next);
    }
  }
  if (!failure.empty())
    noteRelocation(failure + "; it is recorded in " + paths_.back().string(), time);
  layout_ = layout;
  lastCounters_.clear();
  learnSeries();
  for (const CaptureItem& item : std::exchange(held_, {})) take(item, time);
  onCommitSucceeded(time);
  commit(time);  // the file contains the items from its first moment on
}

bool RecordingParts::isOfOtherLayout(const TactileFrame& frame) const {
  return frame.layout != layout_ && !(*frame.layout == *layout_);
}

bool RecordingParts::splitDue(const TactileFrame& frame) const {
  if (isOfOtherLayout(frame)) return true;  // another sensor, or other masks
  if (!partHasFrames_ || closing_) return false;
  if (options_.splitS && frame.hostUs >= partFirstUs_ + microseconds(*options_.splitS)) return true;
  return options_.splitBytes && writer_->bytesOnDisk() >= *options_.splitBytes;
}

void RecordingParts::split(const TactileFrame& frame, RoundTime time) {
  if (time.monoUs < nextTryMonoUs_ || !closeOldPart(time)) return;
  try {
    writePendingEvents();  // first: after a failure no new part may exist yet
    std::unique_ptr<PalpateWriter> next = makeWriter(frame.layout);
    closing_ = std::exchange(writer_, std::move(next));
    closingLayout_ = std::exchange(layout_, frame.layout);
    uncommittedBefore_ = std::exchange(uncommitted_, {});
    partHasFrames_ = false;
    dirtySinceMonoUs_.reset();
    dirtyItems_ = 0;
    lastCounters_.clear();
  } catch (const std::exception& error) {
    return onCommitFailed(error.what(), time);  // continues in the old part
  }
  closeOldPart(time);
}

bool RecordingParts::succeeds(std::unique_ptr<PalpateWriter>& part,
                              RoundTime time,
                              const std::function<void()>& work) {
  for (int relocations = 0;; ++relocations) {
    try {
      work();
      return true;
    } catch (const FileError& error) {
      if (relocations < kMaxRelocations && isMended(part, error.what(), time)) continue;
      const bool isKept = !isLost(*part) || whyNotKept_.empty();
      onCommitFailed(isKept ? error.what() : error.what() + ("; " + whyNotKept_), time);
      return false;
    }
  }
}

// Gives a part whose file is gone or was overwritten a file again.
bool RecordingParts::isMended(std::unique_ptr<PalpateWriter>& part,
                              const std::string& why,
                              RoundTime time) {
  if (!isLost(*part)) return false;
  const std::int64_t monoUs = clock_.monotonicUs();
  const bool rests = monoUs < nextRelocationMonoUs_ && (!finishing_ || relocationFailed_);
  if (rests) return false;
  // One that was left alone for long begins anew.
  if (monoUs >= nextRelocationMonoUs_ + 2 * kLongestRestUs) restUs_ = relocationsHere_ = 0;
  Kept kept = part->isUnreadable() ? Kept::kUnreadable : keepElsewhere(*part, why, time, {});
  if (kept == Kept::kUnreadable && goesOnAnew(part, why, time)) kept = Kept::kWhole;
  relocationFailed_ = kept != Kept::kWhole;
  if (!relocationFailed_) whyNotKept_.clear();
  restUs_ = std::clamp(
      2 * restUs_, finishing_ && relocationFailed_ ? kRestAtEndUs : kFirstRestUs, kLongestRestUs);
  // A copy may have taken longer than a round.
  nextRelocationMonoUs_ = clock_.monotonicUs() + restUs_;
  return !relocationFailed_;
}

// Where a part goes on that can't stay as it is in its folder: there, unless its files vanish there
// time and again, or in an emergency folder.
std::vector<fs::path> RecordingParts::foldersAfter(const fs::path& own) const {
  std::vector<fs::path> folders = emergencyFolders_;
  folders.insert(relocationsHere_ < kMaxRelocations ? folders.begin() : folders.end(), own);
  return folders;
}

// Gives a part whose file was deleted, renamed or replaced a file again, with all that it
// contained, under its own name where that is free.
RecordingParts::Kept RecordingParts::keepElsewhere(PalpateWriter& part,
                                                   const std::string& why,
                                                   RoundTime time,
                                                   const std::optional<fs::path>& wanted) {
  const fs::path before = part.path();
  const fs::path own = before.parent_path();
  const auto size = static_cast<std::uint64_t>(part.bytesOnDisk());
  for (const fs::path& next : wanted ? std::vector{*wanted} : foldersAfter(own)) {
    const auto freeNow = freeBytes_(next.empty() ? "." : next);
    if (freeNow && *freeNow < size + kFreeBeside) {
      whyNotKept_ = next.string() + ": no room there for the whole recording";
      continue;
    }
    const fs::path kept = freePathLike(next / before.filename(), isThere);
    try {
      part.moveTo(kept);
    } catch (const FormatError& error) {
      whyNotKept_ = error.what();
      return Kept::kUnreadable;
    } catch (const std::exception& error) {  // no such folder, not writable, no space
      whyNotKept_ = error.what();
      continue;
    }
    relocationsHere_ = next == own ? relocationsHere_ + 1 : 0;
    if (next != own) leaveFolder(next);
    *std::find(paths_.begin(), paths_.end(), before) = kept;
    ++counts_.writeFailures;
    noteRelocation(why + "; all that was recorded is in " + kept.string() + " now", time);
    return Kept::kWhole;
  }
  return Kept::kNowhere;
}

// Begins a new part for what the disk has not got of one whose file can't be read any more. False:
// nothing has changed.
bool RecordingParts::goesOnAnew(std::unique_ptr<PalpateWriter>& part,
                                const std::string& why,
                                RoundTime time) {
  const fs::path base = base_, folder = folder_;
  const std::int64_t lost = part->framesOnDisk();
  for (const fs::path& next : foldersAfter(folder_)) {
    try {
      if (next != folder_) leaveFolder(next);
      replace(part);
      ++counts_.writeFailures;
      const std::string told =
          why + "; " + std::to_string(lost) + " frames that were in it are lost";
      noteRelocation(told + ", and it continues in " + part->path().string(), time);
      return true;
    } catch (const std::exception& error) {
      whyNotKept_ = error.what();
      base_ = base;
      folder_ = folder;
    }
  }
  return false;
}

// Further parts go into another folder.
void RecordingParts::leaveFolder(const fs::path& folder) {
  base_ = freeBaseIn(folder);
  folder_ = folder;
}

void RecordingParts::noteRelocation(std::string text, RoundTime time) {
  relocation_ = std::move(text);
  addOwn({time.nowUs, time.nowUs, "alarm", {}, relocation_, ""});
}

void RecordingParts::noteFinished(const fs::path& path) {
  if (const auto file = fileIdOf(path)) finished_.emplace_back(path, *file);
}

bool RecordingParts::closeOldPart(RoundTime time) {
  if (!closing_) return true;
  if (!succeeds(closing_, time, [this] { closing_->finish(); })) return false;
  framesInOldParts_ += closing_->framesOnDisk();
  bytesInOldParts_ += closing_->bytesOnDisk();
  noteFinished(closing_->path());
  closing_.reset();
  uncommittedBefore_.clear();
  return true;
}

void RecordingParts::write(const CaptureItem& item, RoundTime time) {
  try {
    const auto* sample = std::get_if<Sample>(&item);
    const bool isFurther = sample && sample->series >= kHandSeries;
    if (isFurther && (sample->series - kHandSeries >= further_.size() ||
                      !further_[sample->series - kHandSeries].indexInFile))
      learnSeries();
    if (isFurther && isRemoved(sample->series - kHandSeries)) return;
    writeTo(item);
  } catch (const FileError&) {  // commits have failed until the memory limit was reached
    return recordLoss(item);
  } catch (const std::invalid_argument& error) {
    ++counts_.refused;
    refusedWhy_ = error.what();
    return;
  }
  if (mcap_) mcap_->add(item);
  endLossInterval(static_cast<std::size_t>(streamOf(item)));
  ++dirtyItems_;
  if (!dirtySinceMonoUs_) dirtySinceMonoUs_ = time.sinceMonoUs;
}

// A sample from before the recording, of a series that was removed before it.
bool RecordingParts::isRemoved(std::size_t index) const {
  return index < further_.size() && further_[index].description.name.empty();
}

void RecordingParts::append(PalpateWriter& writer, const CaptureItem& item) const {
  if (const auto* frame = std::get_if<SharedFrame>(&item)) return writer.addFrame(**frame);
  if (const auto* event = std::get_if<Event>(&item)) {
    if (event->kind != kBaselineKind) writer.addEvent(*event);  // the writer notes its own
    return;
  }
  const auto& sample = std::get<Sample>(item);
  if (sample.series < kHandSeries) return writer.addSample(sample);
  const std::size_t index = sample.series - kHandSeries;
  if (index >= further_.size() || !further_[index].indexInFile)
    throw std::invalid_argument("there is no series " + std::to_string(sample.series));
  Sample inFile = sample;
  inFile.series = *further_[index].indexInFile;
  writer.addSample(inFile);
}

void RecordingParts::writeTo(const CaptureItem& item) {
  append(*writer_, item);
  keepUncommitted(item);
  switch (streamOf(item)) {
    case CaptureStream::kTactile: {
      const std::int64_t stampUs = stampOf(item);
      if (!partHasFrames_) partFirstUs_ = stampUs;
      partHasFrames_ = true;
      intervals_.add(stampUs);
      ++counts_.frames;
      break;
    }
    case CaptureStream::kAngles:
      ++counts_.angles;
      break;
    case CaptureStream::kTemperatures:
      ++counts_.temperatures;
      break;
    case CaptureStream::kEvents:
      ++counts_.events;
      break;
    default: {
      FurtherSeries& series = further_[std::get<Sample>(item).series - kHandSeries];
      series.lastUs = stampOf(item);
      if (series.samples++ == 0) series.firstUs = series.lastUs;
      ++counts_.samples;
    }
  }
}

void RecordingParts::keepUncommitted(const CaptureItem& item) {
  if (!leavesRoom(item, uncommitted_.size(), kMaxHeld)) return;
  uncommitted_.push_back(item);
  if (uncommitted_.size() <= kMaxHeld) return;
  if (streamOf(uncommitted_.front()) == CaptureStream::kTactile) {
    const std::int64_t stampUs = stampOf(uncommitted_.front());
    if (!forgottenFrames_) forgottenFrames_ = CaptureLoss{stampUs, stampUs, 0};
    forgottenFrames_->lastUs = stampUs;
    ++forgottenFrames_->count;
  }
  uncommitted_.pop_front();
}

// Puts a new part in the present folder, with what the disk has not got, in place of an open one.
// Throws FileError: nothing has changed then, but a file whose start failed may remain.
void RecordingParts::replace(std::unique_ptr<PalpateWriter>& part) {
  const bool isLast = &part == &writer_;
  std::deque<CaptureItem>& items = isLast ? uncommitted_ : uncommittedBefore_;
  const std::size_t numPaths = paths_.size();
  const int partBefore = nextPart_;
  std::unique_ptr<PalpateWriter> next;
  try {
    next = makeWriter(isLast ? layout_ : closingLayout_);
    for (const CaptureItem& item : items) append(*next, item);
    next->commit();
  } catch (const std::exception&) {
    paths_.resize(numPaths);
    nextPart_ = partBefore;
    throw;
  }
  items.clear();
  paths_.pop_back();
  const auto old = std::find(paths_.begin(), paths_.end(), part->path());
  if (isLost(*part)) {
    // Nobody has what was in it.
    counts_.lost += part->framesOnDisk();
    counts_.frames -= part->framesOnDisk();
    if (isLast && part->framesOnDisk() > 0)
      addOwn(
          gapEvent(CaptureStream::kTactile,
                   {partFirstUs_, committedUs_, static_cast<std::uint64_t>(part->framesOnDisk())},
                   "its file was overwritten or can't be read"));
    *old = next->path();
  } else {
    framesInOldParts_ += part->framesOnDisk();
    bytesInOldParts_ += part->bytesOnDisk();
    abandoned_.push_back(part->path());
    paths_.insert(std::next(old), next->path());
  }
  part->abandon();
  part = std::move(next);
  if (!isLast) return;
  dirtySinceMonoUs_.reset();
  dirtyItems_ = 0;
  lastCounters_.clear();
  if (const auto loss = std::exchange(forgottenFrames_, {})) {
    counts_.lost += static_cast<std::int64_t>(loss->count);
    counts_.frames -= static_cast<std::int64_t>(loss->count);
    addOwn(gapEvent(CaptureStream::kTactile, *loss, "the disk could not be written"));
  }
}

// A recording of the same name that is there already would take the continuation for its next part.
fs::path RecordingParts::freeBaseIn(const fs::path& folder) const {
  // In the same folder, however it is written, it is the next part.
  std::error_code missing;
  if (folder == folder_ || fs::equivalent(folder, folder_, missing)) return base_;
  return freePathLike(folder / base_.filename(), [this](const fs::path& path) {
    return isThere(path) || (mcap_ && isThere(mcapPathOf(path)));
  });
}

void RecordingParts::continueIn(const fs::path& folder, RoundTime time) {
  nextTryMonoUs_ = time.monoUs;
  // Nobody else has a file that is gone: it goes on whole, or stays as it is. It is left only where
  // it can't be read any more.
  bool movesClosing = closing_ != nullptr;
  bool movesWriter = writer_ != nullptr;
  for (auto& [part, moves] :
       {std::pair(&closing_, &movesClosing), std::pair(&writer_, &movesWriter)}) {
    if (!*part || !(*part)->isGone() || (*part)->isUnreadable()) continue;
    const Kept kept =
        keepElsewhere(**part, error_.empty() ? "the recording is gone" : error_, time, folder);
    if (kept == Kept::kNowhere) return onCommitFailed(whyNotKept_, time);
    *moves = kept == Kept::kUnreadable;
  }
  const fs::path base = base_, folderBefore = folder_;
  const int partBefore = nextPart_;
  base_ = freeBaseIn(folder);
  folder_ = folder;
  if (!writer_ || movesClosing || movesWriter) nextPart_ = 1;
  if (!writer_) {
    if (frameHeld_) open(time);
    return;
  }
  try {
    if (movesClosing) replace(closing_);
    if (movesWriter) replace(writer_);
  } catch (const std::exception& error) {
    // A part whose start failed is left behind, unfinished and without anything that is missing
    // here.
    base_ = base;
    folder_ = folderBefore;
    nextPart_ = partBefore;
    return onCommitFailed(error.what(), time);
  }
  if (movesWriter) onCommitSucceeded(time);
  if (closeOldPart(time) && !movesWriter) commit(time);
}

void RecordingParts::recordLoss(const CaptureItem& item) {
  ++counts_.lost;
  if (const auto* sample = std::get_if<Sample>(&item); sample && sample->series >= kHandSeries) {
    const std::size_t index = sample->series - kHandSeries;
    if (further_.size() <= index) further_.resize(index + 1);
    ++further_[index].lost;
  }
  std::optional<CaptureLoss>& loss = losses_.at(static_cast<std::size_t>(streamOf(item)));
  const std::int64_t stampUs = stampOf(item);
  if (!loss) loss = CaptureLoss{stampUs, stampUs, 0};
  loss->lastUs = stampUs;
  ++loss->count;
}

void RecordingParts::endLossInterval(std::size_t stream) {
  std::optional<CaptureLoss>& loss = losses_.at(stream);
  if (!loss) return;
  std::vector<std::string> names(kHandSeries);
  for (const FurtherSeries& series : further_) names.push_back(series.description.name);
  addOwn(
      gapEvent(static_cast<CaptureStream>(stream), *loss, "the disk could not be written", names));
  loss.reset();
}

void RecordingParts::endLossIntervals() {
  for (std::size_t stream = 0; stream < kCaptureStreams; ++stream) endLossInterval(stream);
}

void RecordingParts::addOwn(Event event) {
  if (notice_) notice_(event);
  unwrittenEvents_.push_back(std::move(event));
}

// What is missing at the end has no end that the device would tell in time.
void RecordingParts::addOpenGaps(RoundTime time) {
  if (!options_.openGaps || std::exchange(gapsTaken_, true)) return;
  for (Event& gap : options_.openGaps(std::min(time.nowUs, endUs_.value_or(time.nowUs)))) {
    const bool isOfFrames =
        gap.json.empty() || !Json::parse(gap.json).contains("stream");  // made by this program
    if (isOfFrames)
      counts_.openGapS = std::max(counts_.openGapS, static_cast<double>(gap.t1Us - gap.tUs) / 1e6);
    unwrittenEvents_.push_back(std::move(gap));
  }
}

void RecordingParts::writePendingEvents() {
  while (!unwrittenEvents_.empty()) {
    // Throws while the disk is full; the event then stays pending.
    writer_->addEvent(unwrittenEvents_.front());
    keepUncommitted(unwrittenEvents_.front());
    if (mcap_) mcap_->add(unwrittenEvents_.front());
    ++counts_.events;
    ++dirtyItems_;
    unwrittenEvents_.erase(unwrittenEvents_.begin());
  }
}

void RecordingParts::updateCounters(RoundTime time) {
  countersMonoUs_ = time.monoUs;
  std::map<std::string, std::int64_t> counters;
  if (options_.counters) counters = options_.counters();
  counters["recorder_lost"] = counts_.lost;
  counters["recorder_refused"] = counts_.refused;
  for (const auto& [name, value] : counters) {
    const auto last = lastCounters_.find(name);
    if (last != lastCounters_.end() && last->second == value) continue;
    writer_->setCounter(name, value);
    lastCounters_[name] = value;
  }
  counts_.counters = std::move(counters);
}

void RecordingParts::lookAfterMcap(RoundTime time) {
  if (!mcap_) return;
  mcap_->flushWhenDue(time.monoUs);
  const std::string failure = mcap_->takeFailure();
  if (failure.empty()) return;
  mcapFailure_ = failure;
  addOwn({time.nowUs,
          time.nowUs,
          "alarm",
          {},
          "the MCAP file stopped, the recording continues: " + failure,
          ""});
}

void RecordingParts::round(RoundTime time) {
  lookAfterMcap(time);
  if (closing_ && time.monoUs >= nextTryMonoUs_ && closeOldPart(time)) onCommitSucceeded(time);
  if (!writer_) {
    if (frameHeld_ && time.monoUs >= nextTryMonoUs_) open(time);
    return;
  }
  if (options_.stopAfterBytes && bytesOnDisk() >= *options_.stopAfterBytes) ended_ = true;
  const bool due = (dirtySinceMonoUs_ && time.monoUs - *dirtySinceMonoUs_ >= commitIntervalUs_) ||
                   dirtyItems_ >= kMaxDirty || !unwrittenEvents_.empty();
  const bool commits = due && time.monoUs >= nextTryMonoUs_;
  // Updated with every commit: losses before a frame are on disk as soon as the frame is.
  if (commits || !countersMonoUs_ || time.monoUs - *countersMonoUs_ >= kCountersUs)
    updateCounters(time);
  if (commits) commit(time);
}

void RecordingParts::commit(RoundTime time) {
  const bool done = succeeds(writer_, time, [this] {
    commitWriter();
    // Only now the disk has room for pending events.
    if (!unwrittenEvents_.empty()) {
      writePendingEvents();
      commitWriter();
    }
  });
  if (!done) return;
  dirtySinceMonoUs_.reset();
  dirtyItems_ = 0;
  if (!closing_) onCommitSucceeded(time);
}

void RecordingParts::commitWriter() {
  writer_->commit();
  committedUs_ = intervals_.lastUs();
  uncommitted_.clear();
  forgottenFrames_.reset();
}

void RecordingParts::onCommitFailed(const std::string& what, RoundTime time) {
  ++counts_.writeFailures;
  nextTryMonoUs_ = time.monoUs + kRetryUs;
  error_ = what;
  if (failingSince_) return;
  failingSince_ = time;
  if (notice_) notice_({time.nowUs, time.nowUs, "alarm", {}, "writing failed: " + what, ""});
}

void RecordingParts::onCommitSucceeded(RoundTime time) {
  if (!failingSince_) return;
  const double seconds = static_cast<double>(time.monoUs - failingSince_->monoUs) / 1e6;
  addOwn({failingSince_->nowUs,
          time.nowUs,
          "alarm",
          {},
          "writing failed for " + fixedText(seconds, 1) + " s and works again: " + error_,
          ""});
  failingSince_.reset();
  error_.clear();
}

bool RecordingParts::ended(RoundTime time) const {
  return ended_ || (endUs_ && time.nowUs >= *endUs_ + kEndGraceUs);
}

bool RecordingParts::finish(RoundTime time) {
  // One attempt at the end, whatever came before.
  if (!std::exchange(finishing_, true)) relocationFailed_ = false;
  if (!writer_ && frameHeld_) open(time);
  if (!writer_) {
    unfinished_ = frameHeld_;
    return !frameHeld_;
  }
  if (!closeOldPart(time)) return !(unfinished_ = true);
  addOpenGaps(time);
  const bool done = succeeds(writer_, time, [&] {
    commitWriter();
    onCommitSucceeded(time);
    endLossIntervals();
    writePendingEvents();
    updateCounters(time);
  });
  // An event of this moment can't be in the file any more.
  if (!done || !succeeds(writer_, time, [this] { writer_->finish(); }))
    return !(unfinished_ = true);
  noteFinished(writer_->path());
  if (mcap_) {
    mcap_->finish();
    const std::string failure = mcap_->takeFailure();
    if (!failure.empty()) mcapFailure_ = failure;
  }
  unfinished_ = false;
  return true;
}

std::int64_t RecordingParts::bytesOnDisk() const {
  return bytesInOldParts_ + (closing_ ? closing_->bytesOnDisk() : 0) +
         (writer_ ? writer_->bytesOnDisk() : 0);
}

std::int64_t RecordingParts::framesOnDisk() const {
  return framesInOldParts_ + (closing_ ? closing_->framesOnDisk() : 0) +
         (writer_ ? writer_->framesOnDisk() : 0);
}

// The open parts that end with this object: nobody can find what is in them.
std::vector<const PalpateWriter*> RecordingParts::vanishing() const {
  std::vector<const PalpateWriter*> parts;
  for (const PalpateWriter* part : {closing_.get(), writer_.get()})
    if (part && isLost(*part)) parts.push_back(part);
  return parts;
}

void RecordingParts::describe(RecorderStatus& status) const {
  using State = RecorderStatus::State;
  status.state = armed_ ? State::kArmed : paths_.empty() ? State::kWaiting : State::kRecording;
  status.path = paths_.empty() ? options_.path : paths_.back();
  status.parts = static_cast<int>(paths_.size());
  status.stopAfterS = options_.stopAfterS;
  status.frames = counts_.frames;
  status.angles = counts_.angles;
  status.temperatures = counts_.temperatures;
  status.samples = counts_.samples;
  status.series = recordedSeries();
  status.firstFrameUs = intervals_.firstUs();
  status.lastFrameUs = intervals_.lastUs();
  status.recordedS = intervals_.durationS();
  status.framesOnDisk = framesOnDisk();
  status.bytesOnDisk = bytesOnDisk();
  status.lost = counts_.lost + lostByQueues();
  status.refused = counts_.refused;
  status.writeError = error_;
  status.relocation = relocation_;
  status.mcapFailure = mcapFailure_;
}

std::int64_t RecordingParts::lostByQueues() const {
  return static_cast<std::int64_t>(
      std::accumulate(lostInQueues_.begin(), lostInQueues_.end(), std::uint64_t{0}));
}

std::vector<RecordedSeries> RecordingParts::recordedSeries() const {
  std::vector<RecordedSeries> recorded;
  for (std::size_t i = 0; i < further_.size(); ++i) {
    const FurtherSeries& series = further_[i];
    const auto lost = static_cast<std::int64_t>(lostInQueues_[1 + kHandSeries + i]) + series.lost;
    if (isRemoved(i) && lost == 0) continue;
    const double seconds = static_cast<double>(series.lastUs - series.firstUs) / kUsPerS;
    recorded.push_back({series.description.name,
                        series.samples,
                        lost,
                        seconds > 0.0 ? static_cast<double>(series.samples - 1) / seconds : 0.0});
  }
  return recorded;
}

// Which parts are unfinished elsewhere.
std::string RecordingParts::abandonedText() const {
  std::string text = abandoned_.front().filename().string();
  if (abandoned_.size() > 1) text += " and " + std::to_string(abandoned_.size() - 1) + " more";
  const fs::path folder = abandoned_.front().parent_path();
  return text + " could not be finished in " + (folder.empty() ? "." : folder.string()) +
         ", where it was begun: 'palpate recover' finishes it; " +
         paths_.back().filename().string() + " in " + paths_.back().parent_path().string() +
         " continues it";
}

RecordingReport RecordingParts::report() const {
  RecordingReport report = counts_;
  report.paths = paths_;
  // What is told is there.
  std::string missing;
  for (const auto& [path, file] : finished_) {
    if (leadsTo(path, file)) continue;
    missing = path.string() + " was moved, deleted or replaced after it was finished";
    std::erase(report.paths, path);
  }
  std::erase_if(report.paths, [](const fs::path& path) { return !isThere(path); });
  const auto vanished = unfinished_ ? vanishing() : std::vector<const PalpateWriter*>();
  report.series = recordedSeries();
  report.lost += lostByQueues();
  report.gaps = intervals_.gaps();
  report.gapsS = intervals_.gapsS();
  report.firstFrameUs = intervals_.firstUs();
  report.lastFrameUs = intervals_.lastUs();
  report.durationS = intervals_.durationS();
  report.rateHz = intervals_.rateHz();
  report.meanRateHz = intervals_.meanRateHz();
  report.bytes = bytesOnDisk();
  for (const PalpateWriter* part : vanished) {
    std::erase(report.paths, part->path());
    report.bytes -= part->bytesOnDisk();
  }
  if (mcap_) report.mcapPaths = mcap_->paths();
  report.mcapFailure = mcapFailure_;
  if (unfinished_) {
    // What waited in memory for the disk is gone.
    std::int64_t onDisk = framesOnDisk();
    for (const PalpateWriter* part : vanished) onDisk -= part->framesOnDisk();
    report.lost += counts_.frames - onDisk;
    report.frames = onDisk;
    report.message =
        error_ + (!vanished.empty()
                      ? "; it could not be kept elsewhere"
                      : "; what was written before is safe: 'palpate recover' finishes the file");
  } else if (report.lost > 0)
    report.message = std::to_string(report.lost) + " items were lost; the gap events show where" +
                     (relocation_.empty() ? "" : "; " + relocation_);
  else if (report.refused > 0)
    report.message = std::to_string(report.refused) + " items were refused: " + refusedWhy_;
  else if (paths_.empty())
    report.message = armed_ ? "nothing was touched" : "no frame arrived";
  else if (!missing.empty())
    report.message = missing;
  else if (!relocation_.empty())
    report.message = relocation_;
  else if (!abandoned_.empty())
    report.message = abandonedText();
  report.nothingTouched = armed_ && paths_.empty();
  report.complete = report.message.empty();
  return report;
}

}  // namespace palpate
