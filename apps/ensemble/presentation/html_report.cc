#include "apps/ensemble/presentation/html_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <set>

#include "apps/ensemble/presentation/comparison.h"
#include "apps/ensemble/presentation/figures.h"
#include "apps/ensemble/presentation/gnuplot.h"
#include "apps/ensemble/presentation/limit_figures.h"
#include "apps/ensemble/presentation/paper_choices.h"
#include "apps/ensemble/presentation/uniform_figures.h"
#include "apps/ensemble/presentation/verdict.h"
#include "libindet/base/counted.h"
#include "libindet/base/error.h"
#include "libindet/io/destination.h"
#include "libindet/io/whole_file.h"

namespace indet {
namespace {

constexpr const char* kStyle = R"(
body{font:16px/1.5 "DejaVu Sans",Verdana,sans-serif;max-width:62rem;margin:2rem auto;padding:0 1rem;color:#111;background:#fff}
h1{font-size:1.7rem}h2{font-size:1.25rem;margin-top:2.5rem}
table{border-collapse:collapse;margin:1rem 0;font-size:.92rem}
th,td{text-align:left;padding:.25rem .8rem .25rem 0;border-bottom:1px solid #ccc;vertical-align:top}
figure{margin:1rem 0;break-inside:avoid}figure svg{max-width:100%;height:auto}
.numbers td:not(:first-child),.numbers th{white-space:nowrap}
.row{display:flex;gap:.5rem;flex-wrap:wrap}.row figure{flex:1 1 15rem}
figcaption,.note{font-size:.92rem;color:#333}.differs{color:#a33000;font-weight:bold}.agrees{color:#00543c}
@media print{body{margin:0;max-width:none;font-size:10pt}}
)";

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&') {
      result += "&amp;";
    } else if (c == '<') {
      result += "&lt;";
    } else if (c == '>') {
      result += "&gt;";
    } else {
      result += c;
    }
  }
  return result;
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

/// The <svg> element of a file, with identifiers that do not collide with those of others.
std::string inline_svg(const std::filesystem::path& path, const std::string& prefix) {
  std::ifstream stream(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  const std::size_t begin = text.find("<svg");
  if (begin == std::string::npos) throw LibraryError(path.string() + " is not a picture");
  text.erase(0, begin);
  for (const char* quote : {"'", "\""}) {
    replace_all(text, std::string(" id=") + quote, std::string(" data-id=") + quote + prefix + "-");
    replace_all(text, " data-id=", " id=");
    replace_all(text, std::string("href=") + quote + "#", std::string("href=") + quote + "#" + prefix + "-");
  }
  replace_all(text, "url(#", "url(#" + prefix + "-");
  return text;
}

/// How a row comes out with other choices, to be unfolded; for packings of the paper's case alone.
std::string dependence_of(const Comparison& row) {
  if (row.verdict.empty()) return "";
  const std::vector<PaperChoice> choices = choices_of(row.quantity);
  if (choices.empty()) return "";
  const auto agreeing = std::count_if(choices.begin(), choices.end(),
                                      [](const PaperChoice& choice) { return choice.verdict == kAgrees; });
  std::string text =
      fmt::format("<details><summary>agrees in {} of {}</summary><table>", agreeing, choices.size());
  for (const PaperChoice& choice : choices) {
    text += fmt::format("<tr><td>{}</td><td>{}</td><td class=\"{}\">{}</td></tr>", escaped(choice.choice),
                        escaped(choice.ours), choice.verdict, choice.verdict);
  }
  return text + "</table></details>";
}

std::string comparison_table(const std::vector<Comparison>& rows) {
  std::string text =
      "<table><tr><th>quantity</th><th>paper</th><th>here</th><th></th><th>with other choices</th></tr>\n";
  for (const Comparison& row : rows) {
    text += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td class=\"{}\">{}</td><td>{}</td></tr>\n",
                        escaped(row.quantity), escaped(row.paper), escaped(row.ours), row.verdict,
                        row.verdict, dependence_of(row));
  }
  return text + "</table>\n";
}

std::string note_on_verdicts(const EnsembleTables& tables) {
  std::string text = "<p class=\"note\">";
  const std::string other_case = reason_for_no_verdict(tables);
  if (other_case.empty()) {
    text +=
        "\"agrees\": within two standard errors of the difference; where the paper gives no error, within 10 "
        "% or two standard errors of ours; where it says which is larger, larger by two standard errors. "
        "\"not decided\": the difference is less, our error is more than a quarter of the paper's number, or "
        "the paper gives no number. Sliding contacts are judged by the raw states, as the paper "
        "does not polish: its ε = 1e-9 counts contacts on their limit, and leaves out those that only the "
        "polish puts there. \"With other choices\" of what the paper leaves open (" +
        escaped(paper_choices_origin()) + "): docs/measurements/paper-choices.tsv.";
  } else {
    text += other_case + " Hence there is no verdict.";
  }
  return text + " File: figures/comparison.csv</p>\n";
}

std::string table_beyond_the_paper(const std::vector<Comparison>& rows) {
  std::string text = "<table><tr><th>quantity</th><th>here</th></tr>\n";
  for (const Comparison& row : rows)
    text += fmt::format("<tr><td>{}</td><td>{}</td></tr>\n", escaped(row.quantity), escaped(row.ours));
  return text + "</table>\n";
}

std::string in_quotes(const std::string& text) { return "\"" + text + "\""; }

std::string csv_of(const std::vector<Comparison>& rows) {
  std::string text = "quantity,paper,here,verdict\n";
  for (const Comparison& row : rows)
    text += fmt::format("{},{},{},{}\n", in_quotes(row.quantity), in_quotes(row.paper), in_quotes(row.ours),
                        row.verdict);
  return text;
}

/// Fig. 4 as a table of what was run.
std::string table_of_runs(const EnsembleTables& tables) {
  const Samples samples(tables);
  std::string text =
      "<table><tr><th>protocol</th><th>how</th><th>packings</th><th>mean M</th><th>mean R (mg)</th><th>mean "
      "overlap "
      "(r<sub>max</sub>)</th><th>came to rest</th></tr>\n";
  for (const sim::ProtocolProperties& properties : sim::kProtocols) {
    const sim::Protocol protocol = properties.protocol;
    if (!samples.has({protocol})) continue;
    const bool simulates = properties.simulator.has_value();
    int still = 0;
    for (std::size_t row = 0; row < tables.runs.rows(); ++row) {
      if (samples.protocols()[row] == protocol && tables.runs.text("ending", row) == "static") ++still;
    }
    const std::vector<double> contacts = samples.runs(protocol, "contacts");
    const auto mean = [&](const char* column, const char* format) {
      const double value = mean_of(samples.runs(protocol, column)).value;
      return std::isnan(value) ? "–" : fmt::format(fmt::runtime(format), value);
    };
    text += fmt::format(
        "<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
        properties.name, properties.description, contacts.size(), mean("contacts", "{:.1f}"),
        mean("mean_R", "{:.2f}"), mean("mean_overlap", "{:.1e}"), simulates ? std::to_string(still) : "–");
  }
  return text + "</table>\n";
}

std::string table_of_times(const EnsembleTables& tables) {
  std::string text =
      "<table><tr><th>stage</th><th>seconds per packing</th><th>longest</th><th>in all</th></tr>\n";
  for (const auto& column : tables.timings.columns()) {
    double sum = 0;
    double longest = 0;
    if (std::isnan(mean_of(column.reals).value)) continue;  // not done for any packing
    for (const double value : column.reals) {
      if (std::isnan(value)) continue;
      sum += value;
      longest = std::max(longest, value);
    }
    text += fmt::format("<tr><td>{}</td><td>{:.2f}</td><td>{:.2f}</td><td>{:.1f}</td></tr>\n",
                        column.label.long_name, mean_of(column.reals).value, longest, sum);
  }
  return text + "</table>\n";
}

std::string failures(const EnsembleContents& contents) {
  if (contents.failures.empty() && contents.missing.empty()) return "<p>No packing failed.</p>\n";
  std::string text = "<ul>\n";
  for (const ItemFailure& failure : contents.failures)
    text += fmt::format("<li>{}: {}</li>\n", escaped(failure.item), escaped(failure.reason));
  for (const std::string& name : contents.missing)
    text += fmt::format("<li>{} is missing</li>\n", escaped(name));
  return text + "</ul>\n";
}

std::string table_of(const std::vector<std::vector<std::string>>& rows) {
  std::string text = "<table class=\"numbers\">\n";
  for (const auto& row : rows) {
    const char* cell = &row == rows.data() ? "th" : "td";
    text += "<tr>";
    for (const std::string& value : row) text += fmt::format("<{0}>{1}</{0}>", cell, escaped(value));
    text += "</tr>\n";
  }
  return text + "</table>\n";
}

std::string csv_of(const std::vector<std::vector<std::string>>& rows) {
  std::string text;
  for (const auto& row : rows) {
    for (const std::string& value : row) text += (&value == row.data() ? "" : ",") + in_quotes(value);
    text += '\n';
  }
  return text;
}

std::string section_of_uniform_sampling(const EnsembleTables& tables, const std::filesystem::path& folder) {
  const std::vector<std::vector<std::string>> summary = uniform_summary(tables);
  if (summary.empty()) return "";
  write_whole_file(folder / "uniform.csv", csv_of(summary));
  return "<h2>Are all contact states equally likely?</h2>\n"
         "<p>Perturb-and-resolve [38] and the simulated states beside a uniform sample of the same "
         "polytopes. "
         "± is one standard error over the packings. The figures are at the end.</p>\n" +
         table_of(summary) + "<p class=\"note\">File: figures/uniform.csv</p>\n";
}

std::string section_of_limits(const EnsembleTables& tables, const std::filesystem::path& folder) {
  const std::vector<std::vector<std::string>> summary = limit_summary(tables);
  if (summary.empty()) return "";
  write_whole_file(folder / "limits.csv", csv_of(summary));
  return "<h2>How far are the packings from yielding?</h2>\n"
         "<p>The tilt, load and friction beyond which no contact forces balance the packing. They follow "
         "from "
         "its contacts alone, whatever its simulated forces are. ± is one standard error; that of CD − MD is "
         "of differences between packings of one seed. The more stable is named where the difference is "
         "above two standard errors. The figures are below.</p>\n" +
         table_of(summary) + "<p class=\"note\">File: figures/limits.csv</p>\n";
}

std::string section_of(const Figure& figure, const std::filesystem::path& folder) {
  const std::string claim =
      figure.claim.empty() ? "" : fmt::format("<b>Paper:</b> {}<br>", escaped(figure.claim));
  return fmt::format(
      "<h2>{}</h2>\n<figure id=\"{}\">\n{}\n<figcaption>{}</figcaption></figure>\n<p>{}<b>Here:</b> "
      "{}</p>\n<p class=\"note\">Files: figures/{}.svg, .pdf, .csv, .gp</p>\n",
      escaped(figure.title), figure.id, inline_svg(folder / (figure.id + ".svg"), figure.id),
      escaped(figure.caption), claim, escaped(figure.finding), figure.id);
}

}  // namespace

void write_report(const std::filesystem::path& folder, const EnsembleContents& contents,
                  const std::vector<Picture>& pictures,
                  const std::vector<std::pair<std::string, std::string>>& about,
                  const ProgressCallback& progress) {
  const std::filesystem::path figures_folder = folder / "figures";
  make_folder(figures_folder);
  const FlatTable& runs = contents.tables.runs;
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Force indeterminacy: "
      "report</title>\n"
      "<link rel=\"icon\" href=\"data:,\"><style>";
  html += kStyle;
  html += "</style></head><body>\n<h1>Force indeterminacy of an ensemble of packings</h1>\n";
  html += fmt::format(
      "<p>{}, {}. Forces and distances are in units of mg, the mean weight of a disk, or the unit of force "
      "that a scene names. ± is one standard error over the seeds. The paper is S. McNamara and H. J. "
      "Herrmann, Phys. Rev. E 70, 061303 (2004), N = 95, μ = 0.3, 60 seeds; numbers in brackets are its "
      "equations.</p>\n",
      counted(static_cast<std::int64_t>(runs.rows()), "packing"),
      counted(static_cast<std::int64_t>(contents.tables.contacts.rows()), "contact"));
  html += "<h2>What was run (Fig. 4)</h2>\n" + table_of_runs(contents.tables);
  const std::vector<Comparison> comparison = compare_with_paper(contents.tables);
  write_whole_file(figures_folder / "comparison.csv", csv_of(comparison));
  html += "<h2>The paper's numbers</h2>\n" + comparison_table(comparison);
  html += note_on_verdicts(contents.tables);
  html += "<h2>Beyond the paper</h2>\n" + table_beyond_the_paper(beyond_the_paper(contents.tables));
  html += section_of_limits(contents.tables, figures_folder);
  html += section_of_uniform_sampling(contents.tables, figures_folder);
  if (!pictures.empty()) {
    html += "<h2>Fig. 5: three contact states</h2>\n<div class=\"row\">\n";
    for (const Picture& picture : pictures) {
      html += fmt::format("<figure id=\"{0}\">{1}<figcaption>{2}</figcaption></figure>\n", picture.file,
                          inline_svg(figures_folder / (picture.file + ".svg"), picture.file),
                          escaped(picture.caption));
    }
    html += "</div>\n";
  }
  const std::vector<Figure> figures = make_figures(contents.tables);
  for (std::size_t i = 0; i < figures.size(); ++i) {
    if (progress && !progress({.stage = "drawing",
                               .done = static_cast<std::int64_t>(i),
                               .total = static_cast<std::int64_t>(figures.size()),
                               .details = figures[i].id}))
      throw Interrupted();
    draw_figure(figures_folder, figures[i]);
    html += section_of(figures[i], figures_folder);
  }
  html += "<h2>Run times</h2>\n" + table_of_times(contents.tables);
  html += "<h2>Failures</h2>\n" + failures(contents);
  html += "<h2>Provenance</h2>\n<table>\n";
  for (const auto& [name, value] : about)
    html += fmt::format("<tr><th>{}</th><td>{}</td></tr>\n", escaped(name), escaped(value));
  html += fmt::format(
      "</table>\n<details><summary>Configuration</summary><pre>{}</pre></details>\n</body></html>\n",
      escaped(contents.config));
  write_whole_file(folder / "report.html", html);
}

}  // namespace indet
