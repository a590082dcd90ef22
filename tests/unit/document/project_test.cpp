#include "language/document/project.h"

#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "unit/document/temporary_directory.h"
#include "unit/document/told.h"

using namespace lockstep::host;

namespace {

using Lines = std::vector<std::string>;

// Files in a directory of their own, loaded from there; the directory does not show in messages.
class Files {
 public:
  void write(const std::string& name, const std::string& text) { directory_.write(name, text); }
  std::string operator/(const std::string& name) const { return directory_ / name; }

  void load(const std::string& name, const Arguments& arguments = {}) {
    diagnostics_ = Diagnostics();
    project_ = load_project(directory_ / name, arguments, diagnostics_);
  }

  Lines told() const { return shorten(lockstep::host::told(diagnostics_)); }
  Lines hints() const { return shorten(lockstep::host::hints(diagnostics_)); }
  Lines paths() const {
    Lines lines;
    for (const auto& source : project_->sources.all()) lines.push_back(source->path());
    return shorten(lines);
  }
  const Project* project() const { return project_.get(); }

 private:
  Lines shorten(Lines lines) const {
    const auto prefix = directory_ / "";
    for (auto& line : lines)
      for (auto at = line.find(prefix); at != std::string::npos; at = line.find(prefix))
        line.erase(at, prefix.size());
    return lines;
  }

  TemporaryDirectory directory_;
  Diagnostics diagnostics_;
  std::unique_ptr<Project> project_;
};

std::string include(const std::string& path) {
  return "<root lockstep='1'>\n <include path='" + path + "'/>\n</root>";
}

}  // namespace

TEST_CASE("includes are relative to the file that they are in") {
  Files files;
  files.write("main.xml", include("parts/./a.xml"));
  files.write("parts/a.xml", include("../other/b.xml"));
  files.write("other/b.xml", "<root/>");
  files.load("main.xml");
  CHECK(files.told().empty());
  CHECK(files.paths() == Lines{"main.xml", "parts/a.xml", "other/b.xml"});
}

TEST_CASE("a file is read once, by whatever path it is reached") {
  Files files;
  files.write(
      "main.xml",
      "<root lockstep='1'><include path='a.xml'/><include path='b.xml'/><include path='./a.xml'/>"
      "<include path='link.xml'/></root>");
  files.write("a.xml", "<root lockstep='1'><arg name='x' default='1'/></root>");
  files.write("b.xml", include("a.xml"));
  REQUIRE(symlink("a.xml", (files / "link.xml").c_str()) == 0);
  files.load("main.xml");
  CHECK(files.told().empty());
  CHECK(files.paths() == Lines{"main.xml", "a.xml", "b.xml"});
}

TEST_CASE("a cycle shows its chain") {
  Files files;
  files.write("main.xml", include("a.xml"));
  files.write("a.xml", include("b.xml"));
  files.write("b.xml", include("./a.xml"));
  files.load("main.xml");
  CHECK(files.told() == Lines{"b.xml:2:17: include cycle: a.xml -> b.xml -> a.xml"});

  files.write("self.xml", include("self.xml"));
  files.load("self.xml");
  CHECK(files.told() == Lines{"self.xml:2:17: include cycle: self.xml -> self.xml"});
}

TEST_CASE("includes have a depth limit that is named") {
  Files files;
  const auto name = [](int i) { return std::to_string(i) + ".xml"; };
  for (int i = 0; i < 40; ++i) files.write(name(i), include(name(i + 1)));
  files.load("0.xml");
  CHECK(files.told() == Lines{"32.xml:2:17: includes are nested deeper than 32 levels"});
  CHECK(files.project()->documents.size() == 33);

  files.write("32.xml", "<root/>");
  files.load("0.xml");
  CHECK(files.told().empty());
}

TEST_CASE("a file that cannot be read is reported where it is included, with the reason") {
  Files files;
  files.write("main.xml",
              "<root lockstep='1'><include path='none.xml'/>\n<include path='directory'/>\n"
              "<include path='good.xml'/></root>");
  files.write("directory/x", "");
  files.write("good.xml", "<root/>");
  files.load("main.xml");
  CHECK(files.told() == Lines{"main.xml:1:35: cannot read 'none.xml': No such file or directory",
                              "main.xml:2:16: cannot read 'directory': Is a directory"});
  CHECK(files.paths() == Lines{"main.xml", "good.xml"});
}

