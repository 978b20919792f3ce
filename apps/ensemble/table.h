#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "indet/ensemble/plan.h"
#include "indet/ensemble/run.h"
#include "indet/io/hdf5_file.h"

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

/// Everything that figures and statistics are made from, with one row a packing, a contact, and a bin.
/// Forces and distances are in units of mg, lengths in r_max, times in √(r_max/g).
struct EnsembleTables {
  FlatTable runs;      ///< One row a packing, in the order of the plan.
  FlatTable contacts;  ///< One row a contact; `run` is the row of its packing.
  FlatTable extremal;  ///< Histogram of R in the extremal states: run, choice, objective, bin, count.
  FlatTable sampled;   ///< Distributions of R under both samplings, one row a bin (uniform_tables.h).
  FlatTable timings;   ///< Seconds by stage, one row a packing.

  EnsembleTables();
};

/// What a plan asks for and what is there.
struct Collection {
  EnsembleTables tables;
  std::vector<std::string> missing;  ///< Units without a complete file of their configuration.
};

/// Reads the unit files of `folders` (parts of one ensemble). Throws InputError if a unit is in two folders
/// that are not the same one.
Collection collect_units(const Plan& plan, const std::vector<std::filesystem::path>& folders,
                         const ProgressCallback& progress = {});

}  // namespace indet
