#include "palpate/batch/export_extras.h"

#include <stdexcept>

#include "palpate/batch/derived_series.h"
#include "palpate/core/hash.h"

namespace palpate {

const RecordingMeta& ExportSource::meta() const {
  if (!meta_) meta_ = readRecordingMeta(file_);
  return *meta_;
}

const std::string& ExportSource::sha256() const {
  if (!sha256_) sha256_ = sha256OfFile(file_);
  return *sha256_;
}

void requirePossible(const ExportChoices& choices,
                     const Recipe& filters,
                     const std::filesystem::path& out) {
  const RecordingFormat& format = formatOf(out);
  if (choices.unitsRow && !format.takesUnitsRow)
    throw std::invalid_argument("--units-row is for .csv; " + out.string() + " isn't one");
  for (const char* option :
       {choices.compression ? "--compression" : "", choices.images ? "--images" : ""})
    if (*option && !format.takesMcap)
      throw std::invalid_argument(std::string(option) + " is for .mcap; " + out.string() +
                                  " isn't one");
  if (!filters.empty() && !format.isExport)
    throw std::invalid_argument(
        "'palpate filter' makes filtered recordings; --filter is for exports");
}

SaveExtras exportExtras(const ExportChoices& choices,
                        const ExportSource& in,
                        const std::filesystem::path& out,
                        const Profile& profile,
                        const Recipe& filters) {
  requirePossible(choices, filters, out);
  SaveExtras all;
  all.unitsRow = choices.unitsRow;
  all.meta = in.meta();
  if (choices.compression) all.mcap.compression = *choices.compression;
  if (choices.images) all.mcap.images = *choices.images;
  if (!formatOf(out).takesSeries) return all;
  ExportExtras& extras = all.exported;
  extras.provenance.program = "palpate " PALPATE_VERSION;
  extras.provenance.sourceFile = in.file().filename().string();
  extras.provenance.sourceSha256 = in.sha256();
  extras.provenance.filters = fullRecipeText(filters);
  extras.provenance.hand = profile.hand().name;
  extras.series =
      derivedSeries(profile, {.withSignals = choices.withSignals, .withSlip = choices.withSlip});
  return all;
}

}  // namespace palpate
