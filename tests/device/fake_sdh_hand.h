// Fake SDH-2 motion controller, written from the protocol document (sections 2 and 4.2), not from
// our driver: its own checksum, its own decoder. It receives and returns bytes, without a thread or
// a port, and can produce errors on request.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace palpate::testing {

class FakeSdhHand {
 public:
  using Bytes = std::vector<std::byte>;
  using Axes = std::vector<double>;

  // --- Properties ---
  bool checksum = true;  // false: as over TCP
  std::string firmware = "0.0.3.3";
  int axes = 7;
  Axes pos{0, -10, 20, -30, 40, -50, 60};
  std::map<std::string, Axes> values{{"p", {0, -10, 20, -30, 40, -50, 60}},
                                     {"v", Axes(7, 40.0)},
                                     {"vel", Axes(7, 0.0)},
                                     {"rvel", Axes(7, 0.0)},
                                     {"a", Axes(7, 100.0)},
                                     {"state", Axes(7, 0.0)},
                                     {"power", Axes(7, 0.0)},
                                     {"ilim", Axes(7, 0.5)},
                                     {"igrip", {1.0, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5}},
                                     {"ihold", {0.1, 0.2, 0.2, 0.2, 0.2, 0.2, 0.2}},
                                     {"vlim", {83, 140, 200, 140, 200, 140, 200}},
                                     {"alim", {5000, 400, 1500, 400, 1500, 400, 1500}},
                                     {"p_min", {0, -90, -90, -90, -90, -90, -90}},
                                     {"p_max", Axes(7, 90.0)},
                                     {"p_offset", Axes(7, 0.0)},
                                     {"ref", Axes(7, 0.0)},
                                     {"pos_save", Axes(7, 0.0)},
                                     {"kv", Axes(7, 0.25)}};
  int con = 0;
  int vp = 0;

  // --- Errors to produce; the counters decrease with each answer ---
  int dropByteAt = -1;        // drops this byte of the next record, once
  int flipByteAt = -1;        // flips a bit of this byte of the next record, once
  int silentAnswers = 0;      // answers that are not sent
  int wrongNames = 0;         // line answers with another name
  int debugLines = 0;         // lines that begin with @ before the next answer
  int errorCode = 0;          // error code of the next answer, once
  int nanAnswers = 0;         // records with a NaN in them
  int wildAnswers = 0;        // records with an angle of 1e6
  std::string garbage;        // bytes before the next answer, once
  std::string lateAnswer;     // old line before the next answer, once
  bool dead = false;          // neither answers nor acts
  bool swapsTargets = false;  // stores other targets than it received
  int lostStops = 0;          // so many `stop` neither arrive nor are answered
  int ignoredStops = 0;       // so many `stop` are answered, but the axes move on
  int pollsPerMotion = 3;     // a motion ends when its states were asked for so many times
  double announcedS = 4.51;   // duration of a motion, as announced

  // --- Log ---
  std::vector<std::string> log;  // "pos?" "p!" for records, lines as received
  std::size_t bytesSeen = 0;
  int moves = 0;
  int stops = 0;
  int pollsUntilIdle = 0;

  Bytes receive(const Bytes& bytes) {
    out_.clear();
    for (const std::byte b : bytes) take(std::to_integer<unsigned>(b));
    return out_;
  }

  // Bitwise as in section 1.2: the table entry is computed, nothing is shared with the driver.
  static unsigned crc(const std::vector<unsigned>& bytes) {
    unsigned crc = 0xFFFF;
    for (const unsigned b : bytes) {
      unsigned r = ((crc ^ b) & 0xFF) << 8;
      for (int i = 0; i < 8; ++i) r = ((r & 0x8000) != 0 ? (r << 1) ^ 0x1021 : r << 1) & 0xFFFF;
      crc = (crc >> 8) ^ r;
    }
    return crc;
  }

