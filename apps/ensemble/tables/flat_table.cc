#include "apps/ensemble/tables/flat_table.h"

#include <cmath>
#include <limits>
#include <utility>

namespace indet {

FlatTable::Column FlatTable::real(std::string name, std::string unit, std::string long_name) {
  return {.name = std::move(name), .kind = Kind::kReal, .label = {std::move(unit), std::move(long_name)}};
}

FlatTable::Column FlatTable::integer(std::string name, std::string long_name) {
  return {.name = std::move(name), .kind = Kind::kInteger, .label = {"1", std::move(long_name)}};
}

FlatTable::Column FlatTable::text(std::string name, std::string long_name) {
  return {.name = std::move(name), .kind = Kind::kText, .label = {"1", std::move(long_name)}};
}

FlatTable::FlatTable(std::vector<Column> columns) : columns_(std::move(columns)) {
  for (std::size_t i = 0; i < columns_.size(); ++i) index_[columns_[i].name] = i;
}

const FlatTable::Column& FlatTable::find(const std::string& name) const { return columns_[index_.at(name)]; }

void FlatTable::add_rows(std::size_t count) {
  rows_ += count;
  for (Column& column : columns_) {
    if (column.kind == Kind::kReal) column.reals.resize(rows_, std::numeric_limits<double>::quiet_NaN());
    if (column.kind == Kind::kInteger) column.integers.resize(rows_, -1);
    if (column.kind == Kind::kText) column.texts.resize(rows_);
  }
}

void FlatTable::set(const std::string& column, std::size_t row, double value) {
  Column& c = columns_[index_.at(column)];
  if (c.kind == Kind::kReal) c.reals.at(row) = value;
  if (c.kind == Kind::kInteger) c.integers.at(row) = static_cast<std::int32_t>(value);
}

void FlatTable::set(const std::string& column, std::size_t row, const std::string& value) {
  columns_[index_.at(column)].texts.at(row) = value;
}

double FlatTable::number(const std::string& column, std::size_t row) const {
  const Column& c = find(column);
  return c.kind == Kind::kReal ? c.reals.at(row) : c.integers.at(row);
}

const std::string& FlatTable::text(const std::string& column, std::size_t row) const {
  return find(column).texts.at(row);
}

double FlatTable::sum(const std::string& column) const {
  double result = 0;
  for (const double value : numbers(column)) result += std::isnan(value) ? 0 : value;
  return result;
}

std::vector<double> FlatTable::numbers(const std::string& column) const {
  const Column& c = find(column);
  if (c.kind == Kind::kReal) return c.reals;
  return {c.integers.begin(), c.integers.end()};
}

void FlatTable::write(Hdf5File& file, const std::string& group) const {
  file.make_group(group);
  for (const Column& c : columns_) {
    const std::string path = group + "/" + c.name;
    if (c.kind == Kind::kReal) file.write(path, c.reals, {rows_}, c.label);
    if (c.kind == Kind::kInteger) file.write(path, c.integers, {rows_}, c.label);
    if (c.kind == Kind::kText) file.write_strings(path, c.texts, c.label);
  }
}

void FlatTable::read(const Hdf5File& file, const std::string& group) {
  rows_ = file.shape(group + "/" + columns_.front().name, 1)[0];
  for (Column& c : columns_) {
    const std::string path = group + "/" + c.name;
    if (c.kind == Kind::kReal) c.reals = file.read_doubles(path, {rows_});
    if (c.kind == Kind::kInteger) c.integers = file.read_integers(path, {rows_});
    if (c.kind == Kind::kText) c.texts = file.read_strings(path, rows_);
  }
}

void append_columns(std::span<const AttributeColumn> attributes, std::vector<FlatTable::Column>& columns) {
  for (const AttributeColumn& a : attributes)
    columns.push_back(FlatTable::real(a.column, a.unit, a.long_name));
}

void take_attributes(const Hdf5File& file, std::span<const AttributeColumn> attributes, std::size_t row,
                     FlatTable& table) {
  for (const AttributeColumn& a : attributes) {
    if (file.has(a.group) && file.has_attribute(a.group, a.attribute))
      table.set(a.column, row, file.double_attribute(a.group, a.attribute));
  }
}

}  // namespace indet
