#pragma once

#include <filesystem>

#include "libindet/io/table.h"

namespace indet {

/// Reads a table of text: a header with the names of the columns, then one row a line.
///
///   separator     comma, semicolon or tab: that of a first line `sep=;`, as Excel writes it, else the first
///                 of these three that the header has
///   decimal mark  a point; between semicolons or tabs also a comma, but not both in one file
///   first column  without a name (or "Unnamed: 0"), with whole numbers: the index that pandas writes; left
///                 out
///
/// Blank lines and everything from # to the end of the line are skipped; a field may stand in double quotes.
/// Throws InputError with file, line and reason.
Table read_csv(const std::filesystem::path& path);

}  // namespace indet
