#include "palpate/core/network_place.h"

#include <stdexcept>

#include <gtest/gtest.h>
#include <netinet/in.h>

#include "palpate/core/error.h"

namespace palpate::network_place_test {
namespace {

std::string readAs(const std::string& text) {
  const auto place = networkPlaceOf(text);
  return place ? place->text() : "none";
}

TEST(NetworkPlace, IsReadFromText) {
  EXPECT_EQ(readAs("9871"), "127.0.0.1:9871");
  EXPECT_EQ(readAs("0.0.0.0:0"), "0.0.0.0:0");
  EXPECT_EQ(readAs("[::1]:65535"), "[::1]:65535");
  EXPECT_EQ(readAs("::1:80"), "[::1]:80");
  for (const char* text :
       {"", "x", ":1", "1:", "70000", "-1", "host:1", "1:1", "127.1:1", "127.0.0.01:1", "[]:1"})
    EXPECT_EQ(readAs(text), "none") << text;
}

// RFC 1122, 3.2.1.3 (127/8); RFC 4291, 2.5.3 (::1) and 2.5.5.2 (::ffff:a.b.c.d).
TEST(NetworkPlace, IsOpenToOthersUnlessItIsALoopback) {
  for (const char* own : {"127.0.0.1", "127.255.0.3", "::1", "0:0:0:0:0:0:0:1", "::ffff:127.0.0.1"})
    EXPECT_FALSE(NetworkPlace{.address = own}.isOpenToOthers()) << own;
  for (const char* open :
       {"0.0.0.0", "192.0.2.1", "128.0.0.1", "::", "2001:db8::1", "::ffff:192.0.2.1", "localhost"})
    EXPECT_TRUE(NetworkPlace{.address = open}.isOpenToOthers()) << open;
  EXPECT_FALSE(NetworkPlace().isOpenToOthers());
}

TEST(NetworkPlace, IsWhatTheSystemHas) {
  const auto v4 = socketAddressOf({"192.0.2.1", 513});
  ASSERT_TRUE(v4);
  EXPECT_EQ(v4->size, sizeof(sockaddr_in));
  const auto& bytes = *reinterpret_cast<const sockaddr_in*>(v4->get());
  EXPECT_EQ(bytes.sin_family, AF_INET);
  EXPECT_EQ(bytes.sin_addr.s_addr, htonl(0xC0000201));
  EXPECT_EQ(bytes.sin_port, htons(513));
  EXPECT_EQ(v4->place().text(), "192.0.2.1:513");
  EXPECT_EQ(socketAddressOf({"2001:db8::1", 1}).value().place().text(), "[2001:db8::1]:1");
  EXPECT_FALSE(socketAddressOf({"localhost", 1}));
}

TEST(ListenAt, BindsAndSaysWhyItCannot) {
  NetworkPlace first;
  const FileDescriptor listener = listenAt(first, "first", SOCK_STREAM, 1);
  EXPECT_GT(first.port, 0);
  EXPECT_GE(listener.get(), 0);
  NetworkPlace datagrams;
  EXPECT_GE(listenAt(datagrams, "datagrams", SOCK_DGRAM).get(), 0);
  EXPECT_GT(datagrams.port, 0);
  try {
    NetworkPlace second = first;
    listenAt(second, "second", SOCK_STREAM, 1);
    FAIL() << "two at one port";
  } catch (const DeviceError& error) {
    EXPECT_EQ(error.fault(), DeviceFault::kBusy);
    EXPECT_STREQ(error.what(), "second: another program uses this port; name another one");
  }
  NetworkPlace elsewhere{.address = "203.0.113.1"};  // for documentation only (RFC 5737)
  EXPECT_THROW(listenAt(elsewhere, "elsewhere", SOCK_STREAM, 1), DeviceError);
  NetworkPlace name{.address = "localhost"};
  EXPECT_THROW(listenAt(name, "name", SOCK_STREAM, 1), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::network_place_test
