#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "base/core/diagnostics.h"
#include "base/core/message_kinds.h"
#include "base/core/suggest.h"
#include "base/core/wording.h"
#include "base/terminal/text_table.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/installed.h"

namespace lockstep::host {
namespace {

namespace fs = std::filesystem;

std::string title_of(const fs::path& page) {
  std::ifstream in(page);
  std::string line;
  std::getline(in, line);
  return printable(line.substr(std::min(line.find_first_not_of("# "), line.size())));
}

std::vector<std::string> page_names() {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(documents_directory(), error)) {
    if (entry.path().extension() == ".md") names.push_back(entry.path().stem());
  }
  std::ranges::sort(names);
  return names;
}

int list_pages(const std::vector<std::string>& names) {
  const fs::path directory = documents_directory();
  std::string text = "Pages, in " + printable(directory.string()) + ":\n";
  std::vector<TableRow> rows;
  for (const std::string& name : names) {
    rows.push_back({{"  " + name, title_of(directory / (name + ".md"))}});
  }
  text += text_table(rows, 2);
  return write_results(text + "\nTo read one: lockstep docs tutorial\n");
}

int explain(const MessageKind& kind) {
  return write_results(
      fmt::format("{}\n\n{}\n\nWhat to do: {}\n", kind.code, kind.meaning, kind.mend));
}

// On a terminal with $PAGER, or less; otherwise its path.
int show_page(const fs::path& page) {
  if (is_terminal(STDOUT_FILENO) && secure_getenv("PATH") != nullptr) {
    const char* const pager = secure_getenv("PAGER");
    std::string shell = "sh", option = "-c", path = page.string();
    std::string command =
        fmt::format("{} \"$1\"", pager == nullptr || *pager == 0 ? "less" : pager);
    char* const words[] = {shell.data(), option.data(), command.data(),
                           shell.data(), path.data(),   nullptr};
    signal(SIGINT, SIG_IGN);  // it is for the pager
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t defaults;
    sigemptyset(&defaults);
    sigaddset(&defaults, SIGINT);
    posix_spawnattr_setsigdefault(&attributes, &defaults);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
    pid_t process = 0;
    int status = 0;
    const bool is_shown =
        posix_spawn(&process, "/bin/sh", nullptr, &attributes, words, environ) == 0 &&
        waitpid(process, &status, 0) == process && WIFEXITED(status) && WEXITSTATUS(status) != 127;
    posix_spawnattr_destroy(&attributes);
    if (is_shown) return kExitSuccess;
  }
  return write_results(page.string() + "\n");
}

int docs(std::string name) {
  const auto kinds = message_kinds();
  const auto kind = std::ranges::find(kinds, name, &MessageKind::code);
  if (kind != kinds.end()) return explain(*kind);
  const std::vector<std::string> names = page_names();
  if (names.empty()) {
    print_error("the documents are not installed", "in Debian: apt install lockstep-doc");
    return kExitUsage;
  }
  if (name.empty()) return list_pages(names);
  if (name.starts_with("docs/")) name = name.substr(5);
  if (name.ends_with(".md")) name.resize(name.size() - 3);
  if (std::ranges::find(names, name) != names.end()) {
    return show_page(documents_directory() / (name + ".md"));
  }
  std::vector<std::string_view> known(names.begin(), names.end());
  for (const MessageKind& it : kinds) known.push_back(it.code);
  const std::string near = did_you_mean(name, known);
  print_error(fmt::format("there is no page '{}'", brief(name)),
              near.empty() ? "`lockstep docs` lists the pages" : near);
  return kExitUsage;
}

std::function<int()> define_docs(CLI::App& app) {
  const auto name = std::make_shared<std::string>();
  app.add_option("page", *name, "A page, or the code of a message (default: list the pages)")
      ->type_name("PAGE|CODE");
  return [name] { return docs(*name); };
}

}  // namespace

extern const Command kDocsCommand{
    "docs", "Open a page of the documents, or explain the code of a message",
    "On a terminal the page opens in $PAGER, or in less; otherwise its path is printed.\n"
    "Exit code: 0 shown, 2 there is no such page, or the documents are not installed.\n"
    "\n"
    "Examples:\n"
    "  lockstep docs\n"
    "  lockstep docs tutorial\n"
    "  lockstep docs unknown-node",
    define_docs};

}  // namespace lockstep::host
