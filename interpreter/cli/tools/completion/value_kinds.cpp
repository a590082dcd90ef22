#include "cli/tools/completion/value_kinds.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "cli/tools/completion/value_words.h"
#include "judge/measure/measure.h"
#include "run/loading/plugins.h"
#include "tree/catalog.h"

namespace lockstep::host {
namespace {

// The tree or the recording that the line names.
std::string file_of(const CommandWalk& walk) {
  return walk.arguments.empty() ? "" : walk.arguments.front();
}

std::vector<Candidate> as_candidates(const std::vector<std::string>& words,
                                     const std::string& end = {}) {
  std::vector<Candidate> result;
  for (const std::string& word : words) result.push_back({word + end});
  return result;
}

std::vector<Candidate> node_ids() {
  std::vector<Candidate> result;
  const PluginSet none;
  const Catalog built_in = make_catalog(none);
  for (const std::string_view id : built_in.ids())
    result.push_back({std::string(id), first_sentence(std::string(built_in.find(id)->doc))});
  return result;
}

std::vector<Candidate> measures() {
  std::vector<Candidate> result;
  for (const Measure* it : all_measures())
    result.push_back({std::string(it->name) + (it->argument.starts_with(':') ? ":" : "")});
  return result;
}

std::vector<Candidate> recorded(const std::string& file) {
  const RecordingWords words = recording_words(file);
  auto result = as_candidates(words.nodes);
  for (const std::string& key : words.keys) result.push_back({key, "entry"});
  return result;
}

std::vector<Candidate> recorded_entries(const std::string& file) {
  std::vector<Candidate> result = {{"all"}, {"none"}};
  std::ranges::copy(as_candidates(tree_words(file).keys), std::back_inserter(result));
  return result;
}

// The values that an option can have, by the name of its type in --help.
struct ValueKind {
  std::string_view type;
  std::string_view files;  // as in Candidates
  std::vector<Candidate> (*words)(const CommandWalk& walk) = nullptr;
};

const ValueKind kValueKinds[] = {
    {"TREE.xml", ":files xml"},
    {"TREE.xml|git:REV", ":files xml"},
    {"FILE.test.xml", ":files xml"},
    {"FILE.html", ":files html"},
    {"FILE.jsonl", ":files jsonl zst"},
    {"A.jsonl", ":files jsonl zst"},
    {"B.jsonl", ":files jsonl zst"},
    {"FILE", ":files"},
    {"FILE|DIR", ":files"},
    {"FILE|DIR|-", ":files"},
    {"PATH", ":files"},
    {"DIR", ":directories"},
    {"FILE|NAME", ":files so", [](const CommandWalk&) { return as_candidates(plugin_names()); }},
    {"NAME=VALUE", "",
     [](const CommandWalk& walk) {
       return as_candidates(tree_words(file_of(walk)).arguments, "=");
     }},
    {"NAME=V1,V2,...", "",
     [](const CommandWalk& walk) {
       return as_candidates(tree_words(file_of(walk)).arguments, "=");
     }},
    {"KEY=VALUE", "",
     [](const CommandWalk& walk) { return as_candidates(tree_words(file_of(walk)).keys, "="); }},
    {"ID=RESULT[:S]", "",
     [](const CommandWalk& walk) { return as_candidates(tree_words(file_of(walk)).leaves, "="); }},
    {"KEYS", "", [](const CommandWalk& walk) { return recorded_entries(file_of(walk)); }},
    {"MEASURE", "", [](const CommandWalk&) { return measures(); }},
    {"PATTERN", "", [](const CommandWalk& walk) { return recorded(file_of(walk)); }},
    {"NODE", "",
     [](const CommandWalk& walk) { return as_candidates(recording_words(file_of(walk)).nodes); }},
};

// "TEXT:wall|virtual" or "EVENT:{start,end}": the words behind the colon.
std::vector<Candidate> listed(const std::string& type) {
  std::vector<Candidate> result;
  std::string list = type.substr(type.find(':') + 1);
  if (type.find(':') == std::string::npos) return result;
  if (list.find('|') == std::string::npos && !list.starts_with('{')) return result;
  for (std::string& word :
       CLI::detail::split(CLI::detail::trim_copy(list, "{}"), list[0] == '{' ? ',' : '|'))
    result.push_back({std::move(word)});
  return result;
}

}  // namespace

std::string first_sentence(const std::string& text) {
  return text.substr(0, std::min(text.find(". "), text.find(';')));
}

Candidates values_of(const CLI::Option& option, const CommandWalk& walk) {
  const std::string type = option.get_type_name();
  const bool is_positional = option.get_positional();
  // Two meanings that the name of the type does not tell apart.
  if (type == "ID" && is_positional && walk.command->get_name() == "nodes") return {node_ids()};
  if (type == "ID" && !is_positional) return {as_candidates(tree_words(file_of(walk)).trees)};
  if (type == "NAME" && option.check_lname("measure")) return {measures()};
  const auto* const kind = std::ranges::find(kValueKinds, type, &ValueKind::type);
  if (kind == std::end(kValueKinds)) return {listed(type)};
  return {kind->words != nullptr ? kind->words(walk) : std::vector<Candidate>(),
          std::string(kind->files)};
}

}  // namespace lockstep::host
