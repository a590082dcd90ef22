// Plugins are found by name in directories, and by nothing but a name.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "abi/support/plugins.h"

namespace lockstep::host::test {
namespace {

using Strings = std::vector<std::string>;

const Strings kDirectories = {"/nowhere", LOCKSTEP_ABI_PLUGINS};

Strings refusal_of_name(std::string_view name, const Strings& directories = kDirectories) {
  PluginSet plugins;
  Diagnostics diagnostics;
  Strings result;
  if (plugins.load_named(name, directories, diagnostics)) result.push_back("was loaded");
  for (std::string& text : texts(diagnostics)) result.push_back(std::move(text));
  return result;
}

TEST_CASE("a plugin is found in the first directory that has it") {
  PluginSet plugins;
  Diagnostics diagnostics;
  REQUIRE(plugins.load_named("good", kDirectories, diagnostics));
  REQUIRE(plugins.list().size() == 1);
  CHECK(plugins.list()[0].name == "good");
  CHECK(plugins.list()[0].version == "1.0.0");
  CHECK(plugins.list()[0].doc == "for tests");
  CHECK(plugins.list()[0].path == plugin_path("good"));
}

TEST_CASE("a plugin that is there already is not loaded twice") {
  PluginSet plugins;
  Diagnostics diagnostics;
  CHECK(plugins.load_file(plugin_path("good"), diagnostics));
  CHECK(plugins.load_file(plugin_path("good"), diagnostics));
  CHECK(plugins.load_named("good", {}, diagnostics));
  CHECK(plugins.list().size() == 1);
  CHECK(diagnostics.all().empty());
}

TEST_CASE("a name is not a path") {
  const std::string hint =
      "a plugin is named by letters, digits, '_' and '-', without path and '.so'";
  for (const std::string name : {"../../x", "/x", "x.so", "", "a b"}) {
    CHECK(refusal_of_name(name) == Strings{"'" + name + "' is not the name of a plugin | " + hint});
  }
}

TEST_CASE("a plugin that is not found: where it was searched, and the nearest name") {
  const std::string searched = std::string("/nowhere, ") + LOCKSTEP_ABI_PLUGINS;
  CHECK(refusal_of_name("init_refused") ==
        Strings{"plugin 'init_refused' is not found: 'init_refused.so' is not in " + searched +
                " | did you mean 'init_refuses'?"});
  CHECK(refusal_of_name("zzzz") ==
        Strings{"plugin 'zzzz' is not found: 'zzzz.so' is not in " + searched +
                " | add the directory that has it to the plugin path: --plugin-path, or "
                "LOCKSTEP_PLUGIN_PATH"});
  CHECK(refusal_of_name("good", {}) ==
        Strings{"plugin 'good' is not found: there is no directory to search | add the directory "
                "that has it to the plugin path: --plugin-path, or LOCKSTEP_PLUGIN_PATH"});
}

TEST_CASE("a leaf works in real time if its plugin says so, and none of ABI 1.0 does") {
  for (const Isolation isolation : {Isolation::InProcess, Isolation::Isolated}) {
    for (const std::string name : {"good", "minor_0", "real_time"}) {
      INFO(name << (isolation == Isolation::Isolated ? ", isolated" : ""));
      PluginSet plugins;
      set_isolation(plugins, isolation);
      Diagnostics diagnostics;
      REQUIRE(plugins.load_file(plugin_path(name), diagnostics));
      CHECK(plugins.types()[0]->real_time == (name == "real_time"));
    }
  }
}

TEST_CASE("a plugin whose file is named as build systems name libraries: what to rename") {
  std::string made = std::filesystem::temp_directory_path() / "lockstep-named-XXXXXX";
  REQUIRE(mkdtemp(made.data()) != nullptr);
  const std::string file = made + "/libgreeter.so";
  std::ofstream(file).put('x');
  CHECK(refusal_of_name("greeter", {made}) ==
        Strings{
            "plugin 'greeter' is not found: 'greeter.so' is not in " + made + " | '" + file +
            "' exists: rename it to 'greeter.so' (in CMake: lockstep_add_plugin, or PREFIX \"\")"});
  std::filesystem::remove_all(made);
}

TEST_CASE("a plugin that was asked for by name has that name") {
  CHECK(refusal_of_name("other_name") ==
        Strings{"plugin '" + plugin_path("other_name") +
                "' calls itself 'something_else', expected 'other_name' | name the file "
                "'something_else.so', or give the plugin the file's name"});
}

}  // namespace
}  // namespace lockstep::host::test
