#include "palpate/imports/table_source.h"

#include <array>
#include <cmath>

#include <sys/stat.h>

#include "palpate/library/recording_folder.h"
#include "palpate/recording/hdf5_recording.h"
#include "palpate/recording/recording.h"

#include "imports/folder_source.h"
#include "imports/import_samples.h"

namespace palpate::table_source_test {
namespace {

struct ReadTable {
  std::string form;
  std::vector<TableColumn> columns;
  std::vector<std::vector<double>> rows;  // NaN where a cell is not a number
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const TableColumn& column : columns) names.push_back(column.name);
    return names;
  }
};

// All numeric columns.
ReadTable readTable(const std::filesystem::path& path, const TableOptions& options = {}) {
  const auto source = openTable(path, options);
  ReadTable table{source->form(), source->columns(), {}};
  std::vector<std::size_t> numeric;
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    if (table.columns[c].isNumeric) numeric.push_back(c);
  source->start(numeric, std::nullopt);
  TableRow row;
  while (source->next(row)) {
    if (!row.complete) continue;
    for (std::size_t i = 0; i < row.values.size(); ++i)
      if (row.states[i] != CellState::kNumber) row.values[i] = std::nan("");
    table.rows.push_back(row.values);
  }
  return table;
}

ReadTable readText(const std::string& text, const TableOptions& options = {}) {
  const testing::TemporaryFolder folder;
  testing::writeFile(folder / "t.csv", text);
  return readTable(folder / "t.csv", options);
}

std::string refusalOf(const std::string& bytes, const TableOptions& options = {}) {
  return testing::errorOf([&] { readText(bytes, options); });
}

using Names = std::vector<std::string>;
using Rows = std::vector<std::vector<double>>;

TEST(TextTable, TheDelimiterIsDetected) {
  for (const char* text : {"a,b,c\n1,2,3\n4,5,6\n",
                           "a;b;c\n1;2;3\n4;5;6\n",
                           "a\tb\tc\n1\t2\t3\n4\t5\t6\n",
                           "a b  c\n1 2   3\n 4 5 6 \n",
                           "a, b, c\r\n1, 2, 3\r\n4, 5, 6\r\n",
                           "\xEF\xBB\xBF"
                           "a,b,c\n1,2,3\n\n4,5,6",
                           "a,b,c,\n1,2,3,\n4,5,6,\n",
                           "# a,b,c\n1,2,3\n# pause\n4,5,6\n",
                           "\"a\",\"b\",\"c\"\n\"1\",2,+3\n4,5,6\n"}) {
    const ReadTable table = readText(text);
    EXPECT_EQ(table.names(), (Names{"a", "b", "c"})) << text;
    EXPECT_EQ(table.rows, (Rows{{1, 2, 3}, {4, 5, 6}})) << text;
  }
}

TEST(TextTable, NamesAndUnitsAreOptional) {
  const ReadTable bare = readText("1,2\n3,4\n");
  EXPECT_EQ(bare.names(), (Names{"column 1", "column 2"}));
  EXPECT_EQ(bare.rows, (Rows{{1, 2}, {3, 4}}));
  const ReadTable units = readText("time;left;right\n[s];[kPa];\n0.1;2;3\n");
  EXPECT_EQ(units.columns[1].unit, "kPa");
  EXPECT_EQ(units.columns[2].unit, "");
  EXPECT_EQ(units.rows, (Rows{{0.1, 2, 3}}));
  EXPECT_NE(units.form.find("units in line 2"), std::string::npos) << units.form;
  const ReadTable inName = readText("time_ms,force [N],axis0_deg,p (kPa),taxel_1\n1,2,3,4,5\n");
  Names found;
  for (const TableColumn& column : inName.columns) found.push_back(column.unit);
  EXPECT_EQ(found, (Names{"ms", "N", "deg", "kPa", ""}));
  // As pandas names columns that have no names.
  const std::string counted = ",0,1,2,3,4,5,6\n0,7,8,9,7,8,9,7\n1,7,8,9,7,8,9,7\n";
  EXPECT_EQ(readText(counted).names()[3], "2");
  EXPECT_EQ(readText(counted).rows.size(), 2u);
  EXPECT_EQ(readText(counted, {.header = HeaderChoice::kAbsent}).rows.size(), 3u);
  EXPECT_EQ(readText("1,2,3,4\n7,8,9,5\n").rows.size(), 2u);
  EXPECT_EQ(readText("7,8\n9,5\n", {.header = HeaderChoice::kPresent}).names(), (Names{"7", "8"}));
}

