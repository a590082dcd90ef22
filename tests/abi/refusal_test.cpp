// Every way in which a plugin is refused, with the whole message: one error and nothing else.
#include <elf.h>

#include <catch2/catch.hpp>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "abi/support/plugins.h"

namespace lockstep::host::test {
namespace {

namespace fs = std::filesystem;
using Strings = std::vector<std::string>;

struct Case {
  const char* plugin;
  const char* message;  // after "plugin '<path>' "
  const char* hint;
};

// clang-format off
const Case kCases[] = {
  {"no_entry", "does not export 'lockstep_plugin_entry'", "is it a lockstep plugin? `lockstep docs plugins` shows how one is built"},
  {"entry_is_function", "exports 'lockstep_plugin_entry' as a function", "define it as a constant of type lockstep_plugin"},
  {"entry_too_small", "exports a constant of 4 bytes, expected a lockstep_plugin", "define lockstep_plugin_entry as in `lockstep docs plugins`"},
  {"wrong_abi", "was built for plugin ABI 2.3, this program has 1.5", "build it with the lockstep/leaf.h of this version"},
  {"undefined_symbol", "cannot be loaded: undefined symbol: a_function_that_nobody_has", "link the plugin with the library that defines it; functions of lockstep are reached through the host table only"},
  {"static_tls", "cannot be loaded: cannot allocate memory in static TLS block", "thread-local variables of it, or of a library that it needs, must have their place when the program starts: set GLIBC_TUNABLES=glibc.rtld.optional_static_tls=4194304, or name the library in LD_PRELOAD"},
  {"plugin_too_small", "has a lockstep_plugin with struct_size 24, expected at least 96", "set it to sizeof(lockstep_plugin)"},
  {"plugin_too_large", "has a lockstep_plugin with struct_size 4000, expected at most 104", "set it to sizeof(lockstep_plugin)"},
  {"no_plugin_name", "has no name", "set lockstep_plugin::name"},
  {"bad_plugin_name", "is named '../x'", "a plugin's name is made of letters, digits, '_' and '-'"},
  {"describe_refuses", "cannot be used: two nodes are called 'Grasp'", "the author of the plugin knows what it needs"},
  {"describe_misfits", "was built for plugin ABI 2.0, this program has 1.5", "build it with the lockstep/leaf.h of this version"},
  {"too_many_leaves", "claims to have 5000 leaf types, expected at most 4096", "check lockstep_plugin::leaf_type_count"},
  {"leaves_without_list", "has 1 leaf types but no list of them", "set lockstep_plugin::leaf_types"},
  {"create_run_alone", "has create_run without destroy_run", "a plugin has both or none"},
  {"null_leaf", "is malformed: leaf type 0 is NULL", "list leaf_type_count leaf types"},
  {"same_leaf_twice", "is malformed: leaf type 1 has the id 'Probe', as one before it", "give each leaf its own id"},
  {"leaf_too_small", "is malformed: leaf type 0 has struct_size 40, expected at least 112", "set it to sizeof(lockstep_leaf_type)"},
  {"no_id", "is malformed: leaf type 0 has no id", "set lockstep_leaf_type::id"},
  {"bad_id", "is malformed: leaf type 0 has the id 'Pro be'", "an id is a letter, then letters, digits, '_' and '-'"},
  {"built_in_id", "is malformed: leaf type 0 has the id 'Sequence', which is a tag of the tree language", "give the leaf another id"},
  {"reserved_id", "is malformed: leaf type 0 has the id 'BehaviorTree', which is a tag of the tree language", "give the leaf another id"},
  {"bad_kind", "is malformed: leaf type 0 ('Probe') has kind 5", "use LOCKSTEP_ACTION, LOCKSTEP_CONDITION, LOCKSTEP_CONTROL or LOCKSTEP_DECORATOR, 1 to 4"},
  {"bad_children", "is malformed: leaf type 0 ('Probe') has at least 3 and at most 2 children", "set lockstep_leaf_type::max_children to 0 for any number"},
  {"no_create", "is malformed: leaf type 0 ('Probe') has no create function", "create, destroy and tick must not be NULL"},
  {"no_destroy", "is malformed: leaf type 0 ('Probe') has no destroy function", "create, destroy and tick must not be NULL"},
  {"no_tick", "is malformed: leaf type 0 ('Probe') has no tick function", "create, destroy and tick must not be NULL"},
  {"behavior_unknown", "is malformed: leaf type 0 ('Probe'): its behavior has the unknown word 'tick'", "did you mean 'ticks'?"},
  {"behavior_no_range", "is malformed: leaf type 0 ('Probe'): its behavior has a wrong 'ticks': '4..2' is not a range", "write 1..5, 3 or 2..inf"},
  {"behavior_twice", "is malformed: leaf type 0 ('Probe'): its behavior has 'ticks' twice", "write it once"},
  {"behavior_null", "is malformed: leaf type 0 ('Probe'): its behavior has a statement without a word or a value", "set both"},
  {"behavior_no_output", "is malformed: leaf type 0 ('Probe'): its behavior has no output 'ticks'", ""},
  {"behavior_no_value", "is malformed: leaf type 0 ('Probe'): its behavior has 'many', which is not a value of 'ticks'", "expected a whole number"},
  {"behavior_no_progress", "is malformed: leaf type 0 ('Probe'): its behavior is about progress, but the leaf has no progress function", "leave out 'progress', 'step', 'finish' and 'held'"},
  {"behavior_of_control", "is malformed: leaf type 0 ('Probe'): its behavior is that of a node with children", "only actions and conditions have one"},
  {"behavior_at_once", "is malformed: leaf type 0 ('Probe'): its behavior has more than one tick, but the leaf never runs", "leave 'ticks' out"},
  {"behavior_without_list", "is malformed: leaf type 0 ('Probe'): its behavior has 1 statements but no list of them", "check lockstep_leaf_type::behavior_count"},
  {"behavior_too_long", "is malformed: leaf type 0 ('Probe'): its behavior claims to have 4097 statements, expected at most 4096", "check lockstep_leaf_type::behavior_count"},
  {"too_many_ports", "is malformed: leaf type 0 ('Probe') claims to have 4097 ports, expected at most 4096", "check lockstep_leaf_type::port_count"},
  {"ports_without_list", "is malformed: leaf type 0 ('Probe') has 1 ports but no list of them", "set lockstep_leaf_type::ports"},
  {"null_port", "is malformed: leaf type 0 ('Probe'): port 0 is NULL", "list port_count ports"},
  {"port_too_small", "is malformed: leaf type 0 ('Probe'): port 0 has struct_size 8, expected at least 48", "set it to sizeof(lockstep_port)"},
  {"no_port_name", "is malformed: leaf type 0 ('Probe'): port 0 has no name", "set lockstep_port::name"},
  {"bad_port_name", "is malformed: leaf type 0 ('Probe'): port 0 is named '2nd'", "a port's name is a letter, then letters, digits, '_', '-' and '.'"},
  {"reserved_port_name", "is malformed: leaf type 0 ('Probe'): port 0 is named 'ID', an attribute that every node has", "give the port another name"},
  {"same_port_twice", "is malformed: leaf type 0 ('Probe'): port 1 is named 'ticks', as a port before it", "give each port of a leaf its own name"},
  {"bad_choices", "is malformed: leaf type 0 ('Probe'): port 0 ('ticks') has the choices 'a;b;a'", "choices are different words, separated by ';' only"},
  {"more_ports_alone", "is malformed: leaf type 0 ('Probe') has more_ports without describe", "a leaf type has both or none"},
  {"fixed_output", "is malformed: leaf type 0 ('Probe'): port 0 ('ticks') is fixed, but is not an input with a constant", "a fixed port is an input that is not an object and has no default entry"},
  {"choices_of_int", "is malformed: leaf type 0 ('Probe'): port 0 ('ticks') has choices, but is not a string", "only a LOCKSTEP_STRING has choices"},
  {"bad_range", "is malformed: leaf type 0 ('Probe'): port 0 ('ticks') has min 2 and max 1", "min is at most max; use HUGE_VAL for no upper end"},
  {"range_of_text", "is malformed: leaf type 0 ('Probe'): port 0 ('ticks') has min and max, but is not a number", "only numbers and lists of them have min and max"},
  {"default_not_in_range", "is malformed: leaf type 0 ('Probe'): port 0 ('ticks') has the default '2': 2 is outside the range of 'ticks'", "it must be from 3 to 4"},
  {"default_no_choice", "is malformed: leaf type 0 ('Probe'): port 0 ('ticks') has the default '2': '2' is not a value of 'ticks'", "it must be one of 'one', 'three'"},
  {"number_out", "is malformed: leaf type 0 ('Probe'): port 0 ('ticks') is an output of type number", "an output is an int or a double, so that others know what they read"},
  {"object_without_type", "is malformed: leaf type 0 ('Probe'): port 0 ('ticks') carries objects of no type", "set lockstep_port::object"},
  {"object_without_release", "is malformed: leaf type 0 ('Probe'): port 0 ('ticks') has a type of objects, 'nav.Path', without retain and release", "set both"},
  {"object_with_half_bytes", "is malformed: leaf type 0 ('Probe'): port 0 ('ticks') has a type of objects, 'nav.Path', with to_bytes without from_bytes", "set both or none"},
  {"bad_port_type", "is malformed: leaf type 0 ('Probe'): port 0 ('ticks') has type 10", "use LOCKSTEP_NUMBER, LOCKSTEP_ANY or one of the types 1 to 9"},
  {"bad_port_direction", "is malformed: leaf type 0 ('Probe'): port 0 ('ticks') has direction 0", "use LOCKSTEP_INPUT, LOCKSTEP_OUTPUT or LOCKSTEP_INOUT, 1 to 3"},
  {"bad_default", "is malformed: leaf type 0 ('Probe'): port 0 ('ticks') has the default 'two', expected a whole number", "a default is a constant, written as in a tree"},
  {"key_as_default", "is malformed: leaf type 0 ('Probe'): port 0 ('ticks') has the default '{key}', expected text", "a default is a constant, written as in a tree"},
  {"default_no_entry", "is malformed: leaf type 0 ('Probe'): port 0 ('ticks') has the default '2', expected an entry", "write {key}, or {=} for the entry of the port's name"},
  {"output_with_default", "is malformed: leaf type 0 ('Probe'): port 0 ('ticks') is an output with a default", "only an input or inout port has a default"},
};
// clang-format on

std::string said(const std::string& path, const std::string& message, const std::string& hint) {
  return "plugin '" + path + "' " + message + " | " + hint;
}

// Bytes of a good plugin, to be damaged.
std::string good_bytes() {
  std::ifstream file(plugin_path("good"), std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// A file of its own for one test, gone afterwards.
struct TemporaryFile {
  std::string path;
  TemporaryFile(const std::string& name, const std::string& bytes)
      : path((fs::path(LOCKSTEP_ABI_PLUGINS) / ("damaged_" + name)).string()) {
    std::ofstream(path, std::ios::binary) << bytes;
  }
  ~TemporaryFile() { fs::remove(path); }
};

TEST_CASE("a plugin that breaks the contract is refused with one error") {
  for (const Case& it : kCases) {
    const std::string path = plugin_path(it.plugin);
    CHECK(refusal(path) == Strings{said(path, it.message, it.hint)});
    CHECK(refusal(path, Isolation::Isolated) == Strings{said(path, it.message, it.hint)});
  }
}

TEST_CASE("what is not a shared object for this machine is refused before the linker sees it") {
  const std::string build = "build it as a MODULE or SHARED library (`lockstep docs plugins`)";
  const std::string directory = LOCKSTEP_ABI_PLUGINS;

  for (const Isolation isolation : {Isolation::InProcess, Isolation::Isolated}) {
    CHECK(refusal("/nowhere/x.so", isolation) ==
          Strings{said("/nowhere/x.so", "does not exist",
                       "check the path; a tree names plugins without path and without '.so'")});
  }
  CHECK(refusal(directory) ==
        Strings{said(directory, "is not a shared object: it is a directory", build)});

  const TemporaryFile text("text.so", "#!/bin/sh\necho no plugin, but long enough to be one\n");
  const TemporaryFile empty("empty.so", "");
  for (const TemporaryFile* file : {&text, &empty}) {
    CHECK(refusal(file->path) ==
          Strings{said(file->path, "is not a shared object: it does not begin like an ELF file",
                       build)});
  }
}

TEST_CASE("a damaged or foreign shared object is named for what it is") {
  std::string bytes = good_bytes();
  REQUIRE(bytes.size() > 4096);
  const auto patched = [&](std::size_t offset, Elf64_Half value) {
    std::string copy = bytes;
    copy.replace(offset, sizeof value, reinterpret_cast<const char*>(&value), sizeof value);
    return copy;
  };

  const TemporaryFile cut("cut.so", bytes.substr(0, 2000));
  CHECK(refusal(cut.path) == Strings{said(cut.path, "is cut off: parts of the file are missing",
                                          "copy or build it again")});

  const TemporaryFile object("object.so", patched(offsetof(Elf64_Ehdr, e_type), ET_REL));
  CHECK(refusal(object.path).front().find("is not a shared object: it is an object file") !=
        std::string::npos);

  const TemporaryFile program("program.so", patched(offsetof(Elf64_Ehdr, e_type), ET_EXEC));
  CHECK(refusal(program.path).front().find("is not a shared object: it is a program") !=
        std::string::npos);

#if defined(__x86_64__)
  const TemporaryFile arm("arm.so", patched(offsetof(Elf64_Ehdr, e_machine), EM_AARCH64));
  CHECK(refusal(arm.path) ==
        Strings{said(arm.path, "is for another kind of machine than this program",
                     "'file' shows which; build it on, or cross-compile it for, the machine that "
                     "runs the tree")});
#endif
}

TEST_CASE("a leaf id belongs to one plugin, and both are named") {
  PluginSet plugins;
  Diagnostics diagnostics;
  REQUIRE(plugins.load_file(plugin_path("good"), diagnostics));
  CHECK_FALSE(plugins.load_file(plugin_path("another_good"), diagnostics));
  CHECK(texts(diagnostics) ==
        Strings{said(plugin_path("another_good"),
                     "has the leaf 'Probe', which plugin '" + plugin_path("good") + "' has already",
                     "load one of the two, or rename the leaf")});
  CHECK(plugins.types().size() == 1);
}

TEST_CASE("two plugins of one name cannot live in one program") {
  PluginSet plugins;
  Diagnostics diagnostics;
  REQUIRE(plugins.load_file(plugin_path("good"), diagnostics));
  CHECK_FALSE(plugins.load_file(plugin_path("same_name"), diagnostics));
  CHECK(texts(diagnostics) == Strings{said(plugin_path("same_name"),
                                           "is named 'good', as is '" + plugin_path("good") + "'",
                                           "load one of the two")});
}

TEST_CASE("a plugin whose init fails is named") {
  const Case kInit[] = {
      {"init_refuses", "refuses to work: its init returned false", ""},
      {"init_explains", "refuses to work: no license", ""},
      {"throws_in_init",
       "refuses to work: its init threw an exception that is not a std::exception", ""}};
  for (const Isolation isolation : {Isolation::InProcess, Isolation::Isolated}) {
    for (const Case& it : kInit) {
      PluginSet plugins;
      set_isolation(plugins, isolation);
      Diagnostics diagnostics;
      REQUIRE(plugins.load_file(plugin_path(it.plugin), diagnostics));
      CHECK_FALSE(plugins.initialize(diagnostics));
      REQUIRE(diagnostics.all().size() == 1);
      CHECK(diagnostics.all()[0].message ==
            "plugin '" + plugin_path(it.plugin) + "' " + it.message);
    }
  }
}

TEST_CASE("a refusal is reported where the tree asked for the plugin") {
  PluginSet plugins;
  Diagnostics diagnostics;
  CHECK_FALSE(plugins.load_file(plugin_path("no_tick"), diagnostics, {"tree.xml", 3, 5}));
  REQUIRE(diagnostics.all().size() == 1);
  CHECK(diagnostics.all()[0].location.file == "tree.xml");
  CHECK(diagnostics.all()[0].location.line == 3);
  CHECK(diagnostics.all()[0].location.column == 5);
}

}  // namespace
}  // namespace lockstep::host::test
