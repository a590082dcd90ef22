// `lockstep monitor`: the runs that have one, and the browser.
#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <filesystem>

#include "web/client.h"

using namespace lockstep::host::test;

namespace {

namespace fs = std::filesystem;

const std::string kEndlessRun = tree_text("<Advance name=\"arm\" step=\"0\"/>");

struct Place {
  Place() {
    fs::create_directory(directory.path("run"));
    // In place of the browser: it says what it was asked to open.
    const std::string browser = directory.file(
        "xdg-open", "#!/bin/sh\necho \"$1\" >\"$OPENED.new\" && mv \"$OPENED.new\" \"$OPENED\"\n");
    chmod(browser.c_str(), 0700);
    environment = {{"XDG_RUNTIME_DIR", directory.path("run")},
                   {"PATH", directory.path("") + ":/usr/bin:/bin"},
                   {"OPENED", directory.path("opened")}};
  }
  Outcome lockstep(std::vector<std::string> arguments) const {
    return run({.arguments = std::move(arguments), .environment = environment});
  }
  std::string link_of(Process& process) const {
    const std::string& said = process.so_far().err;
    while (said.find('\n') == std::string::npos) REQUIRE(process.read_on());
    return said.substr(9, said.find('\n') - 9);
  }

  TemporaryDirectory directory;
  std::map<std::string, std::string> environment;
};

}  // namespace

TEST_CASE("the runs of a user that have a monitor are listed while they live") {
  const Place place;
  const std::string tree = place.directory.file("tree.xml", kEndlessRun);
  const Outcome none = place.lockstep({"monitor"});
  CHECK(none.code == 2);
  CHECK(contains(none.err, "no run of yours has a monitor"));
  const std::vector<std::string> words{"run", tree, "--monitor", "--view", "none"};
  Process first({.arguments = words, .environment = place.environment});
  const std::string link = place.link_of(first);
  std::vector<std::string> more = words;
  more.emplace_back("--monitor-control");
  Process second({.arguments = more, .environment = place.environment});
  const std::string other = place.link_of(second);
  const Outcome both = place.lockstep({"monitor"});
  CHECK(both.code == 0);
  CHECK(lines(both.out).size() == 2);
  CHECK(contains(both.out, "  " + link + " "));
  CHECK(contains(both.out, "  " + other + "  " + tree + "\n"));
  CHECK(contains(other, "#token="));
  CHECK(place.lockstep({"monitor", "--open"}).code == 2);  // which?
  for (const auto& file : fs::directory_iterator(place.directory.path("run") + "/lockstep")) {
    struct stat status {};
    REQUIRE(stat(file.path().c_str(), &status) == 0);
    CHECK((status.st_mode & 0777) == 0600);
  }
  first.signal(SIGKILL);  // it cannot say that it ends
  first.finish();
  CHECK(lines(place.lockstep({"monitor"}).out).size() == 1);
  second.signal(SIGTERM);
  second.finish();
  CHECK(place.lockstep({"monitor"}).code == 2);
  CHECK(fs::is_empty(place.directory.path("run") + "/lockstep"));
}

TEST_CASE("the page of a run is opened in the browser") {
  const Place place;
  const std::string tree = place.directory.file("tree.xml", kEndlessRun);
  Process process({.arguments = {"run", tree, "--monitor", "--view", "none"},
                   .environment = place.environment});
  const std::string link = place.link_of(process);
  CHECK(place.lockstep({"monitor", "--open"}).code == 0);
  // The browser is another program: it gets its time, as ticks of another run.
  const auto opened = [&] {
    const std::string path = place.directory.path("opened");
    while (!fs::exists(path)) {
      place.lockstep({"run", tree, "--max-ticks", "2", "--view", "none"});
    }
    const std::string text = read_file(path);
    fs::remove(path);
    return text;
  };
  CHECK(opened() == link + "\n");
  Process own({.arguments = {"run", tree, "--monitor", "--monitor-open", "--view", "none"},
               .environment = place.environment});
  const std::string its_link = place.link_of(own);
  CHECK(opened() == its_link + "\n");
  CHECK(contains(place.lockstep({"monitor", "1"}).err, "no run 1 of yours has a monitor"));
}

TEST_CASE("a directory that others can write to is not used for links") {
  const Place place;
  const std::string tree = place.directory.file("tree.xml", kEndlessRun);
  const std::string shared = place.directory.path("run") + "/lockstep";
  fs::create_directory(shared);
  chmod(shared.c_str(), 0777);
  Process process({.arguments = {"run", tree, "--monitor", "--view", "none"},
                   .environment = place.environment});
  place.link_of(process);
  CHECK(fs::is_empty(shared));
  CHECK(place.lockstep({"monitor"}).code == 2);
}