TEST(TextTable, ArduinosSerialPlotter) {
  for (const char* text : {"a:1 b:2.5\na:3 b:4\n",
                           "a:1,b:2.5\na:3,b:4\n",
                           "a:1\tb:2.5\t\na:3\tb:4\t\n",
                           "a: 1, b: 2.5\na: 3, b: 4\n",
                           "a=1,b=2.5\na=3,b=4\n",
                           "a = 1; b = 2.5\na = 3; b = 4\n",
                           ">a:1,b:2.5\n>a:3,b:4\n",
                           "b:2.5 a:1\nb:4 a:3\n",
                           "a:1 b:2.5\nb:4 a:3\n"}) {
    const ReadTable table = readText(text);
    ASSERT_EQ(table.columns.size(), 2u) << text;
    const std::size_t a = table.columns[0].name == "a" ? 0 : 1;
    ASSERT_EQ(table.rows.size(), 2u) << text;
    EXPECT_EQ(table.rows[0][a], 1.0) << text;
    EXPECT_EQ(table.rows[0][1 - a], 2.5) << text;
    EXPECT_EQ(table.rows[1][a], 3.0) << text;
    EXPECT_EQ(table.rows[1][1 - a], 4.0) << text;
  }
}

TEST(TextTable, CellsWithoutANumberAreToldApart) {
  const testing::TemporaryFolder folder;
  testing::writeFile(folder / "t.csv", "a,b,c,d\n1,2,3,4\n1,,nan,x7\n1e99,-inf,2,3\n1,2\n");
  const auto source = openTable(folder / "t.csv");
  const std::vector<std::size_t> all{0, 1, 2, 3};
  source->start(all, std::nullopt);
  TableRow row;
  ASSERT_TRUE(source->next(row));
  ASSERT_TRUE(source->next(row));
  EXPECT_EQ(row.line, 3u);
  EXPECT_EQ(row.states,
            (std::vector{
                CellState::kNumber, CellState::kEmpty, CellState::kNotFinite, CellState::kText}));
  EXPECT_EQ(source->placeOf(3), "column 4: \"x7\"");
  EXPECT_EQ(source->placeOf(1), "column 2 is empty");
  ASSERT_TRUE(source->next(row));
  EXPECT_EQ(row.states[0], CellState::kNotFinite);  // no float holds it
  EXPECT_EQ(row.states[1], CellState::kNotFinite);
  ASSERT_TRUE(source->next(row));
  EXPECT_FALSE(row.complete);
  EXPECT_EQ(row.numCells, 2u);
  EXPECT_FALSE(source->next(row));
}

TEST(TextTable, DecimalCommasAreNamed) {
  for (const char* text : {"a;b\n0,5;1,25\n", "0,5\t1,25\n0,5\t3\n", "a b\n0,5 1,25\n"}) {
    const std::string what = refusalOf(text);
    EXPECT_NE(what.find("--decimal comma"), std::string::npos) << what;
    EXPECT_NE(what.find("column 1: \"0,5\""), std::string::npos) << what;
    EXPECT_EQ(readText(text, {.decimal = ','}).rows[0], (std::vector{0.5, 1.25})) << text;
  }
}

