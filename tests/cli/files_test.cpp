// Trees of several files: includes with a name, folders, and files of a project.
#include <catch2/catch.hpp>
#include <filesystem>

#include "support/json.h"
#include "support/paths.h"
#include "support/program.h"

using namespace lockstep::host::test;

namespace {

// In both languages: the same words.
struct Language {
  std::string root, wait;
};
const Language kLanguages[] = {{"lockstep=\"1\"", "<Wait seconds=\"1\"/>"},
                               {"BTCPP_format=\"4\"", "<Sleep msec=\"1000\"/>"}};

class Files {
 public:
  explicit Files(const Language& language) : language_(language) {}

  std::string add(const std::string& name, const std::string& content,
                  const std::string& attributes = "") const {
    return file(name, "<root " + language_.root + attributes + ">" + content + "</root>");
  }
  std::string tree(const std::string& id, const std::string& node) const {
    return "<BehaviorTree ID=\"" + id + "\">" + node + "</BehaviorTree>";
  }
  const std::string& wait() const { return language_.wait; }
  std::string file(const std::string& name, const std::string& content) const {
    std::filesystem::create_directories(std::filesystem::path(path(name)).parent_path());
    return directory_.file(name, content);
  }
  std::string path(const std::string& name) const { return directory_.path(name); }

 private:
  const Language& language_;
  TemporaryDirectory directory_;
};

}  // namespace

TEST_CASE("two included files with trees of one ID are an error, and with `as` they are not") {
  for (const Language& language : kLanguages) {
    const Files files(language);
    files.add("a.xml", files.tree("Main", files.wait()) + files.tree("Go", files.wait()));
    files.add("b.xml", files.tree("Main", files.wait()));
    const std::string main = " main_tree_to_execute=\"Team\"";
    const std::string team = files.add("team.xml",
                                       "<include path=\"a.xml\"/><include path=\"b.xml\"/>" +
                                           files.tree("Team", "<SubTree ID=\"Main\"/>"),
                                       main);
    const Outcome outcome = run_lockstep({"check", team});
    CHECK(outcome.code == 3);
    CHECK(contains(outcome.err, "a tree 'Main' exists already"));
    CHECK(contains(outcome.err, "as=\"NAME\""));
    const std::string both = files.add(
        "both.xml",
        "<include path=\"a.xml\" as=\"a\"/><include path=\"b.xml\" as=\"b\"/>" +
            files.tree("Team",
                       "<Parallel><SubTree ID=\"a.Main\" name=\"x\"/><SubTree ID=\"a.Go\"/>"
                       "<SubTree ID=\"b\"/></Parallel>"),
        main);
    const Outcome named = run_lockstep({"run", both, "--view", "none", "--clock", "virtual"});
    INFO(named.err);
    CHECK(named.code == 0);
  }
}

TEST_CASE("in a file that is included with `as`, names are those of the file") {
  for (const Language& language : kLanguages) {
    const Files files(language);
    files.add("arm.xml", files.tree("Main", files.wait()));
    files.add(
        "truck.xml",
        "<include path=\"arm.xml\" as=\"arm\"/>" +
            files.tree("Main", "<Parallel><SubTree ID=\"Go\"/><SubTree ID=\"arm\"/></Parallel>") +
            files.tree("Go", files.wait()),
        " main_tree_to_execute=\"Main\"");
    const std::string site = files.add(
        "site.xml",
        "<include path=\"truck.xml\" as=\"one\"/><include path=\"truck.xml\" as=\"two\"/>" +
            files.tree("Main",
                       "<Parallel><SubTree ID=\"one\"/><SubTree ID=\"two\"/>"
                       "<SubTree ID=\"two.arm.Main\"/></Parallel>"),
        " main_tree_to_execute=\"Main\"");
    const Outcome shown = run_lockstep({"show", site});
    INFO(shown.err);
    CHECK(shown.code == 0);
    CHECK(contains(shown.out, "Go"));
    CHECK(run_lockstep({"run", site, "--view", "none", "--clock", "virtual"}).code == 0);
    CHECK(
        run_lockstep({"run", site, "--view", "none", "--clock", "virtual", "--tree", "one"}).code ==
        0);
    const std::string other = files.add(
        "other.xml",
        "<include path=\"truck.xml\" as=\"one\"/>" + files.tree("Main", "<SubTree ID=\"Go\"/>"),
        " main_tree_to_execute=\"Main\"");
    const Outcome outside = run_lockstep({"check", "--strict", other});
    CHECK(outside.code == 3);
    CHECK(contains(outside.err, "unknown tree 'Go'"));
  }
}

