// An SQLite file system that fails on demand: the disk fills up, writes go wrong, the power goes.
// It stands on the default one and knows for every file what has been synced and what has not.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace palpate::testing {

class FaultyVfs {
 public:
  enum class Fault {
    kNone,
    kFull,       // "disk full" from the n-th operation on
    kFullOnce,   // at the n-th operation only
    kError,      // input/output error from the n-th operation on
    kErrorOnce,  // at the n-th operation only
    kPowerCut,   // from the n-th operation on nothing reaches the disk
  };

  // Registers itself under name(); one at a time. Readers, which choose no file system, use it only
  // as the default one.
  explicit FaultyVfs(bool asDefault = false);
  ~FaultyVfs();
  FaultyVfs(const FaultyVfs&) = delete;
  FaultyVfs& operator=(const FaultyVfs&) = delete;
  static const char* name() { return "palpate_faulty"; }

  // Operations are writes, truncations, syncs and deletions; they count from 1.
  void failAt(Fault fault, std::int64_t operation);
  void heal() { fault_ = Fault::kNone; }
  // Called at the begin of every operation, by the thread that writes: a slow disk.
  void setHook(std::function<void()> hook) { hook_ = std::move(hook); }
  // Called at every read, which is no operation.
  void setReadHook(std::function<void(std::int64_t size)> hook) { readHook_ = std::move(hook); }
  // Called just before a recording is opened, which is no operation.
  void setOpenHook(std::function<void(const std::string& path)> hook) {
    openHook_ = std::move(hook);
  }
  std::int64_t operations() const { return operations_; }
  bool struck() const { return struck_; }

  // What the disk holds after the power cut: of each file what was synced, and any part of what
  // came since, in any combination, torn at multiples of 512 bytes. Written to `folder`.
  void writeRemains(const std::filesystem::path& folder, std::mt19937& random) const;

  // Of one open file, called by the file system. What was in it before counts as synced.
  void found(const std::string& path);
  int write(const std::string& path, const char* bytes, std::int64_t size, std::int64_t offset);
  int truncate(const std::string& path, std::int64_t size);
  int sync(const std::string& path);
  int remove(const std::string& path);
  void open(const std::string& path) const {
    if (const auto hook = openHook_) hook(path);  // which may set another one
  }
  void read(std::int64_t size) const {
    if (readHook_) readHook_(size);
  }

 private:
  struct Change {
    std::int64_t offset = 0;
    std::string bytes;
    std::int64_t truncateTo = -1;
  };
  struct File {
    std::string durable;
    std::vector<Change> unsynced;
  };
  int step();  // counts an operation; an SQLite error code where it fails
  static void apply(std::string& content, const Change& change);

  std::function<void()> hook_;
  std::function<void(std::int64_t)> readHook_;
  std::function<void(const std::string&)> openHook_;
  Fault fault_ = Fault::kNone;
  std::int64_t failAt_ = 0;
  std::int64_t operations_ = 0;
  bool struck_ = false;
  std::map<std::string, File> files_;
};

}  // namespace palpate::testing
