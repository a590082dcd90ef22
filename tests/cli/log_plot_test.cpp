#include <poll.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdio>
#include <filesystem>
#include <map>

#include "support/json.h"
#include "support/program.h"

using namespace lockstep::host::test;

namespace {

// The traces of the two synchronized nodes that are worked out by hand.
const std::string kA1 =
    "<ParallelAbsolute name=\"pull\" barriers=\"0.5;1\">"
    "<Advance name=\"arm\" step=\"0.1\"/><Advance name=\"base\" step=\"0.3\"/></ParallelAbsolute>";
const std::string kR1 =
    "<ParallelRelative name=\"point\" delta=\"0.2\">"
    "<Advance name=\"arm\" step=\"0.1\"/><Advance name=\"head\" step=\"0.3\"/></ParallelRelative>";

std::string recorded_log(const TemporaryDirectory& directory, const std::string& node) {
  const std::string tree = directory.file("tree.xml", tree_text(node));
  const std::string file = directory.path("run.jsonl");
  const Outcome outcome =
      run_lockstep({"run", tree, "--clock", "virtual", "--view", "none", "--record", file});
  REQUIRE(outcome.code == 0);
  return file;
}

Outcome plot_log(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "log");
  return run_lockstep(std::move(arguments));
}

double measure(const std::string& recording, const std::string& name) {
  const Outcome outcome = plot_log({"measure", recording, "--measure", name, "--json"});
  REQUIRE(outcome.code == 0);
  const auto values = parse_json(outcome.out);
  REQUIRE(values.size() == 1);
  CHECK(values[0]["measure"] == name);
  return values[0]["value"];
}

bool is_svg(const std::string& file) {
  return run({.arguments = {"--noout", "--nonet", file}, .program = "/usr/bin/xmllint"}).code == 0;
}

}  // namespace

TEST_CASE("log measure gives the numbers of the worked traces") {
  const TemporaryDirectory directory;
  SECTION("absolute: two barriers") {
    const std::string recording = recorded_log(directory, kA1);
    CHECK(measure(recording, "progress-distance") == Approx(2.1));
    // base: 0 .3 .6 .6 .6 .6 .9 1, so its step from .6 to .9
    CHECK(measure(recording, "step-length") == Approx(0.3));
    CHECK(measure(recording, "duration") == Approx(0.1));
    CHECK(measure(recording, "predictability:base@0.6") == 2);
    CHECK(measure(recording, "predictability:Main/pull/base@0.6=6") == -4);
    // reached in the last tick, the tenth: no tick has seen it
    CHECK(measure(recording, "predictability:arm@1") == 10);
  }
  SECTION("relative: delta 0.2") {
    const std::string recording = recorded_log(directory, kR1);
    CHECK(measure(recording, "progress-distance") == Approx(2.3));
    CHECK(measure(recording, "duration") == Approx(0.1));
  }
}

TEST_CASE("log measure prints a table, of what a study measures") {
  const TemporaryDirectory directory;
  const Outcome outcome = plot_log({"measure", recorded_log(directory, kA1)});
  CHECK(outcome.code == 0);
  CHECK(outcome.err.empty());
  CHECK(outcome.out ==
        "node       measure            value\n"
        "Main/pull  progress-distance  2.1\n"
        "Main/pull  step-length        0.3\n"
        "Main       duration           0.1\n");
}