TEST_CASE("a file that is included with `as` has its own barriers and pools") {
  for (const Language& language : kLanguages) {
    const Files files(language);
    const std::string member = "<SyncProgress barrier=\"meet\">" + files.wait() + "</SyncProgress>";
    files.add(
        "crew.xml",
        "<barrier name=\"meet\" barriers=\"0.5\"/><resources name=\"yard\" resources=\"dock\"/>" +
            files.tree("Crew", "<Parallel>" + member + member + "</Parallel>") +
            files.tree("One", "<UseResources pool=\"yard\" resources=\"dock\">" + member +
                                  "</UseResources>"));
    const std::string main = " main_tree_to_execute=\"Main\"";
    const std::string own = files.add(
        "own.xml",
        "<include path=\"crew.xml\" as=\"a\"/><include path=\"crew.xml\" as=\"b\"/>" +
            files.tree("Main",
                       "<Parallel><SubTree ID=\"a.Crew\"/><SubTree ID=\"b.Crew\"/></Parallel>"),
        main);
    const Outcome apart = run_lockstep({"run", own, "--json", "--clock", "virtual"});
    INFO(apart.err);
    CHECK(apart.code == 0);
    CHECK(contains(apart.out, "a.meet"));
    CHECK(contains(apart.out, "b.meet"));
    // A SubTree says which one is meant; `yard` is the project's own.
    const std::string shared = files.add(
        "shared.xml",
        "<include path=\"crew.xml\" as=\"a\"/><include path=\"crew.xml\" as=\"b\"/>"
        "<barrier name=\"gate\" barriers=\"0.5\"/><resources name=\"place\" resources=\"dock\"/>" +
            files.tree("Main",
                       "<Parallel><SubTree ID=\"a.One\" meet=\"gate\" yard=\"place\"/>"
                       "<SubTree ID=\"b.One\" meet=\"gate\" yard=\"place\"/></Parallel>"),
        main);
    const Outcome together = run_lockstep({"check", shared});
    INFO(together.err);
    CHECK(together.code == 0);
    CHECK(together.err.empty());
  }
}

TEST_CASE("scripts name the barriers and pools of a file as the file does") {
  for (const Language& language : kLanguages) {
    const Files files(language);
    files.add("crew.xml",
              "<barrier name=\"meet\" barriers=\"0.5\"/><resources name=\"yard\" "
              "resources=\"dock\"/><resources name=\"port\" resources=\"dock\"/>" +
                  files.tree("Crew",
                             "<Parallel><SyncProgress barrier=\"meet\">" + files.wait() +
                                 "</SyncProgress><SyncProgress barrier=\"meet\">" + files.wait() +
                                 "</SyncProgress><UseResources pool=\"yard\" resources=\"dock\">" +
                                 files.wait() +
                                 "</UseResources><WaitUntil code=\"owner(dock) == none &amp;&amp; "
                                 "owner(yard/dock) == none &amp;&amp; progress(meet) &gt;= 0\" "
                                 "timeout=\"1\"/></Parallel>"));
    const std::string main = " main_tree_to_execute=\"Main\"";
    const std::string own = files.add(
        "own.xml",
        "<include path=\"crew.xml\" as=\"a\"/><include path=\"crew.xml\" as=\"b\"/>" +
            files.tree("Main",
                       "<Parallel><SubTree ID=\"a.Crew\"/><SubTree ID=\"b.Crew\"/></Parallel>"),
        main);
    const std::string given = files.add(
        "given.xml",
        "<include path=\"crew.xml\" as=\"a\"/><resources name=\"place\" resources=\"dock\"/>" +
            files.tree("Main", "<SubTree ID=\"a.Crew\" yard=\"place\"/>"),
        main);
    for (const std::string& file : {files.path("crew.xml"), own, given}) {
      const Outcome run = run_lockstep({"run", file, "--view", "none", "--clock", "virtual"});
      INFO(file << run.err);
      CHECK(run.code == 0);
    }
  }
}

