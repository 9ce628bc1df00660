#include "recording/native/palpate_storage.h"

#include <algorithm>

#include "palpate/core/error.h"
#include "palpate/core/first_where.h"

namespace palpate {
namespace {

// From the first to the last item of a block [us]. Unsigned, since a damaged index may claim any
// two times.
std::uint64_t spanUs(const BlockEntry& place) {
  return static_cast<std::uint64_t>(place.t1Us) - static_cast<std::uint64_t>(place.t0Us);
}

// When an item of a block that can't be read was measured, if its items were evenly spaced.
std::int64_t estimatedUs(const BlockEntry& place, std::int64_t item) {
  if (place.n < 2) return place.t0Us;
  const auto steps = static_cast<std::uint64_t>(place.n - 1);
  const auto i = static_cast<std::uint64_t>(item);
  const std::uint64_t sinceFirst = spanUs(place) / steps * i + spanUs(place) % steps * i / steps;
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(place.t0Us) + sinceFirst);
}

}  // namespace

BlockStorage::BlockStorage(std::filesystem::path path, Loader loader)
    : path_(std::move(path)), loader_(std::move(loader)) {}

bool BlockStorage::add(Stream stream, const BlockEntry& place) {
  Entries& entries = streams_[static_cast<std::size_t>(stream)];
  if (place.n < 1 || place.n > static_cast<std::int64_t>(kMaxBlockBytes) ||
      place.first != static_cast<std::int64_t>(entries.numItems) || place.t1Us < place.t0Us ||
      spanUs(place) < static_cast<std::uint64_t>(place.n - 1) ||
      (!entries.places.empty() && place.t0Us <= entries.places.back().t1Us))
    return false;
  entries.places.push_back(place);
  entries.numItems += static_cast<std::size_t>(place.n);
  return true;
}

void BlockStorage::setWidth(Stream stream, std::size_t numValues) {
  streams_[static_cast<std::size_t>(stream)].numValues = numValues;
}

std::int64_t BlockStorage::frameTimeUs(std::size_t frame) const {
  return timeUs(Stream::kTactile, frame);
}

void BlockStorage::readFrame(std::size_t frame, TactileFrame& out) const {
  std::unique_lock lock(mutex_);
  const auto [block, item] = open(Stream::kTactile, frame);
  lock.unlock();  // decoding needs none: the block is ours as long as we hold it
  out.deviceUs = block->index.deviceUs[item];
  readFrameValues(block->block, block->index.begin[item], out);
}

std::optional<std::size_t> BlockStorage::frameAt(std::int64_t timeUs) const {
  return itemAt(Stream::kTactile, timeUs);
}

std::optional<std::size_t> BlockStorage::sampleAt(std::size_t series, std::int64_t timeUs) const {
  return itemAt(streamOfSeries(series), timeUs);
}

std::int64_t BlockStorage::sampleTimeUs(std::size_t series, std::size_t sample) const {
  return timeUs(streamOfSeries(series), sample);
}

Sample BlockStorage::sample(std::size_t series, std::size_t item) const {
  const Stream stream = streamOfSeries(series);
  std::unique_lock lock(mutex_);
  const auto [block, within] = open(stream, item);
  lock.unlock();
  Sample sample{block->index.hostUs[within],
                std::vector<double>(of(stream).numValues),
                series,
                block->index.deviceUs[within]};
  readSampleValues(block->block, block->index.begin[within], sample.values);
  return sample;
}

const BlockEntry& BlockStorage::placeOf(Stream stream, std::size_t item) const {
  const auto& places = of(stream).places;
  const auto after = std::upper_bound(places.begin(),
                                      places.end(),
                                      static_cast<std::int64_t>(item),
                                      [](std::int64_t i, const auto& p) { return i < p.first; });
  return *std::prev(after);
}

// Mostly it is the block that was read last: samples are read one after the other.
const BlockStorage::OpenBlock* BlockStorage::lastWith(Stream stream, std::size_t item) const {
  const OpenBlock* last = last_[static_cast<std::size_t>(stream)].get();
  if (!last || item < last->first || item - last->first >= last->index.begin.size()) return nullptr;
  return last;
}

BlockStorage::OpenItem BlockStorage::open(Stream stream, std::size_t item) const {
  std::shared_ptr<const OpenBlock>& last = last_[static_cast<std::size_t>(stream)];
  if (lastWith(stream, item)) return {last, item - last->first};
  const BlockEntry& place = placeOf(stream, item);
  const std::size_t within = item - static_cast<std::size_t>(place.first);
  const auto* cached = cache_.find(place.id);
  last = cached ? *cached : loaded(stream, place);
  return {last, within};
}

std::shared_ptr<const BlockStorage::OpenBlock> BlockStorage::loaded(Stream stream,
                                                                    const BlockEntry& place) const {
  if (const auto damaged = damaged_.find(place.id); damaged != damaged_.end())
    throw damaged->second;
  auto opened = std::make_shared<OpenBlock>();
  try {
    opened->block = loader_(place.id);
    opened->first = static_cast<std::size_t>(place.first);
    const Block& block = opened->block;
    if (block.stream != stream || block.n != place.n || block.t0Us != place.t0Us ||
        block.t1Us != place.t1Us || !indexBlock(block, of(stream).numValues, opened->index))
      throw FormatError(
          path_,
          "block " + std::to_string(place.id) + " is invalid; 'palpate recover' saves the others");
  } catch (const FormatError& error) {
    damaged_.emplace(place.id, error);
    throw;
  }
  return cache_.add(place.id, opened->block.data.size(), opened);
}

std::shared_ptr<const BlockStorage::OpenBlock> BlockStorage::readable(Stream stream,
                                                                      std::size_t item) const {
  try {
    return open(stream, item).block;
  } catch (const Error&) {
    return nullptr;
  }
}

std::int64_t BlockStorage::timeUs(Stream stream, std::size_t item) const {
  const std::lock_guard lock(mutex_);
  if (const OpenBlock* last = lastWith(stream, item)) return last->index.hostUs[item - last->first];
  const BlockEntry& place = placeOf(stream, item);
  // First and last stamps stand in the index: searching by time opens one block, not twenty.
  if (static_cast<std::int64_t>(item) == place.first) return place.t0Us;
  if (static_cast<std::int64_t>(item) == place.first + place.n - 1) return place.t1Us;
  const std::int64_t within = static_cast<std::int64_t>(item) - place.first;
  if (const auto block = readable(stream, item))
    return block->index.hostUs[static_cast<std::size_t>(within)];
  return estimatedUs(place, within);
}

std::optional<std::size_t> BlockStorage::itemAt(Stream stream, std::int64_t timeUs) const {
  const std::vector<BlockEntry>& places = of(stream).places;
  if (places.empty()) return std::nullopt;
  const auto after = std::upper_bound(
      places.begin(), places.end(), timeUs, [](std::int64_t us, const BlockEntry& place) {
        return us < place.t0Us;
      });
  if (after == places.begin()) return 0;
  const BlockEntry& place = *std::prev(after);
  const auto first = static_cast<std::size_t>(place.first);
  if (timeUs == place.t0Us) return first;
  if (timeUs >= place.t1Us) return first + static_cast<std::size_t>(place.n) - 1;
  const std::lock_guard lock(mutex_);
  const auto block = readable(stream, first);
  const std::size_t later = firstWhere(static_cast<std::size_t>(place.n), [&](std::size_t item) {
    return timeUs < (block ? block->index.hostUs[item]
                           : estimatedUs(place, static_cast<std::int64_t>(item)));
  });
  return first + later - 1;
}

}  // namespace palpate
