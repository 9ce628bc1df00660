#include "palpate/emulator/truth.h"

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"

namespace palpate {

TruthWriter::TruthWriter(const std::filesystem::path& path, Overwrite overwrite, bool hasShear)
    : path_(path), hasShear_(hasShear) {
  requireWritable(path, overwrite);
  out_.open(path, std::ios::binary | std::ios::trunc);
  if (!out_) throw FileError(path, "can't be written");
  out_ << "time_ms,matrix,contact,force_n,x_mm,y_mm,z_mm,slip_x_taxels,slip_y_taxels,turn_deg"
       << (hasShear ? ",shear_x_n,shear_y_n\n" : "\n");
  finish();
}

void TruthWriter::add(std::int64_t hostUs, const std::vector<MatrixTruth>& truth) {
  line_.clear();
  for (std::size_t m = 0; m < truth.size(); ++m) {
    const MatrixTruth& matrix = truth[m];
    appendNumber(line_, hostUs / 1000);
    line_ += ',';
    appendNumber(line_, static_cast<std::int64_t>(m));
    if (!matrix.contact) {
      line_ += hasShear_ ? ",0,,,,,,,,,\n" : ",0,,,,,,,\n";
      continue;
    }
    line_ += ",1";
    for (const double value : {matrix.forceN,
                               matrix.xMm,
                               matrix.yMm,
                               matrix.zMm,
                               matrix.slipXTaxels,
                               matrix.slipYTaxels,
                               matrix.turnDeg}) {
      line_ += ',';
      appendNumber(line_, value);
    }
    for (const double value : {matrix.shearXN, matrix.shearYN}) {
      if (!hasShear_) continue;
      line_ += ',';
      appendNumber(line_, value);
    }
    line_ += '\n';
  }
  out_ << line_;
  if (!out_) throw FileError(path_, "can't be written: is the disk full?");
}

void TruthWriter::finish() {
  out_.flush();
  if (!out_) throw FileError(path_, "can't be written: is the disk full?");
}

}  // namespace palpate
