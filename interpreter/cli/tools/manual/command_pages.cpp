#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "cli/command.h"
#include "cli/command_program.h"
#include "cli/command_walk.h"
#include "cli/help_text.h"
#include "cli/tools/manual/footer.h"
#include "cli/tools/manual/page.h"
#include "cli/tools/manual/pages.h"

namespace lockstep::host {
namespace {

std::string term_of(const CLI::Option& option) {
  if (option.get_positional()) return mdoc_argument(value_name(option));
  std::string term;
  for (const std::string& name : option.get_snames()) term += mdoc_flag(name) + " , ";
  for (const std::string& name : option.get_lnames()) term += mdoc_flag("-" + name) + " , ";
  term.erase(term.size() - 3);
  if (takes_value(option) && !value_name(option).empty())
    term += " " + mdoc_argument(value_name(option));
  return term;
}

std::string about(const CLI::Option& option) {
  std::string text = option.get_description() + ".";
  const std::string standard = option.get_default_str();
  if (!standard.empty()) text += fmt::format(" The default is {}.", standard);
  return text;
}

bool is_help(const CLI::Option& option) {
  return option.check_lname("help") || option.check_lname("help-all");
}

void add_usage(ManualPage& page, const CLI::App& command) {
  std::string line = ".Nm lockstep";
  if (command.get_parent() != nullptr) line += " Cm " + command_name_of(command);
  page.line(line);
  page.line(".Op Ar options");
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_positional()) continue;
    const std::string argument = mdoc_argument(value_name(*option));
    const bool is_many = option->get_items_expected_max() > 1;
    page.line((option->get_required() ? "." : ".Op ") + argument + (is_many ? " ..." : ""));
  }
}

void add_options(ManualPage& page, const CLI::App& command) {
  const auto options = command.get_options([](const CLI::Option* it) { return !is_help(*it); });
  if (options.empty()) return;
  page.begin_list();
  for (const CLI::Option* option : options) page.item(term_of(*option), about(*option));
  page.end_list();
}

void add_paragraphs(ManualPage& page, std::vector<std::string> paragraphs) {
  for (std::string& paragraph : paragraphs) {
    if (is_table(paragraph)) {
      page.literal(paragraph);
    } else {
      page.paragraph();
      std::ranges::replace(paragraph, '\n', ' ');
      page.text(paragraph);
    }
  }
}

void add_see_also(ManualPage& page, bool is_program) {
  page.section("SEE ALSO");
  std::vector<std::string> others;
  if (!is_program) others.emplace_back("lockstep 1");
  for (const Command* it : commands())
    if (is_program) others.push_back(fmt::format("lockstep-{} 1", it->name));
  std::ranges::sort(others);
  others.emplace_back("lockstep-recording 5");
  others.emplace_back("lockstep-tree 5");
  for (std::size_t i = 0; i < others.size(); ++i)
    page.line(".Xr " + others[i] + (i + 1 < others.size() ? " ," : ""));
}

void add_end(ManualPage& page, const Footer& footer, bool is_program) {
  if (!footer.exit_code.empty()) {
    page.section("EXIT STATUS");
    page.text(footer.exit_code);
  }
  if (!footer.examples.empty()) {
    page.section("EXAMPLES");
    page.literal(footer.examples);
  }
  add_see_also(page, is_program);
}

void add_subcommands(ManualPage& page, const CLI::App& command) {
  for (const CLI::App* it : subcommands(command)) {
    page.subsection(command_line_of(*it));
    page.text(it->get_description() + ".");
    add_options(page, *it);
  }
}

std::string page_of(const CLI::App& command, std::string_view date) {
  ManualPage page("lockstep-" + command.get_name(), "1", date, command.get_description());
  page.section("SYNOPSIS");
  const auto below = subcommands(command);
  if (command.get_require_subcommand_min() == 0) add_usage(page, command);
  for (const CLI::App* it : below) add_usage(page, *it);
  page.section("DESCRIPTION");
  page.text(command.get_description() + ".");
  const Footer footer = parse_footer(command.get_footer());
  add_paragraphs(page, footer.text);
  add_options(page, command);
  add_subcommands(page, command);
  add_end(page, footer, false);
  return page.roff();
}

std::string program_page(const CLI::App& program, std::string_view date) {
  ManualPage page("lockstep", "1", date, "behavior trees that keep parallel actions in step");
  page.section("SYNOPSIS");
  page.line(".Nm\n.Ar command\n.Op Ar options");
  page.section("DESCRIPTION");
  page.text(
      "lockstep runs behavior trees at a fixed rate. Leaves come from plugins; synchronized nodes "
      "keep parallel actions in step by their progress. The commands:");
  page.begin_list();
  for (const CLI::App* it : subcommands(program))
    page.item(mdoc_word(it->get_name()), it->get_description() + ".");
  page.end_list();
  page.paragraph();
  page.text("The options:");
  add_options(page, program);
  add_end(page, parse_footer(program.get_footer()), true);
  return page.roff();
}

}  // namespace

std::vector<ManualFile> command_pages(std::string_view date) {
  Program program({}, Program::Options::OfAllCommands);
  std::vector<ManualFile> files = {{"man1/lockstep.1", program_page(program.app(), date)}};
  for (const Command* it : commands()) {
    const CLI::App* const command = program.app().get_subcommand(it->name);
    files.push_back({fmt::format("man1/lockstep-{}.1", it->name), page_of(*command, date)});
  }
  return files;
}

}  // namespace lockstep::host
