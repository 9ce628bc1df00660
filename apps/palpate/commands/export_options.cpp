#include "commands/export_options.h"

#include <stdexcept>

namespace palpate::commands {

OptionSpec unitsRowOption() { return {"units-row", "", "a second row with the units"}; }

std::vector<OptionSpec> withExportOptions(std::vector<OptionSpec> options) {
  options.push_back(
      {"no-signals", "", "of .h5, .mat and .mcap: without the characteristic signals"});
  options.push_back({"no-slip", "", "of .h5, .mat and .mcap: without the slip"});
  options.push_back({"compression", "KIND", "of .mcap: zstd (default), lz4 or none"});
  options.push_back(
      {"images", "KIND", "of .mcap: ros (sensor_msgs/Image, default) or foxglove (RawImage)"});
  options.push_back({"units-row", "", "of .csv: a second row with the units"});
  return options;
}

ExportChoices exportChoicesOf(const CommandLine& given,
                              const Recipe& filters,
                              const std::filesystem::path& out) {
  ExportChoices choices{.withSignals = !given.has("no-signals"),
                        .withSlip = !given.has("no-slip"),
                        .unitsRow = given.has("units-row")};
  if (const auto kind = given.choice("compression", {"zstd", "lz4", "none"}))
    choices.compression = *kind == "lz4"    ? McapCompression::kLz4
                          : *kind == "none" ? McapCompression::kNone
                                            : McapCompression::kZstd;
  if (const auto kind = given.choice("images", {"ros", "foxglove"}))
    choices.images = *kind == "ros" ? McapImages::kRos : McapImages::kFoxglove;
  try {
    requirePossible(choices, filters, out);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
  return choices;
}

}  // namespace palpate::commands
