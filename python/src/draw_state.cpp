#include "draw_fields.h"

namespace beeline::python {
namespace {

nb::tuple colour_state(const Colour& colour) {
  return nb::make_tuple(colour.red, colour.green, colour.blue, colour.alpha);
}

/// The items of a tuple in turn. Throws Error where one is missing.
class StateReader {
 public:
  explicit StateReader(nb::handle state) {
    if (!nb::isinstance<nb::tuple>(state)) raise_type("state", "a tuple", state);
    state_ = nb::borrow<nb::tuple>(state);
  }
  nb::object next() {
    if (at_ >= nb::len(state_)) throw Error("the pickled picture is cut off");
    return nb::object(state_[at_++]);
  }
  template <class T>
  T next_as() {
    return Value<T>::from(next(), "state");
  }
  Colour colour() {
    StateReader parts(next());
    const auto red = parts.next_as<double>(), green = parts.next_as<double>(),
               blue = parts.next_as<double>();
    return {red, green, blue, parts.next_as<double>()};
  }
  bool more() const { return at_ < nb::len(state_); }

 private:
  nb::tuple state_;
  std::size_t at_ = 0;
};

nb::tuple state_of_mark(const PaperStroke& stroke) {
  std::string verbs;
  std::vector<double> coordinates;
  for (const PaperPath::Verb verb : stroke.path.verbs) verbs += "mlcz"[static_cast<int>(verb)];
  for (const PaperPoint& point : stroke.path.points) {
    coordinates.insert(coordinates.end(), {point.x(), point.y()});
  }
  return nb::make_tuple("stroke", Value<std::string>::to(verbs),
                        Value<std::vector<double>>::to(coordinates), colour_state(stroke.fill),
                        colour_state(stroke.line), stroke.width,
                        Value<std::vector<double>>::to(stroke.dashes));
}

nb::tuple state_of_mark(const PaperText& text) {
  return nb::make_tuple("text", Value<std::string>::to(text.text), text.centre.x(), text.centre.y(),
                        text.size, colour_state(text.colour), text.bold, text.upright, text.halo);
}

PaperPath paper_path_from(const std::string& verbs, const std::vector<double>& coordinates) {
  PaperPath path;
  std::size_t points = 0;
  for (const char letter : verbs) {
    const std::size_t index = std::string("mlcz").find(letter);
    if (index == std::string::npos) throw Error("the pickled picture has an unknown line");
    path.verbs.push_back(static_cast<PaperPath::Verb>(index));
    points += index == 3 ? 0 : index == 2 ? 3 : 1;
  }
  if (coordinates.size() != 2 * points) {
    throw Error("the pickled picture has another number of points");
  }
  for (std::size_t i = 0; i < points; ++i) {
    path.points.emplace_back(coordinates[2 * i], coordinates[2 * i + 1]);
  }
  return path;
}

PaperMark mark_from(nb::handle state) {
  StateReader reader(state);
  if (reader.next_as<std::string>() == "stroke") {
    PaperStroke stroke;
    const auto verbs = reader.next_as<std::string>();
    stroke.path = paper_path_from(verbs, reader.next_as<std::vector<double>>());
    stroke.fill = reader.colour();
    stroke.line = reader.colour();
    stroke.width = reader.next_as<double>();
    stroke.dashes = reader.next_as<std::vector<double>>();
    return stroke;
  }
  PaperText text;
  text.text = reader.next_as<std::string>();
  text.centre.x() = reader.next_as<double>();
  text.centre.y() = reader.next_as<double>();
  text.size = reader.next_as<double>();
  text.colour = reader.colour();
  text.bold = reader.next_as<bool>();
  text.upright = reader.next_as<bool>();
  text.halo = reader.next_as<bool>();
  return text;
}

}  // namespace

nb::tuple state_of(const Drawing& drawing) {
  nb::list marks;
  for (const PaperMark& mark : drawing.marks) {
    marks.append(std::visit([](const auto& kind) { return state_of_mark(kind); }, mark));
  }
  return nb::make_tuple(drawing.width, drawing.height, nb::tuple(marks));
}

Drawing drawing_from(const nb::tuple& state) {
  StateReader reader(state);
  Drawing drawing;
  drawing.width = reader.next_as<double>();
  drawing.height = reader.next_as<double>();
  for (StateReader marks(reader.next()); marks.more();) {
    drawing.marks.push_back(mark_from(marks.next()));
  }
  return drawing;
}

}  // namespace beeline::python
