#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "libindet/io/hdf5_file.h"

namespace indet {

/// A table by columns, all of the same length. Missing reals are NaN, missing integers −1, missing texts "".
class FlatTable {
 public:
  enum class Kind : std::uint8_t { kReal, kInteger, kText };
  struct Column {
    std::string name;
    Kind kind = Kind::kReal;
    Label label;
    std::vector<double> reals = {};
    std::vector<std::int32_t> integers = {};
    std::vector<std::string> texts = {};
  };

  static Column real(std::string name, std::string unit, std::string long_name);
  static Column integer(std::string name, std::string long_name);
  static Column text(std::string name, std::string long_name);

  explicit FlatTable(std::vector<Column> columns);

  std::size_t rows() const { return rows_; }
  const std::vector<Column>& columns() const { return columns_; }
  /// Adds rows whose cells are missing.
  void add_rows(std::size_t count);
  void set(const std::string& column, std::size_t row, double value);
  void set(const std::string& column, std::size_t row, const std::string& value);
  double number(const std::string& column, std::size_t row) const;
  const std::string& text(const std::string& column, std::size_t row) const;
  /// A column of reals or integers.
  std::vector<double> numbers(const std::string& column) const;
  /// Over the rows of such a column that have a value.
  double sum(const std::string& column) const;

  void write(Hdf5File& file, const std::string& group) const;
  /// Fills the columns from a file.
  void read(const Hdf5File& file, const std::string& group);

 private:
  const Column& find(const std::string& name) const;

  std::vector<Column> columns_;
  std::map<std::string, std::size_t> index_;
  std::size_t rows_ = 0;
};

/// A column of reals whose values are attributes of a group of other files, one a file.
struct AttributeColumn {
  const char* column;
  const char* group;
  const char* attribute;
  const char* unit;
  const char* long_name;
};
void append_columns(std::span<const AttributeColumn> attributes, std::vector<FlatTable::Column>& columns);
/// Those that the file has become the cells of a row.
void take_attributes(const Hdf5File& file, std::span<const AttributeColumn> attributes, std::size_t row,
                     FlatTable& table);

}  // namespace indet
