#include "commands/export_options.h"

#include <stdexcept>

namespace palpate::commands {

OptionSpec unitsRowOption() { return {"units-row", "", "a second row with the units"}; }

std::vector<OptionSpec> withExportOptions(std::vector<OptionSpec> options) {
  options.push_back(
      {"no-signals", "", "leave the characteristic signals out of .h5, .mat and .mcap"});
  options.push_back({"no-slip", "", "leave the slip out of .h5, .mat and .mcap"});
  options.push_back(worded("compression", "KIND", "of .mcap", kMcapCompressionWords, "zstd"));
  options.push_back(
      worded("images", "KIND", "of .mcap: sensor_msgs/Image or RawImage", kMcapImagesWords, "ros"));
  options.push_back({"units-row", "", "of .csv: a second row with the units"});
  return options;
}

ExportChoices exportChoicesOf(const CommandLine& given,
                              const Recipe& filters,
                              const std::filesystem::path& out) {
  ExportChoices choices{.withSignals = !given.has("no-signals"),
                        .withSlip = !given.has("no-slip"),
                        .unitsRow = given.has("units-row")};
  choices.compression = given.chosen("compression", kMcapCompressionWords);
  choices.images = given.chosen("images", kMcapImagesWords);
  try {
    requirePossible(choices, filters, out);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
  return choices;
}

}  // namespace palpate::commands
