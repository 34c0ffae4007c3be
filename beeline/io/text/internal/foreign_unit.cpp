#include <string>

#include <beeline/io/text/internal/foreign_unit.h>

namespace beeline::internal {
namespace {

struct ForeignWords {
  ForeignUnit unit;
  std::string_view words;  ///< between blanks
};

constexpr ForeignWords foreign_words[] = {
    {{Quantity::angle, 0, true, true},
     " mrad mrads millirad millirads milliradian milliradians urad \xc2\xb5rad microrad "
     "microradians "
     "mdeg millideg millidegree millidegrees gon gons gradian gradians arcmin arcmins arcsec "
     "arcsecs "
     "arcminute arcminutes arcsecond arcseconds "},
    {{Quantity::angle, 0, true, false}, " grad grads rev revs turns cycles "},
    {{Quantity::angle, 0, false, false}, " turn cycle revolution revolutions rotations "},
    {{Quantity::length, 0, true, true}, " cm inch inches "},
    {{Quantity::length, 0, false, true},
     " cms centimetre centimetres centimeter centimeters dm decimetre decimetres decimeter "
     "decimeters um \xc2\xb5m \xce\xbcm micron microns micrometre micrometres micrometer "
     "micrometers "
     "nanometre nanometres nanometer nanometers km kilometre kilometres "},
    {{Quantity::length, 0, false, false}, " ft feet foot yard yards mil mils "},
    {{Quantity::time, 0, false, true}, " minutes hours "},
    {{Quantity::time, 0, false, false},
     " min mins minute h hr hrs hour day days week weeks jiffy jiffies "},
    {{Quantity::angle, 1, true, true}, " rpm rps dps "},
    {{std::nullopt, 0, true, false}, " percent pct counts count ticks encoder enc pulses steps "},
    {{std::nullopt, 0, false, false}, " tick pulse incs increments lsb "}};

constexpr std::string_view other_units =
    " - -- 1 % none n/a na n nm n.m n*m n\xc2\xb7m n-m mnm kn kg a ma amp amps ampere amperes v mv "
    "volt volts w kw watt watts hz khz mhz c degc \xc2\xb0"
    "c celsius f degf fahrenheit k kelvin bar "
    "pa kpa mpa psi bool boolean ";

}  // namespace

const ForeignUnit* foreign_unit(std::string_view word) {
  if (word.empty() || word.find(' ') != std::string_view::npos) return nullptr;
  const std::string between = " " + std::string(word) + " ";
  for (const auto& [unit, words] : foreign_words) {
    if (words.find(between) != std::string_view::npos) return &unit;
  }
  return nullptr;
}

bool is_unit_of_other_quantity(std::string_view word) {
  if (word.empty()) return true;
  return word.find(' ') == std::string_view::npos &&
         other_units.find(" " + std::string(word) + " ") != std::string_view::npos;
}

}  // namespace beeline::internal
