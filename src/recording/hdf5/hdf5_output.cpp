#include "recording/hdf5/hdf5_output.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/core/file_descriptor.h"
#include "palpate/core/hash.h"

#include "recording/hdf5/hdf5_layout.h"

namespace palpate {
namespace {

// What the driver is told of the file (H5Pset_driver).
struct DriverInfo {
  int descriptor = -1;
  int* error = nullptr;
};

// The library's part of an open file comes first.
struct DriverFile {
  H5FD_t base;
  DriverInfo info;
  haddr_t allocated;
  haddr_t end;  // of what was written
};

DriverFile& driverFileOf(H5FD_t* base) { return *reinterpret_cast<DriverFile*>(base); }
const DriverFile& driverFileOf(const H5FD_t* base) {
  return *reinterpret_cast<const DriverFile*>(base);
}

H5FD_t* openDriverFile(const char*, unsigned, hid_t properties, haddr_t) {
  const auto* info = static_cast<const DriverInfo*>(H5Pget_driver_info(properties));
  if (!info) return nullptr;
  auto* file = new (std::nothrow) DriverFile{};
  if (!file) return nullptr;
  file->info = *info;
  return &file->base;
}

herr_t closeDriverFile(H5FD_t* base) {
  delete &driverFileOf(base);
  return 0;
}

herr_t queryFeatures(const H5FD_t*, unsigned long* flags) {
  if (flags)
    *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
             H5FD_FEAT_AGGREGATE_SMALLDATA;
  return 0;
}

haddr_t allocatedOf(const H5FD_t* base, H5FD_mem_t) { return driverFileOf(base).allocated; }

herr_t setAllocated(H5FD_t* base, H5FD_mem_t, haddr_t address) {
  driverFileOf(base).allocated = address;
  return 0;
}

haddr_t writtenEndOf(const H5FD_t* base, H5FD_mem_t) { return driverFileOf(base).end; }

herr_t readBytes(H5FD_t* base, H5FD_mem_t, hid_t, haddr_t address, std::size_t size, void* buffer) {
  auto* to = static_cast<char*>(buffer);
  while (size > 0) {
    const ssize_t got =
        ::pread(driverFileOf(base).info.descriptor, to, size, static_cast<off_t>(address));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    to += got;
    size -= static_cast<std::size_t>(got);
    address += static_cast<haddr_t>(got);
  }
  std::memset(to, 0, size);  // behind the end
  return 0;
}

// After the first failure nothing is written any more.
herr_t writeBytes(
    H5FD_t* base, H5FD_mem_t, hid_t, haddr_t address, std::size_t size, const void* buffer) {
  DriverFile& file = driverFileOf(base);
  file.end = std::max(file.end, address + size);
  const auto* from = static_cast<const char*>(buffer);
  while (size > 0 && *file.info.error == 0) {
    const ssize_t put = ::pwrite(file.info.descriptor, from, size, static_cast<off_t>(address));
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) *file.info.error = errno;
    if (put <= 0) break;
    from += put;
    size -= static_cast<std::size_t>(put);
    address += static_cast<haddr_t>(put);
  }
  return 0;
}

herr_t truncateFile(H5FD_t* base, hid_t, hbool_t) {
  DriverFile& file = driverFileOf(base);
  if (*file.info.error != 0 || file.end == file.allocated) return 0;
  if (::ftruncate(file.info.descriptor, static_cast<off_t>(file.allocated)) != 0)
    *file.info.error = errno;
  file.end = file.allocated;
  return 0;
}

H5FD_class_t driverClass() {
  H5FD_class_t driver{};
#ifdef H5FD_CLASS_VERSION  // HDF5 1.14; drivers that nobody has registered are numbered from 512
  driver.version = H5FD_CLASS_VERSION;
  driver.value = static_cast<H5FD_class_value_t>(512);
#endif
  driver.name = "palpate_output";
  driver.maxaddr = (haddr_t{1} << 62) - 1;
  driver.fc_degree = H5F_CLOSE_STRONG;
  driver.fapl_size = sizeof(DriverInfo);
  driver.open = &openDriverFile;
  driver.close = &closeDriverFile;
  driver.query = &queryFeatures;
  driver.get_eoa = &allocatedOf;
  driver.set_eoa = &setAllocated;
  driver.get_eof = &writtenEndOf;
  driver.read = &readBytes;
  driver.write = &writeBytes;
  driver.truncate = &truncateFile;
  constexpr H5FD_mem_t kFreeSpace[] = H5FD_FLMAP_DICHOTOMY;
  std::copy(std::begin(kFreeSpace), std::end(kFreeSpace), std::begin(driver.fl_map));
  return driver;
}

// HDF5 locks a file that it writes (flock), so that nobody else reads it.
void refuseWritten(const std::filesystem::path& path, Overwrite overwrite) {
  if (overwrite == Overwrite::kRefuse) return;
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.get() < 0) return;
  if (::flock(file.get(), LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw FileError(path, "is being written by another program");
}

}  // namespace

Hdf5Output::Hdf5Output(const std::filesystem::path& path, Overwrite overwrite)
    : out_((requireWritable(path, overwrite), refuseWritten(path, overwrite), path), overwrite) {
  const auto lock = hdf5Lock();
  static const H5FD_class_t driver = driverClass();
  driver_ = Hdf5Id(H5FDregister(&driver), H5FDunregister);
  const Hdf5Id access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  const Hdf5Id creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  const DriverInfo info{out_.descriptor(), &error_};
  require(driver_.ok() && H5Pset_driver(access.get(), driver_.get(), &info) >= 0 &&
          H5Pset_fclose_degree(access.get(), H5F_CLOSE_STRONG) >= 0 &&
          H5Pset_userblock(creation.get(), hdf5_layout::kUserBlockBytes) >= 0 &&
          // Names of members in the order in which they were made, and no times: the same recording
          // gives the same bytes.
          H5Pset_link_creation_order(creation.get(),
                                     H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED) >= 0);
  file_ = Hdf5Id(H5Fcreate(path.filename().c_str(), H5F_ACC_TRUNC, creation.get(), access.get()),
                 H5Fclose);
  require(file_.ok());
}

void Hdf5Output::requireWritten() const {
  if (error_ != 0) throw FileError(out_.path(), "can't be written: " + writeFailureText(error_));
}

void Hdf5Output::require(bool ok) const {
  requireWritten();
  if (!ok) throw FileError(out_.path(), "can't be written: the HDF5 library refused");
}

void Hdf5Output::commit() {
  require(file_.reset());
  driver_.reset();
  const std::string block = hdf5_layout::userBlock(
      sha256OfDescriptor(out_.descriptor(), hdf5_layout::kUserBlockBytes, out_.path()));
  // As the position of the descriptor never moved, this is written at the beginning.
  out_.write(block);
  out_.commit();
}

}  // namespace palpate
