#include "libindet/drawing/canvas.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "libindet/base/error.h"
#include "libindet/io/picture_mark.h"
#include "libindet/io/whole_file.h"

namespace indet {
namespace {

constexpr const char* kFont = "sans-serif";
constexpr double kPixelsPerPoint = 300.0 / 72;
constexpr int kColourStops = 40;

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Cairo = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int size) {
  static_cast<std::string*>(bytes)->append(data, data + size);
  return CAIRO_STATUS_SUCCESS;
}

void check(cairo_status_t status) {
  if (status == CAIRO_STATUS_SUCCESS) return;
  throw LibraryError(fmt::format("Cairo cannot draw: {}", cairo_status_to_string(status)));
}

void set_font(cairo_t* cairo, double size) {
  cairo_select_font_face(cairo, kFont, CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo, size);
}

void set_colour(cairo_t* cairo, const Colour& colour) {
  cairo_set_source_rgb(cairo, colour.red, colour.green, colour.blue);
}

}  // namespace

struct Canvas::State {
  std::filesystem::path path;
  std::string bytes;
  bool pixels = false;
  Surface surface{nullptr, &cairo_surface_destroy};
  Cairo cairo{nullptr, &cairo_destroy};
};

Canvas::Canvas(const std::filesystem::path& path, double width, double height)
    : state_(std::make_unique<State>()) {
  state_->path = path;
  const std::string extension = path.extension().string();
  if (extension == ".svg") {
    state_->surface.reset(cairo_svg_surface_create_for_stream(&append, &state_->bytes, width, height));
    cairo_svg_surface_set_document_unit(state_->surface.get(), CAIRO_SVG_UNIT_PT);
  } else if (extension == ".pdf") {
    state_->surface.reset(cairo_pdf_surface_create_for_stream(&append, &state_->bytes, width, height));
    cairo_pdf_surface_set_metadata(state_->surface.get(), CAIRO_PDF_METADATA_CREATOR, kPdfCreator);
  } else if (extension == ".png") {
    state_->pixels = true;
    state_->surface.reset(cairo_image_surface_create(CAIRO_FORMAT_RGB24,
                                                     static_cast<int>(std::ceil(width * kPixelsPerPoint)),
                                                     static_cast<int>(std::ceil(height * kPixelsPerPoint))));
  } else {
    throw InputError(fmt::format("{}: pictures are written as .svg, .pdf or .png", path.string()));
  }
  check(cairo_surface_status(state_->surface.get()));
  state_->cairo.reset(cairo_create(state_->surface.get()));
  check(cairo_status(state_->cairo.get()));
  if (state_->pixels) {
    cairo_scale(state_->cairo.get(), kPixelsPerPoint, kPixelsPerPoint);
    set_colour(state_->cairo.get(), {1, 1, 1});
    cairo_paint(state_->cairo.get());
  }
}

Canvas::~Canvas() = default;

void Canvas::disk(const Vector2& centre, double radius, const Colour& fill, const Colour& outline,
                  double thickness) {
  cairo_t* cairo = state_->cairo.get();
  cairo_new_path(cairo);
  // The outline stays within the disk, so that touching disks do not overlap.
  cairo_arc(cairo, centre.x(), centre.y(), std::max(radius - 0.5 * thickness, 0.25 * radius), 0,
            2 * std::numbers::pi);
  cairo_close_path(cairo);
  set_colour(cairo, fill);
  cairo_fill_preserve(cairo);
  set_colour(cairo, outline);
  cairo_set_line_width(cairo, thickness);
  cairo_stroke(cairo);
}

void Canvas::hatch(const Vector2& centre, double radius, const Colour& colour, double thickness) {
  constexpr double kDistance = 3.5;  // of the lines, points
  const int lines = std::max(1, static_cast<int>(2 * radius / kDistance) - 1);
  const Vector2 along(std::numbers::sqrt2 / 2, -std::numbers::sqrt2 / 2);
  const Vector2 across(-along.y(), along.x());
  for (int i = 1; i <= lines; ++i) {
    const double offset = radius * (2.0 * i / (lines + 1) - 1);
    const double half = std::sqrt(radius * radius - offset * offset);
    const Vector2 middle = centre + offset * across;
    line(middle - half * along, middle + half * along, thickness, colour, false, false);
  }
}

