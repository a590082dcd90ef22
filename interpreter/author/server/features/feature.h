// The server's answers about a position in an open file: a feature is a function in a separate
// file and a row in features.cpp.
#pragma once

#include <span>
#include <string_view>

#include "author/server/protocol/params.h"
#include "author/server/workspace.h"
#include "base/json/json.h"

namespace lockstep::host {

struct Question {
  const Workspace& workspace;
  const OpenFile& file;
  const ClientParams& client;
  const FileParams& params;
  const Settings& settings;

  std::size_t byte() const { return file.positions().byte_at(params.position); }
};

struct Feature {
  std::string_view method;
  Json (*answer)(const Question& question);
  // Else it is asked when the newest text was analyzed.
  bool takes_older_analysis = true;
  // It changes all open files of a project: each must be analyzed to know whether it is one.
  bool needs_all_files = false;
};

std::span<const Feature> features();
// The answer of `initialize` about them.
Json capabilities();

}  // namespace lockstep::host
