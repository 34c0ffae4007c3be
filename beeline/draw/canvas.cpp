#include <beeline/draw/figure.h>
#include <beeline/draw/internal/cairo.h>
#include <beeline/draw/internal/svg.h>
#include <beeline/error.h>
#include <beeline/io/text/file.h>

namespace beeline {

Format format_of(std::string_view path) {
  const std::string ending = extension(path);
  if (ending == "svg") return Format::svg;
  if (ending == "png") return Format::png;
  if (ending == "pdf") return Format::pdf;
  throw Error("unknown picture format in \"" + std::string(path) +
              "\"; it must end in .svg, .png or .pdf");
}

std::string render(const Picture& picture, Format format) {
  if (format == Format::svg) return internal::svg_of(picture);
#ifdef BEELINE_CAIRO
  return format == Format::png ? internal::png_of(picture) : internal::pdf_of(picture);
#else
  throw Error(
      "this build writes no PNG and PDF pictures, only .svg: configure it with "
      "-DBEELINE_CAIRO=ON, which needs Cairo (Debian: libcairo2-dev)");
#endif
}

std::string render(const Figure& figure, Format format) { return render(compose(figure), format); }

void save(const Figure& figure, const std::string& path) {
  write_file(path, render(figure, format_of(path)));
}

}  // namespace beeline
