// Who may decide what code is loaded: writable directories, and a program with more rights than its
// user. What the rules are for is in docs/security.md.
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>

#include "support/paths.h"
#include "support/program.h"

namespace lockstep::host::test {
namespace {

namespace fs = std::filesystem;

// A directory 'd' with the plugin motion, and a tree that uses it.
struct Installed {
  TemporaryDirectory directory;
  std::string plugins = directory.path("d");
  std::string plugin = plugins + "/motion.so";
  std::string tree = directory.file("tree.xml", tree_text("<Advance/>"));

  Installed() {
    REQUIRE(chmod(directory.path("").c_str(), 0755) == 0);
    REQUIRE(mkdir(plugins.c_str(), 0755) == 0);
    fs::copy_file(LOCKSTEP_BINARY_DIR "/plugins/motion.so", plugin);
    permit(plugin, 0755);
    permit(plugins, 0755);
  }
  static void permit(const std::string& path, mode_t mode) {
    REQUIRE(chmod(path.c_str(), mode) == 0);
  }
  // A copy of lockstep that has the rights of root, whoever starts it; "" where there can be none.
  std::string setuid_program() const {
    struct statvfs system {};
    REQUIRE(statvfs(plugins.c_str(), &system) == 0);
    if (geteuid() != 0 || (system.f_flag & ST_NOSUID) != 0) {
      WARN("skipped: needs root, to make a setuid program, and a file system that allows it");
      return "";
    }
    const std::string program = directory.path("lockstep");
    fs::copy_file(LOCKSTEP_BINARY_DIR "/lockstep", program);
    permit(program, 04755);
    return program;
  }
};

constexpr const char* kWarning = "warning: everyone may write to the plugin";

}  // namespace

TEST_CASE("a plugin that everyone may replace is warned of, and loaded") {
  const Installed it;
  struct Row {
    mode_t directory, plugin;
    std::string warning;  // "" = none
  };
  const Row rows[] = {{0755, 0755, ""},
                      {0775, 0775, ""},
                      {0777, 0755, "directory '" + it.plugins + "'"},
                      {01777, 0755, "directory '" + it.plugins + "'"},
                      {0755, 0757, "'" + it.plugin + "'"}};
  const std::vector<std::string> by_name = {"check", it.tree, "--plugin-path", it.plugins};
  const std::vector<std::string> by_file = {"check", it.tree, "--plugin", it.plugin};
  for (const Row& row : rows) {
    Installed::permit(it.plugin, row.plugin);
    Installed::permit(it.plugins, row.directory);
    for (const auto& arguments : {by_name, by_file}) {
      const Outcome outcome = run_lockstep(arguments);
      INFO(outcome.err);
      CHECK(outcome.code == 0);
      CHECK(contains(outcome.err, kWarning) == !row.warning.empty());
      if (row.warning.empty()) continue;
      CHECK(contains(outcome.err, kWarning + (" " + row.warning)));
      CHECK(contains(outcome.err, "hint: chmod o-w '"));
    }
  }
}

TEST_CASE("the directories behind a plugin that is a symbolic link are looked at, each of them") {
  const Installed it;
  const auto make = [&](const std::string& name, mode_t mode) {
    const std::string path = it.directory.path(name);
    REQUIRE(mkdir(path.c_str(), 0755) == 0);
    Installed::permit(path, mode);
    return path;
  };
  const std::string first = make("first", 0755), middle = make("middle", 0777);
  const std::string last = make("last", 0777);
  fs::rename(it.plugin, last + "/real.so");
  fs::create_symlink("../last/real.so", middle + "/link.so");
  fs::create_symlink(middle + "/link.so", first + "/motion.so");
  const Outcome by_name = run_lockstep({"check", it.tree, "--plugin-path", first});
  const Outcome by_file = run_lockstep({"check", it.tree, "--plugin", first + "/motion.so"});
  for (const Outcome& outcome : {by_name, by_file}) {
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(contains(outcome.err, kWarning + (" directory '" + middle + "'")));
    CHECK(contains(outcome.err, kWarning + (" directory '" + last + "'")));
    CHECK_FALSE(contains(outcome.err, "'" + first + "'"));
  }
  Installed::permit(middle, 0755);
  Installed::permit(last, 0755);
  const Outcome quiet = run_lockstep({"check", it.tree, "--plugin-path", first});
  CHECK(quiet.code == 0);
  CHECK_FALSE(contains(quiet.err, kWarning));
}

TEST_CASE("a directory that everyone may write to is warned of when it is searched first") {
  const Installed it;
  const std::string open = it.directory.path("open");
  REQUIRE(mkdir(open.c_str(), 0755) == 0);
  Installed::permit(open, 0777);
  const Outcome outcome =
      run_lockstep({"check", it.tree, "--plugin-path", open, "--plugin-path", it.plugins});
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.err, kWarning + (" directory '" + open + "'")));
}

