// `lockstep log page`: the file that it writes, and what it refuses. tests/page/ looks at it in a
// browser.
#include <sys/stat.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <thread>

#include "support/program.h"

using namespace lockstep::host::test;

namespace {

std::string record_ticks(const TemporaryDirectory& directory, const std::string& ticks) {
  const std::string tree = directory.file("tree.xml", tree_text("<Advance step=\"1e-6\"/>"));
  const std::string file = directory.path("run.jsonl");
  const Outcome outcome = run_lockstep({"run", tree, "--clock", "virtual", "--view", "none",
                                        "--max-ticks", ticks, "--record", file});
  REQUIRE(outcome.code == 124);
  return file;
}

Outcome log_page(const std::string& recording, const std::string& page) {
  return run_lockstep({"log", "page", recording, "--out", page});
}

// As a browser finds it.
std::string recording_in(const std::string& page) {
  return run({.arguments = {"-c",
                            "sed -n 's/.*\"recording\":\"\\([^\"]*\\)\"}.*/\\1/p' \"$0\" | "
                            "base64 -d | gzip -dc",
                            page},
              .program = "/bin/sh"})
      .out;
}

}  // namespace

TEST_CASE("log page writes one file that holds the page and the bytes of the recording") {
  const TemporaryDirectory directory;
  const std::string page = directory.path("run.html");
  for (const std::string ticks : {"1", "2", "3", "700"}) {
    const std::string recording = record_ticks(directory, ticks);
    const Outcome outcome = log_page(recording, page);
    CHECK(outcome.code == 0);
    CHECK(outcome.out + outcome.err == "");
    CHECK(recording_in(page) == read_file(recording));
    const std::string text = read_file(page);
    CHECK(text.rfind("<!doctype html>", 0) == 0);
    CHECK(text.find("default-src 'none'") != std::string::npos);
    CHECK(text.find("http://") == text.find("http://www.w3.org/"));  // names of XML, no address
  }
}

TEST_CASE("log page --from --to writes the header and the ticks of the range") {
  const TemporaryDirectory directory;
  const std::string recording = record_ticks(directory, "9000"), text = read_file(recording);
  const std::string page = directory.path("run.html");
  const auto page_of = [&](std::vector<std::string> range) {
    range.insert(range.begin(), {"log", "page", recording, "--out", page});
    const Outcome outcome = run_lockstep(range);
    CHECK(outcome.out + outcome.err == "");
    CHECK(outcome.code == 0);
    return lines(recording_in(page));
  };
  const auto all = lines(text);
  const auto part = [&](std::size_t from, std::size_t to) {
    std::vector<std::string> some{all[0]};
    some.insert(some.end(), all.begin() + static_cast<std::ptrdiff_t>(from) + 1,
                all.begin() + static_cast<std::ptrdiff_t>(to) + 2);
    return some;
  };
  // Tick 4096 is the first with the whole state.
  CHECK(page_of({"--from", "5000", "--to", "5010"}) == part(4096, 5010));
  CHECK(page_of({"--to", "10"}) == part(0, 10));
  CHECK(page_of({"--from", "4100"}) == part(4096, 9000));  // with the closing line
  const Outcome behind = run_lockstep({"log", "page", recording, "--out", page, "--from", "9000"});
  CHECK(behind.code == 2);
  CHECK(contains(behind.err, "--from 9000: the recording has ticks 0 to 8999"));
  const Outcome pipe = run({.arguments = {"log", "page", "-", "--out", page, "--to", "10"}});
  CHECK(pipe.code == 2);
  CHECK(contains(pipe.err, "--from and --to need a recording in a file"));
}

TEST_CASE("a page says which ticks were asked for, and of a range that a cut recording lacks") {
  const TemporaryDirectory directory;
  const std::string recording = record_ticks(directory, "20"), page = directory.path("run.html");
  const auto source_of = [&](const std::string& file, std::vector<std::string> range) {
    range.insert(range.begin(), {"log", "page", file, "--out", page});
    const Outcome outcome = run_lockstep(range);
    CHECK(outcome.code == 0);
    const std::string text = read_file(page), begin = "id=\"source\">";
    const std::size_t at = text.find(begin) + begin.size();
    return outcome.err + text.substr(at, text.find("\"recording\"") - at);
  };
  CHECK(source_of(recording, {}) == "{");
  CHECK(source_of(recording, {"--from", "5"}) == R"({"from":5,)");
  CHECK(source_of(recording, {"--to", "7"}) == R"({"to":7,)");
  CHECK(source_of(recording, {"--from", "5", "--to", "7"}) == R"({"from":5,"to":7,)");
  CHECK(source_of(recording, {"--to", "70"}) == "{");  // all, with its end
  const std::string text = read_file(recording);
  const std::string cut = directory.file("cut.jsonl", text.substr(0, text.size() - 30));
  CHECK(source_of(cut, {"--to", "7"}) == R"({"to":7,)");
  CHECK(contains(source_of(cut, {"--from", "5", "--to", "70"}), "the recording is cut"));
}

