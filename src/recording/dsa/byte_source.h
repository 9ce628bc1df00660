// Where the bytes of a recording come from. Private to this module.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

#include "palpate/core/file_descriptor.h"

namespace palpate {

// A file, or memory.
class ByteSource {
 public:
  virtual ~ByteSource() = default;
  // Fills `out` from the current position; fewer bytes only at the end, 0 = nothing left.
  // Throws FileError.
  virtual std::size_t read(std::span<char> out) = 0;
  // Reads from the first byte again. Throws FileError.
  virtual void rewind() = 0;
  virtual std::uint64_t numBytes() const noexcept = 0;
};

// A regular file. Throws FileError: missing, no permission, a folder, not a file.
class FileSource final : public ByteSource {
 public:
  explicit FileSource(const std::filesystem::path& path);
  std::size_t read(std::span<char> out) override;
  void rewind() override;
  std::uint64_t numBytes() const noexcept override { return numBytes_; }

 private:
  std::filesystem::path path_;
  FileDescriptor descriptor_;
  std::uint64_t numBytes_ = 0;
};

// Bytes that outlive the source.
class MemorySource final : public ByteSource {
 public:
  explicit MemorySource(std::span<const std::byte> bytes) noexcept : bytes_(bytes) {}
  std::size_t read(std::span<char> out) override;
  void rewind() override { position_ = 0; }
  std::uint64_t numBytes() const noexcept override { return bytes_.size(); }

 private:
  std::span<const std::byte> bytes_;
  std::size_t position_ = 0;
};

}  // namespace palpate
