#include "unpacked.hpp"

#include <dlfcn.h>

#include <stdexcept>
#include <string_view>

namespace motion {
namespace {

constexpr char kLibrary[] = "libzstd.so.1";
constexpr std::size_t kPart = std::size_t{64} << 10;
constexpr std::string_view kMagic{"\x28\xB5\x2F\xFD", 4};
constexpr int kMostWindow = 25;  // as a power of two, in bytes

// Loaded with the first compressed file: most runs need none.
struct Zstd {
  void* library = dlopen(kLibrary, RTLD_NOW | RTLD_LOCAL);
  decltype(&ZSTD_createDCtx) create = function("ZSTD_createDCtx");
  decltype(&ZSTD_freeDCtx) free = function("ZSTD_freeDCtx");
  decltype(&ZSTD_DCtx_setParameter) set = function("ZSTD_DCtx_setParameter");
  decltype(&ZSTD_decompressStream) decompress = function("ZSTD_decompressStream");
  decltype(&ZSTD_isError) is_error = function("ZSTD_isError");
  decltype(&ZSTD_getErrorName) error_name = function("ZSTD_getErrorName");

 private:
  struct Address {
    void* address;
    template <class Function>
    operator Function*() const {
      return reinterpret_cast<Function*>(address);
    }
  };
  Address function(const char* name) const {
    void* const address = library == nullptr ? nullptr : dlsym(library, name);
    if (address == nullptr) {
      throw std::runtime_error(std::string("it is compressed, and without ") + kLibrary +
                               " it cannot be read");
    }
    return {address};
  }
};

const Zstd& zstd() {
  static const Zstd library;
  return library;
}

}  // namespace

Unpacked::Unpacked(const std::string& name)
    : file_(name, std::ios::binary), bytes_(kPart), text_(kPart) {
  left_ = {bytes_.data(), read(), 0};
  if (!std::string_view(bytes_.data(), left_.size).starts_with(kMagic)) return;
  context_ = {zstd().create(), zstd().free};
  zstd().set(context_.get(), ZSTD_d_windowLogMax, kMostWindow);
}

std::size_t Unpacked::read() {
  file_.read(bytes_.data(), static_cast<std::streamsize>(bytes_.size()));
  return static_cast<std::size_t>(file_.gcount());
}

Unpacked::int_type Unpacked::underflow() {
  ZSTD_outBuffer out{text_.data(), text_.size(), 0};
  while (out.pos == 0) {
    if (left_.pos == left_.size) left_ = {bytes_.data(), read(), 0};
    if (left_.size == 0) return traits_type::eof();
    if (!context_) {
      setg(bytes_.data(), bytes_.data(), bytes_.data() + left_.size);
      left_.pos = left_.size;
      return traits_type::to_int_type(*gptr());
    }
    const std::size_t hint = zstd().decompress(context_.get(), &out, &left_);
    if (zstd().is_error(hint) != 0) {
      throw std::runtime_error(std::string("cannot be decompressed: ") + zstd().error_name(hint));
    }
  }
  setg(text_.data(), text_.data(), text_.data() + out.pos);
  return traits_type::to_int_type(*gptr());
}

}  // namespace motion
