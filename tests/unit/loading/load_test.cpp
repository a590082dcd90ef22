// What a program that carries lockstep calls: this one links nothing of the command line.
#include "run/loading/load.h"

#include <catch2/catch.hpp>

#include "run/run.h"
#include "support/paths.h"
#include "unit/document/temporary_directory.h"
#include "unit/document/told.h"

namespace lockstep::host::test {
namespace {

constexpr auto kGood = R"(<root lockstep="1">
  <arg name="shape" default="line"/>
  <plugin name="motion"/>
  <BehaviorTree ID="Main"><Profile shape="${shape}" step="{step}"/></BehaviorTree>
</root>)";

LoadOptions with_plugins() {
  LoadOptions options;
  options.plugins.directories = {LOCKSTEP_BINARY_DIR "/plugins"};
  return options;
}

struct Loading {
  explicit Loading(const std::string& text, const LoadOptions& options = with_plugins(),
                   const std::string& name = "tree.xml") {
    files.write("tree.xml", text);
    loaded = load(files / name, options, diagnostics, plugins);
  }

  // Of the first error.
  std::string message() const {
    const auto& all = diagnostics.all();
    return all.empty() ? "" : all[0].message;
  }

  TemporaryDirectory files;
  Diagnostics diagnostics;
  std::shared_ptr<PluginSet> plugins = std::make_shared<PluginSet>();
  tl::expected<Loaded, LoadFailure> loaded = tl::unexpected(LoadFailure::Unreadable);
};

}  // namespace

TEST_CASE("load: a leaf called like a node of one language can be used in the other") {
  lockstep_leaf_type wait{};
  wait.struct_size = sizeof wait;
  wait.kind = LOCKSTEP_ACTION;
  wait.id = "Wait";
  wait.create = [](const lockstep_host*, const lockstep_caller*, void*) -> void* {
    static int one;
    return &one;
  };
  wait.destroy = [](void*) {};
  wait.tick = [](void*) -> lockstep_status { return LOCKSTEP_FAILURE; };
  const lockstep_leaf_type* const leaves[] = {&wait};
  lockstep_plugin plugin{};
  plugin.abi_major = LOCKSTEP_ABI_MAJOR;
  plugin.struct_size = sizeof plugin;
  plugin.name = "waits";
  plugin.leaf_type_count = 1;
  plugin.leaf_types = leaves;
  const auto plugins = std::make_shared<PluginSet>();
  Diagnostics diagnostics;
  REQUIRE(plugins->add(plugin, "waits", diagnostics));
  const auto result = [&](const std::string& root, const std::string& node) {
    const std::string text =
        "<root " + root + "><BehaviorTree ID=\"A\">" + node + "</BehaviorTree></root>";
    auto loaded = load_text("t", text, {}, diagnostics, plugins);
    REQUIRE(loaded);
    const Runnable runnable = make_runnable(std::move(*loaded));
    return Run(runnable.tree, {}).tick(Nanoseconds(0));
  };
  CHECK(result("BTCPP_format=\"4\"", "<Wait/>") == Status::Failure);
  CHECK(diagnostics.all().empty());
  CHECK(result("lockstep=\"1\"", "<Wait seconds=\"1\"/>") == Status::Running);
  REQUIRE(diagnostics.all().size() == 1);
  CHECK(diagnostics.all()[0].message == "the leaf 'Wait' of plugin 'waits' cannot be used here");
}

TEST_CASE("load: a tree with its plugins, ready to run") {
  LoadOptions options = with_plugins();
  options.arguments["shape"] = "sigmoid";
  options.values["step"] = "0.25";
  Loading it(kGood, options);
  INFO(it.message());
  REQUIRE(it.loaded);
  CHECK(it.diagnostics.all().empty());
  CHECK(it.loaded->definition.nodes.size() == 1);
  CHECK(it.loaded->project->sources.all().size() == 1);

  const Runnable runnable = make_runnable(std::move(*it.loaded));
  CHECK(runnable.arguments.at(0).value == "sigmoid");
  CHECK(runnable.plugins->list().at(0).name == "motion");
  Diagnostics refused;
  REQUIRE(runnable.plugins->initialize(refused));
  Run run(runnable.tree, {});
  Status status = Status::Running;
  for (int tick = 0; tick < 10 && status == Status::Running; ++tick) {
    status = run.tick(tick * run.period());
  }
  CHECK(status == Status::Success);
}

TEST_CASE("load: a failure has its kind, and errors that say more") {
  struct Row {
    std::string text;
    std::string name;
    LoadFailure failure;
    std::string message;
  };
  const std::string tree = "<BehaviorTree ID='T'><AlwaysSuccess/></BehaviorTree></root>";
  const Row rows[] = {
      {"", "none.xml", LoadFailure::Unreadable, "cannot be read: No such file or directory"},
      {"<root", "tree.xml", LoadFailure::Unreadable, "the tag '<root' is not closed"},
      {"<root lockstep='2'>" + tree, "tree.xml", LoadFailure::Invalid,
       "version '2' of the language is not known"},
      {"<root lockstep='1'><plugin name='none'/>" + tree, "tree.xml", LoadFailure::PluginRefused,
       "plugin 'none' is not found"},
      {"<root lockstep='1'><include path='none.xml'/><plugin name='none'/>" + tree, "tree.xml",
       LoadFailure::Invalid, "cannot read"},
  };
  for (const Row& row : rows) {
    INFO(row.text);
    const Loading it(row.text, with_plugins(), row.name);
    REQUIRE_FALSE(it.loaded);
    CHECK(it.loaded.error() == row.failure);
    CHECK_THAT(it.message(), Catch::StartsWith(row.message));
  }
}

TEST_CASE("load: an option that names what the file does not have") {
  const auto failure = [](auto change) {
    LoadOptions options = with_plugins();
    change(options);
    const Loading it(kGood, options);
    CHECK(it.diagnostics.has_errors());
    CHECK(it.diagnostics.all()[0].location.file.empty());
    return it.loaded.error();
  };
  CHECK(failure([](LoadOptions& it) { it.main_tree = "Other"; }) == LoadFailure::Options);
  CHECK(failure([](LoadOptions& it) { it.arguments["other"] = "1"; }) == LoadFailure::Options);
  CHECK(failure([](LoadOptions& it) { it.values["other"] = "1"; }) == LoadFailure::Options);
}

TEST_CASE("load: warnings come with what was loaded") {
  const Loading it(kGood);
  CHECK(it.loaded);
  CHECK(
      told(it.diagnostics) ==
      std::vector<std::string>{it.files / "tree.xml" + ":4:59: warning: nothing writes '{step}'"});
}

TEST_CASE("load: trees share the plugins that they are given") {
  const Loading first(kGood);
  REQUIRE(first.loaded);
  Diagnostics diagnostics;
  const auto second = load(first.files / "tree.xml", with_plugins(), diagnostics, first.plugins);
  REQUIRE(second);
  CHECK(second->plugins == first.plugins);
  CHECK(second->definition.nodes[0].type == first.loaded->definition.nodes[0].type);
  CHECK(first.plugins->list().size() == 1);
}

}  // namespace lockstep::host::test
