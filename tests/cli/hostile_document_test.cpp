// Tree files that are meant to break the reader. Each ends in an error that says where and what, or
// in a correct run, in a second and 256 MB. What of them reaches a terminal:
// terminal_text_test.cpp.
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <functional>

#include "support/program.h"

namespace lockstep::host::test {
namespace {

using Strings = std::vector<std::string>;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr double kMaxSeconds = 60;
constexpr double kMaxMegabytes = 8192;
#else
constexpr double kMaxSeconds = 2;  // of processor time; one, but this machine may be slow or busy
constexpr double kMaxMegabytes = 256;
#endif
constexpr std::size_t kMaxBytes = std::size_t{64} << 20;

const std::string kHead = "<root lockstep=\"1\" main_tree_to_execute=\"A\">\n";
const std::string kHostileDocumentTree = "<BehaviorTree ID=\"A\"><AlwaysSuccess/></BehaviorTree>\n";

std::string in_tree(const std::string& nodes) {
  return kHead + "<BehaviorTree ID=\"A\">" + nodes + "</BehaviorTree></root>";
}

void check_cost(const Outcome& outcome) {
  INFO(outcome.err.substr(0, 2000));
  CHECK(outcome.cpu_seconds < kMaxSeconds);
  CHECK(outcome.peak_megabytes < kMaxMegabytes);
  CHECK(outcome.err.size() < 1 << 20);
  CHECK(outcome.code < 128);
}

// The big ones are written piece by piece: what this process holds counts as its child's.
struct Hostile {
  std::string name;
  std::function<void(const TemporaryDirectory&, std::ostream&)> write;
  int code;
  std::string message;  // in stderr; "$" stands for the path of the file
};

void check_all(const std::vector<Hostile>& files) {
  for (const Hostile& hostile : files) {
    const TemporaryDirectory directory;
    const std::string path = directory.path("tree.xml");
    {
      std::ofstream out(path, std::ios::binary);
      hostile.write(directory, out);
    }
    const Outcome outcome = run_lockstep({"check", path});
    INFO(hostile.name);
    INFO(fmt::format("{:.2f} s, {:.0f} MB", outcome.cpu_seconds, outcome.peak_megabytes));
    if (std::getenv("LOCKSTEP_TELL_COST") != nullptr) {
      WARN(fmt::format("{}: {:.2f} s, {:.0f} MB, {}", hostile.name, outcome.cpu_seconds,
                       outcome.peak_megabytes, outcome.err.substr(0, 300)));
    }
    check_cost(outcome);
    CHECK(outcome.code == hostile.code);
    std::string message = hostile.message;
    if (message.starts_with('$')) message.replace(0, 1, path);
    CHECK(contains(outcome.err, message));
  }
}

auto text(std::string it) {
  return [it = std::move(it)](const TemporaryDirectory&, std::ostream& out) { out << it; };
}

// `head`, then `part` so many times with {} replaced by the count, {1} by the next, then `tail`.
auto many(std::string head, int times, std::string part, std::string tail) {
  return [=](const TemporaryDirectory&, std::ostream& out) {
    out << head;
    for (int i = 0; i < times; ++i) out << fmt::format(fmt::runtime(part), i, i + 1);
    out << tail;
  };
}

// A tree that is right, with a comment that makes the file so long.
auto padded(std::size_t bytes) {
  return [=](const TemporaryDirectory&, std::ostream& out) {
    const std::string begin = kHead + kHostileDocumentTree + "<!--";
    const std::string end = "--></root>";
    const std::string line(1023, 'x');
    out << begin;
    std::size_t left = bytes - begin.size() - end.size();
    for (; left >= 1024; left -= 1024) out << line << '\n';
    out << line.substr(0, left) << end;
  };
}

auto including(std::string path) {
  return text(kHead + "<include path=\"" + path + "\"/>\n" + kHostileDocumentTree + "</root>");
}

}  // namespace

TEST_CASE("a document that is deep or wide is refused or checked in time and memory") {
  constexpr int kMany = 1'000'000;
  const std::string sequence = "<BehaviorTree ID=\"A\"><Sequence>";
  const std::string end = "</Sequence></BehaviorTree></root>";
  std::string deep, up;
  for (int i = 0; i < 90; ++i) {
    deep += "<Inverter>";
    up += "</Inverter>";
  }
  const auto leaves = [](int count) {
    std::string all;
    for (int i = 0; i < count; ++i) all += "<AlwaysSuccess/>";
    return all;
  };
  check_all({
      {"10,000 elements inside each other",
       many(kHead + "<BehaviorTree ID=\"A\">", 10'000, "<Sequence>", ""), 3,
       "$:2:10242: error: elements are nested deeper than 1024 levels"},
      {"10,000 trees inside each other",
       many(kHead + "<BehaviorTree ID=\"A\"><SubTree ID=\"T0\"/></BehaviorTree>", 10'000,
            "<BehaviorTree ID=\"T{0}\"><SubTree ID=\"T{1}\"/></BehaviorTree>\n", "</root>"),
       3, "$:"},
      {"a million siblings", many(kHead + sequence, kMany, "<AlwaysSuccess/>", end), 0, ""},
      {"a million siblings, all unknown", many(kHead + sequence, kMany, "<X{}/>\n", end), 3,
       "$:2:32: error: unknown node 'X0'"},
      {"a million siblings, all unknown, in one line", many(kHead + sequence, kMany, "<X{}/>", end),
       3, "$:2:32: error: unknown node 'X0'"},
      {"a million siblings, all empty", many(kHead + sequence, kMany, "<Sequence/>\n", end), 3,
       "$:2:32: error:"},
      {"100,000 trees",
       many(kHead + kHostileDocumentTree, 100'000,
            "<BehaviorTree ID=\"T{}\"><AlwaysSuccess/></BehaviorTree>\n", "</root>"),
       0, ""},
      {"100,000 plugins",
       many(kHead, 100'000, "<plugin name=\"p{}\"/>\n", kHostileDocumentTree + "</root>"), 4,
       "$:258:1: error: more than 256 plugins"},
      {"100,000 arguments",
       many(kHead, 100'000, "<arg name=\"a{}\"/>\n", kHostileDocumentTree + "</root>"), 3,
       "$:2:1: error: argument 'a0' has no default"},
      {"100,000 includes",
       many(kHead, 100'000, "<include path=\"f{}.xml\"/>\n", kHostileDocumentTree + "</root>"), 3,
       "$:2:16: error: cannot read '"},
      {"100,000 attributes",
       many(kHead + "<BehaviorTree ID=\"A\"><AlwaysSuccess", 100'000, " a{}=\"\"",
            "/></BehaviorTree></root>"),
       3, "$:2:"},
      {"a billion nodes by subtrees of subtrees",
       many(kHead + "<BehaviorTree ID=\"A\"><SubTree ID=\"T0\"/></BehaviorTree>\n", 30,
            "<BehaviorTree ID=\"T{0}\"><Sequence><SubTree ID=\"U{0}\"/><SubTree ID=\"U{0}\"/>"
            "</Sequence></BehaviorTree><BehaviorTree ID=\"U{0}\"><Sequence><SubTree ID=\"T{1}\"/>"
            "</Sequence></BehaviorTree>\n",
            "</root>"),
       3, "$:"},
      {"100,000 nodes 900 deep",
       many(kHead + "<BehaviorTree ID=\"A\">" + deep + "<SubTree ID=\"T0\"/>" + up, 9,
            "</BehaviorTree><BehaviorTree ID=\"T{0}\">" + deep + "<SubTree ID=\"T{1}\"/>" + up,
            "</BehaviorTree><BehaviorTree ID=\"T9\"><Sequence>" + leaves(100'000) + end),
       3, "error: the paths of all nodes in the tree 'T"},
      {"a name of a megabyte above 500 nodes",
       text(kHead + "<BehaviorTree ID=\"A\"><Sequence name=\"" + std::string(1u << 20u, 'n') +
            "\">" + leaves(500) + end),
       0, ""},
      {"a name of a megabyte above 520 nodes",
       text(kHead + "<BehaviorTree ID=\"A\"><Sequence name=\"" + std::string(1u << 20u, 'n') +
            "\">" + leaves(520) + end),
       3, "$:2:22: error: the paths of all nodes in the tree 'A' are larger than 512 MiB"},
  });
}

TEST_CASE("a document that is long is refused or checked in time and memory") {
  const auto attribute = [](std::size_t megabytes) {
    return [=](const TemporaryDirectory&, std::ostream& out) {
      out << kHead << "<BehaviorTree ID=\"A\"><AlwaysSuccess name=\"";
      const std::string megabyte(std::size_t{1} << 20, 'n');
      for (std::size_t i = 0; i < megabytes; ++i) out << megabyte;
      out << "\"/></BehaviorTree></root>";
    };
  };
  const auto bytes = [](std::size_t count, char byte) {
    return [=](const TemporaryDirectory&, std::ostream& out) {
      const std::string block(std::size_t{1} << 16, byte);
      out << kHead;
      for (std::size_t i = 0; i < count; i += block.size()) out << block;
    };
  };
  check_all({
      {"an attribute of 100 MB", attribute(100), 3, "$: error: the file is larger than 64 MiB"},
      {"an attribute of 30 MB", attribute(30), 0, ""},
      {"64 MiB", padded(kMaxBytes), 0, ""},
      {"64 MiB and a byte", padded(kMaxBytes + 1), 3, "$: error: the file is larger than 64 MiB"},
      {"60 MB of '<'", bytes(60'000'000, '<'), 3, "$:2:1: error:"},
      {"60 MB of '&'", bytes(60'000'000, '&'), 3, "$:2:1: error:"},
      {"60 MB of line ends", bytes(60'000'000, '\n'), 3, "$:1:1: error: '<root>' is not closed"},
  });
}

TEST_CASE("bytes that are no text, and entities, are refused where they stand") {
  using namespace std::string_literals;
  const std::string laughs =
      "<!DOCTYPE lolz [<!ENTITY a \"lol\"><!ENTITY b \"&a;&a;&a;&a;&a;&a;&a;&a;\">"
      "<!ENTITY c \"&b;&b;&b;&b;&b;&b;&b;&b;\">]>\n";
  check_all({
      {"an entity of one's own", text(laughs + in_tree("<AlwaysSuccess name=\"&c;\"/>")), 3,
       "$:1:16: error: definitions in a DOCTYPE are not supported"},
      {"an external entity",
       text("<!DOCTYPE r [<!ENTITY x SYSTEM \"file:///etc/passwd\">]>\n" + kHead +
            kHostileDocumentTree + "</root>"),
       3, "$:1:13: error: definitions in a DOCTYPE are not supported"},
      {"an entity that is not declared", text(in_tree("<AlwaysSuccess name=\"&c;\"/>")), 3,
       "$:2:43: error: '&' does not begin a known reference"},
      {"a NUL", text(kHead + "<!--\0-->"s + kHostileDocumentTree + "</root>"), 3,
       "$:2:5: error: NUL byte"},
      {"only NULs", text(std::string(1000, '\0')), 3, "$:1:1: error: NUL byte"},
      {"a NUL as a reference", text(in_tree("<AlwaysSuccess name=\"&#0;\"/>")), 3,
       "$:2:43: error:"},
      {"not UTF-8", text(in_tree("<AlwaysSuccess name=\"\xC3(\"/>")), 3,
       "$:2:43: error: byte \\xC3 is not UTF-8"},
      {"a surrogate", text(in_tree("<AlwaysSuccess name=\"\xED\xA0\x80\"/>")), 3,
       "$:2:43: error: byte \\xED is not UTF-8"},
      {"too long for UTF-8", text(in_tree("<AlwaysSuccess name=\"\xC0\xAF\"/>")), 3,
       "$:2:43: error: byte \\xC0 is not UTF-8"},
      {"UTF-16", text("\xFF\xFE<\0r\0o\0o\0t\0/\0>\0"s), 3, "$:1:1: error: the file is in UTF-16"},
      {"UTF-16, the other way", text("\xFE\xFF\0<\0r\0o\0o\0t\0/\0>"s), 3,
       "$:1:1: error: the file is in UTF-16"},
      {"nothing", text(""), 3, "$:1:1: error: the file is empty"},
  });
}

TEST_CASE("includes neither hang nor multiply") {
  const auto linked = [](const char* target, const char* name, auto write) {
    return [=](const TemporaryDirectory& directory, std::ostream& out) {
      REQUIRE(symlink(target, directory.path(name).c_str()) == 0);
      write(directory, out);
    };
  };
  const auto fifo = [](const TemporaryDirectory& directory, std::ostream& out) {
    REQUIRE(mkfifo(directory.path("fifo").c_str(), 0600) == 0);
    including("fifo")(directory, out);
  };
  // Each includes the next one twice: 2^25 files, if each were read each time.
  const auto bomb = [](const TemporaryDirectory& directory, std::ostream& out) {
    including("0.xml")(directory, out);
    for (int i = 0; i < 25; ++i) {
      const std::string next = fmt::format("<include path=\"{}.xml\"/>", i + 1);
      directory.file(fmt::format("{}.xml", i), "<root lockstep=\"1\">" + next + next + "</root>");
    }
    directory.file("25.xml", "<root lockstep=\"1\"/>");
  };
  const auto chain = [](const TemporaryDirectory& directory, std::ostream& out) {
    including("0.xml")(directory, out);
    for (int i = 0; i < 1000; ++i) {
      directory.file(fmt::format("{}.xml", i),
                     fmt::format("<root lockstep=\"1\"><include path=\"{}.xml\"/></root>", i + 1));
    }
  };
  const auto together = [](const TemporaryDirectory& directory, std::ostream& out) {
    out << kHead;
    for (int i = 0; i < 8; ++i) {
      out << fmt::format("<include path=\"{}.xml\"/>\n", i);
      std::ofstream part(directory.path(fmt::format("{}.xml", i)), std::ios::binary);
      part << "<root lockstep=\"1\"><!--" << std::string(20'000'000, 'x') << "--></root>";
    }
    out << kHostileDocumentTree << "</root>";
  };
  // A file and the one that it includes have so many bytes together.
  const auto two_files = [](std::size_t bytes) {
    return [=](const TemporaryDirectory& directory, std::ostream& out) {
      const std::string main =
          kHead + "<include path=\"part.xml\"/>\n" + kHostileDocumentTree + "</root>";
      const std::string begin = "<root lockstep=\"1\"><!--", end = "--></root>";
      std::ofstream part(directory.path("part.xml"), std::ios::binary);
      std::size_t left = bytes - main.size() - begin.size() - end.size();
      part << begin;
      for (const std::string line(1023, 'x'); left >= 1024; left -= 1024) part << line << '\n';
      part << std::string(left, 'x') << end;
      out << main;
    };
  };
  const std::string at = "$:2:16: error: ";
  check_all({
      {"a device", including("/dev/zero"), 3,
       at + "cannot read '/dev/zero': it is not a regular file"},
      {"a named pipe", fifo, 3, at},
      {"a directory", including("."), 3, at},
      {"a file of the kernel that blocks", including("/proc/kmsg"), 3, at},
      {"itself", including("tree.xml"), 3, at + "include cycle: "},
      {"itself through a link", linked("tree.xml", "link.xml", including("link.xml")), 3,
       at + "include cycle: "},
      {"a link to itself", linked("loop.xml", "loop.xml", including("loop.xml")), 3, at},
      {"a bomb", bomb, 0, ""},
      {"a chain", chain, 3, "includes are nested deeper than 32 levels"},
      {"160 MB in 8 files", together, 3, "are larger than 64 MiB together"},
      {"64 MiB in 2 files", two_files(kMaxBytes), 0, ""},
      {"64 MiB and a byte in 2 files", two_files(kMaxBytes + 1), 3,
       "are larger than 64 MiB together"},
      {"not a tree", including("/etc/passwd"), 3, "/etc/passwd:1:1: error: "},
  });
}

TEST_CASE("a plugin is a name, never a path") {
  for (const std::string name :
       {"../../x", "/tmp/x", "x.so", ".", "", "a b", "&#x9B;2J", "x&#10;y"}) {
    const TemporaryDirectory directory;
    directory.file("x.so", "");
    const std::string path = directory.file(
        "tree.xml", kHead + "<plugin name=\"" + name + "\"/>\n" + kHostileDocumentTree + "</root>");
    const Outcome outcome = run_lockstep({"check", path, "--plugin-path", directory.path("a/b")});
    INFO(outcome.err);
    CHECK(outcome.code == 4);
    CHECK(contains(outcome.err, path + ":2:15: error: '"));
    CHECK(contains(outcome.err, "is not the name of a plugin"));
  }
}

// Places are looked for only where an error is shown. In one run, so that the machine does not
// count.
TEST_CASE("half a million errors take little more time than half a million nodes that are right") {
  const auto seconds = [](const std::string& node, int code) {
    const TemporaryDirectory directory;
    const std::string path = directory.path("tree.xml");
    std::ofstream out(path);
    many(kHead + "<BehaviorTree ID=\"A\"><Sequence>", 500'000, node + "\n",
         "</Sequence></BehaviorTree></root>")(directory, out);
    out.close();
    const Outcome outcome = run_lockstep({"check", path});
    CHECK(outcome.code == code);
    return outcome.cpu_seconds;
  };
  const double right = seconds("<AlwaysSuccess/>", 0);
  CHECK(seconds("<Unknown/>", 3) < 3 * right);
  CHECK(seconds("<Sequence/>", 3) < 3 * right);
}

// Suggestions and lists are made for what is shown only, and are bounded.
TEST_CASE("thousands of mistakes among thousands of long names are reported in time and memory") {
  // Letters that no word is near to, the same in every run.
  const auto scrambled = [](unsigned seed, std::size_t length) {
    std::string word;
    for (std::size_t i = 0; i < length; ++i) {
      seed = seed * 1664525 + 1013904223;
      word += static_cast<char>('a' + (seed >> 24u) % 10);
    }
    return word;
  };
  const auto trees_and_uses = [](int trees, auto id, int uses, auto used) {
    return [=](const TemporaryDirectory&, std::ostream& out) {
      out << kHead << "<BehaviorTree ID=\"A\"><Sequence>\n";
      for (int i = 0; i < uses; ++i) out << "<SubTree ID=\"" << used(i) << "\"/>\n";
      out << "</Sequence></BehaviorTree>\n";
      for (int i = 0; i < trees; ++i) {
        out << "<BehaviorTree ID=\"" << id(i) << "\"><AlwaysSuccess/></BehaviorTree>\n";
      }
      out << "</root>";
    };
  };
  const auto random = [=](int i) { return scrambled(static_cast<unsigned>(i), 200); };
  const auto other = [=](int i) { return scrambled(static_cast<unsigned>(-i - 1), 200); };
  const auto alike = [](int i) { return std::string(194, 't') + std::to_string(100'000 + i); };
  const auto nearly = [](int i) {
    return std::string(194, 't') + std::to_string(i % 1000) + "xxx";
  };
  const auto long_id = [](int i) { return std::string(300, 'x') + std::to_string(i); };
  const auto short_id = [](int i) { return "T" + std::to_string(i); };
  check_all({
      {"nothing near", trees_and_uses(3000, random, 2000, other), 3, "2000 errors, of which 1000"},
      {"all near", trees_and_uses(3000, alike, 2000, nearly), 3, "did you mean 'ttt"},
      {"too long", trees_and_uses(8000, alike, 1000, long_id), 3, "xxx…'"},
      {"many", trees_and_uses(300'000, short_id, 100'000, long_id), 3, "100000 errors, of which"},
      {"arguments",
       [=](const TemporaryDirectory&, std::ostream& out) {
         out << kHead << kHostileDocumentTree;
         for (int i = 0; i < 3000; ++i)
           out << "<arg name=\"" << random(i) << "\" default=\"${" << other(i) << "}\"/>\n";
         out << "</root>";
       },
       3, "error: unknown argument '"},
      {"attributes of a SubTree",
       [=](const TemporaryDirectory&, std::ostream& out) {
         out << kHead << "<BehaviorTree ID=\"A\"><Sequence>";
         for (int i = 0; i < 5000; ++i)
           out << "<SubTree ID=\"B\" " << random(i) << "=\"1\" " << other(i) << "=\"2\"/>\n";
         out << "</Sequence></BehaviorTree><BehaviorTree "
                "ID=\"B\"><AlwaysSuccess/></BehaviorTree></root>";
       },
       0, "warning: the tree 'B' does not use '"},
      {"a circle of 3000 trees",
       many(kHead + "<BehaviorTree ID=\"A\"><SubTree ID=\"T0\"/></BehaviorTree>\n", 3000,
            "<BehaviorTree ID=\"T{0}\"><Sequence><SubTree ID=\"T{1}\"/><SubTree ID=\"A\"/>"
            "</Sequence></BehaviorTree>\n",
            "<BehaviorTree ID=\"T3000\"><SubTree ID=\"T0\"/></BehaviorTree></root>"),
       3, "the tree 'T0' contains itself: T0 -> T1 -> T2 -> T3 -> T4 -> … (2992 more) … -> T2997"},
  });
}

TEST_CASE("no message is long, whatever is") {
  const std::string word(100'000, 'w');
  const std::string head = "<root lockstep=\"1\" main_tree_to_execute=\"A\">",
                    tree = "<BehaviorTree ID=\"A\">", end = "</BehaviorTree></root>";
  const std::string texts[] = {
      "<" + word + "/>",
      "<" + word + ">",
      "<" + word + "><a></" + word + ">",
      "<r></" + word + ">",
      "</" + word + ">",
      "<r></" + word,
      "<r " + word + "/>",
      "<r " + word + "=1/>",
      "<r " + word + "='<'/>",
      "<r " + word + "='/>",
      "<r " + word + "='' " + word + "=''/>",
      "<" + word,
      "<" + word + " ;/>",
      "<?" + word + "+?><r/>",
      "<?xml version='1.0' encoding='" + word + "'?><r/>",
      "<root lockstep=\"" + word + "\"/>",
      "<root lockstep=\"1\" " + word + "=\"1\"/>",
      "<root lockstep=\"1\" main_tree_to_execute=\"" + word + "\">" + tree + "<AlwaysSuccess/>" +
          end,
      head + "<" + word + "/>" + tree + "<AlwaysSuccess/>" + end,
      head + "<include path=\"" + word + "\"/>" + tree + "<AlwaysSuccess/>" + end,
      head + "<include " + word + "=\"\"/>" + tree + "<AlwaysSuccess/>" + end,
      head + "<plugin name=\"" + word + "\"/>" + tree + "<AlwaysSuccess/>" + end,
      head + "<plugin name=\"" + word + "/\"/>" + tree + "<AlwaysSuccess/>" + end,
      head + "<plugin name=\"a\" isolate=\"" + word + "\"/>" + tree + "<AlwaysSuccess/>" + end,
      head + "<plugin name=\"a\" " + word + "=\"1\"/>" + tree + "<AlwaysSuccess/>" + end,
      head + "<arg name=\"" + word + "\"/>" + tree + "<AlwaysSuccess/>" + end,
      head + "<arg name=\"" + word + "-\" default=\"\"/>" + tree + "<AlwaysSuccess/>" + end,
      head + "<arg name=\"a\" default=\"${" + word + "}\"/>" + tree + "<AlwaysSuccess/>" + end,
      head + "<BehaviorTree ID=\"" + word + "/\"><AlwaysSuccess/>" + end,
      head + "<BehaviorTree ID=\"" + word + "\">" + end,
      head + "<BehaviorTree ID=\"A\" " + word + "=\"1\"><AlwaysSuccess/>" + end,
      head + "<BehaviorTree ID=\"" + word + "\"><AlwaysSuccess/><AlwaysSuccess/>" + end,
      head + "<BehaviorTree ID=\"" + word + "\"><AlwaysSuccess/></BehaviorTree>" +
          "<BehaviorTree ID=\"" + word + "\"><AlwaysSuccess/>" + end,
      head + "<BehaviorTree ID=\"" + word + "\"><SubTree ID=\"" + word + "\"/>" + end,
      head + "<BehaviorTree ID=\"" + word + "\"><" + word + "/>" + end,
      head + tree + "<" + word + "/>" + end,
      head + tree + "<Action ID=\"" + word + "\"/>" + end,
      head + tree + "<SubTree ID=\"" + word + "\"/>" + end,
      head + tree + "<SubTree ID=\"A\" " + word + ".=\"\"/>" + end,
      head + tree + "<SubTree ID=\"A\" _" + word + "=\"\"/>" + end,
      head + tree + "<SubTree ID=\"A\" a=\"{" + word + ".}\"/>" + end,
      head + tree + "<SubTree ID=\"A\" _autoremap=\"" + word + "\"/>" + end,
      head + tree + "<Wait seconds=\"" + word + "\"/>" + end,
      head + tree + "<Wait seconds=\"1\" " + word + "=\"\"/>" + end,
      head + tree + "<Wait seconds=\"1\" name=\"/" + word + "\"/>" + end,
      head + tree + "<ParallelAbsolute at_barrier=\"" + word +
          "\"><AlwaysSuccess/></ParallelAbsolute>" + end,
      head + "<plugin name=\"motion\"/>" + tree + "<Advance step=\"{" + word + ".}\"/>" + end,
      head + "<plugin name=\"motion\"/>" + tree + "<Advance step=\"{" + word + "}\"/>" + end,
      head + "<plugin name=\"motion\"/>" + tree + "<SubTree ID=\"B\" s=\"" + word +
          "\"/></BehaviorTree>" + "<BehaviorTree ID=\"B\"><Advance step=\"{s}\"/>" + end,
      head + "<plugin name=\"motion\"/>" + tree + "<Sequence><Advance name=\"" + word +
          "\"/><Advance name=\"" + word + "\"/></Sequence>" + end,
      head + "<plugin name=\"motion\"/>" + tree + "<Sequence><SubTree ID=\"B\" " + word +
          "=\"1\"/></Sequence>" + "</BehaviorTree><BehaviorTree ID=\"B\"><AlwaysSuccess/>" + end,
  };
  for (const std::string& it : texts) {
    const TemporaryDirectory directory;
    const std::string path = directory.file("tree.xml", it);
    const Outcome outcome = run_lockstep({"check", path});
    std::string abbreviated = it;
    for (auto at = abbreviated.find(word); at != std::string::npos; at = abbreviated.find(word))
      abbreviated.replace(at, word.size(), "w…");
    INFO(abbreviated << "\n" << outcome.err.substr(0, 3000));
    CHECK_FALSE(outcome.err.empty());
    CHECK(contains(outcome.err, "www…"));
    for (const std::string& line : lines(outcome.err)) CHECK(line.size() < 1200);
  }
}

TEST_CASE("arguments that expand to megabytes are refused") {
  const auto doubling = [](int times, std::string tail) {
    return [=](const TemporaryDirectory&, std::ostream& out) {
      out << kHead << "<arg name=\"a0\" default=\"0123456789abcdef\"/>\n";
      for (int i = 1; i <= times; ++i) {
        out << fmt::format("<arg name=\"a{0}\" default=\"${{a{1}}}${{a{1}}}\"/>\n", i, i - 1);
      }
      out << tail << "</root>";
    };
  };
  const auto uses = [](int times) {
    std::string nodes = "<BehaviorTree ID=\"A\"><Sequence>\n";
    for (int i = 0; i < times; ++i) nodes += "<AlwaysSuccess name=\"${a15}\"/>\n";
    return nodes + "</Sequence></BehaviorTree>";
  };
  check_all({
      {"30 times doubled", doubling(30, kHostileDocumentTree), 3,
       "$:19:26: error: the value of 'default' is larger than 1 MiB"},
      {"40 times half a megabyte", doubling(15, uses(40)), 0, ""},
      {"100,000 times half a megabyte", doubling(15, uses(100'000)), 3,
       "error: values with arguments are larger than 64 MiB together"},
  });
}

}  // namespace lockstep::host::test
