#include <beeline/draw/figure.h>
#include <beeline/io/text/file.h>

#include "draw_fields.h"

namespace beeline::python {
namespace {

nb::str svg_of(const Picture& picture) {
  const std::string svg = without_lock([&] { return render(picture, Format::svg); });
  return nb::str(svg.data(), svg.size());
}

nb::str svg_of(const PlayedAnimation& played) {
  const std::string svg =
      without_lock([&] { return animated_svg(played.animation, played.playback); });
  return nb::str(svg.data(), svg.size());
}

/// Browsers play an animation inside <img>, where its style and identifiers stay its own.
nb::object html_of(const PlayedAnimation& played) {
  const nb::object encoded =
      nb::module_::import_("base64").attr("b64encode")(svg_of(played).attr("encode")());
  return nb::str("<img src=\"data:image/svg+xml;base64,") + encoded.attr("decode")() +
         nb::str("\" style=\"max-width: 100%\">");
}

/// Adds copies, which are the picture itself, as it never changes, and what refuses pickles.
template <class Picture>
void bind_copies(nb::class_<Picture>& picture, const std::string& name) {
  bind_copy(picture, name, itself);
  picture.def(
      "__reduce__",
      [](const Picture&) -> nb::object {
        throw nb::type_error("a picture has no pickle; pickle its svg, or what it is drawn from");
      },
      nb::sig("def __reduce__(self) -> typing.NoReturn"));
}

constexpr const char* svg_getter = "def svg(self) -> str";
constexpr const char* size_doc = "Points, 1/72 inch.";

void bind_picture(nb::module_& m) {
  nb::class_<Picture> picture(m, "Picture",
                              "A picture on a page. Notebooks show it; `save()` writes it.");
  picture.def_prop_ro(
      "svg", [](const Picture& self) { return svg_of(self); }, nb::for_getter(nb::sig(svg_getter)),
      "The picture as the text of an SVG file; equal for equal pictures.");
  picture.def_ro("width", &Picture::width, size_doc);
  picture.def_ro("height", &Picture::height, size_doc);
  Signature save("save", "None",
                 "Writes the picture in the format that the path's extension names. PNG and PDF "
                 "need a build with Cairo; without it they raise Error.");
  save.takes("self").takes("path", path_like, "A .svg, .png or .pdf file.");
  define(
      picture,
      [](const Picture& self, nb::handle path) {
        const std::string file = path_from(path, "path");
        without_lock([&] { write_file(file, render(self, format_of(file))); });
      },
      save, nb::arg("path"));
  picture.def("_repr_svg_", &notebook_svg);
  picture.def("__repr__", [](const Picture& self) {
    return "<beeline.Picture of " + number(self.width) + " x " + number(self.height) + " points>";
  });
  bind_copies(picture, "Picture");
  bind_equality(picture, [](const Picture& a, const Picture& b) {
    return a.width == b.width && a.height == b.height && a.marks == b.marks;
  });
}

void bind_animation(nb::module_& m) {
  nb::class_<PlayedAnimation> animation(
      m, "Animation", "A picture that moves. Notebooks play it; `save()` writes it.");
  animation.def_prop_ro(
      "svg", [](const PlayedAnimation& self) { return svg_of(self); },
      nb::for_getter(nb::sig(svg_getter)),
      "The animation as the text of an SVG file that plays in any browser, without a script.");
  animation.def_prop_ro(
      "times",
      [](const PlayedAnimation& self) {
        return Value<std::vector<double>>::to(self.animation.times);
      },
      getter("times", std::string(array_type)), "The times of its frames, s.");
  Signature save("save", "None",
                 "Writes the animation in the format that the path's extension names. All but SVG "
                 "need a build with Cairo and the program ffmpeg; without them they raise Error.");
  save.takes("self").takes("path", path_like, "A .svg, .gif, .mp4 or .webp file.");
  define(
      animation,
      [](const PlayedAnimation& self, nb::handle path) {
        const std::string file = path_from(path, "path");
        without_lock([&] { beeline::save(self.animation, file, self.playback); });
      },
      save, nb::arg("path"));
  animation.def("_repr_html_", &html_of, nb::sig("def _repr_html_(self) -> str"));
  bind_copies(animation, "Animation");
  bind_equality(animation, [](const PlayedAnimation& a, const PlayedAnimation& b) {
    return a.playback.frames_per_second == b.playback.frames_per_second && without_lock([&] {
             return animated_svg(a.animation, a.playback) == animated_svg(b.animation, b.playback);
           });
  });
  animation.def("__repr__", [](const PlayedAnimation& self) {
    const std::vector<double>& times = self.animation.times;
    return "<beeline.Animation of " + number(times.empty() ? 0 : times.back() - times.front()) +
           " s, " + std::to_string(times.size()) + " frames>";
  });
}

}  // namespace

PlayedAnimation::PlayedAnimation(Animation made, const PlaybackOptions& options)
    : animation(std::move(made)), playback(options) {
  check_playback(animation, playback);
}

nb::str notebook_svg(const Picture& picture) {
  std::string svg = without_lock([&] { return render(picture, Format::svg); });
  const std::string start = "<svg ";
  const std::size_t root = svg.find(start);
  svg.insert(root + start.size(), "style=\"max-width: 100%; height: auto\" ");
  return nb::str(svg.data(), svg.size());
}

void bind_pages(nb::module_& m) {
  bind_picture(m);
  bind_animation(m);
}

}  // namespace beeline::python
