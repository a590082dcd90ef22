// The manual pages: of the commands, from the descriptions of their options; of trees, from the
// rows of the nodes; of recordings, from the table of their lines.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lockstep::host {

struct ManualFile {
  std::string name;  // "man1/lockstep-run.1"
  std::string roff;
};

std::vector<ManualFile> command_pages(std::string_view date);
ManualFile tree_page(std::string_view date);
ManualFile recording_page(std::string_view date);

}  // namespace lockstep::host
