// The functions of libzstd that are used. Seen by the sources of this folder only.
#pragma once

// For streams in memory of the caller: a crash handler must not allocate.
#define ZSTD_STATIC_LINKING_ONLY
#include <zstd.h>

#include "base/system/late_library.h"

namespace lockstep::host {

struct ZstdLibrary : LateLibrary {
  ZstdLibrary() : LateLibrary(LOCKSTEP_ZSTD) {}

  decltype(&ZSTD_isError) is_error = function("ZSTD_isError");
  decltype(&ZSTD_getErrorName) error_name = function("ZSTD_getErrorName");

  decltype(&ZSTD_compressBound) compress_bound = function("ZSTD_compressBound");
  decltype(&ZSTD_estimateCStreamSize) stream_size = function("ZSTD_estimateCStreamSize");
  decltype(&ZSTD_initStaticCStream) init_stream = function("ZSTD_initStaticCStream");
  decltype(&ZSTD_CCtx_setParameter) set_parameter = function("ZSTD_CCtx_setParameter");
  decltype(&ZSTD_createCCtx) create_writer = function("ZSTD_createCCtx");
  decltype(&ZSTD_freeCCtx) free_writer = function("ZSTD_freeCCtx");
  decltype(&ZSTD_compress2) compress_whole = function("ZSTD_compress2");
  decltype(&ZSTD_compressStream2) compress = function("ZSTD_compressStream2");
  decltype(&ZSTD_findFrameCompressedSize) frame_size = function("ZSTD_findFrameCompressedSize");
  decltype(&ZSTD_getFrameContentSize) text_size = function("ZSTD_getFrameContentSize");
  decltype(&ZSTD_decompress) decompress_whole = function("ZSTD_decompress");

  decltype(&ZSTD_createDCtx) create_reader = function("ZSTD_createDCtx");
  decltype(&ZSTD_freeDCtx) free_reader = function("ZSTD_freeDCtx");
  decltype(&ZSTD_DCtx_setParameter) set_reader = function("ZSTD_DCtx_setParameter");
  decltype(&ZSTD_DCtx_reset) reset_reader = function("ZSTD_DCtx_reset");
  decltype(&ZSTD_decompressStream) decompress = function("ZSTD_decompressStream");
};

// Loads it with the first call; throws a std::runtime_error if it cannot be loaded.
inline const ZstdLibrary& zstd() {
  static const ZstdLibrary library;
  return library;
}

}  // namespace lockstep::host
