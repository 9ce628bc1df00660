// Writes the ground truth of an emulated hand to CSV, to be compared with its sensor readings:
//   time_ms,matrix,contact,force_n,x_mm,y_mm,z_mm,slip_x_taxels,slip_y_taxels,turn_deg
// One row per matrix and frame; without contact the columns after `contact` are empty. Of hands
// with three components per taxel two more columns: shear_x_n,shear_y_n.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <palpate/core/output_file.h>
#include <palpate/emulator/hand_model.h>

namespace palpate {

class TruthWriter {
 public:
  // Creates the file and writes its header line. Throws FileError.
  explicit TruthWriter(const std::filesystem::path& path,
                       Overwrite overwrite = Overwrite::kRefuse,
                       bool hasShear = false);
  // hostUs: host time of the frame [us since 1970]. Throws FileError (disk full, ..).
  void add(std::int64_t hostUs, const std::vector<MatrixTruth>& truth);
  // Flushes. Throws FileError.
  void finish();

 private:
  std::filesystem::path path_;
  std::ofstream out_;
  std::string line_;
  bool hasShear_;
};

}  // namespace palpate
