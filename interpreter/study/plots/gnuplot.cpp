#include "study/plots/gnuplot.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <system_error>

#include "base/core/diagnostics.h"
#include "base/system/file_descriptor.h"
#include "base/system/output_file.h"
#include "study/plots/gnuplot_process.h"
#include "study/plots/plot_style.h"

namespace lockstep::host {
namespace {

constexpr double kPointsPerPixel = 11.0 / 15;
constexpr char kMissing[] =
    "gnuplot is missing, so no image was made: install the package 'gnuplot-nox'";

// In another directory, so that what is finished can be moved there; removed with what is left.
class WorkDirectory {
 public:
  explicit WorkDirectory(const std::filesystem::path& parent)
      : path_((parent / ".lockstep-plot-XXXXXX").string()) {
    if (mkdtemp(path_.data()) == nullptr) reason_ = errno;
  }
  ~WorkDirectory() {
    std::error_code ignored;
    if (reason_ == 0) std::filesystem::remove_all(path_, ignored);
  }
  WorkDirectory(const WorkDirectory&) = delete;
  WorkDirectory& operator=(const WorkDirectory&) = delete;

  // For whom gnuplot writes, when we have more rights than the user: it gives these up. What we
  // write into it comes before that.
  void give_to_user() const {
    if (getuid() == geteuid()) return;
    [[maybe_unused]] const int ignored = chown(path_.c_str(), getuid(), getgid());
  }
  // 0, or why it could not be made.
  int reason() const { return reason_; }
  std::filesystem::path path() const { return path_; }

 private:
  std::string path_;
  int reason_ = 0;
};

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

// gnuplot 5.4 does not look at what comes of its writes: on a full disk it ends well.
bool is_whole(const std::filesystem::path& image) {
  std::ifstream file(image, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  if (image.extension() == ".svg") return std::string_view(bytes).find("</svg>") != bytes.npos;
  constexpr std::string_view kEndOfPng = "IEND\xAE\x42\x60\x82";
  return bytes.ends_with(kEndOfPng);
}

// "" when gnuplot has made the images.
std::string failure(const GnuplotEnd& ended) {
  if (ended.stopped) return "interrupted while gnuplot drew";
  if (ended.reason == ENOENT) return kMissing;
  if (ended.reason != 0) return fmt::format("cannot start gnuplot: {}", strerror(ended.reason));
  return ended.ok ? "" : "gnuplot failed:" + readable(ended.said);
}

}  // namespace

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
        "set terminal svg noenhanced size {},{} font 'sans-serif,{}' background 'white'\n"
        "set output {}\n",
        size.width, size.height, letter_height(size), output);
  }
  return fmt::format(
      "set terminal pngcairo noenhanced size {},{} font 'sans-serif,{}' fontscale {:.4g} "
      "linewidth 2 pointscale 2\nset output {}\n",
      2 * size.width, 2 * size.height, letter_height(size), 2 * kPointsPerPixel, output);
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
  const std::filesystem::path directory = files.directory.empty() ? "." : files.directory;
  const WorkDirectory work(directory);
  std::vector<std::string> finished{files.stem + ".dat", files.stem + ".gp"};
  const auto fails = [&result](const std::filesystem::path& path, int reason) {
    if (reason == 0) return false;
    result.error = fmt::format("cannot write '{}': {}", printable(path.string()), strerror(reason));
    return true;
  };
  if (fails(directory / finished[0], work.reason())) return result;
  if (fails(directory / finished[0], write_file(work.path() / finished[0], files.data)) ||
      fails(directory / finished[1], write_file(work.path() / finished[1], files.script))) {
    return result;
  }
  work.give_to_user();
  const GnuplotEnd ended = run_gnuplot(work.path(), finished[1]);
  result.error = failure(ended);
  result.gnuplot_missing = ended.reason == ENOENT;
  if (ended.stopped) return result;
  for (const std::string& image : files.images) {
    if (result.ok() && !is_whole(work.path() / image)) {
      result.error = fmt::format("cannot write '{}': gnuplot wrote a part of it, as on a full disk",
                                 printable((directory / image).string()));
    }
  }
  if (result.ok()) finished.insert(finished.end(), files.images.begin(), files.images.end());
  for (const std::string& name : finished) {
    const std::string made = work.path() / name, wanted = directory / name;
    const FileDescriptor file(open(made.c_str(), O_RDONLY | O_CLOEXEC));
    const bool is_placed =
        file.number() >= 0 && take_name(file.number(), made.c_str(), wanted.c_str());
    if (fails(wanted, is_placed ? 0 : errno)) return result;
    result.files.push_back(files.directory / name);
  }
  return result;
}

}  // namespace lockstep::host
