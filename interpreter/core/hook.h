// The moments in the life of a node at which a script of it runs, in the order in which they are
// asked within a tick.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "core/language.h"

namespace lockstep {

enum class Hook : std::uint8_t {
  // Before a tick of an idle node. True: the result without a tick.
  FailureIf,
  SuccessIf,
  SkipIf,
  While,  // also before a tick of a running node; false halts it, and it is skipped
  // After a tick that completes the node, or after it was halted.
  OnSuccess,
  OnFailure,
  Post,
  OnHalted,
};
inline constexpr std::size_t kHooks = 8;

inline constexpr std::string_view kHookAttributes[][kHooks] = {
    {"failure_if", "success_if", "skip_if", "while", "on_success", "on_failure", "on_end",
     "on_halt"},
    {"_failureIf", "_successIf", "_skipIf", "_while", "_onSuccess", "_onFailure", "_post",
     "_onHalted"}};

// The attribute that has the script.
constexpr std::string_view attribute_of(Hook hook, Language language) {
  return kHookAttributes[static_cast<std::size_t>(language)][static_cast<std::size_t>(hook)];
}

constexpr std::optional<Hook> hook_named(std::string_view attribute, Language language) {
  for (std::size_t hook = 0; hook < kHooks; ++hook) {
    if (attribute_of(static_cast<Hook>(hook), language) == attribute)
      return static_cast<Hook>(hook);
  }
  return std::nullopt;
}

}  // namespace lockstep