TEST_CASE("a file without its own barrier means the project's, also with `as`") {
  for (const Language& language : kLanguages) {
    const Files files(language);
    const std::string member = "<SyncProgress barrier=\"meet\">" + files.wait() + "</SyncProgress>";
    files.add("crew.xml", files.tree("One", member));
    const std::string site = files.add(
        "site.xml",
        "<include path=\"crew.xml\" as=\"a\"/><include path=\"crew.xml\" as=\"b\"/>"
        "<barrier name=\"meet\" barriers=\"0.5\"/>" +
            files.tree("Main", "<Parallel><SubTree ID=\"a.One\"/><SubTree ID=\"b\"/></Parallel>"),
        " main_tree_to_execute=\"Main\"");
    const Outcome outcome = run_lockstep({"check", "--strict", site});
    INFO(outcome.err);
    CHECK(outcome.code == 0);
  }
}

TEST_CASE("what is wrong with the name of an include is said") {
  const Files files(kLanguages[0]);
  files.add("a.xml", "<arg name=\"n\" default=\"1\"/>" + files.tree("A", files.wait()));
  files.add("b.xml", files.tree("B", files.wait()));
  const auto error_of = [&](const std::string& includes, const std::string& trees = "") {
    const std::string file =
        files.add("main.xml", includes + files.tree("Main", "<SubTree ID=\"x.A\"/>") + trees,
                  " main_tree_to_execute=\"Main\"");
    return run_lockstep({"check", file}).err;
  };
  CHECK(error_of("<include path=\"a.xml\" as=\"x\"/><include path=\"a.xml\" as=\"y\"/>").empty());
  CHECK(contains(error_of("<include path=\"a.xml\" as=\"x.y\"/>"), "'x.y' is not a name"));
  CHECK(contains(error_of("<include path=\"a.xml\" as=\"\"/>"), "'' is not a name"));
  CHECK(contains(error_of("<include path=\"a.xml\" as=\"x\"/><include path=\"b.xml\" as=\"x\"/>"),
                 "another file has the name 'x'"));
  CHECK(contains(error_of("<include path=\"a.xml\" as=\"x\"/>", files.tree("x", files.wait())),
                 "a tree 'x' exists already"));
  // A cycle stays one by another name.
  files.add("b.xml", "<include path=\"c.xml\" as=\"c\"/>" + files.tree("B", files.wait()));
  files.add("c.xml", "<include path=\"b.xml\" as=\"b\"/>" + files.tree("C", files.wait()));
  CHECK(contains(error_of("<include path=\"a.xml\" as=\"x\"/><include path=\"b.xml\" as=\"b\"/>"),
                 "include cycle"));
}

TEST_CASE("names of includes cannot make files without end") {
  const Files files(kLanguages[0]);
  for (int i = 0; i < 30; ++i) {
    const std::string next = std::to_string(i + 1) + ".xml";
    files.add(std::to_string(i) + ".xml", "<include path=\"" + next +
                                              "\" as=\"a\"/><include path=\"" + next +
                                              "\" as=\"b\"/>" + files.tree("T", files.wait()));
  }
  files.add("30.xml", files.tree("T", files.wait()));
  const Outcome outcome = run_lockstep({"check", files.path("0.xml")});
  CHECK(outcome.code == 3);
  CHECK(contains(outcome.err, "more than 10000 files"));
}

TEST_CASE("check of a folder finds the trees of SubTrees in its other files") {
  for (const Language& language : kLanguages) {
    const Files files(language);
    files.add("main.xml", files.tree("Main", "<SubTree ID=\"Go\"/>"));
    files.add("deep/go.xml", files.tree("Go", "<SubTree ID=\"Stop\"/>"));
    files.add("deep/er/stop.xml",
              files.tree("Stop", files.wait()) + files.tree("Other", "<SubTree ID=\"Gone\"/>"));
    files.add(".git/main.xml", files.tree("Main", "<Nothing/>"));
    const Outcome wrong = run_lockstep({"check", "--strict", files.path("")});
    INFO(wrong.err);
    CHECK(wrong.code == 3);
    const std::string message = "unknown tree 'Gone'";
    REQUIRE(contains(wrong.err, message));
    CHECK(wrong.err.find(message) == wrong.err.rfind(message));  // of three files that have it
    files.add("gone.xml", files.tree("Gone", files.wait()));
    const Outcome folder = run_lockstep({"check", "--strict", files.path("")});
    INFO(folder.err);
    CHECK(folder.code == 0);
    CHECK(contains(folder.out, "main.xml: ok\n"));
    CHECK(contains(folder.out, "stop.xml: ok\n"));
    CHECK(!contains(folder.err, "in another file"));
    files.add("again.xml", files.tree("Stop", files.wait()));
    const Outcome twice = run_lockstep({"check", files.path("")});
    CHECK(twice.code == 3);
    CHECK(contains(twice.err, "2 files of the project have the tree 'Stop'"));
  }
  const TemporaryDirectory empty;
  const Outcome nothing = run_lockstep({"check", empty.path("")});
  CHECK(nothing.code == 3);
  CHECK(contains(nothing.err, "the folder has no tree files"));
}

