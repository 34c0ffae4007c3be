#include <cairo-pdf.h>
#include <cairo.h>
#include <cmath>
#include <memory>

#include <beeline/draw/internal/cairo.h>
#include <beeline/draw/internal/text.h>
#include <beeline/draw/internal/text_width.h>
#include <beeline/error.h>
#include <beeline/internal/shared_library.h>

namespace beeline::internal {
namespace {

constexpr double pixels_per_point = 2.5;

/// The functions of Cairo that are used here, without their prefix cairo_.
struct Cairo {
  SharedLibrary library{BEELINE_CAIRO_LIBRARY, "install Cairo, or write an .svg"};
#define BEELINE_FUNCTION(name) decltype(::cairo_##name)* name = library["cairo_" #name]
  BEELINE_FUNCTION(close_path);
  BEELINE_FUNCTION(create);
  BEELINE_FUNCTION(curve_to);
  BEELINE_FUNCTION(destroy);
  BEELINE_FUNCTION(fill_preserve);
  BEELINE_FUNCTION(font_options_create);
  BEELINE_FUNCTION(font_options_destroy);
  BEELINE_FUNCTION(font_options_set_antialias);
  BEELINE_FUNCTION(font_options_set_hint_metrics);
  BEELINE_FUNCTION(font_options_set_hint_style);
  BEELINE_FUNCTION(image_surface_create);
  BEELINE_FUNCTION(image_surface_get_data);
  BEELINE_FUNCTION(image_surface_get_stride);
  BEELINE_FUNCTION(line_to);
  BEELINE_FUNCTION(move_to);
  BEELINE_FUNCTION(new_path);
  BEELINE_FUNCTION(paint);
  BEELINE_FUNCTION(pdf_surface_create_for_stream);
  BEELINE_FUNCTION(pdf_surface_set_metadata);
  BEELINE_FUNCTION(restore);
  BEELINE_FUNCTION(rotate);
  BEELINE_FUNCTION(save);
  BEELINE_FUNCTION(scale);
  BEELINE_FUNCTION(select_font_face);
  BEELINE_FUNCTION(set_dash);
  BEELINE_FUNCTION(set_font_options);
  BEELINE_FUNCTION(set_font_size);
  BEELINE_FUNCTION(set_line_cap);
  BEELINE_FUNCTION(set_line_join);
  BEELINE_FUNCTION(set_line_width);
  BEELINE_FUNCTION(set_source_rgba);
  BEELINE_FUNCTION(show_text);
  BEELINE_FUNCTION(status);
  BEELINE_FUNCTION(status_to_string);
  BEELINE_FUNCTION(stroke);
  BEELINE_FUNCTION(surface_destroy);
  BEELINE_FUNCTION(surface_finish);
  BEELINE_FUNCTION(surface_flush);
  BEELINE_FUNCTION(surface_status);
  BEELINE_FUNCTION(surface_write_to_png_stream);
  BEELINE_FUNCTION(text_extents);
  BEELINE_FUNCTION(text_path);
  BEELINE_FUNCTION(translate);
#undef BEELINE_FUNCTION
};

/// Cairo, loaded by the first call. Throws Error where it cannot be.
const Cairo& cairo() {
  static const Cairo library;
  return library;
}

struct Destroy {
  void operator()(cairo_surface_t* surface) const { cairo().surface_destroy(surface); }
  void operator()(cairo_t* context) const { cairo().destroy(context); }
};
using Surface = std::unique_ptr<cairo_surface_t, Destroy>;
using Context = std::unique_ptr<cairo_t, Destroy>;

cairo_status_t append(void* bytes, const unsigned char* data, unsigned length) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

void check(cairo_status_t status) {
  if (status == CAIRO_STATUS_SUCCESS) return;
  throw Error(std::string("the picture could not be drawn: ") + cairo().status_to_string(status));
}

void set_colour(cairo_t* to, const Colour& colour) {
  cairo().set_source_rgba(to, colour.red, colour.green, colour.blue, colour.alpha);
}

void trace(cairo_t* to, const PaperPath& path) {
  const PaperPoint* p = path.points.data();
  cairo().new_path(to);
  for (const PaperPath::Verb verb : path.verbs) {
    switch (verb) {
      case PaperPath::Verb::move:
        cairo().move_to(to, p->x(), p->y());
        break;
      case PaperPath::Verb::line:
        cairo().line_to(to, p->x(), p->y());
        break;
      case PaperPath::Verb::close:
        cairo().close_path(to);
        continue;
      case PaperPath::Verb::curve:
        cairo().curve_to(to, p[0].x(), p[0].y(), p[1].x(), p[1].y(), p[2].x(), p[2].y());
        p += 2;
        break;
    }
    ++p;
  }
}

void put(cairo_t* to, const PaperStroke& stroke) {
  trace(to, stroke.path);
  if (stroke.fill.alpha > 0) {
    set_colour(to, stroke.fill);
    cairo().fill_preserve(to);
  }
  if (stroke.line.alpha > 0 && stroke.width > 0) {
    set_colour(to, stroke.line);
    cairo().set_line_width(to, stroke.width);
    // Round caps would close the gaps between dashes.
    cairo().set_line_cap(to, stroke.dashes.empty() ? CAIRO_LINE_CAP_ROUND : CAIRO_LINE_CAP_BUTT);
    cairo().set_dash(to, stroke.dashes.data(), static_cast<int>(stroke.dashes.size()), 0);
    cairo().stroke(to);
  }
  cairo().new_path(to);
}

void put(cairo_t* to, const PaperText& text) {
  const std::string words = drawable(text.text);
  cairo().select_font_face(to, typeface, CAIRO_FONT_SLANT_NORMAL,
                           text.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo().set_font_size(to, text.size);
  cairo().save(to);
  cairo().translate(to, text.centre.x(), text.centre.y());
  if (text.upright) cairo().rotate(to, -1.5707963267948966);
  cairo_text_extents_t extents;
  cairo().text_extents(to, words.c_str(), &extents);
  const double left = -extents.x_advance / 2;
  const double baseline = 0.36 * text.size;  // half the height of a capital letter
  if (text.halo) {
    cairo().move_to(to, left, baseline);
    cairo().text_path(to, words.c_str());
    set_colour(to, paper_white);
    cairo().set_line_width(to, 2.4);
    cairo().set_dash(to, nullptr, 0, 0);
    cairo().stroke(to);
  }
  set_colour(to, text.colour);
  cairo().move_to(to, left, baseline);
  cairo().show_text(to, words.c_str());
  cairo().restore(to);
}

void paint(cairo_surface_t* surface, const Picture& picture, double scale) {
  const Context context(cairo().create(surface));
  cairo_t* to = context.get();
  cairo().scale(to, scale, scale);
  cairo_font_options_t* options = cairo().font_options_create();
  cairo().font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo().font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo().font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo().set_font_options(to, options);
  cairo().font_options_destroy(options);
  cairo().set_line_join(to, CAIRO_LINE_JOIN_ROUND);
  set_colour(to, paper_white);
  cairo().paint(to);
  for (const PaperMark& mark : picture.marks) {
    std::visit([to](const auto& what) { put(to, what); }, mark);
  }
  check(cairo().status(to));
}

/// An image of the page, without an opacity channel.
Surface painted_image(const Picture& picture, int width, int height, double scale) {
  Surface surface(cairo().image_surface_create(CAIRO_FORMAT_RGB24, width, height));
  paint(surface.get(), picture, scale);
  return surface;
}

}  // namespace

std::string png_of(const Picture& picture) {
  std::string bytes;
  const auto pixels = [](double points) {
    return static_cast<int>(std::ceil(points * pixels_per_point));
  };
  const Surface surface =
      painted_image(picture, pixels(picture.width), pixels(picture.height), pixels_per_point);
  check(cairo().surface_write_to_png_stream(surface.get(), append, &bytes));
  return bytes;
}

std::string pdf_of(const Picture& picture) {
  std::string bytes;
  const Surface surface(
      cairo().pdf_surface_create_for_stream(append, &bytes, picture.width, picture.height));
  // A fixed creation date, so that equal figures give equal files.
  cairo().pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE,
                                   "1970-01-01T00:00:00Z");
  paint(surface.get(), picture, 1);
  cairo().surface_finish(surface.get());
  check(cairo().surface_status(surface.get()));
  return bytes;
}

std::string pixels_of(const Picture& picture, int width, int height, double scale) {
  const Surface surface = painted_image(picture, width, height, scale);
  cairo().surface_flush(surface.get());
  const auto* rows = reinterpret_cast<const char*>(cairo().image_surface_get_data(surface.get()));
  const int stride = cairo().image_surface_get_stride(surface.get());
  std::string pixels;
  for (int y = 0; y < height; ++y) {
    pixels.append(rows + std::ptrdiff_t{y} * stride, static_cast<std::size_t>(width) * 4);
  }
  return pixels;
}

}  // namespace beeline::internal
