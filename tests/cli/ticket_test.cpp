// `verify --ticket` and `run --require-ticket`.
#include <catch2/catch.hpp>

#include "support/json.h"
#include "support/paths.h"
#include "support/program.h"

using namespace lockstep::host::test;

namespace {

const std::string kTicketTree =
    "<root lockstep=\"1\" main_tree_to_execute=\"Main\"><arg name=\"s\" default=\"1\"/><include "
    "path=\"part.xml\"/>"
    "<BehaviorTree ID=\"Main\"><SubTree ID=\"Part\"/></BehaviorTree></root>\n";
const std::string kPart =
    "<root lockstep=\"1\"><BehaviorTree ID=\"Part\"><Wait name=\"w\" "
    "seconds=\"${s}\"/></BehaviorTree>"
    "</root>\n";

// A key pair of OpenSSL.
const std::string kPrivate =
    "-----BEGIN PRIVATE KEY-----\n"
    "MC4CAQAwBQYDK2VwBCIEIKc5ai8GOyHM5B5ia80td8KThYLRXpSyUrDETALmSQRO\n"
    "-----END PRIVATE KEY-----\n";
const std::string kPublic =
    "-----BEGIN PUBLIC KEY-----\n"
    "MCowBQYDK2VwAyEArFQmz0cSYyznCtNaFP4Pksr85WaM3auLnRcSrCXgqww=\n"
    "-----END PUBLIC KEY-----\n";
const std::string kOther =
    "-----BEGIN PUBLIC KEY-----\n"
    "MCowBQYDK2VwAyEA91EcsPF/YhTFcbWTU1+Gg+MhwsWZXBGaT+pCZkAbRjE=\n"
    "-----END PUBLIC KEY-----\n";

struct TicketFiles {
  TemporaryDirectory directory;
  std::string tree = directory.file("tree.xml", kTicketTree);
  std::string part = directory.file("part.xml", kPart);
  std::string ticket = directory.file("ticket.json", "");

  Outcome verify(std::vector<std::string> more = {}) {
    std::vector<std::string> words{"verify", tree, "--ticket", ticket, "--out", directory.path("")};
    words.insert(words.end(), more.begin(), more.end());
    return run_lockstep(words);
  }
  Outcome play(std::vector<std::string> more = {}) {
    std::vector<std::string> words{"run", tree, "--clock", "virtual", "--require-ticket", ticket};
    words.insert(words.end(), more.begin(), more.end());
    return run_lockstep(words);
  }
};

}  // namespace

TEST_CASE("the tree of a ticket runs, at the rate of the proof, and what is assumed is printed") {
  TicketFiles files;
  REQUIRE(files.verify().code == 0);
  const auto ticket = parse_json(read_file(files.ticket));
  CHECK(ticket["lockstep_ticket"] == 1);
  CHECK(ticket["is_proof"] == true);
  const Outcome outcome = files.play();
  INFO(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.err, "at 10 ticks per second"));
  CHECK(contains(outcome.err, "not proved, but assumed"));
  CHECK(contains(outcome.out, "11 ticks"));
}

TEST_CASE("options that change what a tree does are printed beside a ticket, or refused") {
  TicketFiles files;
  REQUIRE(files.verify().code == 0);
  const std::string checkpoint = files.directory.path("run.checkpoint");
  CHECK(!contains(files.play().err, "not proved: -"));
  CHECK(contains(files.play({"--stall-fail", "5"}).err, "not proved: --stall-fail"));
  CHECK(contains(files.play({"--on-fault", "fail"}).err, "not proved: --on-fault fail"));
  CHECK(!contains(files.play({"--checkpoint", checkpoint}).err, "not proved: -"));
  const std::vector<std::string> resumed{"--checkpoint", checkpoint, "--resume"};
  CHECK(contains(files.play(resumed).err, "not proved: --resume"));
  CHECK(files.play({"--tick", "exactly-once"}).code == 2);
  REQUIRE(files.verify({"--cuts"}).code == 0);
  CHECK(!contains(files.play(resumed).err, "not proved: -"));
  CHECK(contains(files.play({"--checkpoint", checkpoint, "--resume", "--on-resume", "failure"}).err,
                 "not proved: --on-resume failure: the proof has restart"));
  REQUIRE(files.verify({"--cuts", "--on-resume", "failure"}).code == 0);
  CHECK(contains(files.play(resumed).err, "not proved: --on-resume restart"));
}