TEST_CASE(
    "check of a folder reports a file that is cut in its first tag, and names what is not XML") {
  for (const Language& language : kLanguages) {
    const Files files(language);
    files.add("ok.xml", files.tree("Main", files.wait()));
    static_cast<void>(files.file("empty.xml", ""));
    static_cast<void>(files.file("package.xml", "<package><name>p</name></package>"));
    const Outcome empty = run_lockstep({"check", files.path("")});
    INFO(empty.err);
    CHECK(empty.code == 0);
    CHECK(contains(empty.err, "empty.xml: note: is not XML, so it is not checked"));
    CHECK(!contains(empty.err, "package.xml"));
    static_cast<void>(files.file("cut.xml", "<root " + language.root));
    const Outcome cut = run_lockstep({"check", files.path("")});
    INFO(cut.err);
    CHECK(cut.code == 3);
    CHECK(contains(cut.err, "cut.xml:"));
  }
}

TEST_CASE("check of a folder reports an unknown tree of a file that is included by names once") {
  for (const Language& language : kLanguages) {
    const Files files(language);
    files.add("common.xml", files.tree("Common", "<SubTree ID=\"Gone\"/>"));
    for (const char* name : {"a", "b"}) {
      files.add(name + std::string(".xml"), "<include path=\"common.xml\" as=\"c" +
                                                std::string(name) + "\"/>" +
                                                files.tree("T" + std::string(name), files.wait()));
    }
    const Outcome it = run_lockstep({"check", "--strict", files.path("")});
    INFO(it.err);
    CHECK(it.code == 3);
    const std::string message = "unknown tree '";
    CHECK(contains(it.err, message + "Gone'"));
    CHECK(it.err.find(message) == it.err.rfind(message));
  }
}

TEST_CASE("check --together checks files as one project") {
  for (const Language& language : kLanguages) {
    const Files files(language);
    const std::string main =
        files.add("main.xml", "<barrier name=\"b\" barriers=\"0.5\"/>" +
                                  files.tree("Main",
                                             "<Parallel><SubTree ID=\"Go\"/><SubTree ID=\"Go\"/>"
                                             "</Parallel>"));
    const std::string go = files.add(
        "go.xml",
        files.tree("Go", "<SyncProgress barrier=\"c\">" + files.wait() + "</SyncProgress>"));
    // What is wrong in the other file is seen, which a stand-in would hide.
    const Outcome wrong = run_lockstep({"check", main, go, "--together"});
    CHECK(wrong.code == 3);
    CHECK(contains(wrong.err, "unknown barrier 'c'"));
    files.add("go.xml",
              files.tree("Go", "<SyncProgress barrier=\"b\">" + files.wait() + "</SyncProgress>"));
    const Outcome right = run_lockstep({"check", "--strict", main, go, "--together"});
    INFO(right.err);
    CHECK(right.code == 0);
  }
}

TEST_CASE("a project file names the folders of trees") {
  for (const Language& language : kLanguages) {
    const Files files(language);
    const std::string main =
        files.add("trees/main.xml", files.tree("Main", "<SubTree ID=\"Go\"/>"));
    files.add("shared/go.xml", files.tree("Go", files.wait()));
    CHECK(run_lockstep({"run", main, "--view", "none", "--clock", "virtual"}).code == 3);
    const auto project = [&](const std::string& content) {
      return files.file("lockstep.project.xml",
                        "<project lockstep=\"1\">" + content + "</project>");
    };
    project("<trees folder=\"shared\"/><trees folder=\"trees\"/><plugins folder=\"build\"/>");
    const Outcome run = run_lockstep({"run", main, "--view", "none", "--clock", "virtual"});
    INFO(run.err);
    CHECK(run.code == 0);
    CHECK(run_lockstep({"check", "--strict", main}).code == 0);
    CHECK(run_lockstep({"check", "--strict", files.path("trees")}).code == 0);
    const auto message_of = [&](const std::string& content) {
      project(content);
      const Outcome outcome = run_lockstep({"check", main});
      CHECK(outcome.code == 3);
      return outcome.err;
    };
    CHECK(contains(message_of("<tree folder=\"shared\"/>"), "did you mean 'trees'?"));
    CHECK(contains(message_of("<trees folder=\"gone\"/>"), "there is no folder"));
    CHECK(contains(message_of("<trees folder=\"../x\"/>"), "is not below the project file"));
    CHECK(contains(message_of("<trees folder=\"/\"/>"), "is not below the project file"));
    CHECK(contains(message_of("<trees/>"), "needs the attribute 'folder'"));
    const std::string twice = message_of(
        "<main file=\"trees/main.xml\"/><main file=\"shared/go.xml\"/><trees folder=\"shared\"/>");
    CHECK(contains(twice, "lockstep.project.xml:1:52: error: a second 'main' in 'project'"));
    CHECK(contains(twice, "a project has one main tree"));
    CHECK(contains(message_of("<trees folder=\"shared\""), "lockstep.project.xml:"));
    files.file("lockstep.project.xml", "<project lockstep=\"2\"/>");
    CHECK(contains(run_lockstep({"check", main}).err, "unknown version '2'"));
    files.file("lockstep.project.xml", "<project/>");
    CHECK(contains(run_lockstep({"check", main}).err, "names no version"));
  }
}

