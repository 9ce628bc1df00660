// The command `palpate ports` lists the ports and what answers at each.
#include <algorithm>
#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "palpate/core/escaped_line.h"
#include "palpate/core/json.h"
#include "palpate/core/result_table.h"
#include "palpate/device/port_list.h"
#include "palpate/device/port_probe.h"

#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/table_command.h"

namespace palpate::commands {
namespace {

constexpr std::size_t kProbesAtOnce = 16;

struct Row {
  PortInfo info;
  bool wanted = false;             // to be probed
  std::optional<PortProbe> probe;  // absent: not probed
};

// The device that a name links to; the name itself when it is not a file.
std::string portsDeviceOf(const std::string& name) {
  std::error_code failed;
  const std::string path = std::filesystem::canonical(name, failed).string();
  return failed ? name : path;
}

// The ports of the machine, then the additionally named ones; each device once.
std::vector<Row> rowsOf(const std::vector<std::string>& named) {
  std::vector<Row> rows;
  // Opening a Bluetooth port would connect to the remote device, so that only named ones are
  // probed.
  for (PortInfo& info : listPorts()) {
    const bool wanted = named.empty() && !info.bluetooth;
    rows.push_back({std::move(info), wanted, std::nullopt});
  }
  for (const std::string& name : named) {
    const std::string device = portsDeviceOf(name);
    const auto known = std::find_if(rows.begin(), rows.end(), [&](const Row& row) {
      return portsDeviceOf(row.info.name) == device;
    });
    if (known != rows.end()) {
      known->wanted = true;
      continue;
    }
    PortInfo info;
    info.name = name;
    info.stableName = stableNameOf(name);
    rows.push_back({std::move(info), true, std::nullopt});
  }
  return rows;
}

// Probes the wanted ports, several at a time, because each takes up to 2.5 s.
void probe(std::vector<Row>& rows) {
  std::vector<std::pair<Row*, std::future<PortProbe>>> asked;
  const auto collect = [&] {
    for (auto& [row, answer] : asked) row->probe = answer.get();
    asked.clear();
  };
  for (Row& row : rows) {
    if (!row.wanted) continue;
    if (asked.size() == kProbesAtOnce) collect();
    asked.emplace_back(
        &row, std::async(std::launch::async, [name = row.info.name] { return probePort(name); }));
  }
  collect();
}

std::string answerText(const Row& row) {
  const std::string text = row.probe ? row.probe->message : "not checked";
  return row.info.description.empty() ? text : text + " [" + row.info.description + "]";
}

std::string byIdText(const Row& row) {
  return row.info.stableName == row.info.name ? "-" : row.info.stableName;
}

std::string tableText(const std::vector<Row>& rows) {
  std::size_t nameWidth = 4;
  std::size_t byIdWidth = 10;
  for (const Row& row : rows) {
    nameWidth = std::max(nameWidth, escapedLine(row.info.name).size());
    byIdWidth = std::max(byIdWidth, escapedLine(byIdText(row)).size());
  }
  const auto line = [&](const std::string& name, const std::string& byId, const std::string& what) {
    std::string text = escapedLine(name);
    text.resize(nameWidth + 2, ' ');
    text += escapedLine(byId);
    text.resize(nameWidth + byIdWidth + 4, ' ');
    return text + escapedLine(what) + "\n";
  };
  std::string text = line("port", "by-id name", "device");
  for (const Row& row : rows) text += line(row.info.name, byIdText(row), answerText(row));
  return text;
}

// The stable name of the only port with that answer; nothing when there is none or more than one.
std::optional<std::string> onlyPort(const std::vector<Row>& rows, PortAnswer answer) {
  std::optional<std::string> found;
  for (const Row& row : rows) {
    if (!row.probe || row.probe->answer != answer) continue;
    if (found) return std::nullopt;
    found = row.info.stableName;
  }
  return found;
}

std::string adviceText(const std::vector<Row>& rows) {
  if (rows.empty())
    return "no serial port is there: plug the hand's adapter in, or name a port (a pty, "
           "tcp:HOST:PORT)\n";
  const auto tactile = onlyPort(rows, PortAnswer::kTactile);
  const auto motion = onlyPort(rows, PortAnswer::kMotion);
  if (!tactile && !motion) return {};
  return "connect with:" + (tactile ? " --dsa " + escapedLine(*tactile) : "") +
         (motion ? " --sdh " + escapedLine(*motion) : "") + "\n";
}

std::unique_ptr<ResultTable> portTable(std::vector<Row> rows) {
  const auto column = [](const char* name, const char* meaning, auto of) {
    return columnOf<Row>(name, "", meaning, of);
  };
  const auto ofProbe = [](std::string PortProbe::*field) {
    return [field](const Row& row) { return row.probe ? (*row.probe).*field : std::string(); };
  };
  std::vector<ColumnOf<Row>> columns{
      column("port", "", [](const Row& row) { return row.info.name; }),
      column("by_id",
             "name under /dev/serial/by-id",
             [](const Row& row) {
               return row.info.stableName == row.info.name ? std::optional<std::string>()
                                                           : row.info.stableName;
             }),
      column("description", "", [](const Row& row) { return row.info.description; }),
      column("usb", "", [](const Row& row) { return row.info.usb; }),
      column("answer",
             "what is there",
             [](const Row& row) {
               return std::string(row.probe ? row.probe->answerName() : "not_asked");
             }),
      column("firmware", "", ofProbe(&PortProbe::firmware)),
      column("serial", "", ofProbe(&PortProbe::serial)),
      column("message", "the answer in words", ofProbe(&PortProbe::message))};
  return std::make_unique<RowTable<Row>>("ports", std::move(columns), std::move(rows));
}

}  // namespace

int portsCommand(const Arguments& words) {
  const CommandLine given(
      {.synopsis = "palpate ports [PORT...] [--json] [-o OUT.csv] [--no-probe]",
       .purpose =
           "Lists the serial ports and the device at each: the hand's motion controller, its "
           "tactile controller, or neither. With PORTs (also ptys and tcp:HOST:PORT) only these "
           "are asked. A port that another program uses is not opened. Every other port is sent a "
           "few bytes: give --no-probe if devices are attached that these bytes could disturb.",
       .options = withOutputOptions(
           {{"json", "", "one object of JSON instead of lines; -o: by the ending"},
            {"no-probe", "", "list only, send nothing"}},
           "OUT.csv"),
       .example = "palpate ports"},
      words);
  if (given.helpShown()) return kDone;
  const TableForm form = formOf(given);
  std::vector<Row> rows = rowsOf(given.words());
  if (!given.has("no-probe")) probe(rows);
  if (form == TableForm::kJson) {
    printJson(given, Json::object().set("ports", rowsJson(*portTable(std::move(rows)))));
    return kDone;
  }
  if (given.has("output")) return writeTable(given, *portTable(std::move(rows)));
  StandardOutput out;
  out.write(tableText(rows));
  if (!given.quiet()) out.write(adviceText(rows));
  out.finish();
  return kDone;
}

}  // namespace palpate::commands
