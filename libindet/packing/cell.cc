#include "libindet/packing/cell.h"

#include <algorithm>

#include "libindet/base/doubled_sum.h"

namespace indet {

double Cell::area() const {
  DoubledSum sum;
  sum.add_product(a->x(), b->y());
  sum.add_product(-a->y(), b->x());
  return std::abs(sum.value());
}

double* Stress::find(std::string_view name) {
  const std::array<double*, 4> places = {&xx, &yy, &xy, &pressure};
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (name == kNames[k]) return places[k];
  }
  return nullptr;
}

const char* Stress::contradiction() const {
  if (std::isnan(pressure) || (std::isnan(xx) && std::isnan(yy))) return nullptr;
  return "the pressure is (xx + yy)/2, so that it cannot be given beside xx or yy";
}

int Stress::imposed_count() const {
  int count = 0;
  for (const double component : components()) count += std::isnan(component) ? 0 : 1;
  return count;
}

double Stress::largest() const {
  double largest = 0;
  for (const double component : components()) {
    if (!std::isnan(component)) largest = std::max(largest, std::abs(component));
  }
  return largest;
}

Eigen::Matrix2d compression(const std::array<double, 4>& multipliers) {
  const auto [xx, yy, xy, both] = multipliers;
  Eigen::Matrix2d rate;
  rate << xx + both / 2, xy, 0, yy + both / 2;
  return rate;
}

}  // namespace indet
