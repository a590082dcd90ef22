#include "author/server/features/navigation.h"

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "author/server/features/names.h"
#include "author/server/features/site.h"
#include "author/server/uri.h"

namespace lockstep::host {
namespace {

Json location(const NamePlace& place) {
  return {{"uri", place.text->uri}, {"range", place.text->positions.json(place.range)}};
}

// The element that declares it, or of an entry its tree; null: it is not known.
const TolerantElement* home_of(const NamePlace& name) {
  return name.declared != nullptr ? name.declared : name.scope;
}

// The file that an include names; null: there is none.
Json included_file(const Question& question, std::size_t byte) {
  const TolerantTree& tree = question.file.tree();
  const Site site = site_at(tree, byte);
  const bool is_path = site.part == Site::Part::AttributeValue && site.attribute->name == "path" &&
                       site.element->tag == "include";
  const bool is_tree = site.part == Site::Part::AttributeValue &&
                       kind_of_file(question.file.path) == FileKind::Scenarios &&
                       (site.attribute->name == "tree" || site.attribute->name == "leaves");
  if (!is_path && !is_tree) return {};
  const auto path =
      (std::filesystem::path(question.file.path).parent_path() / site.attribute->value)
          .lexically_normal();
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return {};
  return {{"uri", question.workspace.uri_of(path.string())},
          {"range", Positions("").json(ByteRange{0, 0})}};
}

}  // namespace

Json definition(const Question& question) {
  const std::size_t byte = question.byte();
  const Names names(question);
  const NamePlace* const name = names.at(byte);
  if (name == nullptr) return included_file(question, byte);
  std::vector<Json> found;
  for (const NamePlace* it : names.same_as(*name))
    if (it->is_declaration) found.push_back(location(*it));
  // Nobody in the tree writes an entry that is given from outside: the first place that reads it.
  if (found.empty()) found.push_back(location(*names.same_as(*name).front()));
  return Json::array(std::move(found));
}

Json references(const Question& question) {
  const Names names(question);
  const NamePlace* const name = names.at(question.byte());
  std::vector<Json> found;
  if (name == nullptr) return Json::array();
  const auto add = [&](const NamePlace& it) {
    if (question.params.with_declaration || !it.is_declaration) found.push_back(location(it));
  };
  for (const NamePlace* it : names.same_as(*name)) add(*it);
  const TolerantElement* const home = home_of(*name);
  if (home == nullptr) return Json::array(std::move(found));
  // Those in files that include the one with the declaration.
  std::set<std::string> known;
  for (const ProjectText& it : names.texts()) known.insert(it.identity);
  const std::string& identity = names.text_of(*home)->identity;
  for (const Question& other : projects_with(question, identity)) {
    const Names all(other);
    for (const NamePlace& it : all.places()) {
      const TolerantElement* const its_home = home_of(it);
      const bool is_same = it.kind == name->kind && its_home != nullptr &&
                           its_home->begin == home->begin &&
                           all.text_of(*its_home)->identity == identity &&
                           (it.kind != NameKind::Entry || it.name == name->name);
      if (is_same && !known.contains(it.text->identity)) add(it);
    }
    for (const ProjectText& it : all.texts()) known.insert(it.identity);
  }
  return Json::array(std::move(found));
}

Json highlights(const Question& question) {
  const Names names(question);
  const NamePlace* const name = names.at(question.byte());
  std::vector<Json> found;
  if (name == nullptr) return Json::array();
  for (const NamePlace* it : names.same_as(*name)) {
    if (it->text != name->text) continue;
    found.push_back(Json{{"range", question.file.positions().json(it->range)},
                         {"kind", it->is_declaration ? 3 : 2}});
  }
  return Json::array(std::move(found));
}

}  // namespace lockstep::host