TEST_CASE("log measure: what was not reached has no value, a far target has a gap") {
  const TemporaryDirectory directory;
  const std::string recording = recorded_log(
      directory, "<Fallback><Sequence><Advance name=\"leap\" step=\"1\"/><AlwaysFailure/>" + kA1 +
                     "</Sequence><AlwaysSuccess/></Fallback>");
  const std::vector<std::string> measures{"measure",   recording,
                                          "--measure", "progress-distance",
                                          "--measure", "step-length",
                                          "--measure", "predictability:base@0.6",
                                          "--measure", "predictability:leap@0.7"};
  const Outcome table = plot_log(measures);
  CHECK(table.code == 0);
  CHECK(table.out ==
        "node                              measure                  value  gap\n"
        "Main/Fallback/Sequence/pull       progress-distance        -\n"
        "Main/Fallback/Sequence/pull       step-length              -\n"
        "Main/Fallback/Sequence/pull/base  predictability:base@0.6  -      -\n"
        "Main/Fallback/Sequence/leap       predictability:leap@0.7  1      0.3\n");
  auto with_json = measures;
  with_json.emplace_back("--json");
  const auto values = parse_json(plot_log(with_json).out);
  CHECK(values.at(0)["value"].is_null());
  CHECK_FALSE(values.at(0).contains("gap"));
  CHECK(values.at(2)["value"].is_null());
  CHECK(values.at(2)["gap"].is_null());
  CHECK(values.at(3)["gap"] == Approx(0.3));
}

TEST_CASE("log measure tells which name it does not know") {
  const TemporaryDirectory directory;
  const std::string recording = recorded_log(directory, kA1);
  const std::pair<std::string, std::string> wrong[] = {
      {"speed", "unknown measure 'speed', did you mean 'spread'?"},
      {"color", "unknown measure 'color', there are: progress-distance[[K1:K2]][:PATH], "},
      {"progress-distance:x", "no parallel or barrier 'x', there are: 'Main/pull'"},
      {"progress-distance[3:2]", "expected 'progress-distance[K1:K2]', with whole numbers"},
      {"held", "expected 'held:NODE'"},
      {"held:pull",
       "'Main/pull' is not a child of a synchronized node, of a SyncProgress or of a UseResources, "
       "so it is never held"},
      {"held-by:arm", "expected 'held-by:A:B', two names"},
      {"held-by:base:arn", "no child next to 'Main/pull/base' named 'arn', did you mean 'arm'?"},
      {"held-by:pull:arm", "'Main/pull' is not a child of a synchronized node"},
      {"waits", "expected 'waits:NODE'"},
      {"waits:arm", "no UseResources 'arm'"},
      {"fairness:arms", "no pool 'arms'"},
      {"pauses:arn", "no node 'arn', did you mean 'arm'?"},
      {"entry:lap", "no entry 'lap'"},
      {"duration:x", "expected nothing after 'duration'"},
      {"predictability", "expected 'predictability:NODE@P'"},
      {"predictability:@0.5", "expected 'predictability:NODE@P'"},
      {"predictability:arm@1.5", "is '1.5', expected a number from 0 to 1"},
      {"predictability:arm@0.5=soon", "is 'soon', expected a number of ticks"},
      {"predictability:arn@0.5", "no node 'arn', did you mean 'arm'?"},
      {"predictability:elbow@0.5", "no node 'elbow', there are: 'Main/pull', 'Main/pull/arm'"},
  };
  for (const auto& [name, message] : wrong) {
    const Outcome outcome = plot_log({"measure", recording, "--measure", name});
    INFO(outcome.err);
    CHECK(outcome.code == 2);
    CHECK(contains(outcome.err, message));
    CHECK(outcome.out.empty());
  }
}

TEST_CASE("log measure: the end of a path must mean one node") {
  const TemporaryDirectory directory;
  const std::string recording =
      recorded_log(directory,
                   "<Parallel><Sequence name=\"a\"><Advance name=\"arm\"/></Sequence>"
                   "<Sequence name=\"b\"><Advance name=\"arm\"/></Sequence></Parallel>");
  CHECK(measure(recording, "predictability:a/arm@0.5") == 50);
  const Outcome outcome = plot_log({"measure", recording, "--measure", "predictability:arm@0.5"});
  CHECK(outcome.code == 2);
  CHECK(contains(outcome.err, "/a/arm' as well as "));
}