// imports 19.
TEST(TextTable, QuotedCellsMayHaveDecimalCommas) {
  const std::string text = "a,b,c\n\"0,00\",\"1,5\",7\n\"0,01\",\"10,25\",8\n";
  EXPECT_NE(refusalOf(text).find("column 1: \"0,00\" has a decimal comma; read the file with "
                                 "--decimal comma"),
            std::string::npos)
      << refusalOf(text);
  for (const char delimiter : {'\0', ','}) {
    const ReadTable table = readText(text, {.delimiter = delimiter, .decimal = ','});
    EXPECT_EQ(table.names(), (Names{"a", "b", "c"}));
    EXPECT_EQ(table.rows, (Rows{{0.0, 1.5, 7}, {0.01, 10.25, 8}}));
  }
  EXPECT_NE(refusalOf("a,b\n1,5\n2,7\n", {.delimiter = ',', .decimal = ','})
                .find("decimal commas need another delimiter than a comma, or quotes"),
            std::string::npos);
  const std::string thousands = "a,b\n1,990\n2,\"1,010\"\n";
  EXPECT_NE(refusalOf(thousands).find("\"1,010\" has a comma of thousands or a decimal comma; save "
                                      "the file without commas of thousands"),
            std::string::npos)
      << refusalOf(thousands);
}

TEST(TextTable, ATextIsNoTable) {
  EXPECT_NE(refusalOf("").find("holds no row"), std::string::npos);
  EXPECT_NE(refusalOf("# only a comment\n").find("holds no row"), std::string::npos);
  EXPECT_NE(refusalOf("hello\nworld\n").find("no numbers"), std::string::npos);
  for (const std::string& utf16 : {std::string("\xFF\xFE"
                                               "1\0,\0"
                                               "2\0",
                                               8),
                                   std::string("1\0,\0"
                                               "2\0\n\0",
                                               8),
                                   std::string("\0"
                                               "1\0,\0"
                                               "2\0\n",
                                               8)})
    EXPECT_NE(refusalOf(utf16).find("is a text in UTF-16; save it as UTF-8"), std::string::npos);
  EXPECT_NE(refusalOf(std::string("1,2\n") + std::string(kMaxLineBytes + 10, '7')).find("longer"),
            std::string::npos);
  EXPECT_NE(refusalOf("\x1F\x8B\x08").find("gunzip"), std::string::npos);
  EXPECT_NE(refusalOf("BZh91AY").find("recording already"), std::string::npos);
  const testing::TemporaryFolder folder;
  EXPECT_THROW(openTable(folder / "absent.csv"), FileError);
  EXPECT_THROW(openTable(folder.path()), FormatError);
}

// imports 23: each file has the first bytes that its format's specification gives.
TEST(OpenTable, NamesFilesOfOtherProgramsAndSaysWhatToDo) {
  const std::string zeros(600, '\0');
  const std::string sqlite = "SQLite format 3" + zeros;
  const testing::TemporaryFolder folder;
  for (const auto& [name, bytes, words] : std::vector<std::array<std::string, 3>>{
           {"a.db3", sqlite, "a bag of ROS 2 in SQLite: convert it to MCAP (ros2 bag convert)"},
           {"a.palpate", sqlite, "is a recording already"},
           {"a.xlsx",
            "PK\x03\x04" + zeros.substr(0, 26) + "[Content_Types].xml<Types/>",
            "is an Excel workbook: save it as CSV"},
           {"a.xls", "\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1" + zeros, "is an Excel workbook"},
           {"a.parquet", "PAR1\x15\x04" + zeros, "is a Parquet file"},
           {"a.xdf", "XDF:<info>" + zeros, "is an XDF file"},
           {"a.bag", "#ROSBAG V2.0\n" + zeros, "is a bag of ROS 1"},
           {"a.pkl", "\x80\x04\x95" + zeros, "is a pickle of Python: save its arrays as .npz"},
           {"a.csv",
            "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 12\n",
            "git lfs pull"},
           {"a.mcap", "\x89MCAP0\r\n" + zeros, "palpate convert"},
           {"a.bin", std::string("\1\0\2\0\0\3\0\4\4\0\5\0", 12) + zeros, "neither a text"}}) {
    testing::writeFile(folder / name, bytes);
    const std::string what = testing::errorOf([&, &name = name] { openTable(folder / name); });
    EXPECT_NE(what.find(words), std::string::npos) << what;
    EXPECT_EQ(what.find("UTF-16"), std::string::npos) << what;
  }
  std::filesystem::create_directory(folder / "bag");
  testing::writeFile(folder / "bag/metadata.yaml", "rosbag2_bagfile_information:\n");
  testing::writeFile(folder / "bag/bag_0.mcap", "");
  // Every command says the same, of files that are opened as recordings, too.
  EXPECT_NE(testing::errorOf([&] { openTable(folder / "bag"); }).find("name its file bag_0.mcap"),
            std::string::npos);
  EXPECT_EQ(noRecordingText(folder / "bag"),
            (folder / "bag").string() +
                ": is the folder of a bag of ROS 2: name its file "
                "bag_0.mcap");
  for (const char* name : {"a.db3", "a.xlsx", "a.parquet", "a.xdf", "a.bag", "a.pkl"}) {
    const std::string what = testing::errorOf([&] { openTable(folder / name); });
    EXPECT_EQ(testing::errorOf([&] { openRecording(folder / name); }), what);
    EXPECT_EQ(testing::errorOf([&] { readableRecording(folder / name); }), what);
  }
}

