#include "study/gnuplot.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "core/diagnostics.h"
#include "study/gnuplot_process.h"

namespace lockstep {
namespace {

constexpr char kMissing[] =
    "there is no gnuplot, so no image was made: install the package 'gnuplot-nox'";

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
std::string failure(const GnuplotEnd& ended) {
  if (ended.stopped) return "interrupted while gnuplot drew";
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
  const GnuplotEnd ended = run_gnuplot(directory, files.stem + ".gp");
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
