// Reads bytes of a file at any place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

#include "palpate/core/file_descriptor.h"

namespace palpate {

class RandomReader {
 public:
  // Throws FileError.
  explicit RandomReader(const std::filesystem::path& path);
  // Fills `bytes` with those from `offset` on. Throws FileError, FormatError (the file ends
  // before).
  void read(std::uint64_t offset, std::span<std::byte> bytes) const;
  std::uint64_t size() const noexcept { return size_; }
  const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
  FileDescriptor file_;
  std::uint64_t size_ = 0;
};

}  // namespace palpate
