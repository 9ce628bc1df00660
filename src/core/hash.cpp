#include "palpate/core/hash.h"

#include <array>
#include <cerrno>
#include <fstream>
#include <memory>
#include <span>
#include <system_error>
#include <vector>

#include <openssl/evp.h>
#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"

namespace palpate {
namespace {

class Sha256 {
 public:
  Sha256() : context_(EVP_MD_CTX_new(), &EVP_MD_CTX_free) {
    if (!context_ || EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) != 1)
      throw Error("SHA-256 is not available in this OpenSSL");
  }
  void add(const void* bytes, std::size_t count) {
    if (EVP_DigestUpdate(context_.get(), bytes, count) != 1) throw Error("SHA-256 failed");
  }
  std::string hexadecimal() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned size = 0;
    if (EVP_DigestFinal_ex(context_.get(), digest.data(), &size) != 1)
      throw Error("SHA-256 failed");
    return hexDigits(std::as_bytes(std::span(digest).first(size)), HexLetters::kSmall);
  }

 private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

}  // namespace

std::string sha256(std::span<const std::byte> bytes) {
  Sha256 hash;
  hash.add(bytes.data(), bytes.size());
  return hash.hexadecimal();
}

std::string sha256OfFile(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw FileError(path, "can't be opened for reading");
  Sha256 hash;
  std::vector<char> piece(1u << 16);
  do {
    in.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    hash.add(piece.data(), static_cast<std::size_t>(in.gcount()));
  } while (in);
  if (in.bad()) throw FileError(path, "can't be read");
  return hash.hexadecimal();
}

std::string sha256OfDescriptor(int descriptor,
                               std::uint64_t from,
                               const std::filesystem::path& path) {
  Sha256 hash;
  std::vector<char> piece(1u << 18);
  auto at = static_cast<off_t>(from);
  while (true) {
    const ssize_t got = ::pread(descriptor, piece.data(), piece.size(), at);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw FileError(path, "can't be read: " + std::generic_category().message(errno));
    if (got == 0) break;
    hash.add(piece.data(), static_cast<std::size_t>(got));
    at += got;
  }
  return hash.hexadecimal();
}

}  // namespace palpate
