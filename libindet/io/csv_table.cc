#include "libindet/io/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "libindet/base/error.h"
#include "libindet/base/printable.h"

namespace indet {
namespace {

constexpr std::string_view kSeparators = ",;\t";

/// The lines of a file that hold something, without comments, and messages that name them. A line whose last
/// field has an open quotation mark goes on in the next one.
class CsvLines {
 public:
  CsvLines(std::string source, std::string_view text) : source_(std::move(source)), reader_(text) {}

  /// False at the end of the text.
  bool next(std::string_view* line) {
    while (reader_.next(line)) {
      number_ = reader_.line_number();
      std::string_view more;
      std::size_t read = 0;
      bool quoted = false;
      while (!find_end(line, &read, &quoted)) {
        if (!reader_.next(&more)) fail("a double quote is not closed");
        *line = {line->data(), more.data() + more.size()};
      }
      if (!trimmed(*line).empty()) return true;
    }
    return false;
  }
  int number() const { return number_; }
  [[noreturn]] void fail(const std::string& reason) const {
    throw InputError(fmt::format("{}:{}: {}", source_, number(), reason));
  }

 private:
  /// Cuts a comment off, which a # within quotes does not begin. False if a quotation mark is open at the
  /// end; with more lines it goes on from there.
  bool find_end(std::string_view* line, std::size_t* read, bool* open) const {
    bool quoted = *open;
    for (std::size_t i = *read; i < line->size(); ++i) {
      const char c = (*line)[i];
      if (c == '"') quoted = !quoted;
      if (c == '\r' && !quoted && line->find_first_not_of('\r', i) != std::string_view::npos)
        fail("a carriage return alone ends this line: save the file with the line ends of Unix or Windows");
      if (c != '#' || quoted) continue;
      *line = line->substr(0, i);
      return true;
    }
    *read = line->size();
    *open = quoted;
    return !quoted;
  }

  std::string source_;
  LineReader reader_;
  int number_ = 0;
};

std::string_view unquoted(std::string_view field) {
  field = trimmed(field);
  if (field.size() < 2 || field.front() != '"' || field.back() != '"') return field;
  return field.substr(1, field.size() - 2);
}

/// Makes one quotation mark of two, in the text itself.
std::string_view with_single_marks(std::string_view field, std::string& text) {
  if (field.find("\"\"") == std::string_view::npos) return field;
  const auto begin = text.begin() + (field.data() - text.data());
  auto end = begin;
  for (std::size_t i = 0; i < field.size(); ++i) {
    const char c = field[i];
    *end++ = c;
    if (c == '"' && i + 1 < field.size() && field[i + 1] == '"') ++i;
  }
  return field.substr(0, static_cast<std::size_t>(end - begin));
}

std::vector<std::string_view> split_fields(std::string_view line, char separator) {
  std::vector<std::string_view> fields;
  bool quoted = false;
  std::size_t start = 0;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i < line.size() && line[i] == '"') quoted = !quoted;
    if (i < line.size() && (line[i] != separator || quoted)) continue;
    fields.push_back(unquoted(line.substr(start, i - start)));
    start = i + 1;
  }
  return fields;
}

/// What a line `sep=;` names. (A tab at its end is not white space.)
std::optional<char> named_separator(const CsvLines& lines, std::string_view line) {
  if (line.size() > 1 && line.front() == '"') line = line.substr(1, line.find('"', 1) - 1);
  constexpr std::string_view kName = "sep=";
  const auto same = [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); };
  if (line.size() <= kName.size() || !std::equal(kName.begin(), kName.end(), line.begin(), same)) return {};
  const char separator = line[kName.size()];
  if (kSeparators.find(separator) == std::string_view::npos) {
    lines.fail(fmt::format("fields are separated by commas, semicolons or tabs, not by \"{}\"", separator));
  }
  return separator;
}

