#include "tests/support/periodic_lattice.h"

#include <cmath>
#include <utility>

#include "tests/support/scene_builder.h"

namespace indet::zoo {

Packing periodic_lattice(int columns, int rows, double mu, double disorder) {
  Packing packing;
  packing.named_force_unit = 1;
  const Vector2 up(0.5, std::sqrt(3) / 2);
  packing.cell.a = Vector2(columns, 0);
  packing.cell.b = rows * up;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const Vector2 shift(std::sin(3 * i + 7 * j), std::cos(5 * i - 2 * j));
      add_disk(packing, Vector2(i, 0) + j * up + disorder * shift, 0.5);
    }
  }
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      for (const auto& [di, dj] : {std::pair(1, 0), {0, 1}, {-1, 1}}) {
        const int x = i + di + columns;
        const int y = j + dj;
        Contact contact;
        contact.a = DiskId(j * columns + i);
        contact.b = Body::disk(DiskId(y % rows * columns + x % columns));
        contact.image = {x / columns - 1, y / rows};
        contact.normal = geometric_normal(packing, contact.a, contact.b, contact.image);
        contact.gap = geometric_gap(packing, contact.a, contact.b, contact.image);
        contact.mu = mu;
        packing.contacts.push_back(contact);
      }
    }
  }
  packing.stress.xx = 1;
  packing.stress.yy = 1.1;
  packing.stress.xy = 0.05;
  return packing;
}

}  // namespace indet::zoo