TEST_CASE("a project file names models and plugins") {
  const Files files(kLanguages[1]);
  const std::string main =
      files.add("trees/main.xml", files.tree("Main", "<Grip force=\"soft\"/>"));
  files.add("models.xml",
            "<TreeNodesModel><Action ID=\"Grip\"><input_port name=\"force\" type=\"double\"/>"
            "</Action></TreeNodesModel>");
  files.file("lockstep.project.xml",
             "<project lockstep=\"1\"><models file=\"models.xml\"/></project>");
  CHECK(contains(run_lockstep({"check", main}).err, "'soft' is not a number"));
}

TEST_CASE("a tree that no other one uses may have members of barriers and pools") {
  for (const Language& language : kLanguages) {
    const Files files(language);
    const std::string file =
        files.add("main.xml",
                  "<barrier name=\"b\" barriers=\"0.5\"/><resources name=\"p\" resources=\"r\"/>" +
                      files.tree("Main", files.wait()) +
                      files.tree("Other",
                                 "<SyncProgress barrier=\"b\"><UseResources pool=\"p\" "
                                 "resources=\"r\">" +
                                     files.wait() + "</UseResources></SyncProgress>"),
                  " main_tree_to_execute=\"Main\"");
    const Outcome outcome = run_lockstep({"check", file});
    INFO(outcome.err);
    CHECK(outcome.code == 0);
  }
}

TEST_CASE(
    "an including file for BehaviorTree.CPP replaces a tree that it includes, with a warning") {
  const Files files(kLanguages[1]);
  files.add("lib.xml", files.tree("Go", "<AlwaysFailure/>"));
  files.add("by.xml", "<include path=\"lib.xml\"/>");
  const std::string main =
      files.add("main.xml",
                "<include path=\"by.xml\"/>" + files.tree("Main", "<SubTree ID=\"Go\"/>") +
                    files.tree("Go", "<AlwaysSuccess/>"),
                " main_tree_to_execute=\"Main\"");
  const Outcome outcome = run_lockstep({"run", main, "--clock", "virtual"});
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.err, "this tree 'Go' replaces another one"));
}

TEST_CASE("without a tree file, commands take the main file of the project") {
  const TemporaryDirectory directory;
  directory.file("main.xml", tree_text("<Advance step=\"0.5\"/>"));
  directory.file("lockstep.project.xml",
                 "<project lockstep=\"1\"><main file=\"main.xml\"/></project>");
  const Outcome run =
      shell("mkdir below; cd below; lockstep run --clock virtual --view none", directory);
  INFO(run.err);
  CHECK(run.code == 0);
  CHECK(contains(run.out, "success after 2 ticks"));
  CHECK(contains(shell("lockstep show", directory).out, "Advance"));
  CHECK(shell("lockstep verify", directory).code == 0);
  directory.file("lockstep.project.xml",
                 "<project lockstep=\"1\"><main file=\"gone.xml\"/></project>");
  const Outcome gone = shell("lockstep run", directory);
  CHECK(gone.code == 2);
  CHECK(contains(gone.err, "there is no file 'gone.xml'"));
  directory.file("lockstep.project.xml", "<project lockstep=\"1\"/>");
  CHECK(contains(shell("lockstep run", directory).err, "tree is required"));
}