void Canvas::line(const Vector2& from, const Vector2& to, double thickness, const Colour& colour, bool dashed,
                  bool round) {
  cairo_t* cairo = state_->cairo.get();
  cairo_new_path(cairo);
  cairo_move_to(cairo, from.x(), from.y());
  cairo_line_to(cairo, to.x(), to.y());
  set_colour(cairo, colour);
  cairo_set_line_width(cairo, thickness);
  cairo_set_line_cap(cairo, round ? CAIRO_LINE_CAP_ROUND : CAIRO_LINE_CAP_BUTT);
  const double dash = std::max(thickness, 2.0);
  const std::array<double, 2> dashes = {dash, dash};
  cairo_set_dash(cairo, dashes.data(), dashed ? 2 : 0, 0);
  cairo_stroke(cairo);
  cairo_set_dash(cairo, nullptr, 0, 0);
}

void Canvas::polygon(const std::vector<Vector2>& corners, const Colour& fill) {
  cairo_t* cairo = state_->cairo.get();
  if (corners.empty()) return;
  cairo_new_path(cairo);
  for (const Vector2& corner : corners) cairo_line_to(cairo, corner.x(), corner.y());
  cairo_close_path(cairo);
  set_colour(cairo, fill);
  cairo_fill(cairo);
}

void Canvas::colour_bar(const Vector2& corner, double width, double height) {
  cairo_t* cairo = state_->cairo.get();
  const std::unique_ptr<cairo_pattern_t, decltype(&cairo_pattern_destroy)> gradient(
      cairo_pattern_create_linear(corner.x(), 0, corner.x() + width, 0), &cairo_pattern_destroy);
  for (int i = 0; i <= kColourStops; ++i) {
    const double fraction = static_cast<double>(i) / kColourStops;
    const Colour colour = map_colour(fraction);
    cairo_pattern_add_color_stop_rgb(gradient.get(), fraction, colour.red, colour.green, colour.blue);
  }
  cairo_new_path(cairo);
  cairo_rectangle(cairo, corner.x(), corner.y(), width, height);
  cairo_set_source(cairo, gradient.get());
  cairo_fill_preserve(cairo);
  set_colour(cairo, {0, 0, 0});
  cairo_set_line_width(cairo, 0.4);
  cairo_stroke(cairo);
}

void Canvas::text(const Vector2& place, const std::string& text, double size, double align) {
  cairo_t* cairo = state_->cairo.get();
  set_font(cairo, size);
  set_colour(cairo, {0, 0, 0});
  cairo_move_to(cairo, place.x() - align * text_width(text, size), place.y());
  cairo_show_text(cairo, text.c_str());
}

void Canvas::finish() {
  check(cairo_status(state_->cairo.get()));
  if (state_->pixels) {
    check(cairo_surface_write_to_png_stream(state_->surface.get(), &append, &state_->bytes));
  } else {
    cairo_surface_finish(state_->surface.get());
    check(cairo_surface_status(state_->surface.get()));
  }
  if (state_->pixels) state_->bytes = mark_png(std::move(state_->bytes));
  if (state_->path.extension() == ".svg") state_->bytes = mark_svg(std::move(state_->bytes));
  write_whole_file(state_->path, state_->bytes);
}

double text_width(const std::string& text, double size) {
  const Surface surface(cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, nullptr),
                        &cairo_surface_destroy);
  const Cairo cairo(cairo_create(surface.get()), &cairo_destroy);
  set_font(cairo.get(), size);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo.get(), text.c_str(), &extents);
  return extents.x_advance;
}

}  // namespace indet
