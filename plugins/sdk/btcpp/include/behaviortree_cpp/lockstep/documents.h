// Trees that a program registers one after the other, as one document.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include "behaviortree_cpp/exceptions.h"

namespace BT::lockstep_detail {

class Documents {
 public:
  // Its text.
  std::string add_file(const std::string& file) {
    std::ifstream in(file);
    if (!in) throw RuntimeError("the file '", file, "' cannot be read");
    const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    note_ids(text);
    inner_ += "<include path=\"" + std::filesystem::absolute(file).string() + "\"/>\n";
    return text;
  }
  void add_text(const std::string& text) {
    note_ids(text);
    inner_ += inner_of(text) + "\n";
  }

  const std::vector<std::string>& tree_ids() const { return ids_; }

  // As it is loaded.
  std::string text() const { return "<root BTCPP_format=\"4\">\n" + inner_ + "</root>\n"; }
  // The same with one text more.
  std::string text(const std::string& more) const {
    if (inner_.empty()) return more;
    Documents all = *this;
    all.add_text(more);
    return all.text();
  }
  // The tree that a text names as its main one, or its only one; "": neither.
  static std::string main_of(const std::string& text) {
    static const std::regex main("<root[^>]*\\bmain_tree_to_execute\\s*=\\s*[\"']([^\"']*)[\"']");
    std::smatch found;
    if (std::regex_search(text, found, main)) return found[1];
    Documents one;
    one.note_ids(text);
    return one.ids_.size() == 1 ? one.ids_.front() : "";
  }

 private:
  static std::string inner_of(const std::string& text) {
    const std::size_t root = text.find("<root");
    const std::size_t begin = text.find('>', root);
    const std::size_t end = text.rfind("</root");
    if (root == std::string::npos || end == std::string::npos || begin > end) {
      throw RuntimeError("the text of a tree has no element 'root'");
    }
    return text.substr(begin + 1, end - begin - 1);
  }
  void note_ids(const std::string& text) {
    static const std::regex tree("<BehaviorTree\\s[^>]*\\bID\\s*=\\s*[\"']([^\"']*)[\"']");
    for (std::sregex_iterator it(text.begin(), text.end(), tree), end; it != end; ++it) {
      const auto at = std::lower_bound(ids_.begin(), ids_.end(), (*it)[1].str());
      if (at == ids_.end() || *at != (*it)[1]) ids_.insert(at, (*it)[1]);
    }
  }

  std::string inner_;
  std::vector<std::string> ids_;  // sorted
};

}  // namespace BT::lockstep_detail
