#include "leaves/plugin/contract/words.h"

#include <cstdint>

#include "base/core/plugin_exception.h"
#include "base/system/call_mark.h"

namespace lockstep::host {

PluginWords words_of(const lockstep_plugin& plugin) {
  if (plugin.get_extension == nullptr) return {};
  const void* table = nullptr;
  const MarkedCall mark(CallSite::of_plugin(plugin.name), PluginFunction::Describe);
  thrown_by([&] { table = plugin.get_extension(LOCKSTEP_WORDS); });
  PluginWords all;
  const auto* const words = static_cast<const lockstep_words*>(table);
  for (std::uint32_t i = 0; words != nullptr && i < words->count; ++i) {
    all.emplace(words->words[i], words->numbers[i]);
  }
  return all;
}

}  // namespace lockstep::host
