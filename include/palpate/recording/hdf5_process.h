// An HDF5 file that the program palpate_hdf5 reads for this process, which links no libhdf5 for
// reading: a file on which the library crashes, hangs or takes too much memory costs one line.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/core/child_program.h>
#include <palpate/core/file_descriptor.h>

namespace palpate {

enum class Hdf5Request : std::uint8_t;  // private to the module

// The types as which numbers are read.
enum class Hdf5Number : std::uint8_t { kU8, kI32, kI64, kF32, kF64 };
constexpr std::size_t sizeOf(Hdf5Number type) noexcept {
  constexpr std::size_t kBytes[] = {1, 4, 8, 4, 8};
  return kBytes[static_cast<std::size_t>(type)];
}

// The axis of an array on which a part of it is read.
enum class Hdf5Axis : std::uint8_t { kFirst, kLast };

enum class Hdf5Kind : std::uint8_t { kInteger, kFloat, kText, kOther };

// What is known of a data set without reading it.
struct Hdf5Facts {
  Hdf5Kind kind = Hdf5Kind::kOther;
  std::string typeName;  // "uint16", "float64", "text", ..
  std::vector<std::uint64_t> shape;
  std::uint64_t chunkLength = 0;  // along the first axis; 0: not chunked
  std::string fault;              // why its values can't be read; empty: nothing is known
};

// What a file is read for, and with that how long a request may take: the window waits for the
// values of a recording, 2 s at most (10 s for what else is asked while it is opened); an import
// waits 60 s.
enum class Hdf5Use { kRecording, kImport };

// Safe from several threads. All functions throw FormatError: the file is damaged, refers to other
// files, or the library could not read it in time. Once it has failed on the file, every later call
// says so.
class Hdf5Process {
 public:
  // Starts the program. `path` is for messages; `descriptor`: of the file, open for reading. Throws
  // FileError when the program can't be started.
  Hdf5Process(std::filesystem::path path, int descriptor, Hdf5Use use);

  const std::filesystem::path& path() const noexcept { return path_; }
  // The data sets that are in this file, by their paths; at most 10,000, and 4 MB of names.
  std::vector<std::string> arrayNames();
  bool has(const std::string& name);
  Hdf5Facts facts(const std::string& name);
  // Reads what has these places on an axis, in C order; numbers out of the range of the type are
  // cut to it.
  void read(const std::string& name,
            std::uint64_t first,
            std::uint64_t count,
            Hdf5Number type,
            std::span<std::byte> out,
            Hdf5Axis axis = Hdf5Axis::kFirst);
  // Returns one or more of the texts first .. first + count - 1. Those longer than `longest` bytes
  // are refused.
  std::vector<std::string> texts(const std::string& name,
                                 std::uint64_t first,
                                 std::uint64_t count,
                                 std::uint64_t longest);
  // The value of an attribute of an object ("": of the file); nothing: there is none of this type.
  std::optional<std::string> textAttribute(const std::string& object,
                                           const std::string& name,
                                           std::uint64_t longest);
  std::optional<std::int64_t> integerAttribute(const std::string& object, const std::string& name);
  std::optional<double> numberAttribute(const std::string& object, const std::string& name);
  // The names of the axes of a data set, as its dimension labels or dimension scales (netCDF) say;
  // one that has none is empty. Empty: no axis has one.
  std::vector<std::string> axisNames(const std::string& name);

 private:
  // The value that is answered.
  std::vector<std::byte> ask(Hdf5Request wanted,
                             const std::string& name,
                             std::string_view rest = {});
  std::vector<std::string> namesAsked(Hdf5Request wanted, const std::string& name);
  // Send or receive all bytes before the deadline. Return false where that can't be.
  bool send(std::string_view bytes);
  bool receive(std::span<std::byte> bytes);
  // Waits until the socket is ready for an event of poll().
  bool waitFor(short event);
  // Ends the program, unless it has ended. `wanted` of `name`: what was asked for.
  [[noreturn]] void throwEnded(Hdf5Request wanted, const std::string& name);
  std::string ending(Hdf5Request wanted, const std::string& name);

  std::filesystem::path path_;
  Hdf5Use use_;
  std::mutex mutex_;
  FileDescriptor socket_;
  std::optional<ChildProgram> program_;
  std::chrono::steady_clock::time_point deadline_;  // of the answer
  bool isLate_ = false;                             // the deadline is over
  std::string fault_;                               // why the program ended; empty: it runs
};

}  // namespace palpate
