// What is known of a file after it was checked: the messages of `lockstep check`, and what they
// were found with.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "authoring/server/plugin_cache.h"
#include "core/diagnostics.h"
#include "definition/catalog.h"

namespace lockstep::host {

// Where trees and plugins are found. From the command line, and from the editor.
struct Settings {
  PluginOptions plugins;
  Arguments arguments;
  bool trusted = true;  // else no plugin is loaded
};

struct AnalysisJob {
  std::string uri;
  std::string path;
  std::shared_ptr<const std::string> text;
  std::int64_t version = 0;
  UnsavedTexts unsaved = {};  // of all open files
  std::shared_ptr<const Settings> settings;
};

struct Analysis {
  std::string uri;
  std::int64_t version = 0;
  std::vector<Diagnostic> diagnostics;               // sorted
  std::vector<std::shared_ptr<const Source>> texts;  // that were read, the file first
  std::shared_ptr<const Project> project;            // null: it is not readable, or no tree file
  std::shared_ptr<PluginSet> plugins;                // to which the catalog points
  Catalog catalog;
  std::shared_ptr<const Meaning> meaning;  // null after an error
  bool left_plugins_out = false;           // it asks for some, in a workspace without trust
};

// What the name of a file says about its content.
enum class FileKind : unsigned char { Tree, Scenarios, Leaves };
FileKind kind_of_file(std::string_view path);

Analysis analyze(const AnalysisJob& job, PluginCache& cache);

}  // namespace lockstep::host
