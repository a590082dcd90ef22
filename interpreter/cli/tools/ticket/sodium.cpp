#include "cli/tools/ticket/sodium.h"

#include <fmt/format.h>

#include <stdexcept>

#include "base/core/diagnostics.h"
#include "base/system/late_library.h"
#include "language/document/file.h"

namespace lockstep::host {
namespace {

struct Sodium : LateLibrary {
  Sodium() : LateLibrary(LOCKSTEP_SODIUM) {
    if (init() < 0) throw std::runtime_error("libsodium cannot be used");
  }

  decltype(&sodium_init) init = function("sodium_init");
  decltype(&crypto_hash_sha256) sha256 = function("crypto_hash_sha256");
  decltype(&crypto_sign_seed_keypair) seed_keypair = function("crypto_sign_seed_keypair");
  decltype(&crypto_sign_detached) sign_detached = function("crypto_sign_detached");
  decltype(&crypto_sign_verify_detached) verify_detached = function("crypto_sign_verify_detached");
  decltype(&sodium_base642bin) base64_to_bytes = function("sodium_base642bin");
  decltype(&sodium_hex2bin) hex_to_bytes = function("sodium_hex2bin");
  decltype(&sodium_memzero) wipe = function("sodium_memzero");
};

const Sodium& sodium() {
  static const Sodium library;
  return library;
}

const unsigned char* bytes_of(std::string_view text) {
  return reinterpret_cast<const unsigned char*>(text.data());
}

}  // namespace

std::string hex(std::string_view bytes) {
  std::string text;
  for (const char it : bytes) text += fmt::format("{:02x}", static_cast<unsigned char>(it));
  return text;
}

bool from_hex(std::string_view text, unsigned char* bytes, std::size_t size) {
  std::size_t count = 0;
  return text.size() == 2 * size &&
         sodium().hex_to_bytes(bytes, size, text.data(), text.size(), nullptr, &count, nullptr) ==
             0 &&
         count == size;
}

std::string sha256(std::string_view text) {
  std::string hash(crypto_hash_sha256_BYTES, '\0');
  sodium().sha256(reinterpret_cast<unsigned char*>(hash.data()), bytes_of(text), text.size());
  return hex(hash);
}

Signed sign(std::string_view text, const std::array<unsigned char, crypto_sign_SEEDBYTES>& seed) {
  Signed result;
  std::array<unsigned char, crypto_sign_SECRETKEYBYTES> secret;
  sodium().seed_keypair(result.key.data(), secret.data(), seed.data());
  sodium().sign_detached(result.signature.data(), nullptr, bytes_of(text), text.size(),
                         secret.data());
  sodium().wipe(secret.data(), secret.size());
  return result;
}

bool is_signed(std::string_view text, const Signed& by) {
  return sodium().verify_detached(by.signature.data(), bytes_of(text), text.size(),
                                  by.key.data()) == 0;
}

Result<std::vector<std::string>> pem_blocks(const std::string& path, std::string_view what) {
  constexpr std::size_t kMost = std::size_t{1} << 20u;
  const auto text = read_file(path, kMost);
  if (!text)
    return problem(fmt::format("cannot read '{}': {}", printable(path), text.error().message));
  const std::string begin = fmt::format("-----BEGIN {}-----", what);
  const std::string end = fmt::format("-----END {}-----", what);
  std::vector<std::string> blocks;
  std::string_view rest = *text;
  for (auto at = rest.find(begin); at != rest.npos; at = rest.find(begin)) {
    rest.remove_prefix(at + begin.size());
    const std::string_view body = rest.substr(0, rest.find(end));
    std::string bytes(body.size(), '\0');
    std::size_t count = 0;
    const int failed = sodium().base64_to_bytes(reinterpret_cast<unsigned char*>(bytes.data()),
                                                bytes.size(), body.data(), body.size(), " \r\n",
                                                &count, nullptr, sodium_base64_VARIANT_ORIGINAL);
    if (failed != 0)
      return problem(fmt::format("'{}' has a block that is not PEM", printable(path)));
    bytes.resize(count);
    blocks.push_back(std::move(bytes));
  }
  return blocks;
}

}  // namespace lockstep::host
