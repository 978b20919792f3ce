#include "apps/ensemble/presentation/gnuplot.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "libindet/base/error.h"
#include "libindet/io/whole_file.h"

namespace indet {
namespace {

// Okabe and Ito's palette, in an order whose lightness differs between neighbours.
constexpr std::array<const char*, 8> kColours = {"#0072B2", "#E69F00", "#009E73", "#D55E00",
                                                 "#CC79A7", "#56B4E9", "#F0E442", "#000000"};
// Open ones, of growing size, so that points at one place are all seen: circle, square, triangle, cross.
constexpr std::array<int, 4> kSymbols = {6, 4, 8, 2};
constexpr std::array<double, 4> kSymbolSizes = {0.6, 0.8, 0.95, 0.65};

/// In marks of quotation, those within being doubled: CSV has " and gnuplot '.
std::string quoted(const std::string& text, char mark = '"') {
  std::string result(1, mark);
  for (const char c : text) {
    if (c == mark) result += mark;
    result += c;
  }
  return result + mark;
}

std::string number(double value) { return std::isfinite(value) ? fmt::format("{:.10g}", value) : ""; }

std::string range(const Axis& axis) {
  return axis.low == axis.high ? std::string("[*:*]") : fmt::format("[{:g}:{:g}]", axis.low, axis.high);
}

std::string style(const Series& series) {
  const double width = series.thick ? 2.2 : 1.2;
  const char* colour = kColours[static_cast<std::size_t>(series.colour) % kColours.size()];
  if (series.mark == Mark::kPoints) {
    const auto symbol = static_cast<std::size_t>(series.symbol) % kSymbols.size();
    return fmt::format("with points pt {} ps {} lw 1.7 lc rgb '{}'", kSymbols[symbol], kSymbolSizes[symbol],
                       colour);
  }
  const int dash = series.mark == Mark::kDashed ? 2 : series.mark == Mark::kDotted ? 3 : 1;
  return fmt::format("with lines lw {} dt {} lc rgb '{}'", width, dash, colour);
}

std::string plot_commands(const Figure& figure) {
  std::string text;
  int column = 1;
  for (const Panel& panel : figure.panels) {
    text += fmt::format("set title {}\n", quoted(panel.title, '\''));
    text += fmt::format("set xlabel {}\nset ylabel {}\n", quoted(panel.x.label, '\''),
                        quoted(panel.y.label, '\''));
    text += fmt::format("set xrange {}\nset yrange {}\n", range(panel.x), range(panel.y));
    text += panel.y.logarithmic ? "set logscale y\nset format y '10^{%L}'\n"
                                : "unset logscale y\nset format y '%g'\n";
    text += panel.legend_below ? "set key default below horizontal samplen 2\nset bmargin 6\n"
                               : fmt::format("set key default samplen 3 spacing 1.1 {} top\nset bmargin\n",
                                             panel.legend_left ? "left" : "right");
    std::string separator = "plot ";
    for (const Series& series : panel.series) {
      text += fmt::format("{}data using {}:{} {} title {}", separator, column, column + 1, style(series),
                          quoted(series.name, '\''));
      if (!series.error.empty()) {
        // Vectors, because error bars cut gaps into the curves. On a logarithmic axis they end at y/5.
        const char* low = panel.y.logarithmic ? "(${1}-${2}>${1}/5?${1}-${2}:${1}/5)" : "(${1}-${2})";
        std::string bottom = low;
        const auto put = [&](const std::string& mark, int number_of_column) {
          for (std::size_t at = bottom.find(mark); at != std::string::npos; at = bottom.find(mark))
            bottom.replace(at, mark.size(), fmt::format("${}", number_of_column));
        };
        put("${1}", column + 1);
        put("${2}", column + 2);
        text += fmt::format(
            ", \\\n  data using {0}:{1}:(0):(${2}+${3}-{1}) with vectors nohead lw 0.7 lc rgb '{4}' notitle",
            column, bottom, column + 1, column + 2,
            kColours[static_cast<std::size_t>(series.colour) % kColours.size()]);
      }
      separator = ", \\\n  ";
      column += 3;
    }
    text += '\n';
  }
  return text;
}

void run_gnuplot(const std::filesystem::path& folder, const std::string& script) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  // It warns of every curve that has no point in the panel. Why it fails can be seen by running the script.
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  std::string program = "gnuplot";
  std::string argument = script;
  std::array<char*, 3> arguments = {program.data(), argument.data(), nullptr};
  pid_t child = 0;
  const int error = posix_spawnp(&child, "gnuplot", &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw LibraryError("gnuplot cannot be run; install gnuplot-nox");
  int status = 0;
  waitpid(child, &status, 0);
  if (status != 0)
    throw LibraryError(fmt::format("gnuplot failed: run it on {} to see why", (folder / script).string()));
}

}  // namespace

std::string to_csv(const Figure& figure) {
  std::string text;
  std::size_t rows = 0;
  for (const Panel& panel : figure.panels) {
    for (const Series& series : panel.series) {
      const std::string name = panel.title.empty() ? series.name : panel.title + ", " + series.name;
      text += text.empty() ? "" : ",";
      text += quoted(name + ": " + panel.x.label) + "," + quoted(name + ": " + panel.y.label) + "," +
              quoted(name + ": standard error");
      rows = std::max(rows, series.x.size());
    }
  }
  text += '\n';
  for (std::size_t row = 0; row < rows; ++row) {
    std::string separator;
    for (const Panel& panel : figure.panels) {
      for (const Series& series : panel.series) {
        const bool inside = row < series.x.size();
        text += separator + (inside ? number(series.x[row]) : "") + "," +
                (inside ? number(series.y[row]) : "") + "," +
                (row < series.error.size() ? number(series.error[row]) : "");
        separator = ",";
      }
    }
    text += '\n';
  }
  return text;
}

std::string to_gnuplot(const Figure& figure) {
  const std::size_t panels = std::max<std::size_t>(1, figure.panels.size());
  const double width = panels > 1 ? 430 * static_cast<double>(panels) : 600;
  std::string text = fmt::format("# {}\n# gnuplot {}.gp makes {}.svg and {}.pdf from {}.csv.\n", figure.title,
                                 figure.id, figure.id, figure.id, figure.id);
  text += fmt::format("data = '{}.csv'\n", figure.id);
  text += "set datafile separator ','\nset datafile columnheaders\nset encoding utf8\n";
  text += "set border lw 0.8\nset tics nomirror\nset bars 0\n";
  for (const bool vector : {true, false}) {
    text +=
        vector ? fmt::format("\nset terminal svg size {:g},380 font 'DejaVu Sans,13' background 'white'\n",
                             width)
               : fmt::format("\nset terminal pdfcairo size {:g}cm,9.5cm font 'DejaVu Sans,10'\n", width / 40);
    text += fmt::format("set output '{}.{}'\n", figure.id, vector ? "svg" : "pdf");
    if (panels > 1) text += fmt::format("set multiplot layout 1,{}\n", panels);
    text += plot_commands(figure);
    if (panels > 1) text += "unset multiplot\n";
  }
  text += "set output\n";
  return text;
}

void draw_figure(const std::filesystem::path& folder, const Figure& figure) {
  write_whole_file(folder / (figure.id + ".csv"), to_csv(figure));
  write_whole_file(folder / (figure.id + ".gp"), to_gnuplot(figure));
  run_gnuplot(folder, figure.id + ".gp");
}

}  // namespace indet
