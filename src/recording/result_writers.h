// The forms of result_file.h that are not text. Each returns the number of rows, and throws as
// writeResult(). Private to this module.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "palpate/core/json.h"
#include "palpate/core/output_file.h"
#include "palpate/core/result_table.h"
#include "palpate/recording/mcap_recording.h"

namespace palpate {

std::size_t writeNpzTable(ResultTable& table,
                          const std::filesystem::path& path,
                          Overwrite overwrite);
std::size_t writeMatTable(ResultTable& table,
                          const std::filesystem::path& path,
                          Overwrite overwrite);
std::size_t writeMcapTable(ResultTable& table,
                           const std::filesystem::path& path,
                           Overwrite overwrite,
                           const McapWriteOptions& options = {});
// Of the library palpate_with_hdf5, or of palpate_without_hdf5.
std::size_t writeHdf5Table(ResultTable& table,
                           const std::filesystem::path& path,
                           Overwrite overwrite);

// Its JSON form without rows: {"table", "columns": [{"name", "unit", "kind"}], "rows": []}.
inline Json headOf(const ResultTable& table) {
  return Json::parse(TableText(table, {.form = TableForm::kJson}).begin() + kJsonTableEnd);
}

}  // namespace palpate