TEST_CASE("a main file that cannot be read is no project") {
  Files files;
  files.load("none.xml");
  CHECK(files.told() == Lines{"none.xml: cannot be read: No such file or directory"});
  Diagnostics of_no_name;
  CHECK(load_project("", {}, of_no_name) == nullptr);
  CHECK(told(of_no_name) == Lines{"'' cannot be read: No such file or directory"});
  CHECK(files.project() == nullptr);
  files.load("");
  CHECK(files.told()[0].find("Is a directory") != std::string::npos);
}

TEST_CASE("only regular files are read: others could block or never end") {
  Files files;
  const std::string fifo = files / "fifo.xml";
  REQUIRE(mkfifo(fifo.c_str(), 0600) == 0);
  for (const std::string& path : {std::string("/dev/zero"), std::string("/dev/null"), fifo}) {
    Diagnostics diagnostics;
    CHECK_FALSE(load_project(path, {}, diagnostics));
    CHECK(told(diagnostics) == Lines{path + ": cannot be read: it is not a regular file"});
  }
}

TEST_CASE("all files are checked in one pass") {
  Files files;
  files.write("main.xml",
              "<root lockstep='1'>\n <include path='bad.xml'/>\n <include path='other.xml'/>\n"
              " <N x='${a}'/>\n</root>");
  files.write("bad.xml", "<root lockstep='1'>\n <A>\n</root>");
  files.write("other.xml", "<root lockstep='1'>\n <M y='${b}'/>\n</root>");
  files.load("main.xml");
  CHECK(files.told() == Lines{"bad.xml:3:1: '</root>' closes '<A>', opened at line 2",
                              "main.xml:4:8: unknown argument 'a'",
                              "other.xml:2:8: unknown argument 'b'"});
}

TEST_CASE("arguments reach all files, and the paths of includes") {
  Files files;
  files.write("main.xml",
              "<root lockstep='1'><N x='${b}'/><arg name='part' default='a'/><include "
              "path='${part}.xml'/></root>");
  files.write("a.xml", "<root lockstep='1'><arg name='b' default='2'/><M y='${part}${b}'/></root>");
  files.load("main.xml");
  CHECK(files.told().empty());
  CHECK(files.project()->documents[0]->find_attribute(1, "x")->value == "2");
  CHECK(files.project()->documents[1]->find_attribute(2, "y")->value == "a2");

  files.load("main.xml", {{"part", "gone"}});
  CHECK(files.told() == Lines{"main.xml:1:26: unknown argument 'b'",
                              "main.xml:1:78: cannot read 'gone.xml': No such file or directory"});
}

TEST_CASE("an argument is declared once in all files") {
  Files files;
  files.write("main.xml",
              "<root lockstep='1'><arg name='a' default='1'/><include path='b.xml'/></root>");
  files.write("b.xml", "<root lockstep='1'>\n<arg name='a' default='2'/></root>");
  files.load("main.xml");
  CHECK(files.told() == Lines{"b.xml:2:12: argument 'a' is declared twice"});
  CHECK(files.hints() == Lines{"the first is at main.xml:1:31"});
}

TEST_CASE("an <include> is what it may be") {
  const std::pair<std::string, std::string> rows[] = {
      {"<include/>", "f:1:20: 'include' needs the attribute 'path'"},
      {"<include file='a.xml'/>", "f:1:20: 'include' needs the attribute 'path'"},
      {"<include path='/dev/null' x=''/>", "f:1:46: unknown attribute 'x' of 'include'"},
      {"<include path='/dev/null'><a/></include>", "f:1:46: 'include' cannot contain elements"},
      {"<include path='${x}'/>", "f:1:35: unknown argument 'x'"},
  };
  for (const auto& [element, expected] : rows) {
    INFO(element);
    Diagnostics diagnostics;
    load_project_text("f", "<root lockstep='1'>" + element + "</root>", Arguments(), diagnostics);
    const auto lines = told(diagnostics);
    CHECK(std::count(lines.begin(), lines.end(), expected) == 1);
  }
}

TEST_CASE("only directly in the root an element loads something") {
  Diagnostics diagnostics;
  load_project_text("f", "<root lockstep='1'><T><include path='none.xml'/><arg/></T></root>",
                    Arguments(), diagnostics);
  CHECK(told(diagnostics).empty());
}

TEST_CASE("the first element of every file is root") {
  Files files;
  files.write("main.xml", include("a.xml"));
  files.write("a.xml", "<!-- -->\n <Root><include path='none.xml'/></Root>");
  files.load("main.xml");
  CHECK(files.told() == Lines{"a.xml:2:2: the first element must be 'root', not 'Root'"});
}
