// Lists the sockets on which a process listens, as the system reports them (/proc).
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <sys/types.h>
#include <unistd.h>

namespace palpate::testing {

inline std::set<std::string> socketInodesOf(pid_t pid) {
  std::set<std::string> inodes;
  std::error_code failure;
  const auto folder = "/proc/" + std::to_string(pid) + "/fd";
  for (std::filesystem::directory_iterator entry(folder, failure), end; !failure && entry != end;
       entry.increment(failure)) {
    std::error_code gone;
    const std::string target = std::filesystem::read_symlink(entry->path(), gone).string();
    if (target.starts_with("socket:[")) inodes.insert(target.substr(8, target.size() - 9));
  }
  return inodes;
}

// Entries: "tcp", "udp" (datagrams from any sender are received) and "unix PATH".
inline std::vector<std::string> listeningSocketsOf(pid_t pid) {
  const std::set<std::string> own = socketInodesOf(pid);
  std::vector<std::string> found;
  const auto rows = [](const std::string& table, const auto& row) {
    std::ifstream file("/proc/net/" + table);
    std::string line;
    std::getline(file, line);  // header
    while (std::getline(file, line)) {
      std::istringstream words(line);
      row(std::vector<std::string>{std::istream_iterator<std::string>(words), {}});
    }
  };
  for (const std::string table : {"tcp", "tcp6", "udp", "udp6"}) {
    const std::string listening = table.starts_with("tcp") ? "0A" : "07";
    rows(table, [&](const std::vector<std::string>& words) {
      if (words.size() > 9 && words[3] == listening && own.contains(words[9]))
        found.push_back(table + " " + words[1]);
    });
  }
  constexpr unsigned long kAccepts = 0x10000;
  rows("unix", [&](const std::vector<std::string>& words) {
    if (words.size() > 6 && (std::stoul(words[3], nullptr, 16) & kAccepts) != 0 &&
        own.contains(words[6]))
      found.push_back("unix " + (words.size() > 7 ? words[7] : std::string()));
  });
  return found;
}

}  // namespace palpate::testing