TEST_CASE("a tree that is changed by one character after the ticket is refused") {
  TicketFiles files;
  REQUIRE(files.verify().code == 0);
  SECTION("in the file") {
    files.directory.file("tree.xml", kTicketTree + " ");
    const Outcome outcome = files.play();
    CHECK(outcome.code == 3);
    CHECK(contains(outcome.err, "this is not the tree that was proved"));
    CHECK(contains(outcome.err, "the text of 'the main file'"));
    CHECK(!contains(outcome.err, "part.xml"));
  }
  SECTION("in a file that it includes") {
    std::string part = kPart;
    part.replace(part.find("\"w\""), 3, "\"v\"");
    files.directory.file("part.xml", part);
    const Outcome outcome = files.play();
    CHECK(outcome.code == 3);
    CHECK(contains(outcome.err, "the text of 'part.xml'"));
  }
  SECTION("by an argument") {
    const Outcome outcome = files.play({"--arg", "s=2"});
    CHECK(outcome.code == 3);
    CHECK(contains(outcome.err, "the argument 's': 1 was proved, 2 is given"));
  }
  SECTION("by the rate") {
    const Outcome outcome = files.play({"--rate", "20"});
    CHECK(outcome.code == 3);
    CHECK(contains(outcome.err, "--rate: 10 was proved, 20 is given"));
  }
  SECTION("the ticket is no ticket") {
    for (const char* text : {"", "{}", "[]", "{\"lockstep_ticket\": 2}"}) {
      files.directory.file("ticket.json", text);
      const Outcome outcome = files.play();
      CHECK(outcome.code == 3);
      CHECK(contains(outcome.err, "is no ticket"));
    }
  }
}

TEST_CASE("a ticket that is signed is trusted by its key, and cannot be changed") {
  TicketFiles files;
  const std::string key = files.directory.file("key.pem", kPrivate);
  const std::string trusted = files.directory.file("trusted.pem", kOther + kPublic);
  const std::string others = files.directory.file("others.pem", kOther);
  REQUIRE(files.verify({"--sign", key}).code == 0);
  CHECK(files.play({"--trusted", trusted}).code == 0);
  const Outcome other = files.play({"--trusted", others});
  CHECK(other.code == 3);
  CHECK(contains(other.err, "not trusted"));
  std::string text = read_file(files.ticket);
  text.replace(text.find("\"is_proof\": true"), 16, "\"is_proof\": false");
  files.directory.file("ticket.json", text);
  for (const auto& options : {std::vector<std::string>{}, {"--trusted", trusted}}) {
    const Outcome changed = files.play(options);
    CHECK(changed.code == 3);
    CHECK(contains(changed.err, "changed after it was signed"));
  }
  REQUIRE(files.verify().code == 0);
  const Outcome bare = files.play({"--trusted", trusted});
  CHECK(bare.code == 3);
  CHECK(contains(bare.err, "the ticket is not signed"));
  CHECK(files.verify({"--sign", trusted}).code == 2);
  CHECK(files.play({"--trusted", key}).code == 3);
}

TEST_CASE("there is no ticket for a tree with findings, and none for some of the questions") {
  TicketFiles files;
  const Outcome wrong = files.verify({"--property", "never w.success"});
  CHECK(wrong.code == 1);
  CHECK(read_file(files.ticket).empty());
  CHECK(files.verify({"--only", "trap"}).code == 2);
}

TEST_CASE("what a leaf model accepts and what a limit left out are not called proved") {
  const TemporaryDirectory directory;
  const std::string ticket = directory.path("t.json");
  const std::string tree =
      directory.file("t.xml",
                     "<root lockstep=\"1\"><property name=\"close\">never w.running</property>"
                     "<property name=\"open\">never w.failure</property><BehaviorTree ID=\"M\">"
                     "<Wait name=\"w\" seconds=\"1\"/></BehaviorTree></root>\n");
  const std::string model = directory.file(
      "t.leaves.xml",
      "<leaves lockstep=\"1\"><accept finding=\"property/close\" because=\"known\"/></leaves>\n");
  const auto said = [&](std::vector<std::string> more) {
    std::vector<std::string> words{"verify", tree,    "--ticket",
                                   ticket,   "--out", directory.path("o")};
    words.insert(words.end(), more.begin(), more.end());
    REQUIRE(run_lockstep(words).code != 2);
    return run_lockstep({"run", tree, "--clock", "virtual", "--require-ticket", ticket}).err;
  };
  const std::string accepted = said({"--leaves", model});
  CHECK(contains(accepted, "  proved: open: never w.failure\n"));
  CHECK(!contains(accepted, "proved: close"));
  CHECK(contains(accepted, "  not proved, but accepted: property/close: "));
  CHECK(contains(accepted, " (known)\n"));
  const std::string limited = said({"--leaves", model, "--depth", "2"});
  CHECK(contains(limited, "  holds within the limit: open: never w.failure\n"));
  CHECK(!contains(limited, "  proved: "));
  CHECK(
      contains(run_lockstep({"run", tree, "--clock", "virtual", "--require-ticket", ticket,
                             "--condition-age", "1"})
                   .err,
               "  not proved: --condition-wait, --condition-age: a condition of a program may be"));
}
