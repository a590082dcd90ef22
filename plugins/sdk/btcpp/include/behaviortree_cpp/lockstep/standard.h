// Standard headers that sources get from those of the library without including them.
#pragma once

#include <algorithm>           // IWYU pragma: export
#include <any>                 // IWYU pragma: export
#include <array>               // IWYU pragma: export
#include <atomic>              // IWYU pragma: export
#include <cassert>             // IWYU pragma: export
#include <chrono>              // IWYU pragma: export
#include <cmath>               // IWYU pragma: export
#include <condition_variable>  // IWYU pragma: export
#include <cstring>             // IWYU pragma: export
#include <deque>               // IWYU pragma: export
#include <filesystem>          // IWYU pragma: export
#include <forward_list>        // IWYU pragma: export
#include <functional>          // IWYU pragma: export
#include <future>              // IWYU pragma: export
#include <iomanip>             // IWYU pragma: export
#include <iostream>            // IWYU pragma: export
#include <map>                 // IWYU pragma: export
#include <mutex>               // IWYU pragma: export
#include <numeric>             // IWYU pragma: export
#include <optional>            // IWYU pragma: export
#include <queue>               // IWYU pragma: export
#include <set>                 // IWYU pragma: export
#include <shared_mutex>        // IWYU pragma: export
#include <sstream>             // IWYU pragma: export
#include <thread>              // IWYU pragma: export
#include <valarray>            // IWYU pragma: export
