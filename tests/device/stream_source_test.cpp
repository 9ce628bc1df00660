// Senders that connect to a listening port while another one is read.
#include "device/stream_source.h"

#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include "palpate/core/error.h"

#include "device/scripted_channel.h"
#include "testing/awaited.h"

namespace palpate::testing::stream_source_test {
namespace {

// A source with a sender that is read and goes on sending.
struct ListeningSource {
  ListeningSource() {
    EXPECT_THROW(source.open(), DeviceError);
    holder = connected("1");
    EXPECT_TRUE(awaited([&] { return opens(); }));
  }
  bool opens() {
    try {
      channel = source.open();
    } catch (const DeviceError&) {
    }
    return channel != nullptr;
  }
  FileDescriptor connected(std::string_view text) const {
    FileDescriptor fd(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port = htons(source.localPort().value());
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(fd.get(), reinterpret_cast<const sockaddr*>(&place), sizeof place), 0);
    send(fd, text);
    return fd;
  }
  static void send(const FileDescriptor& fd, std::string_view text) {
    EXPECT_EQ(::send(fd.get(), text.data(), text.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(text.size()));
  }
  // What is remarked when one more sender comes.
  std::string remarkOnOneMore(std::string_view text) {
    waiting.push_back(connected(text));
    return remarkAfter(100'000);
  }
  std::string remarkAfter(std::int64_t us) {
    clock.nowUs += us;
    send(holder, "1");
    Bytes buffer(100);
    EXPECT_GT(channel->read(buffer, std::chrono::seconds(10)), 0u);
    return source.takeRemark();
  }
  ManualClock clock;
  StreamSource source{"listen:0", 9600, clock};
  FileDescriptor holder;
  std::unique_ptr<ByteChannel> channel;
  std::vector<FileDescriptor> waiting;
};

TEST(StreamSource, ANinthWaitingSenderTakesThePlaceOfOneThatIsGone) {
  ListeningSource bench;
  std::string remarks;
  for (int i = 0; i < 8; ++i) remarks += bench.remarkOnOneMore(i == 3 ? "" : "2");
  EXPECT_NE(remarks.find("is connected, too, and waits"), std::string::npos) << remarks;
  bench.waiting.erase(bench.waiting.begin() + 3);
  EXPECT_EQ(bench.remarkOnOneMore("2"), "");
}

TEST(StreamSource, AWaitingSenderThatHasToGoIsTold) {
  ListeningSource bench;
  std::string remarks;
  for (int i = 0; i < 10; ++i) remarks += bench.remarkOnOneMore("2");
  EXPECT_NE(remarks.find("1 sender lost the connection while waiting, at last 127.0.0.1:"),
            std::string::npos)
      << remarks;
  bench.remarkAfter(10'000'000);
  remarks = bench.remarkOnOneMore("2");
  EXPECT_NE(remarks.find("3 senders lost the connection"), std::string::npos) << remarks;
}

}  // namespace
}  // namespace palpate::testing::stream_source_test
