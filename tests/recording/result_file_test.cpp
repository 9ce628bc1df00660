#include "palpate/recording/result_file.h"

#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "palpate/core/error.h"
#include "palpate/core/json.h"

#include "imports/import_samples.h"
#include "recording/result_writers.h"
#include "testing/testing.h"

namespace palpate::result_file_test {
namespace {

namespace fs = std::filesystem;
using testing::TemporaryFolder;

struct Grip {
  std::int64_t timeMs = 0;
  std::string state;
  std::optional<double> force;
  std::optional<std::int64_t> finger;
  bool isHeld = false;
  std::optional<bool> isSure;
  std::int64_t stampUs = 0;
};

std::vector<ColumnOf<Grip>> gripColumns() {
  return {columnOf<Grip>("time_ms", "ms", "host time, since 1970", &Grip::timeMs),
          columnOf<Grip>("state", "", "what the hand does", &Grip::state),
          columnOf<Grip>("force", "N", "of the hand", &Grip::force),
          columnOf<Grip>("finger", "", "", &Grip::finger),
          columnOf<Grip>("held", "", "", &Grip::isHeld),
          columnOf<Grip>("sure", "", "", &Grip::isSure),
          columnOf<Grip>("stamp_us", "us", "", &Grip::stampUs)};
}

// Of every third row the optional cells are not known. Stamps are above 2^53: no double holds them.
constexpr std::int64_t kStampUs = 9'100'000'000'000'001;
RowTable<Grip> grips(std::size_t rows) {
  return {
      "grips", gripColumns(), [rows, at = std::size_t{0}](std::vector<Grip>& made) mutable {
        if (at == rows) return false;
        const auto i = static_cast<std::int64_t>(at++);
        Grip grip{1'600'000'000'000 + i, i % 2 ? "h\xC3\xA4lt" : "", {}, {}, i % 2 == 1, {}, {}};
        grip.stampUs = kStampUs + i;
        if (i % 3 != 0) {
          grip.force = 0.1 * static_cast<double>(i);
          grip.finger = i % 3;
          grip.isSure = i % 3 == 1;
        }
        made.push_back(grip);
        return true;
      }};
}

constexpr const char* kExpected = R"(
import sys, math
folder = sys.argv[1] + '/'
def expected(rows):
    for i in range(rows):
        known = i % 3 != 0
        yield (1600000000000 + i, 'h\u00e4lt' if i % 2 else '', 0.1 * i if known else None,
               i % 3 if known else None, bool(i % 2), (i % 3 == 1) if known else None,
               9100000000000001 + i)
)";

TEST(ResultFile, textIsThatOfTheTable) {
  const TemporaryFolder folder;
  for (const char* name : {"a.csv", "a.json", "A.CSV"}) {
    auto table = grips(5), same = grips(5);
    EXPECT_EQ(writeResult(table, folder / name), 5u);
    std::string text;
    writeTableText(same, {.form = tableFormOf(name)}, [&](const auto& part) { text += part; });
    EXPECT_EQ(testing::readFile(folder / name), text);
  }
  auto table = grips(1);
  writeResult(table, folder / "u.csv", Overwrite::kRefuse, {.unitsRow = true});
  EXPECT_NE(testing::readFile(folder / "u.csv").find("\nms,,N,,,,us\n"), std::string::npos);
}

TEST(ResultFile, numpyReadsAnArrayPerColumn) {
  const TemporaryFolder folder;
  auto table = grips(1000);
  EXPECT_EQ(writeResult(table, folder / "a.npz"), 1000u);
  auto none = grips(0);
  EXPECT_EQ(writeResult(none, folder / "none.npz"), 0u);
  testing::runPython(folder, std::string(kExpected) + R"(
import json, numpy as np
a = np.load(folder + 'a.npz')
meta = json.loads(str(a['meta']))
assert meta['table'] == 'grips' and meta['columns'][2] == {'name': 'force', 'unit': 'N', 'kind': 'number'}
assert [c['name'] for c in meta['columns']] == [n for n in a.files if n != 'meta']
assert a['time_ms'].dtype == '<i8' and a['held'].dtype == bool and a['state'].dtype.kind == 'U'
assert a['stamp_us'].dtype == '<i8' and a['finger'].dtype == '<f8' and a['sure'].dtype == '<f8'
same = lambda x, y: math.isnan(x) if y is None else x == y
for i, row in enumerate(expected(1000)):
    got = [a[c['name']][i] for c in meta['columns']]
    assert all(same(x, y) for x, y in zip(got, row)), (i, got, row)
none = np.load(folder + 'none.npz')
assert none['force'].shape == (0,) and none['state'].shape == (0,)
)");
}

TEST(ResultFile, scipyReadsAStructureOfColumns) {
  const TemporaryFolder folder;
  auto table = grips(1000);
  EXPECT_EQ(writeResult(table, folder / "a.mat"), 1000u);
  testing::runPython(folder, std::string(kExpected) + R"(
import scipy.io
a = scipy.io.loadmat(folder + 'a.mat', simplify_cells=True)
names = list(a['columns']['name'])
assert names == list(a['grips']), names
assert a['columns']['units'][2] == 'N' and a['columns']['meaning'][1] == 'what the hand does'
assert a['grips']['stamp_us'].dtype == 'int64' and a['grips']['held'].dtype == 'uint8'
text = lambda x: x if isinstance(x, str) else ''
same = lambda x, y: text(x) == y if isinstance(y, str) else math.isnan(x) if y is None else x == y
for i, row in enumerate(expected(1000)):
    got = [a['grips'][n][i] for n in names]
    assert all(same(x, y) for x, y in zip(got, row)), (i, got, row)
)");
}

// Rows of several chunks, the last one not full.
TEST(ResultFile, h5pyReadsAGroupOfColumns) {
  const TemporaryFolder folder;
  for (const std::size_t rows : {0, 3, 4096, 9000}) {
    auto table = grips(rows);
    EXPECT_EQ(writeResult(table, folder / ("a" + std::to_string(rows) + ".h5")), rows);
  }
  testing::runPython(folder, std::string(kExpected) + R"(
import h5py
for rows in (0, 3, 4096, 9000):
    with h5py.File(folder + f'a{rows}.h5', 'r') as f:
        assert f.attrs['format'] == 'palpate table' and f.attrs['table'] == 'grips'
        g = f['grips']
        assert g['force'].attrs['units'] == 'N' and g['state'].attrs['meaning'] == 'what the hand does'
        assert g['finger'].attrs['missing_value'] == -2**63 and g['sure'].attrs['missing_value'] == 255
        columns = {n: g[n].asstr()[:] if n == 'state' else g[n][:] for n in g}
        assert all(len(c) == rows for c in columns.values())
        names = ['time_ms', 'state', 'force', 'finger', 'held', 'sure', 'stamp_us']
        assert sorted(names) == sorted(columns)
        for i, row in enumerate(expected(rows)):
            row = list(row)
            row[3] = -2**63 if row[3] is None else row[3]
            row[5] = 255 if row[5] is None else row[5]
            got = [columns[n][i] for n in names]
            assert all(math.isnan(x) if y is None else x == y for x, y in zip(got, row)), (i, got, row)
)");
}

TEST(ResultFile, mcapHasAMessageOfJsonPerRow) {
  const TemporaryFolder folder;
  auto table = grips(1000), packed = grips(1000);
  EXPECT_EQ(
      writeMcapTable(
          table, folder / "a.mcap", Overwrite::kRefuse, {.compression = McapCompression::kNone}),
      1000u);
  EXPECT_EQ(writeResult(packed, folder / "b.mcap"), 1000u);
  EXPECT_LT(fs::file_size(folder / "b.mcap"), fs::file_size(folder / "a.mcap") / 4);
  testing::runPython(folder,
                     std::string(kExpected) +
                         "sys.path.insert(0, '" PALPATE_MCAP_CHECK_FOLDER
                         "')\nsys.dont_write_bytecode = True\nimport json, mcap_check\n" +
                         R"(
a = mcap_check.read(folder + 'a.mcap')
messages = a['messages']['/palpate/grips']
assert a['types']['/palpate/grips'] == ('palpate.grips', 'jsonschema', 'json')
names = ['time_ms', 'state', 'force', 'finger', 'held', 'sure', 'stamp_us']
assert len(messages) == 1000
for (log, data), row in zip(messages, expected(1000)):
    assert log == row[0] * 1000000
    assert json.loads(data) == dict(zip(names, row)), (data, row)
)");
}

TEST(ResultFile, saysWhatAFormCannotHold) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& name, std::vector<ColumnOf<int>> columns) {
    RowTable<int> table("a", std::move(columns), std::vector<int>{1, 2});
    try {
      writeResult(table, folder / name);
    } catch (const FileError& error) {
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  const auto number = [](const char* name) {
    return std::vector{columnOf<int>(name, "", "", [](int value) { return value; })};
  };
  EXPECT_NE(refused("a.mcap", number("n")).find("no column time_us, time_ms or begin_ms"),
            std::string::npos);
  EXPECT_NE(refused("a.npz", number("meta")).find("the column 'meta'"), std::string::npos);
  EXPECT_NE(refused("a.mat", number("a/b")).find("the column 'a/b'"), std::string::npos);
  EXPECT_NE(refused("a.mat", number("a_name_that_is_longer_than_matlab_allows")).find("at most 31"),
            std::string::npos);
  EXPECT_NE(refused("a.txt", number("n")).find("must end in .csv, .json, .npz"), std::string::npos);
  EXPECT_TRUE(fs::is_empty(folder.path()));
  EXPECT_EQ(refused("a.npz", number("n")), "nothing");
  EXPECT_NE(refused("a.npz", number("n")).find("exists"), std::string::npos);
}

// A file is refused before the table is read, and a table that fails leaves none.
TEST(ResultFile, leavesNoPartOfAFile) {
  const TemporaryFolder folder;
  for (const std::string& ending : resultEndings()) {
    RowTable<Grip> table("a", gripColumns(), [](std::vector<Grip>& rows) -> bool {
      static int count = 0;
      if (++count % 3 == 0) throw FormatError("b.dsa", "damaged");
      rows.resize(5000);
      return true;
    });
    EXPECT_THROW(writeResult(table, folder / ("a" + ending)), FormatError) << ending;
    EXPECT_FALSE(fs::exists(folder / ("a" + ending))) << ending;
  }
}

}  // namespace
}  // namespace palpate::result_file_test
