#include "palpate/interop/remote_client.h"

#include <string>

#include "palpate/core/error.h"
#include "palpate/interop/remote_server.h"

#include "testing/testing.h"

namespace palpate::remote_client_test {
namespace {
using namespace std::chrono_literals;

// Keeps what it is asked, and never answers.
class SilentTarget : public RemoteTarget {
 public:
  void carryOut(const RemoteRequest&, Done done) override { kept_ = std::move(done); }

 private:
  Done kept_;
};

TEST(RemoteClient, SaysWhereNobodyListens) {
  const testing::TemporaryFolder folder;
  try {
    RemoteClient client(folder / "none");
    FAIL();
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("--remote"), std::string::npos) << error.what();
  }
}

TEST(RemoteClient, GivesUpInTime) {
  const testing::TemporaryFolder folder;
  SilentTarget target;
  const RemoteServer server(folder / "s", target);
  RemoteClient client(folder / "s");
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_THROW(client.ask("status", 100ms), FileError);
  EXPECT_GE(std::chrono::steady_clock::now() - begin, 95ms);
}

TEST(RemoteClient, NoticesThatTheOtherEndHasGone) {
  const testing::TemporaryFolder folder;
  SilentTarget target;
  auto server = std::make_unique<RemoteServer>(folder / "s", target);
  RemoteClient client(folder / "s");
  EXPECT_NE(client.ask("help", 5000ms).find("\"ok\":true"), std::string::npos);
  server.reset();
  EXPECT_THROW(client.ask("status", 5000ms), FileError);
}

}  // namespace
}  // namespace palpate::remote_client_test
