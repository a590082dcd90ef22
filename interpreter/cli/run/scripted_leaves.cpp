#include "cli/run/scripted_leaves.h"

#include "cli/console.h"
#include "document/file.h"

namespace lockstep::host {

bool read_scripts(RunCommandOptions& options, LeafScripts& scripts) {
  constexpr std::size_t kMost = std::size_t{64} << 20u;
  const auto text = read_file(options.leaves, kMost, FileKinds::RegularOrPipe);
  if (!text) {
    print_error(
        "--leaves: cannot read '" + printable(options.leaves) + "': " + text.error().message,
        text.error().hint);
    return false;
  }
  if (is_leaf_file(*text)) {
    print_error(
        "--leaves: '" + printable(options.leaves) + "' says what leaves may do, not what they do",
        "run plays scripts; `lockstep verify --leaves` takes such a file");
    return false;
  }
  auto parsed = parse_leaf_scripts(*text);
  if (!parsed) {
    print_error(printable(options.leaves) + ':' + parsed.error().message, parsed.error().hint);
    return false;
  }
  scripts = std::move(*parsed);
  options.load.unknown = MissingNodes::AreMocked;
  if (scripts.rate && !options.is_rate_given) options.rate = *scripts.rate;
  if (scripts.ticks && !options.max_ticks && !options.timeout) options.max_ticks = *scripts.ticks;
  return true;
}

bool give_scripts(const RunCommandOptions& options, LeafScripts scripts, const Tree& tree,
                  PlayedLeaves& played) {
  if (const auto wrong = PlayedLeaves::check(scripts, tree)) {
    print_error(printable(options.leaves) + ": " + wrong->message, wrong->hint);
    return false;
  }
  played.set_scripts(std::move(scripts));
  return true;
}

}  // namespace lockstep::host