 private:
  const std::map<unsigned, std::string> binary_{{0x80, "v"},
                                                {0x81, "vel"},
                                                {0x82, "rvel"},
                                                {0x83, "pos"},
                                                {0x84, "state"},
                                                {0x85, "p"},
                                                {0x86, "a"},
                                                {0x8B, "tpap"},
                                                {0x8C, "tvav"},
                                                {0xA3, "ilim"},
                                                {0xA4, "power"}};
  std::string line_;
  std::vector<unsigned> record_;
  Bytes out_;

  void take(unsigned b) {
    ++bytesSeen;
    if (!record_.empty() || (line_.empty() && b >= 0x80)) {
      record_.push_back(b);
      if (record_.size() >= 2 && record_.size() == record_[1] + 2) {
        const auto record = record_;
        record_.clear();
        answerRecord(record);
      }
      return;
    }
    if (b == '\n') {
      std::string line = line_;
      line_.clear();
      while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
      line.erase(0, line.find_first_not_of(' '));
      if (!line.empty()) answerLine(line);
    } else if (!(line_.empty() && b == ' ')) {
      line_ += static_cast<char>(b);
    }
  }

  void put(const std::string& text) {
    for (const char c : text) out_.push_back(static_cast<std::byte>(c));
  }

  // Returns false when this answer is not to be sent.
  bool beginAnswer() {
    if (dead) return false;
    if (silentAnswers > 0) {
      --silentAnswers;
      return false;
    }
    put(garbage);
    garbage.clear();
    put(lateAnswer);
    lateAnswer.clear();
    for (; debugLines > 0; --debugLines) put("@progress line with = and E13\r\n");
    return true;
  }

  Axes act(const std::string& name, const Axes* set) {
    if (name == "pos") return pos;
    if (name == "tpap") {
      if (set) values["p"] = *set;
      return pos;
    }
    if (name == "tvav") {
      if (set) values["v"] = *set;
      return values["vel"];
    }
    if (name == "state") {
      if (pollsUntilIdle > 0 && --pollsUntilIdle == 0) {
        pos = values["p"];
        values["state"] = Axes(7, 0.0);
      }
      return values["state"];
    }
    if (set) values[name] = *set;
    if (set && name == "p" && swapsTargets) std::swap(values["p"][1], values["p"][2]);
    return values[name];
  }

  void answerRecord(const std::vector<unsigned>& record) {
    const unsigned expectedSize = (record[2] == 7 ? 29u : 1u) + (checksum ? 2u : 0u);
    int status = 0;
    Axes answer(7, 0.0);
    const auto found = binary_.find(record[0]);
    if (checksum) {
      const std::vector<unsigned> covered(record.begin(), record.end() - 2);
      if (crc(covered) != (record[record.size() - 2] | record.back() << 8)) status = 33;
    }
    if (status == 0 && (found == binary_.end() || record[1] != expectedSize)) status = 13;
    if (status == 0) {
      log.push_back(found->second + (record[2] == 7 ? "!" : "?"));
      Axes set;
      for (std::size_t axis = 0; record[2] == 7 && axis < 7; ++axis) {
        unsigned bits = 0;
        for (std::size_t i = 4; i > 0; --i) bits = bits << 8 | record[3 + 4 * axis + i - 1];
        float value = 0;
        std::memcpy(&value, &bits, 4);
        set.push_back(static_cast<double>(value));
      }
      if (!dead && errorCode == 0) answer = act(found->second, set.empty() ? nullptr : &set);
    }
    if (!beginAnswer()) return;
    if (errorCode != 0) status = std::exchange(errorCode, 0);
    if (nanAnswers > 0 && nanAnswers-- > 0) answer[3] = std::strtod("nan", nullptr);
    if (wildAnswers > 0 && wildAnswers-- > 0) answer[3] = 1e6;
    std::vector<unsigned> reply = {
        record[0], checksum ? 0x20u : 0x1Eu, 7u, static_cast<unsigned>(status)};
    for (const double value : answer) {
      const float narrow = static_cast<float>(value);
      unsigned bits = 0;
      std::memcpy(&bits, &narrow, 4);
      for (int i = 0; i < 4; ++i) reply.push_back(bits >> (8 * i) & 0xFF);
    }
    if (checksum) {
      const unsigned sum = crc(reply);
      reply.push_back(sum & 0xFF);
      reply.push_back(sum >> 8);
    }
    for (int i = 0; i < static_cast<int>(reply.size()); ++i) {
      if (i == dropByteAt) continue;
      out_.push_back(static_cast<std::byte>(i == flipByteAt
                                                ? reply[static_cast<std::size_t>(i)] ^ 0x10
                                                : reply[static_cast<std::size_t>(i)]));
    }
    dropByteAt = flipByteAt = -1;
  }

