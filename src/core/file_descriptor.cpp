#include "palpate/core/file_descriptor.h"

#include <unistd.h>

namespace palpate {

FileDescriptor::~FileDescriptor() {
  if (fd_ >= 0) ::close(fd_);
}

}  // namespace palpate
