// Properties on the command line, the same for each command that has them.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "language/property/property.h"

namespace CLI {
class App;
}

namespace lockstep::host {

struct PropertyOptions {
  std::vector<std::string> texts;
  std::vector<std::string> files;
};

void add_property_options(CLI::App& app, PropertyOptions& options);

// Those of a tree file, and then these: the names are made for these alone. Prints what is wrong,
// each at its column, and returns nothing then.
std::optional<std::vector<Property>> all_properties(std::vector<Property> of_file,
                                                    const PropertyOptions& options,
                                                    const std::function<PropertyNames()>& names);

}  // namespace lockstep::host
