#include "palpate/core/file_descriptor.h"

#include <fcntl.h>
#include <unistd.h>

#include "testing/testing.h"

namespace palpate::file_descriptor_test {
namespace {

FileDescriptor opened() { return FileDescriptor(::open("/dev/null", O_RDONLY | O_CLOEXEC)); }
bool isOpen(int fd) { return ::fcntl(fd, F_GETFD) >= 0; }

TEST(FileDescriptor, ClosesItselfOnce) {
  int fd = -1;
  {
    FileDescriptor first = opened();
    fd = first.get();
    ASSERT_TRUE(isOpen(fd));
    const FileDescriptor second = std::move(first);
    EXPECT_EQ(second.get(), fd);
    EXPECT_TRUE(isOpen(fd));
  }
  EXPECT_FALSE(isOpen(fd));
}

TEST(FileDescriptor, WhatItHeldBeforeIsClosedByAnAssignment) {
  FileDescriptor held = opened();
  const int before = held.get();
  held = FileDescriptor();
  EXPECT_EQ(held.get(), -1);
  EXPECT_FALSE(isOpen(before));
}

TEST(FileDescriptor, ReleasedItIsTheCallers) {
  int fd = -1;
  {
    FileDescriptor held = opened();
    fd = held.release();
    EXPECT_EQ(held.get(), -1);
  }
  EXPECT_TRUE(isOpen(fd));
  ::close(fd);
}

}  // namespace
}  // namespace palpate::file_descriptor_test
