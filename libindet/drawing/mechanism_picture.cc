#include "libindet/drawing/mechanism_picture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libindet/drawing/palette.h"
#include "libindet/drawing/sheet.h"

namespace indet {
namespace {

const Colour kMovingFill{0.80, 0.88, 0.95};

/// How a contact is drawn.
double thickness_of(ContactMotion motion) { return motion == ContactMotion::kRests ? 0.5 : 1.6; }
const Colour& colour_of(ContactMotion motion) {
  if (motion == ContactMotion::kOpens) return palette::kUnbounded;
  return motion == ContactMotion::kSlides ? palette::kPositive : palette::kDiskOutline;
}

void draw_arrow(Canvas& canvas, const Vector2& from, const Vector2& along, const Colour& colour) {
  const double length = along.norm();
  if (length < 0.5) return;
  const Vector2 towards = along / length;
  const Vector2 side(-towards.y(), towards.x());
  const double head = std::min(5.0, 0.5 * length);
  const Vector2 tip = from + along;
  const Vector2 neck = tip - head * towards;
  canvas.line(from, neck, 1.2, colour, false, false);
  canvas.polygon({tip, neck + 0.45 * head * side, neck - 0.45 * head * side}, colour);
}

/// An arc about the centre of a disk that turns, as long as the way of a point of its edge, with a head.
void draw_spin(Canvas& canvas, const Vector2& centre, double radius, double way, const Colour& colour) {
  const double angle = std::min(std::abs(way) / radius, 1.8 * std::numbers::pi);
  if (angle * radius < 1.5) return;
  const double sense = way > 0 ? -1 : 1;  // the page has y downwards
  const auto point = [&](double share) -> Vector2 {
    const double phi = std::numbers::pi / 2 + sense * (share - 0.5) * angle;
    return centre + radius * Vector2(std::cos(phi), std::sin(phi));
  };
  constexpr int kPieces = 24;
  for (int k = 0; k < kPieces; ++k)
    canvas.line(point(1.0 * k / kPieces), point((k + 1.0) / kPieces), 0.8, colour, false, false);
  const Vector2 tip = point(1);
  const Vector2 along = (tip - point(1 - 1.0 / kPieces)).normalized();
  const Vector2 side(-along.y(), along.x());
  canvas.polygon({tip + 3 * along, tip + 1.6 * side, tip - 1.6 * side}, colour);
}

std::vector<LegendItem> legend_of(const std::vector<ContactMotion>& motions) {
  std::vector<LegendItem> items = {{22,
                                    [](Canvas& canvas, const Vector2& at) {
                                      draw_arrow(canvas, at, {22, 0}, palette::kNegative);
                                    },
                                    "velocity of a disk (the arc below its centre: it turns)"}};
  const auto add = [&](ContactMotion motion, const char* text) {
    if (std::find(motions.begin(), motions.end(), motion) == motions.end()) return;
    items.push_back({22,
                     [motion](Canvas& canvas, const Vector2& at) {
                       canvas.line(at, at + Vector2(22, 0), thickness_of(motion), colour_of(motion),
                                   motion == ContactMotion::kOpens, false);
                     },
                     text});
  };
  add(ContactMotion::kOpens, "contact opens");
  add(ContactMotion::kSlides, "contact slides");
  add(ContactMotion::kRests, "contact holds");
  return items;
}

}  // namespace

void draw_mechanism(const std::filesystem::path& path, const Packing& packing,
                    const exact::BodyMotion& motion, const std::string& caption) {
  const std::vector<ContactMotion> motions = contact_motions(packing, motion);
  Sheet sheet(
      path, packing, caption, [&](const Sheet&) { return legend_of(motions); }, 0);
  sheet.draw_bodies();
  Canvas& canvas = sheet.canvas();
  const double per_radius = sheet.radius();
  double fastest = 0;
  for (Eigen::Index i = 0; i < motion.disks.rows(); ++i)
    fastest = std::max(fastest, motion.disks.row(i).lpNorm<Eigen::Infinity>());
  const double scale = fastest > 0 ? 2 * per_radius / fastest : 0;
  // The radius on the page of one length of the scene: from two points of it.
  const double length = (sheet.place({1, 0}) - sheet.place({0, 0})).norm();
  for (const DiskId disk : moving_disks(motion)) {
    const Disk& body = packing[disk];
    canvas.disk(sheet.place(body.position), body.radius * length, kMovingFill, palette::kNegative, 0.8);
  }
  for (int i = 0; i < packing.contact_count(); ++i) {
    const Contact& contact = packing[ContactId(i)];
    const ContactMotion what = motions[static_cast<std::size_t>(i)];
    for (const Sheet::Line& line : sheet.lines(contact))
      canvas.line(line.from, line.to, thickness_of(what), colour_of(what), what == ContactMotion::kOpens,
                  false);
  }
  for (const DiskId disk : moving_disks(motion)) {
    const Disk& body = packing[disk];
    const Vector2 centre = sheet.place(body.position);
    const Vector2 velocity = motion.disks.row(disk.value()).head<2>();
    draw_spin(canvas, centre, 0.55 * body.radius * length, scale * motion.disks(disk.value(), 2),
              palette::kBlack);
    draw_arrow(canvas, centre, scale * Sheet::direction(velocity), palette::kNegative);
  }
  for (Eigen::Index w = 0; w < motion.walls.rows(); ++w) {
    const Wall& wall = packing.walls[static_cast<std::size_t>(w)];
    const Vector2 velocity = motion.walls(w, 0) * wall.normal + motion.walls(w, 1) * wall.tangent();
    draw_arrow(canvas, sheet.place(wall.point), scale * Sheet::direction(velocity), palette::kLoad);
  }
  sheet.finish();
}

}  // namespace indet