TEST_CASE("log plot: a node that no tick reached is a note beside the images of others") {
  const TemporaryDirectory directory;
  const std::string recording = recorded_log(directory, "<Fallback>" + kA1 + kR1 + "</Fallback>");
  const Outcome both = plot_log({"plot", recording, "--out", directory.path("x.svg")});
  CHECK(both.code == 0);
  CHECK(contains(both.out, "x-pull.svg\n"));
  CHECK(both.err == "lockstep: note: no tick reached 'Main/Fallback/point'\n");
  const Outcome none =
      plot_log({"plot", recording, "--node", "point", "--out", directory.path("x.svg")});
  CHECK(none.code == 2);
  CHECK(contains(none.err, "error: no tick reached 'Main/Fallback/point'"));
}

TEST_CASE("log plot draws an SVG or a PNG, with data and script beside it") {
  const TemporaryDirectory directory;
  const std::string recording = recorded_log(directory, GENERATE(kA1, kR1));
  const Outcome svg = plot_log({"plot", recording, "--out", directory.path("x.svg")});
  CHECK(svg.code == 0);
  CHECK(svg.err.empty());
  CHECK(svg.out == directory.path("x.svg") + "\n");
  CHECK(is_svg(directory.path("x.svg")));
  CHECK(contains(read_file(directory.path("x.svg")), ">arm</text>"));
  CHECK(plot_log({"plot", recording, "--out", directory.path("x.png"), "--width", "360"}).code ==
        0);
  CHECK(read_file(directory.path("x.png")).starts_with("\x89PNG\r\n\x1a\n"));
  CHECK(contains(read_file(directory.path("x.gp")), "size 720,"));
  // The last line leads to what the last tick reached: a period after it.
  CHECK(contains(read_file(directory.path("x.dat")), "\n0.1 1 1 1 1\n"));
}

TEST_CASE("log plot draws a file for each synchronized node, or for the one that is named") {
  const TemporaryDirectory directory;
  const std::string recording =
      recorded_log(directory, "<Sequence memory=\"true\">" + kA1 + kR1 + "</Sequence>");
  const Outcome both = plot_log({"plot", recording, "--out", directory.path("x.svg")});
  CHECK(both.code == 0);
  CHECK(both.out == directory.path("x-pull.svg") + "\n" + directory.path("x-point.svg") + "\n");
  const Outcome one =
      plot_log({"plot", recording, "--out", directory.path("y.svg"), "--node", "point"});
  CHECK(one.code == 0);
  CHECK(one.out == directory.path("y.svg") + "\n");
  const Outcome none =
      plot_log({"plot", recording, "--out", directory.path("z.svg"), "--node", "arm"});
  CHECK(none.code == 2);
  CHECK(contains(none.err, "no node 'arm', there are: 'Main/Sequence/pull', '"));
}

TEST_CASE("log plot says what it cannot draw") {
  const TemporaryDirectory directory;
  const std::string plain = recorded_log(directory, "<Parallel><Advance name=\"arm\"/></Parallel>");
  const Outcome none = plot_log({"plot", plain, "--out", directory.path("x.svg")});
  CHECK(none.code == 2);
  CHECK(contains(none.err, "the recording has no synchronized node"));
  CHECK(!std::filesystem::exists(directory.path("x.gp")));
  const std::string recording = recorded_log(directory, kA1);
  const Outcome format = plot_log({"plot", recording, "--out", directory.path("x.pdf")});
  CHECK(format.code == 2);
  CHECK(contains(format.err, "expected a name that ends in .svg or .png"));
  const Outcome nowhere = plot_log({"plot", recording, "--out", directory.path("none/x.svg")});
  CHECK(nowhere.code == 2);
  CHECK(contains(nowhere.err, "No such file or directory"));
  CHECK(plot_log({"plot", recording}).code == 2);
  const std::string text = read_file(recording);
  const std::string named = directory.file("run.dat", text);
  CHECK(plot_log({"plot", named, "--out", directory.path("run.svg")}).code == 2);
  CHECK((read_file(named) == text));
}