  static std::string upper(std::string text) {
    for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return text;
  }
  static std::string number(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.2f", value);
    return text;
  }
  static std::string list(const Axes& values) {
    std::string text;
    for (const double value : values) text += (text.empty() ? "" : ", ") + number(value);
    return text;
  }

  void answerLine(const std::string& line) {
    const std::string command = line.substr(0, line.find_first_of("(="));
    if (command == "stop" && lostStops > 0) {
      --lostStops;
      return;
    }
    log.push_back(line);
    if (!dead && errorCode == 0 && command == "m") {
      ++moves;
      pollsUntilIdle = pollsPerMotion;
      values["state"] = Axes(7, 1.0);
    }
    if (!dead && command == "stop") {
      ++stops;
      if (ignoredStops > 0) {
        --ignoredStops;
      } else {
        pollsUntilIdle = 0;
        values["state"] = Axes(7, 0.0);
      }
    }
    if (!beginAnswer()) return;
    if (errorCode != 0) {
      put("E" + std::to_string(std::exchange(errorCode, 0)) + "\r\n");
      return;
    }
    std::string answer = text(command, line);
    if (wrongNames > 0 && wrongNames-- > 0) answer = "SN=48";
    put(answer + "\r\n");
  }

  std::string text(const std::string& command, const std::string& line) {
    const std::map<std::string, std::string> words{
        {"ver", firmware},
        {"ver_date", "2013-09-19"},
        {"soc", "SDH_SOC 7"},
        {"soc_date", "2013-01-01"},
        {"id", "SDH"},
        {"sn", "48"},
        {"numaxis", std::to_string(axes)},
        {"temp", "40.50,45.75,37.00,41.75,34.00,44.00,36.75,48.50,48.25"},
        {"m", number(announcedS)},
        {"get_duration", "3.25"}};
    const std::string name = upper(command);
    if (const auto word = words.find(command); word != words.end())
      return name + "=" + word->second;
    if (command == "stop") return "STOP";
    const std::size_t equals = line.find('=');
    const std::string given = equals == std::string::npos ? "" : line.substr(equals + 1);
    for (int* setting : {&con, &vp}) {
      if (command != (setting == &con ? "con" : "vp")) continue;
      if (!given.empty()) *setting = std::atoi(given.c_str());
      return name + "=" + std::to_string(*setting);
    }
    if (command == "pid")
      return name + line.substr(3, 3) + "=" + (given.empty() ? "1.00,2.00,3.50" : given);
    if (!values.contains(command) && command != "pos" && command != "tpap" && command != "tvav")
      return "E13";
    if (const std::size_t bracket = line.find('('); bracket != std::string::npos) {
      const auto axis = static_cast<std::size_t>(std::atoi(line.c_str() + bracket + 1));
      if (!given.empty()) values[command].at(axis) = std::atof(given.c_str());
      return name + "(" + std::to_string(axis) + ")=" + number(values[command].at(axis));
    }
    if (given.empty()) return name + "=" + list(act(command, nullptr));
    Axes set;
    for (const char* at = given.c_str(); *at != 0;) {
      char* end = nullptr;
      set.push_back(std::strtod(at, &end));
      at = *end == ',' ? end + 1 : end;
    }
    if (set.size() != 7) return "E11";
    return name + "=" + list(act(command, &set));
  }
};

}  // namespace palpate::testing