TEST_CASE("log page takes a recording from stdin, and what a cut one has") {
  const TemporaryDirectory directory;
  const std::string text = read_file(record_ticks(directory, "9"));
  const std::string cut = text.substr(0, text.size() - 30);
  const std::string page = directory.path("run.html");
  const Outcome outcome = run({.arguments = {"log", "page", "-", "--out", page}, .input = cut});
  CHECK(outcome.code == 0);
  CHECK(outcome.err.find("the recording is cut") != std::string::npos);
  CHECK(recording_in(page) == cut);
}

TEST_CASE("log page writes nothing where there is nothing to show") {
  const TemporaryDirectory directory;
  const std::string recording = record_ticks(directory, "5");
  const std::string page = directory.file("run.html", "mine");
  SECTION("a damaged recording") {
    const std::string wrong = directory.file("wrong.jsonl", read_file(recording) + "{}\n");
    const Outcome outcome = log_page(wrong, page);
    CHECK(outcome.code == 3);
    CHECK(outcome.err.find("wrong.jsonl:8: ") != std::string::npos);
    CHECK(read_file(page) == "mine");
  }
  SECTION("the recording itself as the page") {
    const std::string before = read_file(recording);
    const Outcome outcome = log_page(recording, recording);
    CHECK(outcome.code == 2);
    CHECK(read_file(recording) == before);
  }
  SECTION("no such file") {
    CHECK(log_page(directory.path("none.jsonl"), page).code == 2);
    CHECK(read_file(page) == "mine");
  }
  SECTION("no such directory") {
    const Outcome outcome = log_page(recording, directory.path("none/run.html"));
    CHECK(outcome.code == 2);
    CHECK(outcome.err.find("none/run.html") != std::string::npos);
  }
  SECTION("a disk that is full") {
    const Outcome outcome = log_page(recording, "/dev/full");
    CHECK(outcome.code == 2);
    CHECK(outcome.err.find("cannot write '/dev/full'") != std::string::npos);
  }
}

TEST_CASE("log page names the output that cannot be written, and does not blame the recording") {
  const TemporaryDirectory directory;
  const std::string recording = directory.path("run.jsonl");
  const std::string tree = directory.file("tree.xml", tree_text("<Wait seconds=\"1\"/>"));
  REQUIRE(run_lockstep({"run", tree, "--clock", "virtual", "--view", "none", "--record", recording})
              .code == 0);
  for (const std::vector<std::string>& range : {std::vector<std::string>{}, {"--from", "5"}}) {
    std::vector<std::string> words{"log", "page", recording, "--out", "/dev/full"};
    words.insert(words.end(), range.begin(), range.end());
    const Outcome outcome = run_lockstep(words);
    CHECK(outcome.code == 2);
    CHECK(outcome.err == "lockstep: error: cannot write '/dev/full': No space left on device\n");
  }
}

TEST_CASE("log page keeps no more of a recording in memory than log info does") {
  const TemporaryDirectory directory;
  const std::string recording = record_ticks(directory, "400000");
  const double megabytes = static_cast<double>(std::filesystem::file_size(recording)) / (1u << 20u);
  CHECK(megabytes > 24);
  const Outcome page = log_page(recording, directory.path("run.html"));
  CHECK(page.code == 0);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  const Outcome info = run_lockstep({"log", "info", recording});
  CHECK(page.peak_megabytes < info.peak_megabytes + megabytes / 3);
#endif
}

TEST_CASE("log page says on a terminal how much it has read, and in the end no more") {
  const TemporaryDirectory directory;
  const auto text = lines(read_file(record_ticks(directory, "1")));
  const std::string pipe = directory.path("pipe.jsonl");
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  Process process({.arguments = {"log", "page", pipe, "--out", directory.path("run.html")}},
                  Process::Output::Terminal);
  std::atomic<bool> is_shown = false;
  std::thread writer([&] {
    std::ofstream out(pipe);
    out << text.front() << "\n";
    for (unsigned tick = 0; !is_shown && out; ++tick) {
      out << R"({"tick":)" << tick << R"(,"time_s":0,"nodes":[]})" << std::endl;
    }
  });
  CHECK(process.wait_for(" MB"));
  is_shown = true;
  writer.join();
  const Outcome outcome = process.finish();
  CHECK(outcome.code == 0);
  const std::string& out = outcome.out;
  CHECK(contains(out.substr(out.rfind(" MB")), "\r\x1b[K"));
}
