// Trees that a program registers one after the other, as one document.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "behaviortree_cpp/exceptions.h"
#include "behaviortree_cpp/lockstep/xml.h"

namespace BT::lockstep_detail {

// The trees, models and plugins of several documents.
struct TreeSet {
  std::map<std::string, XmlElement> trees;  // by ID; the last one of an ID
  std::vector<XmlElement> others;           // models and plugins
};

inline std::string read_file(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw RuntimeError("the file '", file.string(), "' cannot be read");
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

// Where an <include> leads to, from a file of this directory. "": a package that is not there.
inline std::filesystem::path included_file(const XmlElement& include,
                                           const std::filesystem::path& directory) {
  const std::filesystem::path path = include.get("path");
  const std::string* const package = include.find("ros_pkg");
  if (package == nullptr) return path.is_absolute() ? path : directory / path;
  const char* const prefixes = std::getenv("AMENT_PREFIX_PATH");
  for (const StringView prefix : splitString(prefixes == nullptr ? "" : prefixes, ':')) {
    const auto share = std::filesystem::path(prefix) / "share" / *package;
    std::error_code error;
    if (std::filesystem::is_directory(share, error)) return share / path;
  }
  return {};
}

class Documents {
 public:
  // Throws when a document is not as it should be.
  using Check = std::function<void(const XmlElement& root)>;

  // Returns the tree that it names as its main one, or its only one; "": neither. When it throws,
  // nothing has been added.
  std::string add_file(const std::filesystem::path& file, const Check& check,
                       bool with_includes = true) {
    const std::filesystem::path whole = std::filesystem::absolute(file);
    return add({read_file(file), whole.string(), {}, false}, whole.parent_path(), check,
               with_includes);
  }
  std::string add_text(const std::string& text, const Check& check, bool with_includes = true) {
    return add({text, "", {}, false}, std::filesystem::current_path(), check, with_includes);
  }

  const TreeSet& set() const { return set_; }
  std::vector<std::string> tree_ids() const {
    std::vector<std::string> ids;
    for (const auto& [id, tree] : set_.trees) ids.push_back(id);
    return ids;
  }

  // The main tree that the first document names; "": none.
  const std::string& named_main() const { return named_main_; }
  bool has_unnamed() const { return !unnamed_.empty(); }

  // The text to load: the only document that is needed, unchanged, so that errors name its lines,
  // or a text of those that it needs.
  struct Loaded {
    std::string text, file;  // one of them
    std::string main_tree;   // "": the only one, which has no ID
  };
  Loaded loaded(const std::string& main_tree) const {
    std::set<std::string> reached;
    if (!main_tree.empty()) reach(main_tree, reached);
    while (reach_beside(reached)) {
    }
    std::vector<const Part*> needed;
    for (const Part& it : parts_) {
      if (main_tree.empty() || it.has_others || has_one_of(it, reached)) needed.push_back(&it);
    }
    if (needed.size() != 1) return {text(needed), "", main_tree};
    const Part& only = *needed.front();
    const std::string main = unnamed_.count(main_tree) == 0 ? main_tree : "";
    return only.file.empty() ? Loaded{only.text, "", main} : Loaded{"", only.file, main};
  }

 private:
  struct Part {
    std::string text, file;        // "": it has no file
    std::vector<std::string> ids;  // of its trees, also included ones
    bool has_others = false;       // models, plugins
  };

  std::string add(Part part, const std::filesystem::path& directory, const Check& check,
                  bool with_includes) {
    const XmlElement root = read_xml(part.text);
    Documents added = *this;
    std::set<std::string> seen{part.file};
    const std::size_t others = set_.others.size();
    added.note(root, directory, check, with_includes, seen, part.ids);
    part.has_others = added.set_.others.size() != others;
    const std::string only = part.ids.size() == 1 ? part.ids.front() : "";
    added.drop_replaced(part);
    added.parts_.push_back(std::move(part));
    const std::string main = root.get("main_tree_to_execute");
    if (parts_.empty()) added.named_main_ = main;
    *this = std::move(added);
    return main.empty() ? only : main;
  }

  // A part all of whose trees are in a newer one.
  void drop_replaced(const Part& newer) {
    const auto is_in_newer = [&newer](const std::string& id) {
      return std::find(newer.ids.begin(), newer.ids.end(), id) != newer.ids.end();
    };
    for (Part& it : parts_) {
      it.ids.erase(std::remove_if(it.ids.begin(), it.ids.end(), is_in_newer), it.ids.end());
    }
    parts_.erase(std::remove_if(parts_.begin(), parts_.end(),
                                [](const Part& it) { return it.ids.empty() && !it.has_others; }),
                 parts_.end());
  }

  static bool has_one_of(const Part& part, const std::set<std::string>& ids) {
    return std::any_of(part.ids.begin(), part.ids.end(),
                       [&ids](const std::string& id) { return ids.count(id) != 0; });
  }
  // A document is loaded as a whole, so all of its trees need what is in them. False: they have it.
  bool reach_beside(std::set<std::string>& reached) const {
    const std::size_t before = reached.size();
    for (const Part& it : parts_) {
      if (!has_one_of(it, reached)) continue;
      for (const std::string& id : it.ids) reach(id, reached);
    }
    return reached.size() != before;
  }
  // The tree, and those that are in it.
  void reach(const std::string& id, std::set<std::string>& reached) const {
    const auto tree = set_.trees.find(id);
    if (tree != set_.trees.end() && reached.insert(id).second) reach_inside(tree->second, reached);
  }
  void reach_inside(const XmlElement& element, std::set<std::string>& reached) const {
    for (const XmlElement& it : element.children) {
      if (it.name == "SubTree" || it.name == "SubTreePlus") reach(it.get("ID"), reached);
      reach_inside(it, reached);
    }
  }

  void note(const XmlElement& root, const std::filesystem::path& directory, const Check& check,
            bool with_includes, std::set<std::string>& seen, std::vector<std::string>& ids) {
    check(root);
    for (const XmlElement& it : root.children) {
      if (it.name == "BehaviorTree") {
        ids.push_back(note_tree(it));
      } else if (it.name != "include") {
        set_.others.push_back(it);
      } else if (const auto file = included_file(it, directory).lexically_normal();
                 with_includes && !file.empty() && seen.insert(file.string()).second) {
        std::error_code error;
        if (!std::filesystem::is_regular_file(file, error)) continue;  // lockstep says where
        note(read_xml(read_file(file)), file.parent_path(), check, true, seen, ids);
      }
    }
  }

  // Its ID, also where it has none.
  std::string note_tree(const XmlElement& tree) {
    std::string id = tree.get("ID");
    if (id.empty()) {
      id = "BehaviorTree_" + std::to_string(unnamed_.size());
      unnamed_.insert(id);
    }
    XmlElement& kept = set_.trees[id] = tree;
    kept.set("ID", id);
    return id;
  }

  std::string text(const std::vector<const Part*>& parts) const {
    std::string text = "<root BTCPP_format=\"4\">\n";
    XmlElement models;  // a document has one such element at most
    models.name = "TreeNodesModel";
    for (const Part* it : parts) {
      text += it->file.empty() ? inner_of(it->text, models)
                               : StrCat("<include path=\"", xml_escaped(it->file), "\"/>");
      text += "\n";
      for (const std::string& id : it->ids) {
        if (unnamed_.count(id) != 0) text += write_xml(set_.trees.at(id));
      }
    }
    if (!models.children.empty()) text += write_xml(models);
    return text + "</root>\n";
  }
  // The content of the root, without a tree that has no ID. Models go to `models`.
  static std::string inner_of(const std::string& document, XmlElement& models) {
    const XmlElement root = read_xml(document);
    const auto is_left_out = [](const XmlElement& it) {
      return it.name == "TreeNodesModel" || (it.name == "BehaviorTree" && it.get("ID").empty());
    };
    if (std::any_of(root.children.begin(), root.children.end(), is_left_out)) {
      std::string text;
      for (const XmlElement& it : root.children) {
        if (it.name == "TreeNodesModel") {
          models.children.insert(models.children.end(), it.children.begin(), it.children.end());
        } else if (!is_left_out(it)) {
          text += write_xml(it);
        }
      }
      return text;
    }
    const std::size_t begin = document.find('>', document.find("<root"));
    const std::size_t end = document.rfind("</root");
    return end == std::string::npos ? "" : document.substr(begin + 1, end - begin - 1);
  }

  std::vector<Part> parts_;
  TreeSet set_;
  std::set<std::string> unnamed_;  // IDs that trees without one were given
  std::string named_main_;
};

}  // namespace BT::lockstep_detail
