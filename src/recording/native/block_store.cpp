#include "recording/native/block_store.h"

#include <algorithm>

#include <unistd.h>

#include "palpate/core/error.h"

namespace palpate {
namespace {

constexpr std::int64_t kMemoryBytes = 32 << 20;

}  // namespace

bool BlockStore::add(const Block& block) {
  auto& stream = streams_[static_cast<std::size_t>(block.stream)];
  const auto known = stream.find(block.first);
  const bool isNew = known == stream.end();
  if (!isNew && known->second.n >= block.n) return false;
  const auto size = static_cast<std::int64_t>(block.data.size());
  std::int64_t begin = static_cast<std::int64_t>(memory_.size());
  if (begin + size <= kMemoryBytes && !file_) {
    memory_.insert(memory_.end(), block.data.begin(), block.data.end());
  } else {
    if (!file_) file_.reset(std::tmpfile());
    if (!file_ ||
        ::pwrite(fileno(file_.get()), block.data.data(), block.data.size(), fileBytes_) != size)
      throw Error("no space for temporary files");
    begin = kMemoryBytes + fileBytes_;
    fileBytes_ += size;
  }
  const auto id = static_cast<std::int64_t>(data_.size());
  data_.push_back({block.stream,
                   block.coding,
                   static_cast<std::uint32_t>(block.data.size()),
                   block.first,
                   begin});
  stream.insert_or_assign(block.first, StoredBlock{block.n, block.t0Us, block.t1Us, id});
  return isNew;
}

bool BlockStore::empty() const {
  return std::all_of(streams_.begin(), streams_.end(), [](const auto& s) { return s.empty(); });
}

Block BlockStore::load(std::int64_t id) const {
  const Data& data = data_.at(static_cast<std::size_t>(id));
  const StoredBlock& place = stream(data.stream).at(data.first);
  Block block{data.stream, data.first, place.n, place.t0Us, place.t1Us, data.coding, {}};
  block.data.resize(data.size);
  if (data.begin < kMemoryBytes)
    std::copy_n(memory_.begin() + data.begin, data.size, block.data.begin());
  else if (::pread(fileno(file_.get()), block.data.data(), data.size, data.begin - kMemoryBytes) !=
           static_cast<ssize_t>(data.size))
    throw Error("a temporary file can't be read");
  return block;
}

}  // namespace palpate
