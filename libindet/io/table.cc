#include "libindet/io/table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <string_view>
#include <system_error>
#include <utility>

#include "libindet/base/counted.h"
#include "libindet/base/error.h"
#include "libindet/base/printable.h"
#include "libindet/io/gzip.h"
#include "libindet/io/utf8.h"

namespace indet {
namespace {

constexpr std::string_view kBlank = " \t\r\f\v";

template <class T>
bool parse_whole(std::string_view text, T* value) {
  text = trimmed(text);
  if (text.starts_with('+')) {
    text.remove_prefix(1);
    if (text.starts_with('-')) return false;
  }
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, *value);
  return error == std::errc() && stop == end && !text.empty();
}

/// Says by what a file is packed that cannot be unpacked here.
void require_unpacked(const std::filesystem::path& path, std::string_view bytes) {
  using namespace std::string_view_literals;
  constexpr std::pair<std::string_view, const char*> kPackers[] = {
      {"\x28\xB5\x2F\xFD"sv, "zstd"}, {"\3757zXZ"sv, "xz"}, {"BZh"sv, "bzip2"}, {"PK\x03\x04"sv, "zip"}};
  for (const auto& [start, packer] : kPackers) {
    if (!bytes.starts_with(start)) continue;
    throw InputError(fmt::format("{}: is packed by {}; unpack it first (gzip alone is understood)",
                                 path.string(), packer));
  }
}

}  // namespace

std::shared_ptr<const std::string> read_text(const std::filesystem::path& path) {
  std::error_code status;
  if (std::filesystem::is_directory(path, status)) {
    throw InputError(fmt::format("{}: is a folder, not a file", path.string()));
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    throw InputError(
        fmt::format("{}: cannot be read ({})", path.string(), std::generic_category().message(errno)));
  }
  auto text =
      std::make_shared<std::string>(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  if (stream.bad()) throw InputError(fmt::format("{}: reading failed", path.string()));
  if (is_gzip(*text)) *text = unpack_gzip(*text, path.string());
  if (text->starts_with("\xFF\xFE") || text->starts_with("\xFE\xFF")) {
    throw InputError(fmt::format("{}: is UTF-16 text; save it as UTF-8", path.string()));
  }
  require_unpacked(path, *text);
  if (text->starts_with("\xEF\xBB\xBF")) text->erase(0, 3);
  require_utf8(path, *text);
  return text;
}

bool parse_number(std::string_view text, double* value) { return parse_whole(text, value); }
bool parse_number(std::string_view text, std::int64_t* value) { return parse_whole(text, value); }

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::vector<std::string_view> split_words(std::string_view line) {
  std::vector<std::string_view> words;
  std::size_t start = line.find_first_not_of(kBlank);
  while (start != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(kBlank, start), line.size());
    words.push_back(line.substr(start, end - start));
    start = line.find_first_not_of(kBlank, end);
  }
  return words;
}

bool LineReader::next(std::string_view* line) {
  if (rest_.empty()) return false;
  const std::size_t end = rest_.find('\n');
  *line = rest_.substr(0, end);
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
  if (line->ends_with('\r')) line->remove_suffix(1);
  ++line_number_;
  return true;
}

Table::Table(std::string source, std::shared_ptr<const std::string> text, int header_line,
             std::vector<std::string> columns)
    : source_(std::move(source)),
      text_(std::move(text)),
      header_line_(header_line),
      columns_(std::move(columns)) {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (columns_[i].empty()) {
      throw InputError(fmt::format("{}:{}: column {} has no name", source_, header_line_, i + 1));
    }
    if (!index_.emplace(columns_[i], i).second) {
      throw InputError(
          fmt::format("{}:{}: column {} is given twice", source_, header_line_, excerpt(columns_[i])));
    }
  }
}

void Table::add_row(int line, std::vector<std::string_view> fields, std::string_view advice) {
  if (fields.size() != columns_.size()) {
    throw InputError(fmt::format("{}:{}: {}, but there are {} columns ({}){}", source_, line,
                                 counted(static_cast<std::int64_t>(fields.size()), "field"), columns_.size(),
                                 excerpt(fmt::format("{}", fmt::join(columns_, ", "))), advice));
  }
  lines_.push_back(line);
  fields_.insert(fields_.end(), fields.begin(), fields.end());
}

void Table::require(const std::vector<std::string>& columns) const {
  for (const std::string& column : columns) {
    if (has(column)) continue;
    throw InputError(fmt::format("{}:{}: column {} is missing; the file has {}", source_, header_line_,
                                 column, excerpt(fmt::format("{}", fmt::join(columns_, ", ")))));
  }
}

void Table::allow_only(const std::vector<std::string>& columns) const {
  for (const std::string& column : columns_) {
    if (std::find(columns.begin(), columns.end(), column) != columns.end()) continue;
    throw InputError(fmt::format("{}:{}: column {} is unknown; the known ones are {}", source_, header_line_,
                                 excerpt(column), fmt::join(columns, ", ")));
  }
}

std::string_view Table::text(int row, std::string_view column) const {
  const auto found = index_.find(column);
  if (found == index_.end()) require({std::string(column)});  // which throws
  return fields_[static_cast<std::size_t>(row) * columns_.size() + found->second];
}

bool Table::is_empty(int row, std::string_view column) const {
  return !has(column) || text(row, column).empty();
}

double Table::number(int row, std::string_view column) const {
  const std::string_view field = text(row, column);
  double value = 0;
  if (parse_number(field, &value)) return value;
  if (field.empty()) fail(row, column, "the field is empty");
  if (field.find(',') != std::string_view::npos) {
    fail(row, column,
         fmt::format("\"{}\" is not a number: it must have a decimal point and no separator of thousands "
                     "(a decimal comma is read where semicolons separate the fields)",
                     excerpt(field)));
  }
  fail(row, column, fmt::format("\"{}\" is not a number (or outside the range of a double)", excerpt(field)));
}

double Table::number_or(int row, std::string_view column, double fallback) const {
  return is_empty(row, column) ? fallback : number(row, column);
}

std::int32_t Table::integer(int row, std::string_view column) const {
  const std::string_view field = text(row, column);
  std::int64_t value = 0;
  if (!parse_number(field, &value)) {
    double real = 0;
    if (!parse_number(field, &real) || std::trunc(real) != real || std::abs(real) > 1e15) {
      fail(row, column, fmt::format("\"{}\" is not a whole number", excerpt(field)));
    }
    value = static_cast<std::int64_t>(real);
  }
  if (value < std::numeric_limits<std::int32_t>::min() || value > std::numeric_limits<std::int32_t>::max()) {
    fail(row, column, fmt::format("{} does not fit into 32 bits", value));
  }
  return static_cast<std::int32_t>(value);
}

void Table::fail(int row, const std::string& reason) const {
  throw InputError(fmt::format("{}:{}: {}", source_, line(row), reason));
}

void Table::fail(int row, std::string_view column, const std::string& reason) const {
  throw InputError(fmt::format("{}:{}: column {}: {}", source_, line(row), column, reason));
}

}  // namespace indet
