#include <algorithm>
#include <cstdlib>
#include <map>

#include <beeline/formula/internal/digits.h>
#include <beeline/formula/internal/notation.h>
#include <beeline/internal/utf8.h>

namespace beeline::internal {
namespace {

const std::map<std::string, std::string> unicode_letters{
    {"alpha", "α"}, {"beta", "β"}, {"gamma", "γ"}, {"theta", "θ"}, {"phi", "φ"},
    {"psi", "ψ"},   {"dq", "q̇"},   {"dJ", "J̇"},    {"c", "c"},     {"s", "s"}};
const std::map<char, std::string> unicode_subscripts{
    {'0', "₀"}, {'1', "₁"}, {'2', "₂"}, {'3', "₃"}, {'4', "₄"}, {'5', "₅"}, {'6', "₆"}, {'7', "₇"},
    {'8', "₈"}, {'9', "₉"}, {'-', "₋"}, {'t', "ₜ"}, {'a', "ₐ"}, {'x', "ₓ"}, {'_', "′"}, {'k', "ₖ"}};

constexpr const char* unicode_roots[] = {"", "√2", "√3", "√6"};
constexpr const char* latex_roots[] = {"", "\\sqrt{2}", "\\sqrt{3}", "\\sqrt{6}"};

bool is_greek(const std::string& letter) {
  return letter.size() > 2 && unicode_letters.count(letter) > 0;
}

/// Whether the tree is written with a minus sign in front.
bool is_negative(const Tree& tree) {
  const bool has_coefficient = tree.kind == Tree::Kind::number ||
                               tree.kind == Tree::Kind::product || tree.kind == Tree::Kind::angle;
  return has_coefficient && tree.coefficient.is_negative();
}

Tree negated(Tree tree) {
  tree.coefficient = -tree.coefficient;
  return tree;
}

/// Whether a factor is a word, which a space separates from its neighbours: cos(2 q1).
bool is_word(const std::string& factor) {
  return factor.rfind("cos", 0) == 0 || factor.rfind("sin", 0) == 0;
}

}  // namespace

std::string decimal(double value) {
  const std::string exact = shortest_digits(value);
  const std::string brief = rounded_digits(value, 15);
  return brief.size() < exact.size() ? brief : exact;
}

std::string escaped_latex(const std::string& text) {
  const std::map<char, std::string> commands{
      {'\\', "\\textbackslash{}"}, {'~', "\\textasciitilde{}"}, {'^', "\\textasciicircum{}"}};
  std::string result;
  for (const char c : text) {
    const auto command = commands.find(c);
    if (command != commands.end()) {
      result += command->second;
    } else if (static_cast<unsigned char>(c) >= 0x80) {
      if (!continues_character(c)) result += '?';
    } else {
      if (std::string("#$%&_{}").find(c) != std::string::npos) result += '\\';
      result += c;
    }
  }
  return result;
}

std::string subscripted(const std::string& letter, const std::string& subscript, bool latex) {
  if (latex) {
    const std::string head = letter == "dq"     ? "\\dot{q}"
                             : letter == "dJ"   ? "\\dot{J}"
                             : is_greek(letter) ? "\\" + letter
                                                : letter;
    std::string below = subscript;
    std::string primes;
    while (!below.empty() && below.back() == '_') {
      below.pop_back();
      primes += "'";
    }
    return head + primes + (below.empty() ? "" : "_{" + below + "}");
  }
  const auto known = unicode_letters.find(letter);
  std::string text = known == unicode_letters.end() ? letter : known->second;
  for (const char c : subscript) {
    const auto below = unicode_subscripts.find(c);
    text += below == unicode_subscripts.end() ? std::string(1, c) : below->second;
  }
  return text;
}

Notation::Notation(const std::vector<Symbol>& symbols, bool latex)
    : symbols_(symbols), latex_(latex) {
  many_joints_ = std::any_of(symbols.begin(), symbols.end(),
                             [](const Symbol& symbol) { return symbol.coordinate > 8; });
}

std::string Notation::symbol(int number) const {
  const Symbol& symbol = symbols_[static_cast<std::size_t>(number)];
  return subscripted(symbol.letter, symbol.subscript, latex_);
}

std::string Notation::angle(const Angle& angle) const {
  std::string text;
  for (const auto& [number, multiple] : angle.multiples) {
    const char* minus = latex_ ? "-" : "−";
    if (text.empty()) {
      text += multiple < 0 ? minus : "";
    } else {
      text += multiple < 0 ? " " + std::string(minus) + " " : " + ";
    }
    const int times = std::abs(multiple);
    text += (times == 1 ? "" : std::to_string(times)) + symbol(number);
  }
  return text.empty() ? "0" : text;
}

bool Notation::abbreviates(const Trig& trig) const {
  return !many_joints_ &&
         std::all_of(trig.angle.multiples.begin(), trig.angle.multiples.end(),
                     [&](const std::pair<int, int>& entry) {
                       const Symbol& symbol = symbols_[static_cast<std::size_t>(entry.first)];
                       return symbol.is_coordinate() && std::abs(entry.second) == 1;
                     });
}

std::string Notation::trig(const Trig& trig) const {
  if (abbreviates(trig)) {
    std::string subscript;
    for (const auto& [number, multiple] : trig.angle.multiples) {
      subscript += (multiple < 0 ? "-" : "") + symbols_[static_cast<std::size_t>(number)].subscript;
    }
    return subscripted(trig.sine ? "s" : "c", subscript, latex_);
  }
  const std::string function = std::string(latex_ ? "\\" : "") + (trig.sine ? "sin" : "cos");
  const auto& multiples = trig.angle.multiples;
  if (multiples.size() == 1 && multiples.front().second == 1) {
    return function + ' ' + symbol(multiples.front().first);
  }
  return function + '(' + angle(trig.angle) + ')';
}

std::string Notation::meaning(const Trig& trig) const {
  if (!abbreviates(trig)) return "";
  const std::string function = std::string(latex_ ? "\\" : "") + (trig.sine ? "sin" : "cos");
  const bool one = trig.angle.multiples.size() == 1;
  return function + (one ? " " : "(") + angle(trig.angle) + (one ? "" : ")");
}

std::string Notation::number(const Coefficient& coefficient, bool before_factors) const {
  if (!coefficient.exact()) return decimal(coefficient.value());
  std::string numerator;
  int parts = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::int64_t part = coefficient.parts()[i];
    if (part == 0) continue;
    const std::string minus = latex_ ? "-" : "−";
    const std::string sign = part < 0 ? (parts == 0 ? minus : " " + minus + " ") : " + ";
    if (parts++ > 0 || part < 0) numerator += sign;
    const std::string magnitude = std::to_string(part).substr(part < 0 ? 1 : 0);
    const std::string root = latex_ ? latex_roots[i] : unicode_roots[i];
    numerator += magnitude == "1" && i > 0 ? root : magnitude + root;
  }
  if (parts == 0) return "0";
  const std::string denominator = std::to_string(coefficient.denominator());
  if (coefficient.denominator() == 1) {
    return parts > 1 && before_factors ? '(' + numerator + ')' : numerator;
  }
  if (latex_) return "\\tfrac{" + numerator + "}{" + denominator + "}";
  const std::string fraction = (parts > 1 ? '(' + numerator + ')' : numerator) + '/' + denominator;
  return before_factors ? '(' + fraction + ')' : fraction;
}

