#include "cli/check_mends.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "base/system/replace_text.h"
#include "base/terminal/outlet.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "language/document/file.h"
#include "language/document/language_of.h"

namespace lockstep::host {
namespace {

constexpr std::size_t kMostMends = 1000;

using MessageKey = std::tuple<std::string_view, std::string>;

MessageKey key_of(const Diagnostic& it) {
  return {it.code.text(), it.message};
}

struct TextCheck {
  std::vector<MendableMessage> messages;
  std::size_t syntax_errors = 0;  // which hide all others

  std::size_t count(const MessageKey& key) const {
    return static_cast<std::size_t>(std::ranges::count_if(
        messages, [&](const MendableMessage& it) { return key_of(it.message) == key; }));
  }
};

class FileMending {
 public:
  FileMending(const std::string& path, const LoadCommandOptions& load, std::string text)
      : path_(path), load_(load), original_(std::move(text)), text_(original_) {}

  int run() {
    TextCheck checked = check(text_);
    for (std::size_t count = 0; count < kMostMends; ++count) {
      if (!mend_one(checked)) break;
    }
    if (text_ == original_) return kExitSuccess;
    if (const auto done = replace_text(path_, original_, text_); !done) return refuse(done.error());
    messages().say(told_);
    return kExitSuccess;
  }

 private:
  TextCheck check(const std::string& text) {
    Diagnostics found;
    LoadCommandOptions load = load_;
    load.text = text;
    static_cast<void>(load_given(path_, load, found, plugins_));
    found.sort();
    MessageMends mends(plugins_);
    mends.set_text(path_, text);
    TextCheck checked{mends.of(found.all())};
    checked.syntax_errors = static_cast<std::size_t>(std::ranges::count(
        found.all(), "xml-syntax", [](const Diagnostic& it) { return it.code.text(); }));
    return checked;
  }

  // Keeps the first certain mend after which its message is gone, and the text can still be read.
  bool mend_one(TextCheck& checked) {
    for (const MendableMessage& it : checked.messages) {
      const Diagnostic& message = it.message;
      if (message.location.file != path_ || it.mends.empty()) continue;
      const Mend& mend = it.mends.front();
      if (!mend.is_certain) continue;
      if (!tried_.emplace(message.location.line, message.location.column, message.message).second)
        continue;
      std::string text = mend.edit.apply(text_);
      TextCheck after = check(text);
      const MessageKey key = key_of(message);
      if (after.count(key) >= checked.count(key)) continue;
      if (after.syntax_errors > checked.syntax_errors) continue;
      told_ += fmt::format("{}:{}:{}: mended: {} [{}]\n", printable(path_), message.location.line,
                           message.location.column, printable(mend.title), message.code.text());
      text_ = std::move(text);
      checked = std::move(after);
      return true;
    }
    return false;
  }

  const std::string& path_;
  const LoadCommandOptions& load_;
  const std::string original_;
  std::string text_, told_;
  std::shared_ptr<PluginSet> plugins_ = std::make_shared<PluginSet>();
  std::set<std::tuple<std::uint32_t, std::uint32_t, std::string>> tried_;
};

}  // namespace

void MessageMends::set_text(const std::string& path, std::string text) {
  auto file = std::make_unique<File>();
  file->text = std::move(text);
  file->tree = read_tolerantly(file->text);
  file->catalog = make_catalog(*plugins_, language_of(file->text));
  file->mends.emplace(file->tree, file->catalog);
  files_[path] = std::move(file);
}

const MessageMends::File* MessageMends::file(const std::string& path) {
  const auto known = files_.find(path);
  if (known != files_.end()) return known->second.get();
  auto text = read_file(path, Document::kMaxBytes);
  if (!text) return files_.emplace(path, nullptr).first->second.get();
  set_text(path, std::move(*text));
  return files_[path].get();
}

std::vector<MendableMessage> MessageMends::of(std::span<const Diagnostic> messages) {
  std::vector<MendableMessage> all;
  for (const Diagnostic& it : messages) {
    MendableMessage& message = all.emplace_back(MendableMessage{it});
    const File* const in = it.location.line == 0 ? nullptr : file(it.location.file);
    if (in == nullptr) continue;
    message.place = in->mends->place_of(it);
    message.mends = in->mends->of(it);
  }
  return all;
}

int mend_file(const std::string& path, const LoadCommandOptions& load) {
  auto text = read_file(path, Document::kMaxBytes);
  if (!text) return kExitSuccess;  // the check that follows says why
  return FileMending(path, load, std::move(*text)).run();
}

}  // namespace lockstep::host
