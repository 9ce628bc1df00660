// Hands and tables for tests of the import.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "palpate/model/hand_description.h"
#include "palpate/recording/recording.h"
#include "palpate/recording/recording_import.h"

#include "testing/program.h"
#include "testing/testing.h"

namespace palpate::testing {

// A hand of these matrices, without joints unless asked.
inline HandDescription handOf(std::vector<MatrixLayout> matrices,
                              std::size_t numAxes = 0,
                              std::size_t numTemperatures = 0) {
  HandDescription hand;
  hand.name = "test pad";
  for (std::size_t m = 0; m < matrices.size(); ++m)
    hand.matrices.emplace_back().name = m == 0 ? "left" : m == 1 ? "right" : "other";
  hand.layout = std::make_shared<const SensorLayout>(std::move(matrices));
  for (std::size_t i = 0; i < numAxes; ++i)
    hand.axes.emplace_back().name = "joint " + std::to_string(i);
  for (std::size_t i = 0; i < numTemperatures; ++i)
    hand.temperatureSensors.emplace_back().name = "sensor " + std::to_string(i);
  return hand;
}

inline HandDescription pad(int rows, int columns) {
  return handOf({MatrixLayout::full(rows, columns, 2.0)});
}

// Two matrices of 2 x 2.
inline HandDescription twoPads() {
  return handOf({MatrixLayout::full(2, 2, 2.0), MatrixLayout::full(2, 2, 2.0)});
}

// Writes a table, imports it, and reads the recording.
struct Imported {
  ImportReport report;
  Profile profile;
};
inline Imported importText(const TemporaryFolder& folder,
                           const std::string& text,
                           const HandDescription& hand,
                           const ImportMapping& mapping = {},
                           const ImportOptions& options = {.overwrite = Overwrite::kReplace}) {
  writeFile(folder / "table.csv", text);
  const ImportReport report =
      importRecording(folder / "table.csv", hand, mapping, folder / "out.palpate", options);
  return {report, openRecording(folder / "out.palpate")};
}

// Runs a Python script with the folder as its argument.
inline void runPython(const TemporaryFolder& folder, const std::string& script) {
  const ProgramResult result =
      runProgram("/usr/bin/python3", {"-c", script, folder.path().string()});
  ASSERT_EQ(result.exitCode, 0) << result.err;
}

// What an error says; empty when there was none.
template <typename Do>
std::string errorOf(Do what) {
  try {
    what();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace palpate::testing