TEST_CASE(
    "entries of the search path in the environment: empty ones are not the working directory") {
  const Installed it;
  const auto check = [&](const std::string& path) {
    return run({.arguments = {"-c", "cd \"$0\" && \"$1\" check \"$2\"", it.plugins,
                              LOCKSTEP_BINARY_DIR "/lockstep", it.tree},
                .environment = {{"LOCKSTEP_PLUGIN_PATH", path}},
                .program = "/bin/sh"});
  };
  Installed::permit(it.plugins, 0777);
  CHECK(contains(check(":").err, kWarning) == false);
  CHECK(contains(check("").err, kWarning) == false);
  CHECK(contains(check("/nowhere::" + it.plugins).err, kWarning));
}

TEST_CASE("a program with more rights than its user takes no relative path and no environment") {
  const Installed it;
  const std::string program = it.setuid_program();
  if (program.empty()) return;
  Installed::permit(it.tree, 0644);
  const auto check = [&](std::vector<std::string> options, const std::string& path) {
    std::vector<std::string> arguments = {
        "--reuid=65534",        "--clear-groups", "/bin/sh", "-c",   "cd \"$0\" && exec \"$@\"",
        it.directory.path("d"), program,          "check",   it.tree};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run({.arguments = arguments,
                .environment = {{"LOCKSTEP_PLUGIN_PATH", path}},
                .program = "/usr/bin/setpriv"});
  };
  const Outcome absolute = check({"--plugin-path", it.plugins}, "/nowhere");
  CHECK(absolute.code == 0);
  CHECK(contains(absolute.err, "warning: LOCKSTEP_PLUGIN_PATH is not read"));

  const Outcome environment = check({}, it.plugins);
  CHECK(environment.code == 4);
  CHECK(contains(environment.err, "plugin 'motion' is not found"));
  CHECK_FALSE(contains(environment.err, it.plugins));

  const Outcome relative = check({"--plugin-path", "."}, "");
  CHECK(relative.code == 4);
  CHECK(
      contains(relative.err, "--plugin-path .: a program with more rights than its user refuses"));
  CHECK(contains(relative.err, "plugin 'motion' is not found"));  // not looked for there either

  const Outcome file = check({"--plugin", "./motion.so"}, "");
  CHECK(file.code == 4);
  CHECK(contains(file.err, "--plugin ./motion.so: a program with more rights"));

  fs::create_directory(it.plugins + "/build");
  fs::copy_file(it.plugin, it.plugins + "/build/motion.so");
  const Outcome project = check({}, "");
  CHECK(project.code == 4);
  CHECK(contains(project.err, "plugin 'motion' is not found"));
}

TEST_CASE("a program with more rights than its user takes gnuplot from where the system has it") {
  const Installed it;
  const std::string program = it.setuid_program();
  if (program.empty()) return;
  const std::string tree = it.directory.file(
      "sync.xml", tree_text("<ParallelRelative delta=\"0\"><Advance/></ParallelRelative>"));
  const std::string recording = it.directory.path("run.jsonl");
  REQUIRE(run_lockstep({"run", tree, "--clock", "virtual", "--record", recording}).code == 0);
  Installed::permit(recording, 0644);
  const std::string mark = it.directory.path("mark");
  const auto fake = it.directory.file("d/gnuplot", "#!/bin/sh\n: > '" + mark + "'\n");
  Installed::permit(fake, 0755);
  // gnuplot gives up the rights that it was started with.
  Installed::permit(fs::path(recording).parent_path(), 0777);
  const Outcome outcome =
      run({.arguments = {"--reuid=65534", "--clear-groups", program, "log", "plot", recording,
                         "--out", it.directory.path("x.svg")},
           .environment = {{"PATH", it.plugins + ":/usr/bin:/bin"}},
           .program = "/usr/bin/setpriv"});
  INFO(outcome.err);
  CHECK_FALSE(fs::exists(mark));
  CHECK(outcome.code == 0);
  CHECK(fs::exists(it.directory.path("x.svg")));
}

}  // namespace lockstep::host::test