std::string Notation::factor(const Tree& tree) const {
  return tree.kind == Tree::Kind::sum ? '(' + sum(tree) + ')' : text(tree);
}

/// Factors are written in this order: lengths, cosines and sines, brackets, velocities.
int Notation::rank(const Tree& factor) const {
  const Tree& base = factor.kind == Tree::Kind::power ? factor.parts.front() : factor;
  if (base.kind == Tree::Kind::trig) return 1;
  if (base.kind != Tree::Kind::symbol) return 2;
  return symbols_[static_cast<std::size_t>(base.symbol)].kind == SymbolKind::rate ? 3 : 0;
}

std::string Notation::product(const Tree& tree) const {
  const Coefficient& coefficient = tree.coefficient;
  std::string text;
  if (!(coefficient == Coefficient(1)) || tree.parts.empty()) {
    text = number(coefficient, !tree.parts.empty());
  }
  std::vector<Tree> parts = tree.parts;
  std::stable_sort(parts.begin(), parts.end(),
                   [this](const Tree& a, const Tree& b) { return rank(a) < rank(b); });
  bool after_word = !coefficient.exact();
  for (const Tree& part : parts) {
    const std::string next = factor(part);
    const bool word = is_word(latex_ && next[0] == '\\' ? next.substr(1) : next);
    if ((after_word || word) && !text.empty()) text += latex_ ? "\\," : " ";
    text += latex_ && !text.empty() && text.back() != ' ' ? " " + next : next;
    after_word = word;
  }
  return text;
}

