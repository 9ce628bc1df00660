// Writes the items of an emulated hand in one of the forms that docs/manual/stream_protocol.md
// specifies.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <palpate/emulator/emulated_stream.h>

namespace palpate {

class StreamEncoder {
 public:
  StreamEncoder(const HandDescription& hand, EmulatedStreamFormat format);

  // Bytes with which a connection begins: the description of the sender. Text begins with a
  // comment, because a receiver does not use its first line.
  std::vector<std::byte> beginning() const;
  // Appends one item; times are those of the hand's clock [us since it was switched on].
  void appendFrame(std::vector<std::byte>& out,
                   std::uint64_t number,
                   std::int64_t deviceUs,
                   std::span<const float> values) const;
  void appendAngles(std::vector<std::byte>& out,
                    std::int64_t deviceUs,
                    const std::vector<double>& values) const;
  void appendTemperatures(std::vector<std::byte>& out,
                          std::int64_t deviceUs,
                          const std::vector<double>& degC) const;
  bool isChecksummed() const noexcept { return format_ == EmulatedStreamFormat::kBinary; }

 private:
  std::string description() const;
  std::string frameJson(std::uint64_t number,
                        std::int64_t deviceUs,
                        std::span<const float> values) const;

  const HandDescription& hand_;
  const EmulatedStreamFormat format_;
};

}  // namespace palpate