// A folder that can't be listed, or is gone by then, has no files; no exception of the standard
// library is thrown.
TEST(FolderSource, AFolderThatCanNotBeListedHoldsNothing) {
  const testing::TemporaryFolder folder;
  EXPECT_TRUE(filesPerMatrix(folder / "none").empty());
  EXPECT_THROW(FolderSource(folder / "none", {}), FormatError);
}

// Every dtype of whole and real numbers, both byte orders, both orders of the array, compressed or
// not, in a .npz and alone: NumPy writes, and each value must be what NumPy computed for it.
TEST(NumpyArrays, HaveTheValuesThatNumpyWrote) {
  const testing::TemporaryFolder folder;
  testing::runPython(folder, R"(
import sys, numpy as np
folder = sys.argv[1] + '/'
base = (np.arange(3 * 4 * 2).reshape(3, 4, 2) * 5) % 120
arrays, names = {}, []
for kind in ['b1', 'i1', 'i2', 'i4', 'i8', 'u1', 'u2', 'u4', 'u8', 'f2', 'f4', 'f8']:
  for order in '<>':
    for layout in 'CF':
      values = base.astype(kind)
      if kind[0] == 'i': values = -values
      if kind[0] == 'f': values = values / np.array(8, dtype=kind) - np.array(2, dtype=kind)
      name = kind + ('l' if order == '<' else 'b') + layout
      arrays[name] = np.asarray(values.astype(order + kind), order=layout)
      names.append(name)
np.savez(folder + 'plain.npz', **arrays)
np.savez_compressed(folder + 'packed.npz', **arrays)
for name in names: np.save(folder + name + '.npy', arrays[name])
with open(folder + 'truth.csv', 'w') as out:
  for row in range(3):
    out.write(','.join(repr(float(v)) for n in names for v in arrays[n][row].ravel()) + '\n')
)");
  const ReadTable truth = readTable(folder / "truth.csv", {.header = HeaderChoice::kAbsent});
  ASSERT_EQ(truth.rows.size(), 3u);
  ASSERT_EQ(truth.rows[0].size(), 48u * 8);
  EXPECT_EQ(readTable(folder / "plain.npz").rows, truth.rows);
  const ReadTable packed = readTable(folder / "packed.npz");
  EXPECT_EQ(packed.rows, truth.rows);
  std::size_t at = 0;
  for (const TableColumn& column : packed.columns) {
    EXPECT_EQ(column.shape, (std::vector<std::size_t>{4, 2}));
    EXPECT_EQ(column.numRows, 3u);
    const ReadTable alone = readTable(folder / (column.name + ".npy"));
    for (std::size_t row = 0; row < 3; ++row)
      EXPECT_EQ(alone.rows[row],
                std::vector<double>(truth.rows[row].begin() + static_cast<std::ptrdiff_t>(at),
                                    truth.rows[row].begin() + static_cast<std::ptrdiff_t>(at + 8)))
          << column.name;
    at += 8;
  }
}

