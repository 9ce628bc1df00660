#include "commands/export_options.h"

#include "palpate/core/hash.h"
#include "palpate/interop/derived_series.h"
#include "palpate/recording/recording.h"

namespace palpate::commands {

std::vector<OptionSpec> withExportOptions(std::vector<OptionSpec> options) {
  options.push_back({"no-signals", "", "of .h5 and .mat: without the characteristic signals"});
  options.push_back({"no-slip", "", "of .h5 and .mat: without the slip"});
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
  if (!recipe.empty() && (format == RecordingFormat::kDsa || format == RecordingFormat::kPalpate))
    throw UsageError("'palpate filter' makes filtered recordings; --filter is for exports");
  all.meta = readRecordingMeta(in);
  if (format != RecordingFormat::kHdf5 && format != RecordingFormat::kMat) return all;
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
