#include "commands/export_options.h"

#include "palpate/core/hash.h"
#include "palpate/interop/derived_series.h"
#include "palpate/recording/recording.h"

namespace palpate::commands {

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

SaveExtras saveExtrasOf(const CommandLine& given,
                        const std::filesystem::path& in,
                        const std::filesystem::path& out,
                        const Profile& profile,
                        const Recipe& recipe) {
  const RecordingFormat format = formatOf(out);
  SaveExtras all;
  all.unitsRow = given.has("units-row");
  if (all.unitsRow && format != RecordingFormat::kCsv)
    throw UsageError("--units-row is for .csv; " + out.string() + " isn't one");
  const auto compression = given.choice("compression", {"zstd", "lz4", "none"});
  const auto images = given.choice("images", {"ros", "foxglove"});
  for (const auto* chosen : {&compression, &images})
    if (*chosen && format != RecordingFormat::kMcap)
      throw UsageError(std::string(chosen == &images ? "--images" : "--compression") +
                       " is for .mcap; " + out.string() + " isn't one");
  if (compression)
    all.mcap.compression = *compression == "lz4"    ? McapCompression::kLz4
                           : *compression == "none" ? McapCompression::kNone
                                                    : McapCompression::kZstd;
  if (images) all.mcap.images = *images == "ros" ? McapImages::kRos : McapImages::kFoxglove;
  if (!recipe.empty() && (format == RecordingFormat::kDsa || format == RecordingFormat::kPalpate))
    throw UsageError("'palpate filter' makes filtered recordings; --filter is for exports");
  all.meta = readRecordingMeta(in);
  if (format != RecordingFormat::kHdf5 && format != RecordingFormat::kMat &&
      format != RecordingFormat::kMcap)
    return all;
  ExportExtras& extras = all.exported;
  extras.provenance.program = "palpate " PALPATE_VERSION;
  extras.provenance.sourceFile = in.filename().string();
  extras.provenance.sourceSha256 = sha256OfFile(in);
  extras.provenance.filters = recipeText(recipe);
  extras.provenance.hand = profile.hand().name;
  extras.series = derivedSeries(
      profile, {.withSignals = !given.has("no-signals"), .withSlip = !given.has("no-slip")});
  return all;
}

}  // namespace palpate::commands
