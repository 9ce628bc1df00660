#include "recording/faulty_vfs.h"

#include <algorithm>

#include <sqlite3.h>

#include "testing/testing.h"

namespace palpate::testing {
namespace {

FaultyVfs* theOne = nullptr;
sqlite3_vfs* under = nullptr;
sqlite3_vfs shim;

struct FaultyFile {
  sqlite3_file base;
  std::string* path;
  sqlite3_file* real() { return reinterpret_cast<sqlite3_file*>(this + 1); }
};

FaultyFile& of(sqlite3_file* file) { return *reinterpret_cast<FaultyFile*>(file); }
sqlite3_file* realOf(sqlite3_file* file) { return of(file).real(); }

int closeFile(sqlite3_file* file) {
  delete of(file).path;
  return realOf(file)->pMethods->xClose(realOf(file));
}
int readFileAt(sqlite3_file* file, void* bytes, int size, sqlite3_int64 offset) {
  theOne->read(size);
  return realOf(file)->pMethods->xRead(realOf(file), bytes, size, offset);
}
int writeFileAt(sqlite3_file* file, const void* bytes, int size, sqlite3_int64 offset) {
  const int code = theOne->write(*of(file).path, static_cast<const char*>(bytes), size, offset);
  return code != SQLITE_OK ? code
                           : realOf(file)->pMethods->xWrite(realOf(file), bytes, size, offset);
}
int truncateFile(sqlite3_file* file, sqlite3_int64 size) {
  const int code = theOne->truncate(*of(file).path, size);
  return code != SQLITE_OK ? code : realOf(file)->pMethods->xTruncate(realOf(file), size);
}
int syncFile(sqlite3_file* file, int) { return theOne->sync(*of(file).path); }
int fileSize(sqlite3_file* file, sqlite3_int64* size) {
  return realOf(file)->pMethods->xFileSize(realOf(file), size);
}
int lockFile(sqlite3_file* file, int level) {
  return realOf(file)->pMethods->xLock(realOf(file), level);
}
int unlockFile(sqlite3_file* file, int level) {
  return realOf(file)->pMethods->xUnlock(realOf(file), level);
}
int checkLock(sqlite3_file* file, int* held) {
  return realOf(file)->pMethods->xCheckReservedLock(realOf(file), held);
}
int control(sqlite3_file* file, int operation, void* argument) {
  return realOf(file)->pMethods->xFileControl(realOf(file), operation, argument);
}
int sectorSize(sqlite3_file* file) { return realOf(file)->pMethods->xSectorSize(realOf(file)); }
int characteristics(sqlite3_file* file) {
  return realOf(file)->pMethods->xDeviceCharacteristics(realOf(file));
}

sqlite3_io_methods methods() {
  sqlite3_io_methods io{};
  io.iVersion = 1;  // no shared memory, no mapping
  io.xClose = closeFile;
  io.xRead = readFileAt;
  io.xWrite = writeFileAt;
  io.xTruncate = truncateFile;
  io.xSync = syncFile;
  io.xFileSize = fileSize;
  io.xLock = lockFile;
  io.xUnlock = unlockFile;
  io.xCheckReservedLock = checkLock;
  io.xFileControl = control;
  io.xSectorSize = sectorSize;
  io.xDeviceCharacteristics = characteristics;
  return io;
}
const sqlite3_io_methods kMethods = methods();

int openFile(sqlite3_vfs*, const char* path, sqlite3_file* file, int flags, int* outFlags) {
  FaultyFile& faulty = of(file);
  const bool isRecording = path && (flags & SQLITE_OPEN_MAIN_DB) != 0;
  if (isRecording) theOne->open(path);
  const int code = under->xOpen(under, path, faulty.real(), flags, outFlags);
  faulty.base.pMethods = code == SQLITE_OK ? &kMethods : nullptr;
  if (code == SQLITE_OK) faulty.path = new std::string(path ? path : "");
  if (code == SQLITE_OK && isRecording) theOne->found(path);
  return code;
}
int deleteFile(sqlite3_vfs*, const char* path, int syncFolder) {
  const int code = theOne->remove(path);
  return code != SQLITE_OK ? code : under->xDelete(under, path, syncFolder);
}

}  // namespace

FaultyVfs::FaultyVfs(bool asDefault) {
  theOne = this;
  under = sqlite3_vfs_find(nullptr);
  shim = *under;
  shim.zName = name();
  shim.pNext = nullptr;
  shim.szOsFile = under->szOsFile + static_cast<int>(sizeof(FaultyFile));
  shim.xOpen = openFile;
  shim.xDelete = deleteFile;
  sqlite3_vfs_register(&shim, asDefault ? 1 : 0);
}

FaultyVfs::~FaultyVfs() {
  sqlite3_vfs_unregister(&shim);
  theOne = nullptr;
}

void FaultyVfs::failAt(Fault fault, std::int64_t operation) {
  fault_ = fault;
  failAt_ = operation;
}

int FaultyVfs::step() {
  if (hook_) hook_();
  ++operations_;
  if (fault_ == Fault::kNone || operations_ < failAt_) return SQLITE_OK;
  const bool once = fault_ == Fault::kFullOnce || fault_ == Fault::kErrorOnce;
  if (once && operations_ > failAt_) return SQLITE_OK;
  struck_ = true;
  return fault_ == Fault::kFull || fault_ == Fault::kFullOnce ? SQLITE_FULL : SQLITE_IOERR_WRITE;
}

void FaultyVfs::found(const std::string& path) {
  if (!files_.contains(path)) files_[path].durable = readFile(path);
}

int FaultyVfs::write(const std::string& path,
                     const char* bytes,
                     std::int64_t size,
                     std::int64_t offset) {
  const bool alreadyOff = struck_ && fault_ == Fault::kPowerCut;
  const int code = step();
  // The write during which the power goes may reach the disk in part.
  if (code == SQLITE_OK || (fault_ == Fault::kPowerCut && !alreadyOff))
    files_[path].unsynced.push_back({offset, std::string(bytes, static_cast<std::size_t>(size))});
  return code;
}

int FaultyVfs::truncate(const std::string& path, std::int64_t size) {
  const int code = step();
  if (code == SQLITE_OK) files_[path].unsynced.push_back({0, {}, size});
  return code;
}

int FaultyVfs::sync(const std::string& path) {
  const int code = step();
  if (code != SQLITE_OK) return code;
  File& file = files_[path];
  for (const Change& change : file.unsynced) apply(file.durable, change);
  file.unsynced.clear();
  return SQLITE_OK;
}

int FaultyVfs::remove(const std::string& path) {
  const int code = step();
  if (code == SQLITE_OK) files_.erase(path);
  return code;
}

void FaultyVfs::apply(std::string& content, const Change& change) {
  if (change.truncateTo >= 0) {
    content.resize(static_cast<std::size_t>(change.truncateTo));
    return;
  }
  const auto begin = static_cast<std::size_t>(change.offset);
  if (content.size() < begin + change.bytes.size()) content.resize(begin + change.bytes.size());
  content.replace(begin, change.bytes.size(), change.bytes);
}

void FaultyVfs::writeRemains(const std::filesystem::path& folder, std::mt19937& random) const {
  for (const auto& [path, file] : files_) {
    std::string content = file.durable;
    const unsigned kind = random() % 4;  // all, none, or any of the changes
    for (Change change : file.unsynced) {
      if (kind == 1 || (kind >= 2 && random() % 2 == 0)) continue;
      if (kind == 3 && random() % 3 == 0 && change.truncateTo < 0)
        change.bytes.resize(std::min<std::size_t>(change.bytes.size(), 512 * (random() % 8)));
      if (change.truncateTo < 0 && change.bytes.empty()) continue;
      apply(content, change);
    }
    writeFile(folder / std::filesystem::path(path).filename(), content);
  }
}

}  // namespace palpate::testing
