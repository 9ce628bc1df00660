// MAT files of version 5 as tables: what is read of them, and that none is read in part.
#include <map>

#include "palpate/imports/recording_import.h"
#include "palpate/imports/table_source.h"

#include "imports/import_samples.h"

namespace palpate::mat5_test {
namespace {

using testing::pad;
using testing::TemporaryFolder;

void makeMatFiles(const TemporaryFolder& folder, const std::string& script) {
  testing::runPython(folder,
                     std::string(testing::kMat5Writer) + "folder = sys.argv[1] + '/'\n" + script);
}

// The rows of one column.
std::vector<std::vector<double>> rowsOf(TableSource& source, std::size_t column) {
  source.start(std::span(&column, 1), std::nullopt);
  std::vector<std::vector<double>> rows;
  for (TableRow row; source.next(row);) rows.push_back(row.values);
  return rows;
}

std::map<std::string, std::size_t> namesOf(const TableSource& source) {
  std::map<std::string, std::size_t> names;
  for (std::size_t c = 0; c < source.columns().size(); ++c) names[source.columns()[c].name] = c;
  return names;
}

constexpr const char* kAllKinds = R"(
def parts():
  yield array('pad', np.arange(24.).reshape(2, 3, 4), 'u1')
  for kind in classes: yield array('of_' + kind, np.array([[1], [100]], kind))
  yield array('negative', np.array([[-1.0], [-30000.0]]), 'i2')
  yield array('yes', np.array([[1], [0], [1]], 'u1'), flags=0x200)
  yield structure('one', [{'a': array('', np.array([[5.], [6.]])), 'in': structure('', [{'b': array('', np.array([7.]))}])}])
  yield structure('many', [{'x': array('', np.array([1.]))}, {'x': array('', np.array([2.]))}])
  yield cells('c', [array('', np.array([[3.], [4.]])), array('', np.array([9.]))])
  yield matrix(4, (1, 2), 'words', element(16, b'ab'))
  yield matrix(5, (2, 2), 'thin', element(5, pack('i', 0)))
  yield matrix(6, (1, 1), 'complex', element(9, pack('d', 1)) + element(9, pack('d', 2)), 0x800)
  yield matrix(6, (0, 0), 'empty', element(9, b''))
  yield pack('II', 14, 24 + 16) + element(6, pack('II', 17, 0)) + element(1, b'object__') + bytes(8)
write(folder + 'plain.mat', *parts())
write(folder + 'packed.mat', *map(packed, parts()))
big = True
write(folder + 'big.mat', *parts())
write(folder + 'big_packed.mat', *map(packed, parts()))
)";

TEST(Mat5, ArraysOfAllKindsAreReadAndTheOthersAreNamed) {
  const TemporaryFolder folder;
  makeMatFiles(folder, kAllKinds);
  using Rows = std::vector<std::vector<double>>;
  for (const char* name : {"plain.mat", "packed.mat", "big.mat", "big_packed.mat"}) {
    SCOPED_TRACE(name);
    const auto source = openTable(folder / name);
    EXPECT_TRUE(source->isColumnMajor());
    const auto names = namesOf(*source);
    const auto& columns = source->columns();
    const auto rows = [&](const char* column) { return rowsOf(*source, names.at(column)); };
    // pad(r, c, f) is 12 r + 4 c + f; the axes are reversed.
    const TableColumn& first = columns[names.at("pad")];
    EXPECT_EQ(first.type, "float64");
    EXPECT_EQ(first.numRows, 4u);
    EXPECT_EQ(first.shape, (std::vector<std::size_t>{3, 2}));
    EXPECT_EQ(rows("pad"),
              (Rows{{0, 12, 4, 16, 8, 20},
                    {1, 13, 5, 17, 9, 21},
                    {2, 14, 6, 18, 10, 22},
                    {3, 15, 7, 19, 11, 23}}));
    for (const char* kind : {"f8", "f4", "i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8"})
      EXPECT_EQ(rows(("of_" + std::string(kind)).c_str()), (Rows{{1, 100}})) << kind;
    EXPECT_EQ(columns[names.at("of_u2")].type, "uint16");
    EXPECT_EQ(rows("negative"), (Rows{{-1, -30000}}));
    EXPECT_EQ(columns[names.at("yes")].type, "bool");
    EXPECT_EQ(rows("yes"), (Rows{{1, 0, 1}}));
    EXPECT_EQ(rows("one.a"), (Rows{{5, 6}}));
    EXPECT_EQ(rows("one.in.b"), (Rows{{7}}));
    EXPECT_EQ(rows("many(1).x"), (Rows{{1}}));
    EXPECT_EQ(rows("many(2).x"), (Rows{{2}}));
    EXPECT_EQ(rows("c{1}"), (Rows{{3, 4}}));
    EXPECT_EQ(rows("c{2}"), (Rows{{9}}));
    for (const auto& [column, type] : std::map<std::string, std::string>{{"words", "text"},
                                                                         {"thin", "sparse"},
                                                                         {"complex", "complex"},
                                                                         {"empty", "float64"},
                                                                         {"object__", "object"}}) {
      EXPECT_EQ(columns[names.at(column)].type, type);
      EXPECT_FALSE(columns[names.at(column)].isNumeric) << column;
    }
    EXPECT_EQ(columns.size(), 24u);
  }
}

// By another writer of this form.
TEST(Mat5, WhatSciPySavesIsRead) {
  const TemporaryFolder folder;
  testing::runPython(folder, R"(
import sys, numpy as np
from scipy.io import savemat
pad = np.arange(48.).reshape(8, 2, 3)
session = {'pad': np.moveaxis(pad, 0, 2), 'time_s': np.arange(8) * 0.01, 'who': 'me'}
for packed in [False, True]:
  for name, content in [('flat', session), ('struct', {'session': session})]:
    savemat(f'{sys.argv[1]}/{name}{int(packed)}.mat', content, do_compression=packed)
)");
  for (const char* name : {"flat0.mat", "flat1.mat", "struct0.mat", "struct1.mat"}) {
    importRecording(
        folder / name, pad(2, 3), {}, folder / "o.palpate", {.overwrite = Overwrite::kReplace});
    const Profile made = openRecording(folder / "o.palpate");
    ASSERT_EQ(made.numFrames(), 8u) << name;
    EXPECT_EQ(made.frame(7).values, (std::vector<float>{42, 43, 44, 45, 46, 47})) << name;
    EXPECT_EQ(made.frameTimeUs(7), 70'000) << name;
  }
}

// What SciPy saves, and the same arrays by h5py as MATLAB's version 7.3 lays them out.
TEST(Mat5, BothVersionsOfAFileGiveTheSameRecording) {
  const TemporaryFolder folder;
  testing::runPython(folder, R"(
import sys, h5py, numpy as np
from scipy.io import savemat
classes = {'f8': 'double', 'f4': 'single', 'i1': 'int8', 'u1': 'uint8', 'i2': 'int16', 'u2': 'uint16',
           'i4': 'int32', 'u4': 'uint32', 'i8': 'int64', 'u8': 'uint64', '?': 'logical'}
time = np.arange(8.).reshape(8, 1) * 0.01
for kind, name in classes.items():
  pad = (np.arange(48).reshape(8, 2, 3) % (2 if kind == '?' else 128)).astype(kind)
  for axes, values in {'rcf': np.moveaxis(pad, 0, 2), 'frc': pad, 'fn': pad.reshape(8, 6)}.items():
    path = f'{sys.argv[1]}/{name}_{axes}'
    savemat(path + '.5.mat', {'pad': values, 'time_s': time}, do_compression=axes != 'fn')
    with h5py.File(path + '.7.mat', 'w', userblock_size=512) as f:
      for key, data, of in [('pad', values.astype('u1' if kind == '?' else kind), name), ('time_s', time, 'double')]:
        f[key] = data.T
        f[key].attrs['MATLAB_class'] = np.bytes_(of)
    with open(path + '.7.mat', 'r+b') as f: f.write(b'MATLAB 7.3 MAT-file'.ljust(512))
)");
  for (const char* name : {"double",
                           "single",
                           "int8",
                           "uint8",
                           "int16",
                           "uint16",
                           "int32",
                           "uint32",
                           "int64",
                           "uint64",
                           "logical"})
    for (const char* axes : {"rcf", "frc", "fn"}) {
      SCOPED_TRACE(std::string(name) + " " + axes);
      std::vector<ImportReport> reports;
      // Of logical arrays, which may be masks, no matrix is made unless it is asked for.
      ImportMapping mapping;
      if (*name == 'l') mapping.matrices.emplace_back().columns = "pad";
      for (const char* version : {"5", "7"}) {
        reports.push_back(
            importRecording(folder / (std::string(name) + "_" + axes + "." + version + ".mat"),
                            pad(2, 3),
                            mapping,
                            folder / "o.palpate",
                            {.overwrite = Overwrite::kReplace}));
        const Profile made = openRecording(folder / "o.palpate");
        ASSERT_EQ(made.numFrames(), 8u);
        for (std::size_t i = 0; i < 8; ++i) {
          EXPECT_EQ(made.frameTimeUs(i), static_cast<std::int64_t>(i) * 10'000);
          for (std::size_t k = 0; k < 6; ++k)
            EXPECT_EQ(made.frame(i).values[k],
                      static_cast<float>((6 * i + k) % (*name == 'l' ? 2 : 128)))
                << version << " " << i << " " << k;
        }
      }
      EXPECT_EQ(reports[0].notes, reports[1].notes);
      EXPECT_EQ(reports[0].lossText(), reports[1].lossText());
    }
  for (const char* version : {"5", "7"})
    EXPECT_NE(testing::errorOf([&] {
                importRecording(folder / ("logical_rcf." + std::string(version) + ".mat"),
                                pad(2, 3),
                                {},
                                folder / "o.palpate",
                                {.overwrite = Overwrite::kReplace});
              }).find("no numbers: pad (bool)"),
              std::string::npos)
        << version;
}

TEST(Mat5, FilesThatAreCutOffOrDamagedAreRefused) {
  const TemporaryFolder folder;
  makeMatFiles(folder, R"(
pad = array('pad', np.arange(24.).reshape(2, 3, 4))
short = matrix(6, (2, 3), 'pad', element(9, pack('3d', 0, 1, 2)))
write(folder + 'plain.mat', pad)
write(folder + 'packed.mat', packed(pad))
write(folder + 'short.mat', short, array('t', [1., 2.]))
write(folder + 'packed_short.mat', packed(short))
write(folder + 'long.mat', matrix(6, (2, 3), 'pad', element(9, bytes(72))))
write(folder + 'huge.mat', matrix(6, (2000000000,) * 7, 'pad', element(9, bytes(24))))
write(folder + 'packed_huge.mat', packed(matrix(6, (1000000, 1000000), 'pad', element(9, bytes(24)))))
write(folder + 'none.mat')
np.random.seed(7)
write(folder + 'noise.mat', np.random.bytes(3000))
write(folder + 'packed_noise.mat', pack('II', 15, 3000) + np.random.bytes(3000))
open(folder + 'zero.mat', 'wb')
write(folder + 'negative.mat', matrix(6, (-2, 3), 'pad', element(9, bytes(48))))
write(folder + 'text.mat', matrix(6, (2, 3), 'pad', element(16, bytes(6))))
write(folder + 'nested.mat', structure('s', [{'f': pack('II', 14, 0xFFFFFFF0)}]))
whole = packed(pad)
write(folder + 'checksum.mat', whole[:-1] + bytes([whole[-1] ^ 1]))
more = pad + bytes(100)
data = zlib.compress(more)
write(folder + 'more.mat', pack('II', 15, len(data)) + data)
)");
  const auto refusal = [&](const std::string& name) {
    return testing::errorOf([&] {
      const auto source = openTable(folder / name);
      for (std::size_t c = 0; c < source->columns().size(); ++c) rowsOf(*source, c);
    });
  };
  EXPECT_EQ(refusal("plain.mat"), "");
  EXPECT_EQ(refusal("packed.mat"), "");
  for (const char* name :
       {"short.mat", "packed_short.mat", "long.mat", "huge.mat", "packed_huge.mat", "text.mat"})
    EXPECT_NE(refusal(name).find("\"pad\" declares a different number of numbers than it holds"),
              std::string::npos)
        << name << refusal(name);
  for (const auto& [name, words] :
       std::map<std::string, std::string>{{"none.mat", "is a MAT file without arrays"},
                                          {"noise.mat", "is damaged: no array at byte 128"},
                                          {"packed_noise.mat", "can't be decompressed"},
                                          {"zero.mat", "holds no row"}})
    EXPECT_NE(refusal(name).find(words), std::string::npos) << name << refusal(name);
  for (const char* name : {"negative.mat", "nested.mat"})
    EXPECT_NE(refusal(name).find("is damaged"), std::string::npos) << name << refusal(name);
  EXPECT_NE(refusal("checksum.mat").find("can't be decompressed"), std::string::npos)
      << refusal("checksum.mat");
  EXPECT_NE(refusal("more.mat").find("holds more than it declares"), std::string::npos)
      << refusal("more.mat");
  for (const char* name : {"plain.mat", "packed.mat"}) {
    const std::string whole = testing::readFile(folder / name);
    for (std::size_t size = std::string("MATLAB 5.0 MAT-file").size(); size < whole.size();
         ++size) {
      testing::writeFile(folder / "cut.mat", whole.substr(0, size));
      EXPECT_NE(refusal("cut.mat"), "") << name << " " << size;
    }
    // Of the bytes that stand in front of the numbers each may be any other.
    for (std::size_t at = 124; at < std::min<std::size_t>(whole.size(), 200); ++at)
      for (const int change : {0x01, 0x80, 0xFF}) {
        std::string damaged = whole;
        damaged[at] = static_cast<char>(damaged[at] ^ change);
        testing::writeFile(folder / "cut.mat", damaged);
        refusal("cut.mat");
      }
  }
}

// A recording as MAT file, of a square matrix: the shape doesn't tell the rows from the columns.
TEST(Mat5, WhatPalpateExportedIsImportedAgain) {
  const TemporaryFolder folder;
  const auto made = testing::importText(
      folder, "time_ms,m0[0][0],m0[0][1],m0[1][0],m0[1][1]\n0,1,2,3,4\n10,5,6,7,8\n", pad(2, 2));
  saveRecording(made.profile, {}, folder / "out.mat");
  const ImportReport report =
      importRecording(folder / "out.mat", pad(2, 2), {}, folder / "again.palpate");
  const Profile again = openRecording(folder / "again.palpate");
  ASSERT_EQ(again.numFrames(), 2u);
  EXPECT_EQ(again.frame(1).values, made.profile.frame(1).values);
  EXPECT_EQ(again.frameTimeUs(1) - again.frameTimeUs(0), 10'000);
  // Texts stand in front of the arrays.
  const ImportPreview preview = previewImport(folder / "out.mat", pad(2, 2), {});
  EXPECT_EQ(preview.problem, "");
}

}  // namespace
}  // namespace palpate::mat5_test
