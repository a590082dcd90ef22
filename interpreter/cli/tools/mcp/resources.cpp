#include "cli/tools/mcp/resources.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include "cli/installed.h"
#include "language/document/file.h"

namespace lockstep::host {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{64} << 20u;

struct DocumentResource {
  std::string_view name, title;
};
constexpr DocumentResource kDocuments[] = {
    {"nodes-and-attributes", "The language of trees"},
    {"nodes", "All nodes"},
    {"expressions", "Scripts and conditions"},
    {"properties", "Properties of runs"},
    {"verify", "Verification, and leaf models"},
    {"testing", "Scenarios"},
    {"messages", "The codes of messages, with examples and what mends them"},
    {"recording", "Recordings"},
    {"btcpp", "Trees for BehaviorTree.CPP"},
    {"cli", "Commands and exit codes"},
};
constexpr std::string_view kDocs = "lockstep://docs/", kExamples = "lockstep://examples/",
                           kLast = "lockstep://recordings/last";

Json resource_row(std::string uri, std::string_view name, std::string_view title,
                  std::string_view type) {
  return {{"uri", std::move(uri)}, {"name", name}, {"title", title}, {"mimeType", type}};
}

std::optional<Resource> resource_file(const std::string& path, std::string_view type) {
  auto text = read_file(path, kMaxBytes);
  if (!text || text->size() > kMaxBytes) return std::nullopt;
  return Resource{type, std::move(*text)};
}

}  // namespace

Json list_resources() {
  Json all = Json::array();
  for (const auto& [name, title] : kDocuments)
    all.push_back(resource_row(std::string(kDocs).append(name), name, title, "text/markdown"));
  for (const std::string& it : example_names())
    all.push_back(
        resource_row(std::string(kExamples).append(it), it, "An example tree", "text/xml"));
  all.push_back(resource_row(std::string(kLast), "last", "The recording of the last simulation",
                             "application/jsonl"));
  return {{"resources", std::move(all)}};
}

std::optional<Resource> read_resource(std::string_view uri, const std::string& recording) {
  if (uri == kLast) return resource_file(recording, "application/jsonl");
  if (uri.starts_with(kDocs)) {
    uri.remove_prefix(kDocs.size());
    if (std::ranges::find(kDocuments, uri, &DocumentResource::name) == std::end(kDocuments))
      return std::nullopt;
    return resource_file((documents_directory() / uri).string() + ".md", "text/markdown");
  }
  if (!uri.starts_with(kExamples)) return std::nullopt;
  uri.remove_prefix(kExamples.size());
  const std::vector<std::string> names = example_names();
  if (std::ranges::find(names, uri) == names.end()) return std::nullopt;
  return resource_file(example_file(std::string(uri)).string(), "text/xml");
}

}  // namespace lockstep::host
