// Client of remote control: sends a request as one line and waits for its answer.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace palpate {

// To be used from one thread.
class RemoteClient {
 public:
  // Throws FileError when no server listens there, or without permission.
  explicit RemoteClient(std::filesystem::path socket);
  ~RemoteClient();
  RemoteClient(const RemoteClient&) = delete;
  RemoteClient& operator=(const RemoteClient&) = delete;

  // Sends a request (std::invalid_argument if it contains a line end) and returns its answer, a
  // line of JSON without line end. Throws FileError when no answer arrives in time or the server
  // has gone; the connection can't be used after that.
  std::string ask(std::string_view request, std::chrono::milliseconds timeout);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate
