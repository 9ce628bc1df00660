#include "device/serial_port_channel.h"

#include <cerrno>

#include <fcntl.h>
#include <libserialport.h>
#include <sys/ioctl.h>
#include <termios.h>

#include "palpate/core/error.h"

#include "device/tty_channel.h"

namespace palpate {
namespace {

// Throws a DeviceError when a call of libserialport failed.
void require(sp_return result, const std::string& name, const std::string& what) {
  if (result == SP_OK) return;
  if (result == SP_ERR_FAIL && what.empty()) throwOpenError(sp_last_error_code(), name);
  throw DeviceError(DeviceFault::kUnsupported,
                    name,
                    "this port can't be set to " + what + "; use another port or adapter");
}

}  // namespace

void SerialPortChannel::Closer::operator()(sp_port* port) const noexcept {
  int fd = -1;
  if (sp_get_port_handle(port, &fd) == SP_OK && fd >= 0) {
    // The exclusive mode does not end by itself while another program has the port open. Only a
    // mode set by this program is ended; root could end that of another program, too.
    if (ours) ::ioctl(fd, TIOCNXCL);
    sp_close(port);
  }
  sp_free_port(port);
}

bool SerialPortChannel::knows(const std::string& path) {
  sp_port* found = nullptr;
  if (sp_get_port_by_name(path.c_str(), &found) != SP_OK) return false;
  sp_free_port(found);
  return true;
}

SerialPortChannel::SerialPortChannel(std::string name, int fd, Port port, FileDescriptor lock)
    : DescriptorChannel(std::move(name), fd, false),
      lock_(std::move(lock)),
      port_(std::move(port)) {}

SerialPortChannel::~SerialPortChannel() = default;

std::unique_ptr<ByteChannel> SerialPortChannel::open(const std::string& path,
                                                     const std::string& name,
                                                     int baud) {
  sp_port* found = nullptr;
  if (sp_get_port_by_name(path.c_str(), &found) != SP_OK)
    throw DeviceError(DeviceFault::kNotFound,
                      name,
                      "no such port: plug in the adapter, or check the name of the port");
  Port port(found, Closer{});
  // Locked before libserialport opens and configures the port: another program may be streaming
  // there.
  FileDescriptor lock(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (lock.get() < 0) throwOpenError(errno, name);
  lockLine(lock.get(), name);
  int exclusive = 0;
  if (::ioctl(lock.get(), TIOCGEXCL, &exclusive) == 0 && exclusive != 0)
    throwOpenError(EBUSY, name);  // root could open it nevertheless
  // libserialport 0.1.2 locks the port itself, before it changes anything: not beside our lock.
  sp_return opened = sp_open(port.get(), SP_MODE_READ_WRITE);
  if (opened == SP_ERR_FAIL && sp_last_error_code() == EWOULDBLOCK) {
    sp_close(port.get());  // it leaves the descriptor open
    lock = FileDescriptor();
    opened = sp_open(port.get(), SP_MODE_READ_WRITE);
    // Another program was faster.
    if (opened == SP_ERR_FAIL && sp_last_error_code() == EWOULDBLOCK) throwOpenError(EBUSY, name);
  }
  require(opened, name, "");
  int fd = -1;
  require(sp_get_port_handle(port.get(), &fd), name, "be waited for");
  ::fcntl(fd, F_SETFD, FD_CLOEXEC);
  if (::ioctl(fd, TIOCEXCL) != 0) throwOpenError(errno, name);
  port.get_deleter().ours = true;
  require(sp_set_baudrate(port.get(), baud), name, std::to_string(baud) + " baud");
  require(sp_set_bits(port.get(), 8), name, "8 data bits");
  require(sp_set_parity(port.get(), SP_PARITY_NONE), name, "no parity");
  require(sp_set_stopbits(port.get(), 1), name, "1 stop bit");
  require(sp_set_flowcontrol(port.get(), SP_FLOWCONTROL_NONE), name, "no flow control");
  // Corrects settings that libserialport leaves unchanged: HUPCL, VMIN.
  if (!makeRaw(fd)) throwOpenError(errno, name);
  sp_flush(port.get(), SP_BUF_INPUT);
  return std::unique_ptr<ByteChannel>(
      new SerialPortChannel(name, fd, std::move(port), std::move(lock)));
}

}  // namespace palpate
