// palpate_stop: stops a hand when the program that moves it has died (last_stop.h starts it).
//   standard input   a pipe whose other end only that program holds: it ends with that program
//   standard output  the motion port
//   argument         the bytes that stop the hand
// It needs the C library only, and little memory: it has to live when there is none left.
#include <cerrno>
#include <csignal>
#include <cstring>
#include <initializer_list>

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

namespace {

constexpr int kPort = STDOUT_FILENO;
constexpr int kWaitMs = 20;

// True if the system accepts this value.
bool setOomScore(const char* value) {
  const int file = ::open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC);
  const bool written = file >= 0 && ::write(file, value, std::strlen(value)) > 0;
  if (file >= 0) ::close(file);
  return written;
}

void keepAlive() {
  for (const int number : {SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGPIPE}) std::signal(number, SIG_IGN);
  // `pkill palpate` ends the program, not its last stop.
  ::prctl(PR_SET_NAME, "hand_stop");
  ::close_range(STDERR_FILENO + 1, ~0U, 0);
  if (::chdir("/") != 0) return;
  ::mlockall(MCL_CURRENT | MCL_FUTURE);
  if (!setOomScore("-1000")) setOomScore("0");
}

void awaitDeath() {
  char byte = 0;
  for (;;) {
    const ssize_t got = ::read(STDIN_FILENO, &byte, 1);
    if (got == 0 || (got < 0 && errno != EINTR)) return;
  }
}

// The port doesn't block; a port that takes nothing for 60 ms is given up.
void send(const char* bytes) {
  std::size_t left = std::strlen(bytes);
  for (int tries = 0; tries < 3 && left > 0; ++tries) {
    const ssize_t written = ::write(kPort, bytes, left);
    if (written > 0) {
      bytes += written;
      left -= static_cast<std::size_t>(written);
      continue;
    }
    pollfd wait{kPort, POLLOUT, 0};
    ::poll(&wait, 1, kWaitMs);
  }
}

// Closing a port can wait for half a minute until its bytes are gone; a network connection that is
// closed with unread answers loses bytes on their way.
void leavePort() {
  int left = 0;
  for (int tries = 0; tries < 10; ++tries) {
    char answer[256];
    while (::recv(kPort, answer, sizeof answer, MSG_DONTWAIT) > 0) {
    }
    if (::ioctl(kPort, TIOCOUTQ, &left) != 0 || left == 0) break;
    ::poll(nullptr, 0, kWaitMs);
  }
  if (left > 0) ::tcflush(kPort, TCOFLUSH);
  ::ioctl(kPort, TIOCNXCL);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    constexpr char kUsage[] = "palpate_stop: palpate starts this program; don't run it directly\n";
    return ::write(STDERR_FILENO, kUsage, sizeof kUsage - 1) > 0 ? 2 : 3;
  }
  keepAlive();
  awaitDeath();
  for (int times = 0; times < 3; ++times) {
    send(argv[1]);
    ::poll(nullptr, 0, kWaitMs);
  }
  leavePort();
  ::_exit(0);
}
