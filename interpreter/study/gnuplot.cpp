#include "study/gnuplot.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "core/diagnostics.h"

extern char** environ;

namespace lockstep {
namespace {

constexpr char kMissing[] =
    "there is no gnuplot, so no image was made: install the package 'gnuplot-nox'";

struct Ended {
  int reason = 0;   // why it could not be started, or 0
  bool ok = false;  // it ended with 0
  std::string said = {};
};

// Everything that the child inherits of us but does not want: signals that a run has blocked, our
// directory, our terminal.
class Child {
 public:
  explicit Child(const std::filesystem::path& directory, int out) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions_, out, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions_, out, STDERR_FILENO);
    posix_spawn_file_actions_addchdir_np(&actions_, directory.c_str());
    posix_spawnattr_init(&attributes_);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes_, &none);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK);
  }
  ~Child() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  // 0, or why not.
  int start(std::string script) {
    char program[] = "gnuplot", defaults[] = "-d";  // -d: not what the user's ~/.gnuplot says
    char* arguments[] = {program, defaults, script.data(), nullptr};
    return posix_spawnp(&pid_, program, &actions_, &attributes_, arguments, environ);
  }
  bool succeeds() const {
    int status = 0;
    while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }

 private:
  posix_spawn_file_actions_t actions_;
  posix_spawnattr_t attributes_;
  pid_t pid_ = -1;
};

std::string read_all(int file) {
  std::string text;
  std::array<char, 4096> buffer;
  while (true) {
    const ssize_t count = read(file, buffer.data(), buffer.size());
    if (count > 0) text.append(buffer.data(), static_cast<std::size_t>(count));
    if (count == 0 || (count < 0 && errno != EINTR)) return text;
  }
}

Ended run_gnuplot(const std::filesystem::path& directory, const std::string& script) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return {.reason = errno};
  Child child(directory, ends[1]);
  const int reason = child.start("./" + script);
  close(ends[1]);
  if (reason != 0) {
    close(ends[0]);
    return {.reason = reason};
  }
  Ended ended{.said = read_all(ends[0])};
  close(ends[0]);
  ended.ok = child.succeeds();
  return ended;
}

// 0, or why not.
int write_file(const std::filesystem::path& path, const std::string& text) {
  errno = 0;
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file << text;
  file.close();
  return file ? 0 : (errno != 0 ? errno : EIO);
}

// Its lines, each with control characters made visible; blank ones left out.
std::string readable(std::string_view text) {
  std::string lines;
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    const auto line = text.substr(0, end);
    if (line.find_first_not_of(" \t") != std::string_view::npos) lines += "\n  " + printable(line);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

// "" when gnuplot has made the images.
std::string failure(const Ended& ended) {
  if (ended.reason == ENOENT) return kMissing;
  if (ended.reason != 0) return fmt::format("cannot start gnuplot: {}", strerror(ended.reason));
  return ended.ok ? "" : "gnuplot has failed:" + readable(ended.said);
}

}  // namespace

std::string_view plot_color(std::size_t index) {
  constexpr std::string_view kColors[] = {"#0072b2", "#e69f00", "#009e73",
                                          "#cc79a7", "#56b4e9", "#d55e00"};
  return kColors[index % std::size(kColors)];
}

// In single quotes all is as it stands, but a quote at the beginning cannot be doubled there. In
// double quotes a backquote would run a command; written as octal digits it is only a letter.
std::string gnuplot_string(std::string_view text) {
  const std::string visible = printable(text);
  if (visible.find('\'') == std::string::npos) return "'" + visible + "'";
  std::string literal = "\"";
  for (const char c : visible) {
    if (c == '"' || c == '\\' || c == '`' || c == '@' || c == '$') {
      literal += fmt::format("\\{:03o}", c);
    } else {
      literal += c;
    }
  }
  return literal + "\"";
}

std::string gnuplot_file(std::string_view name) {
  return gnuplot_string(std::string("./").append(name));
}

bool is_plot_image(const std::filesystem::path& image) {
  return image.extension() == ".svg" || image.extension() == ".png";
}

std::string gnuplot_terminal(const std::filesystem::path& image, PlotSize size) {
  const std::string output = gnuplot_file(image.filename().string());
  if (image.extension() == ".svg") {
    return fmt::format(
        "set terminal svg noenhanced size {},{} font 'sans-serif,15' background 'white'\n"
        "set output {}\n",
        size.width, size.height, output);
  }
  return fmt::format(
      "set terminal pngcairo noenhanced size {},{} font 'sans-serif,11' fontscale 2 linewidth 2 "
      "pointscale 2\n"
      "set output {}\n",
      2 * size.width, 2 * size.height, output);
}

std::string file_stem(std::string_view text) {
  constexpr std::size_t kLongest = 120;
  std::string stem;
  for (const char c : text.substr(0, kLongest)) {
    const bool keep = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                      c == '-' || c == '.';
    if (keep && !(stem.empty() && c == '.')) {
      stem += c;
    } else if (!stem.ends_with('_')) {
      stem += '_';
    }
  }
  return stem;
}

PlotResult draw(const PlotFiles& files) {
  PlotResult result;
  const std::pair<std::string, const std::string&> texts[] = {{files.stem + ".dat", files.data},
                                                              {files.stem + ".gp", files.script}};
  for (const auto& [name, text] : texts) {
    const auto path = files.directory / name;
    if (const int reason = write_file(path, text); reason != 0) {
      result.error =
          fmt::format("cannot write '{}': {}", printable(path.string()), strerror(reason));
      return result;
    }
    result.files.push_back(path);
  }
  const auto directory = files.directory.empty() ? "." : files.directory;
  const Ended ended = run_gnuplot(directory, files.stem + ".gp");
  result.error = failure(ended);
  result.gnuplot_missing = ended.reason == ENOENT;
  for (const std::string& image : files.images) {
    std::error_code ignored;
    if (result.ok()) {
      result.files.push_back(files.directory / image);
    } else if (ended.reason == 0) {
      std::filesystem::remove(files.directory / image, ignored);
    }
  }
  return result;
}

}  // namespace lockstep
