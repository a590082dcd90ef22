// The tree files of a project. A SubTree finds its tree in one of them, also without an <include>.
#pragma once

#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/core/diagnostics.h"
#include "base/core/language.h"

namespace lockstep::host {

class Library {
 public:
  // Whether a file of that name is one of trees for all that is known without reading it.
  static bool may_be_tree_file(std::string_view path);

  // Adds the tree files in a folder and below it, in the order of their paths. Links to folders,
  // and folders whose names begin with '.', are not followed. Returns the files. An error has no
  // place: `folder` as it was given.
  std::vector<std::string> add_folder(const std::string& folder, Diagnostics& diagnostics);
  // Returns false if it is no file of trees or models. One with mistakes is one.
  bool add_file(const std::string& path) { return add(path) == Kind::Trees; }
  bool is_full() const;  // what is added is not known
  // A file that each tree of its language includes.
  void add_models(const std::string& path);

  // The files of a language that have a tree.
  std::span<const std::string> files_with(std::string_view tree, const LanguageRules& rules) const;
  std::vector<std::string> trees(const LanguageRules& rules) const;
  // Empty: none.
  std::vector<std::string> models(const LanguageRules& rules) const;

 private:
  enum class Kind { Trees, Others, NoXml };
  Kind add(const std::string& path);

  struct Models {
    std::string path;
    const LanguageRules* rules;
  };
  std::map<const LanguageRules*, std::map<std::string, std::vector<std::string>, std::less<>>>
      files_with_;
  std::vector<Models> models_;
  std::set<std::string> known_;  // by file_identity()
  std::size_t bytes_ = 0;        // of all
};

}  // namespace lockstep::host