TEST(NumpyArrays, OthersAreListedButHoldNoNumbers) {
  const testing::TemporaryFolder folder;
  testing::runPython(folder, R"(
import sys, numpy as np
np.savez(sys.argv[1] + '/a.npz', text=np.array(['a', 'b']), record=np.zeros(2, dtype=[('x', 'f4'), ('y', 'i2')]),
         one=np.array(3.0), values=np.arange(6.0).reshape(2, 3), complex=np.zeros(2, dtype='c16'),
         when=np.array(['2014-11-27T10:31:05.25'] * 2, dtype='datetime64[ms]'), column=np.zeros((2, 1)))
)");
  const auto source = openTable(folder / "a.npz");
  std::string text;
  for (const TableColumn& column : source->columns())
    text += column.name + (column.isNumeric ? "+" : "-") + (column.hasDates ? "d" : "") + " ";
  EXPECT_EQ(text, "text- record- one- values+ complex- when-d column+ ");
  source->start({}, 5);
  TableRow row;
  ASSERT_TRUE(source->next(row));
  EXPECT_EQ(row.time.whole, 1'417'084'265'250'000);
}

TEST(NumpyArrays, DamageIsOneLine) {
  const testing::TemporaryFolder folder;
  testing::runPython(folder, R"(
import sys, numpy as np
folder = sys.argv[1] + '/'
np.savez(folder + 'a.npz', m0=np.arange(600.0).reshape(100, 6))
np.savez_compressed(folder + 'b.npz', m0=np.random.default_rng(1).integers(0, 4096, (500, 6)))
np.save(folder + 'a.npy', np.arange(600.0).reshape(100, 6))
)");
  const auto refusalOfBytes = [&](const std::string& bytes) { return refusalOf(bytes); };
  for (const char* name : {"a.npz", "b.npz", "a.npy"}) {
    const std::string whole = testing::readFile(folder / name);
    for (const std::size_t length : {std::size_t{12}, whole.size() / 2, whole.size() - 30}) {
      const std::string what = refusalOfBytes(whole.substr(0, length));
      EXPECT_NE(what, "") << name << " " << length;
      EXPECT_EQ(what.find('\n'), std::string::npos);
    }
  }
  std::string flipped = testing::readFile(folder / "b.npz");
  flipped[flipped.size() / 2] = static_cast<char>(flipped[flipped.size() / 2] ^ 0x10);
  EXPECT_NE(refusalOfBytes(flipped).find("is damaged"), std::string::npos);
  flipped = testing::readFile(folder / "a.npz");
  flipped[flipped.size() / 2] = static_cast<char>(flipped[flipped.size() / 2] ^ 0x10);
  EXPECT_NE(refusalOfBytes(flipped).find("checksum"), std::string::npos);
  EXPECT_NE(refusalOfBytes(testing::readFile(folder / "a.npz").substr(0, 900)).find("cut off"),
            std::string::npos);
}

std::string npyWith(const std::string& literal, std::size_t length) {
  std::string bytes = "\x93NUMPY";
  bytes += '\x01';
  bytes += '\0';
  bytes += static_cast<char>(length & 0xFF);
  bytes += static_cast<char>(length >> 8);
  return bytes + literal;
}

TEST(NumpyArrays, HugeAndWrongHeadersAreRefused) {
  const auto refused = [](const std::string& literal) {
    return refusalOf(npyWith(literal, literal.size()) + std::string(64, '\0'));
  };
  const std::string good = "{'descr': '<f4', 'fortran_order': False, 'shape': (4, 4), }";
  EXPECT_EQ(refused(good), "");
  for (const char* literal :
       {"{'descr': '<f4', 'fortran_order': False, 'shape': (1000000000000, 4), }",
        "{'descr': '<f4', 'fortran_order': False, 'shape': (4611686018427387904, 4), }",
        "{'descr': '<f4', 'fortran_order': False, 'shape': (0, 4611686018427387904, 8), }",
        "{'descr': '<f4', 'fortran_order': False, 'shape': (-1, 4), }",
        "{'descr': '<f4', 'fortran_order': False, 'shape': (4, ",
        "{'descr': '<f4', 'fortran_order': Maybe, 'shape': (4, 4), }",
        "{'descr': '<f4', 'shape': (4, 4), }",
        "{'descr': [('x', '<f4'",
        "{'colour': 3}",
        "[]",
        ""})
    EXPECT_NE(refused(literal), "") << literal;
  EXPECT_NE(refusalOf(npyWith(good, 60'000)), "");
  std::string version2 = "\x93NUMPY\x02";
  version2 += std::string(1, '\0') + "\xFF\xFF\xFF\x7F" + good;
  EXPECT_NE(refusalOf(version2).find("too many"), std::string::npos);
}

TEST(Hdf5DataSets, HaveTheValuesThatH5pyWrote) {
  const testing::TemporaryFolder folder;
  testing::runPython(folder, R"(
import sys, numpy as np, h5py
folder = sys.argv[1] + '/'
base = (np.arange(5 * 3 * 2).reshape(5, 3, 2) * 7) % 100
names = []
with h5py.File(folder + 'a.h5', 'w') as f, open(folder + 'truth.csv', 'w') as out:
  truth = []
  for kind in ['i1', 'i2', 'i4', 'i8', 'u1', 'u2', 'u4', 'u8', 'f2', 'f4', 'f8']:
    for order in '<>':
      values = base.astype(kind)
      if kind[0] == 'i': values = -values
      if kind[0] == 'f': values = values / np.array(8, dtype=kind)
      name = 'tactile/' + kind + ('l' if order == '<' else 'b')
      f.create_dataset(name, data=values.astype(order + kind), dtype=order + kind,
                       chunks=(2, 3, 1), compression='gzip' if order == '<' else None)
      truth.append((name, values))
  truth.sort()
  f['tactile/f4l'].attrs['units'] = 'kPa'
  f['text'] = 'no number'
  for row in range(5):
    out.write(','.join(repr(float(v)) for n, a in truth for v in a[row].ravel()) + '\n')
)");
  const ReadTable truth = readTable(folder / "truth.csv", {.header = HeaderChoice::kAbsent});
  const ReadTable read = readTable(folder / "a.h5");
  EXPECT_EQ(read.rows, truth.rows);
  EXPECT_EQ(read.columns.size(), 23u);
  for (const TableColumn& column : read.columns)
    EXPECT_EQ(column.unit, column.name == "tactile/f4l" ? "kPa" : "") << column.name;
  const std::string whole = testing::readFile(folder / "a.h5");
  EXPECT_NE(refusalOf(whole.substr(0, whole.size() / 2)).find("can't be opened as HDF5"),
            std::string::npos);
}

// MATLAB's files of version 7.3 are HDF5 behind 512 bytes of text.
TEST(Hdf5DataSets, OfAMatlabFileAreReadAndARecordingIsNamedAsOne) {
  const testing::TemporaryFolder folder;
  testing::runPython(folder, R"(
import sys, h5py
path = sys.argv[1] + '/a.mat'
with h5py.File(path, 'w', userblock_size=512) as f: f['pad'] = [[1., 2.], [3., 4.]]
with open(path, 'r+b') as f: f.write(b'MATLAB 7.3 MAT-file'.ljust(512))
)");
  EXPECT_TRUE(isHdf5Table(folder / "a.mat"));
  const ReadTable read = readTable(folder / "a.mat");
  ASSERT_EQ(read.columns.size(), 1u);
  EXPECT_EQ(read.columns[0].name, "pad");
  EXPECT_EQ(read.rows.size(), 2u);
  EXPECT_NE(refusalOf(std::string(kHdf5RecordingStart)).find("is a recording already"),
            std::string::npos);
  EXPECT_FALSE(isHdf5Table(folder / "nothing"));
  testing::writeFile(folder / "short", "\x89HD");
  EXPECT_FALSE(isHdf5Table(folder / "short"));
}

TEST(OpenTable, RefusesAFifoAndADevice) {
  const testing::TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder / "fifo").c_str(), 0600), 0);
  EXPECT_THROW(openTable(folder / "fifo", {}), FileError);
  EXPECT_THROW(openTable("/dev/zero", {}), FileError);
}

TEST(TableColumn, WidthIsTheProductOfItsShape) {
  EXPECT_EQ(TableColumn{}.width(), 1u);
  TableColumn column;
  column.shape = {14, 6};
  EXPECT_EQ(column.width(), 84u);
  for (const char letter : {',', ';', '\t', ' ', '\0'})
    EXPECT_EQ(delimiterNamed(delimiterName(letter)), letter);
  EXPECT_EQ(delimiterNamed("pipe"), std::nullopt);
}

}  // namespace
}  // namespace palpate::table_source_test
