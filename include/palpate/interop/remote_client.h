// The other end of remote control: asks one line, waits for its answer.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace palpate {

// One thread.
class RemoteClient {
 public:
  // Throws FileError: nobody listens there, no permission.
  explicit RemoteClient(std::filesystem::path socket);
  ~RemoteClient();
  RemoteClient(const RemoteClient&) = delete;
  RemoteClient& operator=(const RemoteClient&) = delete;

  // Sends a request (no line end in it: std::invalid_argument) and returns its answer, a line of
  // JSON without its end. Throws FileError: no answer in time, or the other end has gone; the
  // connection is of no use after that.
  std::string ask(std::string_view request, std::chrono::milliseconds timeout);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate
