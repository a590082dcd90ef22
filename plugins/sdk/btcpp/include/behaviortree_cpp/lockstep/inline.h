// Where the functions of these headers are that are no templates. A program or a plugin that is
// linked with liblockstep-btcpp.a, as CMake's target does it, defines LOCKSTEP_BTCPP_LIBRARY, and
// finds them there: each source then compiles declarations only. Else each source has them all.
#pragma once

#include <cstddef>  // __GLIBCXX__

// The library has them for libstdc++ as it is without checks; other classes need their own.
#if defined(LOCKSTEP_BTCPP_LIBRARY) && defined(__GLIBCXX__) && !defined(_GLIBCXX_DEBUG) && \
    _GLIBCXX_USE_CXX11_ABI
#define LOCKSTEP_BTCPP_HAS_FUNCTIONS 0
#else
#define LOCKSTEP_BTCPP_HAS_FUNCTIONS 1
#endif

#ifdef LOCKSTEP_BTCPP_MAKES_LIBRARY
#define LOCKSTEP_BTCPP_INLINE
#else
#define LOCKSTEP_BTCPP_INLINE inline
#endif
