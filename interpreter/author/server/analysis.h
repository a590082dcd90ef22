// The knowledge about a file after it was checked: the messages of `lockstep check`, and what they
// were found with.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "author/server/plugin_cache.h"
#include "base/core/diagnostics.h"
#include "language/document/tolerant.h"
#include "tree/catalog.h"

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
  std::uint64_t serial = 0;   // later jobs have larger ones
  UnsavedTexts unsaved = {};  // of all open files
  std::shared_ptr<const Settings> settings;
};

struct Analysis {
  std::string uri;
  std::int64_t version = 0;
  std::uint64_t serial = 0;                          // of its job
  std::vector<Diagnostic> diagnostics;               // sorted
  std::vector<std::shared_ptr<const Source>> texts;  // that were read, the file first
  std::vector<TolerantTree> included;                // the elements of the other texts
  // A text that is not readable has only the declarations that can be recognized in it.
  std::shared_ptr<const Project> project;
  std::shared_ptr<PluginSet> plugins;  // to which the catalog points
  Catalog catalog;
  std::shared_ptr<const Meaning> meaning;  // null after an error
  bool left_plugins_out = false;           // it asks for some, in a workspace without trust
  bool is_whole = true;                    // false: more messages may come
};

// The name of a file decides what its content is.
enum class FileKind : unsigned char { Tree, Scenarios, Leaves };
FileKind kind_of_file(std::string_view path);

LoadOptions load_options(const Settings& settings, UnsavedTexts unsaved);

// Takes little time: its `is_whole` is false if complete() has more to say.
Analysis analyze(const AnalysisJob& job, PluginCache& cache);
// Adds what a search over all behaviors is sure of, unless `stop_signal` returns something else
// than 0 before.
void complete(Analysis& analysis, std::function<int()> stop_signal);

}  // namespace lockstep::host
