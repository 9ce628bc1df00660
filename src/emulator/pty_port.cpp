// The pseudo-terminal behind openPtyPort().
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <termios.h>
#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/core/file_descriptor.h"
#include "palpate/emulator/port_server.h"

namespace palpate {
namespace {
namespace fs = std::filesystem;

// True if `link` is a symbolic link to a pty or to nothing, so that it may be replaced.
bool mayBeReplaced(const fs::path& link) {
  struct stat own {};
  if (::lstat(link.c_str(), &own) != 0 || !S_ISLNK(own.st_mode)) return false;
  struct stat target {};
  if (::stat(link.c_str(), &target) != 0) return true;
  constexpr unsigned kFirstPtsMajor = 136, kLastPtsMajor = 143;
  return S_ISCHR(target.st_mode) && major(target.st_rdev) >= kFirstPtsMajor &&
         major(target.st_rdev) <= kLastPtsMajor;
}

void makeLink(const std::string& target, const fs::path& link) {
  if (::symlink(target.c_str(), link.c_str()) == 0) return;
  if (errno != EEXIST)
    throw FileError(link, std::string("can't be created: ") + std::strerror(errno));
  if (!mayBeReplaced(link))
    throw FileError(link, "exists and isn't a link to a port: choose another name, or remove it");
  const fs::path aside = link.string() + ".new" + std::to_string(::getpid());
  if (::symlink(target.c_str(), aside.c_str()) != 0)
    throw FileError(link, std::string("can't be created: ") + std::strerror(errno));
  if (::rename(aside.c_str(), link.c_str()) != 0) {
    const int error = errno;
    ::unlink(aside.c_str());
    throw FileError(link, std::string("can't be replaced: ") + std::strerror(error));
  }
}

class PtyPort final : public PortServer {
 public:
  explicit PtyPort(fs::path link) : link_(std::move(link)) {
    if (!link_.empty()) link_ = fs::absolute(link_);
    plug();
  }
  ~PtyPort() override { unplug(); }
  PtyPort(const PtyPort&) = delete;
  PtyPort& operator=(const PtyPort&) = delete;

  const std::string& name() const noexcept override { return name_; }
  int descriptor() const noexcept override { return master_.get(); }
  bool connected() const noexcept override { return master_.get() >= 0; }

  std::size_t read(std::span<std::byte> into) override {
    if (master_.get() < 0) return 0;
    const ssize_t n = ::read(master_.get(), into.data(), into.size());
    return n > 0 ? static_cast<std::size_t>(n) : 0;
  }

  std::size_t write(std::span<const std::byte> bytes) override {
    if (master_.get() < 0) return 0;
    const ssize_t n = ::write(master_.get(), bytes.data(), bytes.size());
    return n > 0 ? static_cast<std::size_t>(n) : 0;
  }

  void unplug() noexcept override {
    if (!link_.empty() && !target_.empty()) {
      std::array<char, 256> now{};
      const ssize_t n = ::readlink(link_.c_str(), now.data(), now.size());
      // Another emulator may have replaced the link.
      if (n > 0 && target_.compare(0, std::string::npos, now.data(), static_cast<size_t>(n)) == 0)
        ::unlink(link_.c_str());
    }
    target_.clear();
    slave_ = FileDescriptor();
    master_ = FileDescriptor();
  }

  void plug() override {
    if (master_.get() >= 0) return;
    try {
      open();
    } catch (...) {
      unplug();
      throw;
    }
  }

  // TIOCEXCL outlives the client that set it, because this process holds the terminal open. A
  // running client also holds the lock (as our driver does), or uses neither.
  void releaseStaleLock() noexcept override {
    int exclusive = 0;
    if (slave_.get() < 0 || ::ioctl(slave_.get(), TIOCGEXCL, &exclusive) != 0 || exclusive == 0)
      return;
    if (::flock(slave_.get(), LOCK_EX | LOCK_NB) != 0) return;
    ::ioctl(slave_.get(), TIOCNXCL);
    ::flock(slave_.get(), LOCK_UN);
  }

 private:
  [[noreturn]] void fail(const char* what) const {
    throw DeviceError(DeviceFault::kDisconnected,
                      link_.empty() ? "pseudo-terminal" : link_.string(),
                      std::string(what) + ": " + std::strerror(errno));
  }

  void open() {
    master_ = FileDescriptor(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK));
    if (master_.get() < 0 || ::grantpt(master_.get()) != 0 || ::unlockpt(master_.get()) != 0)
      fail("no pseudo-terminal is available");
    std::array<char, 128> path{};
    if (::ptsname_r(master_.get(), path.data(), path.size()) != 0)
      fail("a terminal without a name");
    // Held open, so that the port sees no hang-up when a client closes, and the settings are kept.
    slave_ = FileDescriptor(::open(path.data(), O_RDWR | O_NOCTTY | O_CLOEXEC));
    if (slave_.get() < 0) fail("the terminal can't be opened");
    termios raw{};
    if (::tcgetattr(slave_.get(), &raw) != 0) fail("the terminal has no settings");
    ::cfmakeraw(&raw);
    ::cfsetspeed(&raw, B115200);
    raw.c_cc[VMIN] = 1;
    raw.c_cc[VTIME] = 0;
    if (::tcsetattr(slave_.get(), TCSANOW, &raw) != 0) fail("the terminal can't be made raw");
    if (!link_.empty()) makeLink(path.data(), link_);
    target_ = path.data();
    name_ = link_.empty() ? target_ : link_.string();
  }

  fs::path link_;
  std::string name_;
  std::string target_;  // target of our link; empty without a link
  FileDescriptor master_;
  FileDescriptor slave_;
};

}  // namespace

std::unique_ptr<PortServer> openPtyPort(fs::path link) {
  return std::make_unique<PtyPort>(std::move(link));
}

}  // namespace palpate
