// Hands and tables for tests of the import.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "palpate/imports/recording_import.h"
#include "palpate/model/hand_description.h"
#include "palpate/recording/recording.h"

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

// Writes MAT files of version 5 by the published form, without SciPy: array(), structure(),
// cells(), packed(), write(). Arrays are NumPy's, with MATLAB's axes.
constexpr const char* kMat5Writer = R"(
import struct, sys, zlib, numpy as np
big = False
def pack(form, *values): return struct.pack(('>' if big else '<') + form, *values)
def element(kind, data):
  if 0 < len(data) <= 4:
    head = pack('HH', len(data), kind) if big else pack('HH', kind, len(data))
    return head + data.ljust(4, b'\0')
  return pack('II', kind, len(data)) + data + b'\0' * (-len(data) % 8)
def matrix(number, sizes, name, rest, flags=0):
  body = (element(6, pack('II', number | flags, 0)) + element(5, pack('%di' % len(sizes), *sizes)) +
          element(1, name.encode()) + rest)
  return pack('II', 14, len(body)) + body
classes = {'f8': 6, 'f4': 7, 'i1': 8, 'u1': 9, 'i2': 10, 'u2': 11, 'i4': 12, 'u4': 13, 'i8': 14, 'u8': 15}
kinds = {'i1': 1, 'u1': 2, 'i2': 3, 'u2': 4, 'i4': 5, 'u4': 6, 'f4': 7, 'f8': 9, 'i8': 12, 'u8': 13}
# `stored`: the type in the file, which may be a smaller one than the array has.
def array(name, values, stored=None, flags=0):
  values = np.asarray(values)
  sizes = values.shape if values.ndim > 1 else (1, values.size)
  stored = stored or values.dtype.str[1:]
  data = values.astype(('>' if big else '<') + stored).tobytes(order='F')
  return matrix(classes[values.dtype.str[1:]], sizes, name, element(kinds[stored], data), flags)
def structure(name, rows):
  fields = list(rows[0])
  rest = element(5, pack('i', 32)) + element(1, b''.join(f.encode().ljust(32, b'\0') for f in fields))
  return matrix(2, (1, len(rows)), name, rest + b''.join(row[f] for row in rows for f in fields))
def cells(name, parts): return matrix(1, (1, len(parts)), name, b''.join(parts))
def packed(part):
  data = zlib.compress(part)
  return pack('II', 15, len(data)) + data
def write(path, *parts):
  head = b'MATLAB 5.0 MAT-file, made by a test'.ljust(116) + bytes(8)
  with open(path, 'wb') as f: f.write(head + pack('H', 0x100) + (b'MI' if big else b'IM') + b''.join(parts))
)";

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
