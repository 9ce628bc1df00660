// GNU Octave reads what writeMat() writes. It is a large package, so this is a slow test; the fast
// tests (mat_export_test) read the same files with SciPy.

#include <gtest/gtest.h>

#include "palpate/model/profile_builder.h"
#include "palpate/recording/mat_export.h"

#include "testing/testing.h"

namespace palpate::mat_octave_slow_test {
namespace {

constexpr const char* kOctave = "octave-cli";

TEST(MatOctave, structuresArraysTextsAndTimesAreRead) {
  if (std::system("command -v octave-cli >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "Octave isn't installed";
  const testing::TemporaryFolder folder;
  // Taxel k of frame i has 10 i + k counts.
  ProfileBuilder builder(std::make_shared<const SensorLayout>(
      std::vector<MatrixLayout>{MatrixLayout::full(2, 3, 2.5)}));
  for (std::size_t i = 0; i < 300; ++i) {
    std::vector<float> values;
    for (std::size_t k = 0; k < 6; ++k) values.push_back(static_cast<float>(10 * i + k));
    const auto timeUs = 1'600'000'000'000'001 + static_cast<std::int64_t>(i) * 10;
    builder.addFrame(timeUs, values);
    builder.addAngles(timeUs, std::vector<double>{static_cast<double>(i), 0.25});
  }
  ExportExtras extras;
  extras.provenance.sourceFile = "a.dsa";
  const std::vector<Event> events{{5, 9, "note", 1, "first", "{}"},
                                  {7, 7, "mark", std::nullopt, "", ""}};
  const Profile profile = builder.finish({});
  writeMat({profile, events, {{"operator", "A. B."}}, extras}, folder / "a.mat");
  testing::writeFile(folder / "check.m", R"(
a = load(argv(){1});
m = a.tactile.m0;
assert(class(m), 'uint16');
assert(size(m), [3 2 300]);
expected = reshape(10 * reshape(0:299, 1, 1, 300) + reshape(0:5, 3, 2), 3, 2, 300);
assert(double(m), expected);
assert(class(a.tactile.time_us), 'int64');
assert(a.tactile.time_us(2) - a.tactile.time_us(1) == int64(10));
assert(bitand(a.tactile.time_us(1), int64(1)) == int64(1));
assert(a.tactile.units, 'counts');
assert(a.joints.angles(:, 8)', [7 0.25]);
assert(a.events.kind, {'note'; 'mark'});
assert(a.events.text{1}, 'first');
assert(isempty(a.events.text{2}));
assert(a.events.matrix(:)', [1 -1]);
assert(a.provenance.source_file, 'a.dsa');
assert(any(strcmp(a.meta.value, 'A. B.')));
printf('read');
)");
  const std::string out = folder / "out";
  const std::string command = std::string(kOctave) + " --no-init-file '" +
                              (folder / "check.m").string() + "' '" + (folder / "a.mat").string() +
                              "' > '" + out + "'";
  EXPECT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(testing::readFile(out), "read");
}

}  // namespace
}  // namespace palpate::mat_octave_slow_test
