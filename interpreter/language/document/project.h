// A tree file and everything it includes, with load-time arguments substituted: all the documents
// that a definition is made from.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "language/document/document.h"
#include "language/document/ros_packages.h"

namespace lockstep::host {

// `--arg name=value`.
using Arguments = std::map<std::string, std::string, std::less<>>;

class Library;

struct DeclaredArgument {
  std::string name;
  std::optional<std::string> default_value;  // none: must be given
  std::string doc;
  std::string value;  // in force
};
// Those in force, by name.
Arguments values_of(const std::vector<DeclaredArgument>& arguments);

struct Project {
  // Of a name in a file: that before the prefix was put before it.
  static std::string_view written(std::string_view name, std::string_view prefix) {
    return name.starts_with(prefix) ? name.substr(prefix.size()) : name;
  }

  const LanguageRules* rules = &kLockstepRules;  // of the main file, and so of all
  // The main file first, then as included. Their paths are as a user would write them: relative
  // ones stay relative.
  Sources sources;
  std::vector<std::unique_ptr<Document>> documents;  // of the sources
  std::size_t given = 0;  // the first of them: the others are from a Library
  // The documents that each document includes, in that order.
  std::vector<std::vector<std::uint32_t>> includes;
  // What <include as="truck"> puts before the names of the trees, the barriers and the pools of a
  // document, and of those that it includes: "truck.". Its elements have the IDs of trees so. "":
  // nothing.
  std::vector<std::string> prefixes;
  // Such a file: "truck" stands for its main tree, if it has one.
  struct NamedFile {
    std::string name;
    Place place;  // of the attribute `as`
    std::uint32_t document;
  };
  std::vector<NamedFile> named;
  // The trees of the Library, if a SubTree names one that no file has: it may mean one of them.
  std::vector<std::string> library_trees;
  std::vector<DeclaredArgument> arguments;
};

// Accepts a pipe, which can be read only once and may block; for a file that the user has named.
// "-" is stdin, called 'stdin', with includes relative to the working directory.
enum class MainFile : bool { IsRegular, MayBePipe };

// Texts that nobody has saved yet, by file_identity(): they are read instead of the files.
using UnsavedTexts = std::map<std::string, std::shared_ptr<const std::string>, std::less<>>;

// The same for all spellings of a path, and for links to one file.
std::string file_identity(const std::string& path);

// Reads `path`, its <include>s (relative to the including file, each file once, a cycle is an error
// that shows the chain) and its <arg>s, and replaces ${name} in every attribute ($${ is a literal
// ${). A value with an error is left as written. Reports all errors; returns null only if the main
// file could not be parsed. Unknown names in `arguments` are errors without a place, with a hint
// that lists the declared.
// A SubTree whose tree is in none of these files finds it in `library`, if there is one.
std::unique_ptr<Project> load_project(const std::string& path, const Arguments& arguments,
                                      Diagnostics& diagnostics, MainFile main = MainFile::IsRegular,
                                      const RosPackages& packages = {},
                                      const Library* library = nullptr);

// The same from text instead of a main file; includes are relative to `path`.
std::unique_ptr<Project> load_project_text(const std::string& path, std::string text,
                                           const Arguments& arguments, Diagnostics& diagnostics,
                                           const RosPackages& packages = {},
                                           const UnsavedTexts& unsaved = {},
                                           const Library* library = nullptr);

}  // namespace lockstep::host
