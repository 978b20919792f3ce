#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace indet {

/// The text of a file, unpacked if it is a gzip file; it must be UTF-8, of which a byte order mark is
/// dropped. Throws InputError if it cannot be read, or with the line that holds other bytes.
std::shared_ptr<const std::string> read_text(const std::filesystem::path& path);

/// One number, independent of the locale: "1", "-1.5e3", "+2", "nan", "inf". The whole of `text` must be the
/// number.
bool parse_number(std::string_view text, double* value);
bool parse_number(std::string_view text, std::int64_t* value);

/// A table of text with named columns. It knows the line of each row, so that every message can say where the
/// trouble is: "scene/disks.csv:3: column mass: "heavy" is not a number". All members that read throw
/// InputError with such a message.
class Table {
 public:
  /// The columns in the order of the fields of a row. Fields are views into `text`. Throws if a column has no
  /// name or is given twice.
  Table(std::string source, std::shared_ptr<const std::string> text, int header_line,
        std::vector<std::string> columns);

  /// Throws if the number of fields is not that of the columns; `advice` is added to the message.
  void add_row(int line, std::vector<std::string_view> fields, std::string_view advice = {});

  int rows() const { return static_cast<int>(lines_.size()); }
  int line(int row) const { return lines_[static_cast<std::size_t>(row)]; }
  const std::string& source() const { return source_; }
  const std::vector<std::string>& columns() const { return columns_; }
  bool has(std::string_view column) const { return index_.contains(column); }

  /// Throws, naming the first one that is missing.
  void require(const std::vector<std::string>& columns) const;
  /// Throws, naming the first column that is none of these. A misspelt optional column would otherwise be
  /// silently ignored.
  void allow_only(const std::vector<std::string>& columns) const;

  /// True if the table has no such column, or its field in this row is empty.
  bool is_empty(int row, std::string_view column) const;
  std::string_view text(int row, std::string_view column) const;
  double number(int row, std::string_view column) const;
  double number_or(int row, std::string_view column, double fallback) const;
  /// A whole number, also as "3.0": pandas writes it so where the column has had an empty field.
  std::int32_t integer(int row, std::string_view column) const;

  /// Throws InputError: source, line, column if one is given, reason.
  [[noreturn]] void fail(int row, const std::string& reason) const;
  [[noreturn]] void fail(int row, std::string_view column, const std::string& reason) const;

 private:
  std::string source_;
  std::shared_ptr<const std::string> text_;
  int header_line_;
  std::vector<std::string> columns_;
  std::unordered_map<std::string_view, std::size_t> index_;
  std::vector<int> lines_;
  std::vector<std::string_view> fields_;  ///< rows × columns
};

/// The lines of a text, one at a time, without their ends (LF or CRLF).
class LineReader {
 public:
  explicit LineReader(std::string_view text) : rest_(text) {}
  /// False at the end of the text.
  bool next(std::string_view* line);
  int line_number() const { return line_number_; }  ///< Of the line last read, from 1.

 private:
  std::string_view rest_;
  int line_number_ = 0;
};

/// Without white space at both ends.
std::string_view trimmed(std::string_view text);
/// Split at runs of white space.
std::vector<std::string_view> split_words(std::string_view line);

}  // namespace indet
