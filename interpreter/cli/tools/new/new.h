// The parts of `lockstep new`.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "author/scaffold/plan.h"
#include "base/core/problem.h"

namespace CLI {
class App;
}

namespace lockstep::host {

struct Tree;

struct NewPart {
  CLI::App* app;
  std::function<int()> run;
};

NewPart define_new_project(CLI::App& app);
NewPart define_new_plugin(CLI::App& app);
NewPart define_new_leaf(CLI::App& app);
NewPart define_new_node(CLI::App& app);
NewPart define_new_tree(CLI::App& app);
NewPart define_new_leaves(CLI::App& app);

// A leaf model of a tree, in the layout of `fmt`: see verify/leaf_model_text.h.
std::string new_leaf_model(const Tree& tree, const std::string& tree_file,
                           const std::vector<std::uint32_t>& observed);

void add_dry_run(CLI::App& app, bool& is_dry_run);
void add_language(CLI::App& app, std::string& language);

// A Problem if lockstep's own nodes, in either language, have that ID.
Result<void> check_not_built_in(std::string_view id);

// Prints the commands to type next, on stderr.
void print_next(std::span<const std::string> lines);
// Writes the files unless it is a dry run, lists them on stdout, and prints the commands to type
// next on stderr.
int make_files(const NewFiles& files, bool is_dry_run, std::span<const std::string> next);

// A word of a command, in quotes if it needs some.
std::string in_shell(const std::string& word);
// How the user calls this program, and what CMake needs to find it: "" or an option.
std::string program_word();
std::string configure_option();

}  // namespace lockstep::host