TEST_CASE("log plot refuses a picture that nobody could read") {
  const TemporaryDirectory directory;
  const std::string recording = recorded_log(directory, kA1);
  const auto plot = [&](const std::string& option, const std::string& pixels) {
    return plot_log({"plot", recording, "--out", directory.path("x.svg"), option, pixels});
  };
  CHECK(plot("--width", "360").code == 0);
  CHECK(plot("--height", "240").code == 0);
  const Outcome narrow = plot("--width", "359");
  CHECK(narrow.code == 2);
  CHECK(contains(narrow.err, "'359' is not a whole number from 360 to 8000"));
  CHECK(contains(plot("--height", "239").err, "'239' is not a whole number from 240 to 8000"));
  for (const char* bad : {"8001", "-720", "7e2", "720px", ""}) {
    CAPTURE(bad);
    CHECK(plot("--width", bad).code == 2);
  }
}

// 20,000 ticks of 1,000 children are 160 MB of progress.
TEST_CASE("log plot of a large recording takes what its picture needs, not what it holds") {
  const TemporaryDirectory directory;
  std::string node = "<ParallelRelative delta=\"1\"><Advance name=\"arm\" step=\"0.0001\"/>";
  for (int i = 0; i < 999; ++i) node += "<Advance step=\"0\"/>";
  const std::string tree = directory.file("tree.xml", tree_text(node + "</ParallelRelative>"));
  const std::string recording = directory.path("run.jsonl");
  REQUIRE(run_lockstep({"run", tree, "--clock", "virtual", "--view", "none", "--max-ticks", "20000",
                        "--record", recording})
              .code == 124);
  const Outcome outcome = plot_log({"plot", recording, "--out", directory.path("x.svg")});
  CHECK(outcome.code == 0);
  CHECK(std::filesystem::file_size(directory.path("x.dat")) < 2'000'000);
  CHECK(std::filesystem::file_size(directory.path("x.svg")) < 8'000'000);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  CHECK(outcome.peak_megabytes < 100);  // gnuplot's too
#endif
  CHECK(contains(read_file(directory.path("x.gp")), "the first 36 of 1000 children"));
}

TEST_CASE("log plot without gnuplot names the package and leaves the data") {
  const TemporaryDirectory directory;
  const std::string recording = recorded_log(directory, kA1);
  const Outcome outcome =
      run({.arguments = {"log", "plot", recording, "--out", directory.path("x.svg")},
           .environment = {{"PATH", directory.path("")}}});
  CHECK(outcome.code == 2);
  CHECK(outcome.out.empty());
  CHECK(contains(outcome.err, "install the package 'gnuplot-nox'"));
  CHECK(contains(read_file(directory.path("x.dat")), "# time_s"));
}

