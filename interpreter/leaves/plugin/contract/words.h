// The words of a plugin that scripts know as numbers: LOCKSTEP_WORDS in lockstep/leaf.h.
#pragma once

#include <map>
#include <string>

#include "lockstep/leaf.h"

namespace lockstep::host {

using PluginWords = std::map<std::string, double, std::less<>>;

// Asks the plugin.
PluginWords words_of(const lockstep_plugin& plugin);

}  // namespace lockstep::host
