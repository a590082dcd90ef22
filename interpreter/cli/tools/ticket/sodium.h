// What tickets need of libsodium.
#pragma once

#include <sodium.h>

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "base/core/problem.h"

namespace lockstep::host {

using PublicKey = std::array<unsigned char, crypto_sign_PUBLICKEYBYTES>;
using SignatureBytes = std::array<unsigned char, crypto_sign_BYTES>;

// Each throws a std::runtime_error where libsodium is not installed.

// In hexadecimal.
std::string sha256(std::string_view text);

struct Signed {
  PublicKey key;
  SignatureBytes signature;
};
// `seed`: the private key, 32 bytes.
Signed sign(std::string_view text, const std::array<unsigned char, crypto_sign_SEEDBYTES>& seed);
bool is_signed(std::string_view text, const Signed& by);

std::string hex(std::string_view bytes);
// False if it is not so many bytes in hexadecimal.
bool from_hex(std::string_view text, unsigned char* bytes, std::size_t size);

// The bytes between the lines BEGIN and END of each such block of a PEM file.
Result<std::vector<std::string>> pem_blocks(const std::string& path, std::string_view what);

}  // namespace lockstep::host
