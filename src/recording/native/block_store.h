// Intact blocks found while recovering: their index in memory, their data in memory up to a bound,
// then in a nameless temporary file. Private to this module.
#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <map>
#include <memory>
#include <vector>

#include "palpate/recording/palpate_schema.h"

namespace palpate {

class BlockStore {
 public:
  struct StoredBlock {
    std::int64_t n = 0;
    std::int64_t t0Us = 0;
    std::int64_t t1Us = 0;
    std::int64_t id = 0;
  };

  // False: one like it is there already (of two with the same first item the longer one counts).
  // Throws Error where there is no room for a temporary file.
  bool add(const Block& block);
  // By the first item.
  const std::map<std::int64_t, StoredBlock>& stream(Stream stream) const {
    return streams_[static_cast<std::size_t>(stream)];
  }
  bool empty() const;
  Block load(std::int64_t id) const;

 private:
  struct Data {  // of a block
    Stream stream;
    BlockCoding coding;
    std::uint32_t size;
    std::int64_t first;
    std::int64_t begin;  // in memory_, or behind kMemoryBytes: in the file
  };

  std::array<std::map<std::int64_t, StoredBlock>, 3> streams_;
  std::vector<Data> data_;  // by id
  std::vector<std::byte> memory_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_{nullptr, &std::fclose};
  std::int64_t fileBytes_ = 0;
};

}  // namespace palpate
