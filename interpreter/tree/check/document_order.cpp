#include "tree/check/document_order.h"

#include <algorithm>

namespace lockstep::host {
namespace {

// From the last to the first: then the first visit of a document is the one that counts.
void visit(const Project& project, std::uint32_t document, std::vector<bool>& seen,
           std::vector<std::uint32_t>& order) {
  if (seen[document]) return;
  seen[document] = true;
  order.push_back(document);
  const auto& includes = project.includes[document];
  for (auto included = includes.rbegin(); included != includes.rend(); ++included) {
    visit(project, *included, seen, order);
  }
}

}  // namespace

std::vector<std::uint32_t> document_order(const Project& project) {
  std::vector<bool> seen(project.documents.size());
  std::vector<std::uint32_t> order;
  visit(project, 0, seen, order);
  std::ranges::reverse(order);
  return order;
}

}  // namespace lockstep::host
