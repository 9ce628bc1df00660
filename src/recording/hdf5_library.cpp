#include "recording/hdf5_library.h"

#include <utility>

namespace palpate {
namespace {

std::recursive_mutex& hdf5Mutex() {
  static std::recursive_mutex mutex;
  return mutex;
}

bool writeAttributeOf(
    hid_t object, const char* name, hid_t stored, hid_t memory, hid_t space, const void* value) {
  const Hdf5Id attribute(H5Acreate2(object, name, stored, space, H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose);
  return attribute.ok() && H5Awrite(attribute.get(), memory, value) >= 0;
}

// The attribute, where it is one value of a class of types.
Hdf5Id attributeOf(hid_t object, const char* name, H5T_class_t kind) {
  if (H5Aexists(object, name) <= 0) return {};
  Hdf5Id attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  if (!attribute.ok()) return {};
  const Hdf5Id type(H5Aget_type(attribute.get()), H5Tclose);
  const Hdf5Id space(H5Aget_space(attribute.get()), H5Sclose);
  if (H5Tget_class(type.get()) != kind || H5Sget_simple_extent_npoints(space.get()) != 1) return {};
  return attribute;
}

}  // namespace

std::unique_lock<std::recursive_mutex> hdf5Lock() {
  std::unique_lock lock(hdf5Mutex());
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  return lock;
}

Hdf5Id::Hdf5Id(Hdf5Id&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}

Hdf5Id& Hdf5Id::operator=(Hdf5Id&& other) noexcept {
  reset();
  id_ = std::exchange(other.id_, -1);
  close_ = other.close_;
  return *this;
}

bool Hdf5Id::reset() {
  if (id_ < 0) return true;
  const auto lock = hdf5Lock();
  return close_(std::exchange(id_, -1)) >= 0;
}

Hdf5Id hdf5TextType() {
  Hdf5Id type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), H5T_VARIABLE);
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  return type;
}

std::string hdf5StoredText(const std::string& text) {
  std::string stored;
  for (const char c : text) {
    if (c == '\0')
      stored += "\xC0\x80";
    else if (c == '\xC0')
      stored += "\xC0\x81";
    else
      stored += c;
  }
  return stored;
}

std::string hdf5RestoredText(const std::string& stored) {
  std::string text;
  for (std::size_t i = 0; i < stored.size(); ++i) {
    const bool escaped = stored[i] == '\xC0' && i + 1 < stored.size();
    if (escaped && stored[i + 1] == '\x80')
      text += '\0', ++i;
    else if (escaped && stored[i + 1] == '\x81')
      text += '\xC0', ++i;
    else
      text += stored[i];
  }
  return text;
}

bool writeHdf5Attribute(hid_t object, const char* name, const std::string& text) {
  const Hdf5Id type = hdf5TextType();
  const Hdf5Id space(H5Screate(H5S_SCALAR), H5Sclose);
  const std::string stored = hdf5StoredText(text);
  const char* pointer = stored.c_str();
  return writeAttributeOf(
      object, name, type.get(), type.get(), space.get(), static_cast<const void*>(&pointer));
}

bool writeHdf5Attribute(hid_t object, const char* name, const std::vector<std::string>& texts) {
  if (texts.empty()) return true;
  const Hdf5Id type = hdf5TextType();
  const hsize_t count = texts.size();
  const Hdf5Id space(H5Screate_simple(1, &count, nullptr), H5Sclose);
  std::vector<const char*> pointers;
  for (const std::string& text : texts) pointers.push_back(text.c_str());
  return writeAttributeOf(
      object, name, type.get(), type.get(), space.get(), static_cast<const void*>(pointers.data()));
}

bool writeHdf5Attribute(hid_t object, const char* name, std::int64_t value) {
  const Hdf5Id space(H5Screate(H5S_SCALAR), H5Sclose);
  return writeAttributeOf(object, name, H5T_STD_I64LE, H5T_NATIVE_INT64, space.get(), &value);
}

bool writeHdf5Attribute(hid_t object, const char* name, double value) {
  const Hdf5Id space(H5Screate(H5S_SCALAR), H5Sclose);
  return writeAttributeOf(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, space.get(), &value);
}

std::optional<std::string> readHdf5Text(hid_t object, const char* name, std::size_t mostBytes) {
  const Hdf5Id attribute = attributeOf(object, name, H5T_STRING);
  if (!attribute.ok()) return std::nullopt;
  const Hdf5Id type(H5Aget_type(attribute.get()), H5Tclose);
  const Hdf5Id memory(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_cset(memory.get(), H5Tget_cset(type.get()));
  std::string text;
  if (H5Tis_variable_str(type.get()) > 0) {
    H5Tset_size(memory.get(), H5T_VARIABLE);
    char* pointer = nullptr;
    if (H5Aread(attribute.get(), memory.get(), static_cast<void*>(&pointer)) < 0 || !pointer)
      return std::nullopt;
    text = pointer;
    H5free_memory(pointer);
  } else {
    const std::size_t size = H5Tget_size(type.get());
    if (size > mostBytes) return std::nullopt;
    text.assign(size + 1, '\0');
    H5Tset_size(memory.get(), size + 1);
    if (H5Aread(attribute.get(), memory.get(), text.data()) < 0) return std::nullopt;
    text.resize(text.find('\0'));
  }
  if (text.size() > mostBytes) return std::nullopt;
  return text;
}

std::optional<std::int64_t> readHdf5Integer(hid_t object, const char* name) {
  const Hdf5Id attribute = attributeOf(object, name, H5T_INTEGER);
  std::int64_t value = 0;
  if (!attribute.ok() || H5Aread(attribute.get(), H5T_NATIVE_INT64, &value) < 0)
    return std::nullopt;
  return value;
}

std::optional<double> readHdf5Number(hid_t object, const char* name) {
  const Hdf5Id attribute = attributeOf(object, name, H5T_FLOAT);
  double value = 0.0;
  if (!attribute.ok() || H5Aread(attribute.get(), H5T_NATIVE_DOUBLE, &value) < 0)
    return std::nullopt;
  return value;
}

}  // namespace palpate
