#pragma once

#include <filesystem>
#include <string>

#include "apps/ensemble/tables/figure.h"

namespace indet {

/// The data of a figure: three columns a curve (x, y, standard error; empty where there is none).
std::string to_csv(const Figure& figure);

/// A gnuplot script that makes ID.svg and ID.pdf from ID.csv in the folder where it is run.
std::string to_gnuplot(const Figure& figure);

/// Writes ID.csv and ID.gp to the folder and runs gnuplot there, which makes ID.svg and ID.pdf. Throws
/// LibraryError if gnuplot is not installed or fails.
void draw_figure(const std::filesystem::path& folder, const Figure& figure);

}  // namespace indet
