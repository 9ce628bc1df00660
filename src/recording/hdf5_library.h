// What every source that uses HDF5 shares: one lock, identifiers that close themselves, texts and
// attributes. Debian's library is not made for threads: each call of it is made under the lock.
// Private to this module.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <hdf5.h>

namespace palpate {

// Keeps other threads out of the library; a thread may take it several times. Errors of the library
// are not printed: callers report them.
std::unique_lock<std::recursive_mutex> hdf5Lock();

// Owns an identifier of the library; the lock is taken to give it back.
class Hdf5Id {
 public:
  using Close = herr_t (*)(hid_t);
  Hdf5Id() = default;
  Hdf5Id(hid_t id, Close close) : id_(id), close_(close) {}
  ~Hdf5Id() { reset(); }
  Hdf5Id(Hdf5Id&& other) noexcept;
  Hdf5Id& operator=(Hdf5Id&& other) noexcept;
  hid_t get() const noexcept { return id_; }
  bool ok() const noexcept { return id_ >= 0; }
  // Returns false when the library could not close it (nothing to close: true).
  bool reset();

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

// The type of texts of any length, in UTF-8.
Hdf5Id hdf5TextType();
// HDF5 ends a text at its first NUL. A text of bytes is stored as it is unless it has a NUL or a
// byte C0, which UTF-8 never has: they become C0 80 and C0 81.
std::string hdf5StoredText(const std::string& text);
std::string hdf5RestoredText(const std::string& stored);

// Write an attribute of an object; false: the library refused. An empty text is stored as well.
bool writeHdf5Attribute(hid_t object, const char* name, const std::string& text);
bool writeHdf5Attribute(hid_t object, const char* name, const std::vector<std::string>& texts);
bool writeHdf5Attribute(hid_t object, const char* name, std::int64_t value);
bool writeHdf5Attribute(hid_t object, const char* name, double value);

// The value of an attribute; nothing where there is none of that type, or a text is longer than
// `mostBytes`.
std::optional<std::string> readHdf5Text(hid_t object, const char* name, std::size_t mostBytes);
std::optional<std::int64_t> readHdf5Integer(hid_t object, const char* name);
std::optional<double> readHdf5Number(hid_t object, const char* name);

}  // namespace palpate
