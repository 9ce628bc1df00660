#include "palpate/recording/result_file.h"

#include <algorithm>

#include "palpate/core/error.h"
#include "palpate/core/file_name.h"

#include "recording/result_writers.h"

namespace palpate {
namespace {

// `write`: null for text.
struct ResultForm {
  const char* ending;
  std::size_t (*write)(ResultTable&, const std::filesystem::path&, Overwrite) = nullptr;
};
constexpr ResultForm kResultForms[] = {
    {".csv"},
    {".json"},
    {".npz", &writeNpzTable},
    {".mat", &writeMatTable},
    {".h5", &writeHdf5Table},
    {".hdf5", &writeHdf5Table},
    {".mcap", [](auto& table, const auto& path, Overwrite overwrite) {
       return writeMcapTable(table, path, overwrite);
     }}};

}  // namespace

std::vector<std::string> resultEndings() {
  std::vector<std::string> endings;
  for (const ResultForm& form : kResultForms) endings.emplace_back(form.ending);
  return endings;
}

std::size_t writeResult(ResultTable& table,
                        const std::filesystem::path& path,
                        Overwrite overwrite,
                        const ResultFileOptions& options) {
  const std::string ending = lowerEndingOf(path.string());
  const auto* form = std::find_if(std::begin(kResultForms),
                                  std::end(kResultForms),
                                  [&](const ResultForm& each) { return ending == each.ending; });
  if (form == std::end(kResultForms)) {
    std::string list;
    for (const ResultForm& each : kResultForms)
      list += (list.empty() ? "" : ", ") + std::string(each.ending);
    throw FileError(path, "the name of a table must end in " + list);
  }
  if (form->write) return form->write(table, path, overwrite);
  return writeTableFile(
      table, path, overwrite, {.form = tableFormOf(path), .unitsRow = options.unitsRow});
}

}  // namespace palpate