// A gnuplot that tells its number and then draws for ever.
TEST_CASE("gnuplot does not outlive log plot") {
  const TemporaryDirectory directory;
  const std::string recording = recorded_log(directory, kA1);
  const std::string pipe = directory.path("pipe");
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  const std::string endless =
      directory.file("gnuplot", "#!/bin/sh\necho $$ > '" + pipe + "'\nexec sleep 1000\n");
  REQUIRE(chmod(endless.c_str(), 0700) == 0);
  for (const int number : {SIGTERM, SIGINT, SIGKILL}) {
    Process process({.arguments = {"log", "plot", recording, "--out", directory.path("x.svg")},
                     .environment = {{"PATH", directory.path("") + ":/usr/bin:/bin"}}});
    const auto gnuplot = static_cast<pid_t>(std::stol(read_file(pipe)));
    const int watched = static_cast<int>(syscall(SYS_pidfd_open, gnuplot, 0));
    REQUIRE(watched >= 0);
    process.signal(number);
    CHECK(process.finish().code == 128 + number);
    pollfd end{watched, POLLIN, 0};
    CHECK(poll(&end, 1, 10'000) == 1);
    close(watched);
    kill(gnuplot, SIGKILL);
    if (number == SIGKILL) continue;
    for (const auto& file : std::filesystem::directory_iterator(directory.path(""))) {
      CHECK_FALSE(contains(file.path().string(), "lockstep-plot"));
      CHECK(file.path().extension() != ".gp");
    }
  }
}

TEST_CASE("gnuplot is not looked for in relative directories of PATH") {
  const TemporaryDirectory directory;
  const std::string recording = recorded_log(directory, kA1);
  const std::string mark = directory.path("mark");
  const std::string fake = directory.file("gnuplot", "#!/bin/sh\n: > '" + mark + "'\n");
  REQUIRE(chmod(fake.c_str(), 0700) == 0);
  const Outcome outcome =
      run({.arguments = {"log", "plot", recording, "--out", directory.path("x.svg")},
           .environment = {{"PATH", ".::/nowhere"}}});
  CHECK(outcome.code == 2);
  CHECK(contains(outcome.err, "gnuplot is missing"));
  CHECK_FALSE(std::filesystem::exists(mark));
}

TEST_CASE("log measure and log plot read what a cut recording has") {
  const TemporaryDirectory directory;
  std::string text = read_file(recorded_log(directory, kA1));
  text.resize(text.size() * 3 / 4);
  const std::string cut = directory.file("cut.jsonl", text);
  for (const Outcome& outcome :
       {plot_log({"measure", cut}), plot_log({"plot", cut, "--out", directory.path("x.svg")})}) {
    CHECK(outcome.code == 0);
    CHECK(!outcome.out.empty());
    CHECK(contains(outcome.err, "the recording is cut"));
  }
}

TEST_CASE(
    "barriers from an entry: recording, plot and replay show those that counted in each tick") {
  const TemporaryDirectory directory;
  const std::string file = directory.path("run.jsonl");
  const Outcome outcome = run_lockstep(
      {"run", LOCKSTEP_SOURCE_DIR "/trees/replanning.xml", "--clock", "virtual", "--record", file});
  REQUIRE(outcome.code == 0);
  CHECK(contains(outcome.err,
                 "1.000 s  tick 100     Replanning/open/pull/base: waits for arm at "
                 "barrier 0.4\n"));
  std::vector<std::string> limits;
  for (const std::string& line : lines(read_file(file))) {
    const auto values = parse_json(line);
    if (values.contains("limits"))
      limits.push_back(values["tick"].dump() + values["limits"].dump());
  }
  CHECK(limits == std::vector<std::string>{"0[[2,0.5]]", "100[[2,0.4]]", "200[[2,0.55]]",
                                           "275[[2,0.7]]", "350[[2,0.85]]", "425[[2,null]]"});
  REQUIRE(plot_log({"plot", file, "--out", directory.path("plot.svg")}).code == 0);
  std::map<double, double> limit_at;  // the third column
  for (const std::string& line : lines(read_file(directory.path("plot.dat")))) {
    double time = 0, least = 0, limit = 0;
    if (std::sscanf(line.c_str(), "%lf %lf %lf", &time, &least, &limit) == 3) {
      limit_at.emplace(time, limit);  // later lines tell when a child was held
    }
  }
  CHECK(limit_at.at(0.99) == 0.5);
  CHECK(limit_at.at(1) == 0.4);
  CHECK(limit_at.at(1.99) == 0.4);
  CHECK(limit_at.at(2) == 0.55);
  CHECK(limit_at.at(4.5) == 1);
  CHECK(contains(read_file(directory.path("plot.gp")), "(barriers from an entry)"));
  const Outcome replay = run_lockstep({"replay", file, "--print", "--at", "150"});
  CHECK(contains(replay.out, "waits for arm at barrier 0.4"));
}