char separator_of_header(const CsvLines& lines, std::string_view header) {
  for (const char separator : kSeparators) {
    if (split_fields(header, separator).size() > 1) return separator;
  }
  if (split_words(header).size() > 1) {
    lines.fail("fields must be separated by commas, semicolons or tabs, not by blanks");
  }
  return ',';
}

/// Turns the decimal commas of a file into points, and refuses both in one file: one of them would then
/// separate thousands.
class DecimalMarks {
 public:
  DecimalMarks(const CsvLines& lines, std::string& text) : lines_(lines), text_(text) {}

  void read(std::string_view field) {
    double value = 0;
    if (parse_number(field, &value)) {
      if (field.find('.') != std::string_view::npos) note(field, point_, comma_);
      return;
    }
    const std::size_t comma = field.find(',');
    if (comma == std::string_view::npos) return;
    std::string with_point(field);
    with_point[comma] = '.';
    if (!parse_number(with_point, &value)) return;
    note(field, comma_, point_);
    text_[static_cast<std::size_t>(field.data() - text_.data()) + comma] = '.';
  }

 private:
  struct Seen {
    int line = 0;
    std::string field;
  };
  void note(std::string_view field, Seen& seen, const Seen& other) const {
    if (other.line > 0) {
      lines_.fail(fmt::format("the number \"{}\" has another decimal mark than \"{}\" in line {}",
                              excerpt(field), excerpt(other.field), other.line));
    }
    if (seen.line == 0) seen = {lines_.number(), std::string(field)};
  }

  const CsvLines& lines_;
  std::string& text_;
  Seen point_, comma_;
};

/// pandas writes the index of a frame as a first column without a name, and calls it so when it reads that
/// back.
bool is_index_name(std::string_view name) { return name.empty() || name == "Unnamed: 0"; }

std::vector<std::string> read_header(const CsvLines& lines, std::string_view line, char separator) {
  std::vector<std::string> columns;
  for (const std::string_view field : split_fields(line, separator)) columns.emplace_back(trimmed(field));
  double value = 0;
  if (parse_number(columns.front(), &value)) {
    lines.fail(fmt::format("the first line must name the columns, but begins with the number {}",
                           excerpt(columns.front())));
  }
  return columns;
}

void require_row_number(const CsvLines& lines, std::string_view field) {
  std::int64_t row = 0;
  if (parse_number(field, &row)) return;
  lines.fail(
      fmt::format("the first column has no name, so it must be the row numbers of pandas, but here it "
                  "has \"{}\": name it, or leave it out",
                  excerpt(field)));
}

}  // namespace

Table read_csv(const std::filesystem::path& path) {
  const auto text = std::make_shared<std::string>(*read_text(path));  // decimal commas become points in it
  CsvLines lines(path.string(), *text);
  std::string_view line;
  bool found = lines.next(&line);
  const std::optional<char> named = found ? named_separator(lines, line) : std::nullopt;
  if (named) found = lines.next(&line);
  if (!found) throw InputError(fmt::format("{}: the file is empty; it needs a header", path.string()));
  const char separator = named ? *named : separator_of_header(lines, line);
  std::vector<std::string> columns = read_header(lines, line, separator);
  const bool has_index = columns.size() > 1 && is_index_name(columns.front());
  if (has_index) columns.erase(columns.begin());

  Table table(path.string(), text, lines.number(), std::move(columns));
  DecimalMarks marks(lines, *text);
  while (lines.next(&line)) {
    std::vector<std::string_view> fields = split_fields(line, separator);
    if (separator != ',') {
      for (const std::string_view field : fields) marks.read(field);
    }
    if (has_index) {
      require_row_number(lines, fields.front());
      fields.erase(fields.begin());
    }
    for (std::string_view& field : fields) field = with_single_marks(field, *text);
    const bool hint = separator == ',' && fields.size() > table.columns().size();
    table.add_row(lines.number(), std::move(fields),
                  hint ? "; decimal commas are read only where semicolons separate the fields" : "");
  }
  return table;
}

}  // namespace indet
