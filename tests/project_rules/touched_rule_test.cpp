// Code asks isTouched() whether a taxel is touched (model/tactile_frame.h). A comparison with 0 of
// its own would go on when touch is decided otherwise: each one stands in a list.
#include <iterator>
#include <map>
#include <regex>
#include <string>

#include <gtest/gtest.h>

#include "project_rules/source_tree.h"

namespace palpate::testing::touched_rule_test {
namespace {

// Comparisons with 0 of single-precision numbers, as values of taxels are, and of what has the name
// of such a value. Those below were reviewed: none asks whether a taxel is touched. The list may
// only shrink.
const std::map<std::string, std::size_t> kReviewed = {
    {"apps/palpate/commands/calibrate_sensitivity.cpp", 1},
    {"apps/palpate/commands/contact_command.cpp", 1},
    {"apps/palpate/commands/render_command.cpp", 1},
    {"apps/palpate/commands/spectrum_command.cpp", 1},
    {"apps/palpate/gui/batch/batch_pictures.cpp", 1},
    {"apps/palpate/gui/hand3d/hand_mesh.cpp", 1},
    {"apps/palpate/gui/hand3d/hand_scene.cpp", 3},
    {"apps/palpate/gui/hand3d/hand_scene_builder.cpp", 1},
    {"apps/palpate/gui/hand3d/hand_tile.cpp", 2},
    {"apps/palpate/gui/hand3d/raster_setup.cpp", 7},
    {"apps/palpate/gui/matrices/matrices_painter.cpp", 2},
    {"include/palpate/model/active_taxels.h", 1},
    {"include/palpate/model/matrix_layout.h", 2},
    {"include/palpate/model/tactile_frame.h", 3},
    {"src/calibration/tare.cpp", 3},
    {"src/capture/recording_options.cpp", 1},
    {"src/device/dsa_frame.cpp", 1},
    {"src/device/stop_main.cpp", 1},
    {"src/device/stream_shape.cpp", 1},
    {"src/emulator/sdh_command_processor.cpp", 1},
    {"src/emulator/simulated_recording.cpp", 1},
    {"src/emulator/synthetic_profile.cpp", 1},
    {"src/filter/median_neighbors.cpp", 1},
    {"src/filter/recipe.cpp", 1},
    {"src/filter/separable_filters.cpp", 1},
    {"src/filter/spatial_filter.cpp", 1},
    {"src/imports/csv_shape.cpp", 1},
    {"src/interop/foxglove_messages.cpp", 2},
    {"src/interop/remote_fields.cpp", 1},
    {"src/model/frame_coding.cpp", 1},
    {"src/recognition/session_offset.cpp", 1},
    {"src/slip/contact_ends.cpp", 2},
    {"src/slip/key_frame.cpp", 1},
    {"src/slip/ncc_method.cpp", 5},
    {"src/slip/surface_grid.cpp", 1},
    {"src/slip/surface_information.cpp", 2},
};

// Behind "//" and in lines of text nothing is code.
std::size_t numComparisons(const std::string& text) {
  static const std::regex comparison(
      R"( *(>|<=|!=) *0\.0?F)"
      R"(|((value|values|counts|reading|measured)[\])]*|values[\[(][^<>=]*[\])]))"
      R"( *(>|<=|!=) *0(\.0?)?([^.0-9F]|$))");
  std::size_t count = 0;
  for (const std::string& line : linesOf(text)) {
    const std::string code = line.substr(0, line.find("//"));
    const std::size_t begin = code.find_first_not_of(' ');
    if (begin == std::string::npos || code[begin] == '"' || code.find('0') == std::string::npos)
      continue;
    count += static_cast<std::size_t>(
        std::distance(std::sregex_iterator(code.begin(), code.end(), comparison), {}));
  }
  return count;
}

TEST(TouchedRule, FindsComparisonsOfValues) {
  for (const char* code : {"if (x > 0.0F)",
                           "return !(frame.values[place] > 0);",
                           "values(y, x) != 0.0",
                           "(matrix.array() > 0.F).any()",
                           "peak.counts <= 0.0F",
                           "value > 0"})
    EXPECT_EQ(numComparisons(code), 1u) << code;
  EXPECT_EQ(numComparisons("value > 0.0F && counts > 0"), 2u);
  for (const char* code : {"value > 0.5",
                           "x > 0.05F",
                           "// value > 0",
                           "  \"value > 0\"",
                           "values.size() > 0",
                           "n > 0"})
    EXPECT_EQ(numComparisons(code), 0u) << code;
}

TEST(TouchedRule, CodeAsksIsTouched) {
  std::map<std::string, std::size_t> found;
  for (const SourceFile& file : cppFiles({"apps", "include", "src"}))
    if (const std::size_t count = numComparisons(file.text); count > 0) found[file.path] = count;
  for (const auto& [path, count] : found) {
    const auto reviewed = kReviewed.find(path);
    EXPECT_LE(count, reviewed == kReviewed.end() ? 0u : reviewed->second)
        << path << ": ask isTouched() whether a taxel is touched";
  }
  for (const auto& [path, count] : kReviewed) {
    const auto now = found.find(path);
    EXPECT_GE(now == found.end() ? 0u : now->second, count) << path << ": lower the list";
  }
}

}  // namespace
}  // namespace palpate::testing::touched_rule_test
