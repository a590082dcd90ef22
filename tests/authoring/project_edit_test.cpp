// Renames, extractions and inlinings over the files of a project: the definition stays the same but
// for the names.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <functional>

#include "author/edit/entry_uses.h"
#include "author/edit/renames.h"
#include "author/edit/subtree_edits.h"
#include "property/random_source.h"
#include "run/loading/load.h"
#include "run/shape_of.h"
#include "support/program.h"

namespace lockstep::host::test {
namespace {

namespace fs = std::filesystem;

struct LoadedFile {
  tl::expected<Loaded, LoadFailure> loaded;
  Diagnostics diagnostics;
};

LoadedFile load_file(const std::string& path) {
  LoadOptions options;
  options.plugins.directories = {LOCKSTEP_BINARY_DIR "/plugins"};
  options.plugins.program_directory = LOCKSTEP_BINARY_DIR;
  LoadedFile file{tl::unexpected(LoadFailure::Invalid), {}};
  file.loaded = load(path, options, file.diagnostics);
  return file;
}

// The nodes but for SubTrees, with numbers in place of the names of entries. An entry with a start
// value is that value, as where a SubTree gives it.
std::string shape_of(const Definition& definition) {
  std::string shape;
  std::map<std::uint32_t, std::size_t> numbers;
  const auto has_start_value = [&](const Port& port) {
    return !std::holds_alternative<NoValue>(definition.entries[port.entry].initial);
  };
  for (const DefinitionNode& node : definition.nodes) {
    if (node.type->id == "SubTree") continue;
    shape += node.type->id;
    for (std::size_t i = 0; i < node.type->parameters.size(); ++i) {
      const Port& port = definition.ports[node.first + i];
      if (port.entry != Port::kNone && !has_start_value(port)) {
        const auto number = numbers.try_emplace(port.entry, numbers.size()).first->second;
        shape += fmt::format(" {}=e{}", node.type->parameters[i].name, number);
      } else if (port.entry != Port::kNone) {
        shape += fmt::format(" {}={}", node.type->parameters[i].name,
                             to_text(definition.entries[port.entry].initial));
      } else if (port.value != Port::kNone && !node.type->parameters[i].is_script) {
        shape += fmt::format(" {}={}", node.type->parameters[i].name,
                             to_text(definition.values[port.value]));
      }
    }
    shape += '\n';
  }
  return shape +
         fmt::format("{} entries, {} scripts",
                     std::ranges::count_if(definition.entries,
                                           [](const BlackboardEntry& it) {
                                             return std::holds_alternative<NoValue>(it.initial);
                                           }),
                     definition.scripts.size());
}

std::string errors_of(const Diagnostics& diagnostics) {
  std::string text;
  for (const Diagnostic& it : diagnostics.all())
    if (it.severity == Severity::Error) text += render(it, false);
  return text;
}

// A copy of the trees of this project, to be edited.
class Trees {
 public:
  Trees() {
    const fs::path from(LOCKSTEP_SOURCE_DIR);
    fs::copy(from / "trees", directory_.path("trees"), fs::copy_options::recursive);
    fs::copy(from / "tests/trees/good", directory_.path("good"), fs::copy_options::recursive);
    fs::copy(from / "tests/trees/btcpp/good", directory_.path("btcpp"),
             fs::copy_options::recursive);
    for (const auto& file : fs::recursive_directory_iterator(directory_.path(""))) {
      const std::string name = file.path().string();
      if (name.ends_with(".xml") && load_file(name).loaded) files_.push_back(name);
    }
    std::sort(files_.begin(), files_.end());
  }

  const std::vector<std::string>& files() const { return files_; }