std::string Notation::sum(const Tree& tree) const {
  std::string text;
  for (const Tree& part : tree.parts) {
    const bool negative = is_negative(part);
    if (text.empty()) {
      text += this->text(part);
      continue;
    }
    if (part.kind == Tree::Kind::signed_root) {
      text += (latex_ ? " \\pm " : " ± ") + root(part);
      continue;
    }
    text += negative ? (latex_ ? " - " : " − ") : " + ";
    text += this->text(negative ? negated(part) : part);
  }
  return text;
}

/// A numerator or denominator on one line: in brackets unless it is one factor.
std::string Notation::bracketed(const Tree& tree) const {
  const bool number = tree.kind == Tree::Kind::number && tree.coefficient.denominator() == 1 &&
                      !tree.coefficient.is_negative();
  const bool one_factor =
      number || tree.kind == Tree::Kind::symbol || tree.kind == Tree::Kind::trig ||
      (tree.kind == Tree::Kind::product && tree.parts.size() == 1 &&
       tree.coefficient == Coefficient(1) && tree.parts.front().kind != Tree::Kind::sum);
  return one_factor ? text(tree) : '(' + text(tree) + ')';
}

std::string Notation::root(const Tree& tree) const {
  const std::string square = text(tree.parts.front());
  return latex_ ? "\\sqrt{" + square + '}' : "√(" + square + ')';
}

std::string Notation::arctangent(const Tree& tree) const {
  return (latex_ ? "\\operatorname{atan2}(" : "atan2(") + text(tree.parts[0]) + ", " +
         text(tree.parts[1]) + ')';
}

std::string Notation::text(const Tree& tree) const {
  if (is_negative(tree)) return (latex_ ? "-" : "−") + text(negated(tree));
  switch (tree.kind) {
    case Tree::Kind::number:
      return number(tree.coefficient, false);
    case Tree::Kind::symbol:
      return symbol(tree.symbol);
    case Tree::Kind::trig:
      return trig(tree.trig);
    case Tree::Kind::sum:
      return sum(tree);
    case Tree::Kind::product:
      return product(tree);
    case Tree::Kind::power: {
      constexpr const char* superscripts[] = {"", "", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
      const std::string base = factor(tree.parts[0]);
      if (latex_ || tree.exponent > 9) return base + "^{" + std::to_string(tree.exponent) + '}';
      return base + superscripts[tree.exponent];
    }
    case Tree::Kind::quotient:
      if (latex_) return "\\frac{" + text(tree.parts[0]) + "}{" + text(tree.parts[1]) + '}';
      return bracketed(tree.parts[0]) + '/' + bracketed(tree.parts[1]);
    case Tree::Kind::angle:
      return number(tree.coefficient * Coefficient(15), false) + (latex_ ? "^{\\circ}" : "°");
    case Tree::Kind::signed_root:
      return (latex_ ? "\\pm" : "±") + root(tree);
    case Tree::Kind::arctangent:
      return arctangent(tree);
  }
  return "";
}

}  // namespace beeline::internal
