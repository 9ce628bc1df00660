// NumPy's arrays: one in a .npy file, or several by name in a .npz (a zip file of .npy).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "imports/stored_array_source.h"
#include "imports/zip_archive.h"

namespace palpate {

class NpzSource final : public StoredArraySource {
 public:
  explicit NpzSource(const std::filesystem::path& path);
  std::string form() const override;
  std::string rowNote() const override;

 protected:
  std::unique_ptr<SequentialReader> unpacked(std::size_t column) override;

 private:
  void addColumn(const std::string& name, NpyHeader header, std::uint64_t available);

  bool isArchive_ = false;
  std::vector<ZipEntry> entries_;  // of the columns of an archive
};

}  // namespace palpate