 private:
  TemporaryDirectory directory_;
  std::vector<std::string> files_;
};

void write(const std::string& path, std::string_view text) {
  std::ofstream(path, std::ios::binary) << text;
}

// Writes the edit, loads again, and writes the texts as they were.
void check_edit(const std::string& file, const ProjectTexts& texts, const ProjectEdit& edit,
                const std::string& shape) {
  std::vector<std::string> after;
  for (std::uint32_t i = 0; i < texts.size(); ++i) {
    const Source& source = *texts.document(i).source();
    after.push_back(edit[i].apply(source.text()));
    write(source.path(), after[i]);
  }
  const LoadedFile again = load_file(file);
  for (std::uint32_t i = 0; i < texts.size(); ++i)
    write(texts.document(i).source()->path(), texts.document(i).source()->text());
  INFO(after[0]);
  REQUIRE(errors_of(again.diagnostics) == "");
  REQUIRE(again.loaded.has_value());
  REQUIRE(shape_of(again.loaded->definition) == shape);
}

int edits_of(const std::string& file,
             const std::function<std::vector<Result<ProjectEdit>>(const ProjectTexts&)>& make) {
  const LoadedFile before = load_file(file);
  const Catalog catalog = make_catalog(*before.loaded->plugins, *before.loaded->project->rules);
  const ProjectTexts texts(*before.loaded->project, catalog);
  int made = 0;
  for (const auto& edit : make(texts)) {
    if (!edit) continue;
    INFO(file << ", edit " << made);
    check_edit(file, texts, *edit, shape_of(before.loaded->definition));
    ++made;
  }
  return made;
}

std::vector<ElementAt> all_of(const ProjectTexts& texts, const std::function<bool(ElementAt)>& is) {
  std::vector<ElementAt> found;
  texts.for_each_element([&](ElementAt at) {
    if (is(at)) found.push_back(at);
  });
  return found;
}

std::vector<ElementAt> trees_of(const ProjectTexts& texts) {
  return all_of(texts, [&](ElementAt at) {
    return texts.document(at.document).elements()[at.element].tag == "BehaviorTree";
  });
}

// A leaf that uses entries by their names.
constexpr NodeType kOpens{
    .id = "Opens", .category = NodeCategory::Action, .doc = "", .opens_entries = true};

// One text, changed; or the message.
std::string changed(const std::string& nodes,
                    const std::function<Result<ProjectEdit>(const ProjectTexts&)>& make) {
  Diagnostics diagnostics;
  const auto project = load_project_text(
      "t.xml", "<root lockstep=\"1\" main_tree_to_execute=\"A\">\n" + nodes + "</root>\n",
      Arguments(), diagnostics);
  REQUIRE(project != nullptr);
  const PluginSet none;
  Catalog catalog = make_catalog(none);
  catalog.add(&kOpens);
  const ProjectTexts texts(*project, catalog);
  const auto edit = make(texts);
  if (!edit) return edit.error().message;
  const std::string after = (*edit)[0].apply(texts.document(0).source()->text());
  const auto begin = after.find('\n') + 1;
  return after.substr(begin, after.size() - begin - std::string_view("</root>\n").size());
}

ElementAt first(const ProjectTexts& texts, std::string_view tag) {
  return all_of(texts,
                [&](ElementAt at) {
                  return texts.document(at.document).elements()[at.element].tag == tag;
                })
      .front();
}

}  // namespace

TEST_CASE("project edits: trees, entries and arguments get other names, and stay what they are") {
  const Trees trees;
  REQUIRE(trees.files().size() > 40);
  int ids = 0, keys = 0, arguments = 0;
  for (const std::string& file : trees.files()) {
    ids += edits_of(file, [](const ProjectTexts& texts) {
      std::vector<Result<ProjectEdit>> edits;
      for (const ElementAt tree : trees_of(texts)) {
        const std::string id(texts.value(tree, "ID"));
        edits.push_back(rename_tree(texts, id, id + " & more"));
      }
      return edits;
    });
    keys += edits_of(file, [](const ProjectTexts& texts) {
      std::vector<Result<ProjectEdit>> edits;
      for (const ElementAt tree : trees_of(texts)) {
        for (const std::string& key : keys_in(texts, {tree.document, tree.element}))
          edits.push_back(rename_entry(texts, texts.value(tree, "ID"), key, key + "_2"));
      }
      return edits;
    });
    arguments += edits_of(file, [](const ProjectTexts& texts) {
      std::vector<Result<ProjectEdit>> edits;
      for (const ElementAt at :
           all_of(texts, [&](ElementAt it) { return !texts.value(it, "name").empty(); }))
        edits.push_back(rename_argument(texts, texts.value(at, "name"), "another"));
      return edits;
    });
  }
  CHECK(ids > 60);
  CHECK(keys > 60);
  CHECK(arguments > 60);
}

TEST_CASE("project edits: a part of a tree becomes a tree, and a SubTree its nodes") {
  const Trees trees;
  RandomSource random(7);
  int extracted = 0, inlined = 0;
  for (const std::string& file : trees.files()) {
    extracted += edits_of(file, [&](const ProjectTexts& texts) {
      std::vector<Result<ProjectEdit>> edits;
      for (const ElementAt at :
           all_of(texts, [&](ElementAt it) { return texts.tree_around(it).has_value(); }))
        if (random.one_in(4)) edits.push_back(extract_subtree(texts, at, "Extracted"));
      return edits;
    });
    inlined += edits_of(file, [](const ProjectTexts& texts) {
      std::vector<Result<ProjectEdit>> edits;
      for (const ElementAt at : all_of(texts, [&](ElementAt it) { return texts.is_sub_tree(it); }))
        edits.push_back(inline_subtree(texts, at));
      return edits;
    });
  }
  CHECK(extracted > 50);
  CHECK(inlined > 20);
}

TEST_CASE("project edits: an entry gets another name wherever it is the same entry") {
  const auto rename = [](const std::string& nodes) {
    return changed(
        nodes, [](const ProjectTexts& texts) { return rename_entry(texts, "A", "k", "new_k"); });
  };
  const auto a = [](const std::string& nodes) {
    return "<BehaviorTree ID=\"A\">" + nodes + "</BehaviorTree>\n";
  };
  const std::string b = "<BehaviorTree ID=\"B\"><Script code=\"k := 1\"/></BehaviorTree>\n";
  CHECK(rename(a("<Script code=\"k := 1; kk := 'k' ; a = k\"/>")) ==
        a("<Script code=\"new_k := 1; kk := 'k' ; a = new_k\"/>"));
  CHECK(rename(a("<Check code='1 &lt; k' while=\"k\n  > 2\"/>")) ==
        a("<Check code='1 &lt; new_k' while=\"new_k\n  > 2\"/>"));
  CHECK(rename(a("<SubTree ID=\"B\" x=\"{k}\" k=\"{k}\" name=\"k\"/>") + b) ==
        a("<SubTree ID=\"B\" x=\"{new_k}\" k=\"{new_k}\" name=\"k\"/>") + b);
  CHECK(rename(a("<SubTree ID=\"B\" _autoremap=\"true\"/>") + b) ==
        a("<SubTree ID=\"B\" _autoremap=\"true\" k=\"{new_k}\"/>") + b);
  CHECK(
      rename(a("<Check code=\"k == ${k}\"/>") + "<property name=\"p\">always {k} > 1</property>") ==
      a("<Check code=\"new_k == ${k}\"/>") + "<property name=\"p\">always {new_k} > 1</property>");
  CHECK(rename(a("<Script code=\"k := 1; new_k := 2\"/>")) ==
        "the tree 'A' has an entry 'new_k' already");
  CHECK(rename(a("<AlwaysSuccess/>")) == "the tree 'A' has no entry 'k'");
  const auto inner =
      changed(a("<SubTree ID=\"B\" k=\"{k}\"/><SubTree ID=\"B\" _autoremap=\"true\"/>") + b,
              [](const ProjectTexts& texts) { return rename_entry(texts, "B", "k", "j"); });
  CHECK(inner ==
        a("<SubTree ID=\"B\" j=\"{k}\"/><SubTree ID=\"B\" _autoremap=\"true\" j=\"{k}\"/>") +
            "<BehaviorTree ID=\"B\"><Script code=\"j := 1\"/></BehaviorTree>\n");
}

TEST_CASE("project edits: a name that means something else is refused") {
  const auto renamed = [](std::string_view name) {
    return changed("<BehaviorTree ID=\"A\"><Script code=\"k := 1\"/></BehaviorTree>\n",
                   [&](const ProjectTexts& texts) { return rename_entry(texts, "A", "k", name); });
  };
  for (const std::string name :
       {"true", "false", "and", "or", "name", "ID", "_description", "while", "_autoremap",
        "skip_if", "on_success", "_k", "1k", "@k"}) {
    CHECK(renamed(name) == "'" + name + "' cannot be a key");
  }
  CHECK(renamed("_skipIf") == "'_skipIf' cannot be a key");
  CHECK(renamed("skipIf").find("skipIf := 1") != std::string::npos);
  CHECK(changed("<BehaviorTree ID=\"A\"><Wait seconds=\"1\"/></BehaviorTree>\n",
                [](const ProjectTexts& texts) { return rename_tree(texts, "A", "Sequence"); }) ==
        "'Sequence' cannot be the ID of a tree");
}

TEST_CASE("project edits: a tree of a part, and back") {
  const std::string before =
      "  <BehaviorTree ID=\"A\">\n    <Sequence>\n      <!-- c -->\n      <Fallback>\n"
      "        <Script code=\"k := 1\n  + 1\"/>\n      </Fallback>\n      <Check code=\"k > 0\"/>\n"
      "    </Sequence>\n  </BehaviorTree>\n";
  const std::string after =
      "  <BehaviorTree ID=\"A\">\n    <Sequence>\n      <!-- c -->\n      <SubTree ID=\"B\" "
      "k=\"{k}\"/>\n"
      "      <Check code=\"k > 0\"/>\n    </Sequence>\n  </BehaviorTree>\n"
      "  <BehaviorTree ID=\"B\">\n    <Fallback>\n      <Script code=\"k := 1\n  + 1\"/>\n"
      "    </Fallback>\n  </BehaviorTree>\n";
  CHECK(changed(before, [](const ProjectTexts& texts) {
          return extract_subtree(texts, first(texts, "Fallback"), "B");
        }) == after);
  const std::string back = changed(after, [](const ProjectTexts& texts) {
    return inline_subtree(texts, first(texts, "SubTree"));
  });
  CHECK(back.starts_with(before));
}

TEST_CASE("project edits: what nodes cannot say is not inlined") {
  const auto inlined = [](const std::string& sub_tree, const std::string& inside) {
    return changed(
        "<BehaviorTree ID=\"A\"><Sequence><Script code=\"k := 0\"/>" + sub_tree +
            "</Sequence></BehaviorTree><BehaviorTree ID=\"B\">" + inside + "</BehaviorTree>\n",
        [](const ProjectTexts& texts) { return inline_subtree(texts, first(texts, "SubTree")); });
  };
  const std::string script = "<Script code=\"k := 1\"/>";
  CHECK(inlined("<SubTree ID=\"B\" k=\"5\"/>", script) == "the entry 'k' has a start value here");
  CHECK(inlined("<SubTree ID=\"B\" table=\"x\"/>", script) ==
        "'table' is not an entry of the tree");
  CHECK(inlined("<SubTree ID=\"B\" while=\"k\"/>", "<Script code=\"k := 1\" while=\"true\"/>") ==
        "the SubTree has 'while', and the first node has 'while'");
  CHECK(inlined("<SubTree ID=\"B\" success_if=\"k == 1\"/>",
                "<Wait seconds=\"1\" on_success=\"k += 1\"/>") ==
        "the SubTree has 'success_if', and the first node has 'on_success'");
  CHECK(inlined("<SubTree ID=\"B\" success_if=\"k == 1\"/>", "<Wait seconds=\"1\"/>")
            .find("<Wait seconds=\"1\" success_if=\"k == 1\"/>") != std::string::npos);
  // An entry that only the tree has stays one.
  CHECK(inlined("<SubTree ID=\"B\"/>", script).find("<Script code=\"k_2 := 1\"/>") !=
        std::string::npos);
  CHECK(inlined("<SubTree ID=\"B\" k=\"3\"/>", "<Wait seconds=\"{k}\"/>")
            .find("<Wait seconds=\"3\"/>") != std::string::npos);
}

TEST_CASE("project edits: a part whose entries are not known stays where it is") {
  const auto extracted = [](const std::string& part, const std::string& inside) {
    return changed("<BehaviorTree ID=\"A\"><Sequence>" + part +
                       "</Sequence></BehaviorTree><BehaviorTree ID=\"B\">" + inside +
                       "</BehaviorTree>\n",
                   [](const ProjectTexts& texts) {
                     return extract_subtree(texts, first(texts, "Sequence"), "C");
                   });
  };
  const std::string opens = "'Opens' may use entries that no port names",
                    shared = "<SubTree ID=\"B\" _autoremap=\"true\"/>";
  CHECK(extracted("<Opens/>", "<Wait seconds=\"1\"/>") == opens);
  CHECK(extracted("<Nowhere/>", "<Wait seconds=\"1\"/>") == "no plugin has 'Nowhere'");
  CHECK(extracted(shared, "<Opens/>") == opens);
  CHECK(extracted("<SubTree ID=\"B\"/>", "<Opens/>").find("ID=\"C\"") != std::string::npos);
  CHECK(changed("<BehaviorTree ID=\"A\">" + shared +
                    "</BehaviorTree><BehaviorTree ID=\"B\">"
                    "<Opens/></BehaviorTree>",
                [](const ProjectTexts& texts) {
                  return inline_subtree(texts, first(texts, "SubTree"));
                }) == opens);
}

}  // namespace lockstep::host::test
