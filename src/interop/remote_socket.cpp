#include "interop/remote_socket.h"

#include <cerrno>
#include <cstring>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include "palpate/core/error.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

constexpr int kWaitingClients = 16;
constexpr std::chrono::milliseconds kLockWait{1000};
constexpr std::chrono::milliseconds kLockRound{5};

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
  throw FileError(path, what + ": " + std::strerror(errno));
}

sockaddr_un addressOf(const fs::path& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string& name = path.native();
  if (name.empty() || name.size() >= sizeof address.sun_path)
    throw FileError(path,
                    "a socket's name has 1.." + std::to_string(sizeof address.sun_path - 1) +
                        " bytes: name another one");
  std::memcpy(address.sun_path, name.data(), name.size());
  return address;
}

FileDescriptor newSocket(const fs::path& path) {
  FileDescriptor made(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (made.get() < 0) fail(path, "no socket is available");
  return made;
}

bool connects(int socket, const sockaddr_un& address) {
  return ::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
}

// Two programs that start at the same time check the existing path one after the other. The lock is
// on the folder, so it leaves no file behind.
FileDescriptor lockFolderOf(const fs::path& path) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  FileDescriptor opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (opened.get() < 0) fail(folder, "no socket can be made there");
  const auto end = std::chrono::steady_clock::now() + kLockWait;
  while (::flock(opened.get(), LOCK_EX | LOCK_NB) != 0) {
    if (std::chrono::steady_clock::now() > end) fail(folder, "is locked by another program");
    std::this_thread::sleep_for(kLockRound);
  }
  return opened;
}

// Throws unless `path` is free now; removes the socket of a program that has ended.
void clear(const fs::path& path, const sockaddr_un& address) {
  struct stat found {};
  if (::lstat(path.c_str(), &found) != 0) return;
  if (!S_ISSOCK(found.st_mode)) throw FileError(path, "isn't a socket: name another one");
  const FileDescriptor probe = newSocket(path);
  if (connects(probe.get(), address) || errno != ECONNREFUSED)
    throw FileError(path,
                    "another program is remote-controlled there: end it, or name another socket");
  if (::unlink(path.c_str()) != 0) fail(path, "an old socket can't be removed");
}

}  // namespace

ListeningSocket::ListeningSocket(fs::path path) : path_(std::move(path)) {
  const sockaddr_un address = addressOf(path_);
  const FileDescriptor lock = lockFolderOf(path_);
  clear(path_, address);
  socket_ = newSocket(path_);
  if (::bind(socket_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
    fail(path_, "can't be created");
  struct stat made {};
  // Before listen() no client can connect, so the initial mode does not matter.
  if (::chmod(path_.c_str(), S_IRUSR | S_IWUSR) != 0 || ::lstat(path_.c_str(), &made) != 0 ||
      ::listen(socket_.get(), kWaitingClients) != 0) {
    const int error = errno;
    ::unlink(path_.c_str());
    errno = error;
    fail(path_, "can't listen");
  }
  device_ = made.st_dev;
  inode_ = made.st_ino;
}

ListeningSocket::~ListeningSocket() {
  struct stat found {};
  if (::lstat(path_.c_str(), &found) == 0 && found.st_dev == device_ && found.st_ino == inode_)
    ::unlink(path_.c_str());
}

bool isOfThisUser(int socket) noexcept {
  ucred peer{};
  socklen_t size = sizeof peer;
  return ::getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0 &&
         (peer.uid == ::geteuid() || peer.uid == 0);
}

FileDescriptor connectTo(const fs::path& path) {
  const sockaddr_un address = addressOf(path);
  FileDescriptor made = newSocket(path);
  if (connects(made.get(), address)) return made;
  if (errno == ENOENT || errno == ECONNREFUSED)
    throw FileError(path,
                    "nothing is remote-controlled there: switch Remote control on in the window, "
                    "or run palpate with --remote");
  if (errno == EAGAIN) throw FileError(path, "too many clients wait there: try again");
  fail(path, "can't connect");
}

}  // namespace palpate
