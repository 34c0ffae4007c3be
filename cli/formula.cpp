#include <algorithm>
#include <fmt/format.h>
#include <memory>

#include <beeline/error.h>
#include <beeline/formula/document.h>
#include <beeline/io/text/file.h>

#include "arm_argument.h"
#include "format.h"
#include "result_files.h"
#include "verbs.h"

namespace beeline::command {
namespace {

struct FormulaArguments {
  ArmArgument arm;
  UnitArgument unit;
  JacobianArgument jacobian;
  std::string of = "forward", as = "text", out;
  double angle_tolerance = SymbolicOptions{}.angle_tolerance;
  bool all = false, numbers = false, standalone = false;
};

/// What --of asks for by a name.
struct ContentName {
  const char* name;
  std::vector<bool FormulaContent::*> members;
};

const std::vector<ContentName> content_names{
    {"forward", {&FormulaContent::links, &FormulaContent::tool}},
    {"links", {&FormulaContent::links}},
    {"jacobian", {&FormulaContent::jacobian}},
    {"derivative", {&FormulaContent::derivative}},
    {"determinant", {&FormulaContent::determinant}},
    {"inverse", {&FormulaContent::inverse}}};

std::vector<std::string> known_names() {
  std::vector<std::string> names;
  for (const ContentName& content : content_names) names.emplace_back(content.name);
  names.emplace_back("all");
  return names;
}

/// The names between the commas of --of.
std::vector<std::string> wanted_names(std::string_view list) {
  std::vector<std::string> wanted = items_of(list, ',');
  for (const std::string& name : wanted) check_choice("--of", name, known_names());
  return wanted;
}

FormulaContent content_of(const FormulaArguments& arguments, const Arm& arm,
                          const SymbolicArm& symbolic) {
  FormulaContent content{.links = false, .products = arguments.all, .tool = false};
  content.task = arguments.jacobian.read(arm);
  content.frame = content.task.frame;
  for (const std::string& wanted : wanted_names(arguments.of)) {
    for (const ContentName& named : content_names) {
      if (wanted != named.name && wanted != "all") continue;
      for (const auto member : named.members) content.*member = true;
    }
    if (wanted != "all") continue;  // all that there is
    content.determinant = content.task.size() == arm.dof() && content.frame != Frame::space;
    content.inverse = has_inverse_formula(symbolic);
  }
  if (content.determinant && content.frame == Frame::space) {
    throw Error("--of determinant needs --frame base or tool, not space");
  }
  return content;
}

Json formula_json(const WrittenFormula& formula) {
  Json rows = Json::list();
  for (const std::vector<std::string>& row : formula.cells) rows.append(Json(row));
  Json json{{"left", formula.left}, {"cells", rows}};
  if (!formula.row_names.empty()) json.add("rows", formula.row_names);
  if (!formula.explanation.empty()) json.add("explanation", formula.explanation);
  return json;
}

Json document_json(const FormulaDocument& document) {
  Json symbols = Json::list();
  for (const WrittenSymbol& symbol : document.symbols) {
    Json json{{"name", symbol.name}, {"code_name", symbol.code_name}};
    if (symbol.formula.empty()) {
      json.add("value", symbol.value);
    } else {
      json.add("formula", symbol.formula);
      json.add("joint", symbol.joint);
      json.add("multiplier", symbol.multiplier);
      json.add("offset", symbol.offset);
    }
    json.add("unit", symbol.unit);
    json.add("meaning", symbol.meaning);
    symbols.append(json);
  }
  Json abbreviations = Json::object();
  for (const auto& [name, meaning] : document.abbreviations) abbreviations.add(name, meaning);
  Json json{{"title", document.title},
            {"convention", document.convention},
            {"symbols", symbols},
            {"abbreviations", abbreviations},
            {"notes", document.notes}};
  for (const WrittenSection& section : document.sections) {
    Json formulas = Json::list();
    for (const WrittenFormula& formula : section.formulas) formulas.append(formula_json(formula));
    json.add(section.key, Json{{"title", section.title},
                               {"remarks", section.remarks},
                               {"formulas", formulas},
                               {"sentences", section.sentences}});
  }
  return json;
}

/// The formulas as text, with the document for --json.
Answer written_formulas(const FormulaArguments& arguments, const SymbolicArm& arm,
                        const FormulaContent& content) {
  const FormulaStyle style{.latex = arguments.as == "latex",
                           .numbers = arguments.numbers,
                           .degrees = arguments.unit.degrees};
  FormulaDocument document = formula_document(arm, content, style);
  const std::vector<std::string> wanted = wanted_names(arguments.of);
  const bool all = std::find(wanted.begin(), wanted.end(), "all") != wanted.end();
  if (all && content.frame == Frame::space) {
    document.notes.emplace_back("The determinant is left out: it needs --frame base or tool.");
  }
  return {.text = style.latex ? latex_of(document, arguments.standalone) : text_of(document),
          .document = document_json(document)};
}

/// The code, with its operations for --json.
Answer generated_code(const FormulaArguments& arguments, const SymbolicArm& arm,
                      const FormulaContent& content) {
  const CodeLanguage language = arguments.as == "python" ? CodeLanguage::python
                                : arguments.as == "c"    ? CodeLanguage::c
                                                         : CodeLanguage::cpp;
  const GeneratedCode code = formula_code(arm, content, language, arguments.numbers);
  if (code.functions.empty()) {
    throw Error(
        "--as " + arguments.as +
        " generates code for forward, jacobian, derivative and determinant of --of, not for " +
        arguments.of);
  }
  Json functions = Json::list();
  for (const GeneratedFunction& function : code.functions) {
    functions.append({{"name", function.name},
                      {"purpose", function.purpose},
                      {"multiplications", function.multiplications},
                      {"additions", function.additions},
                      {"trigonometric", function.trigonometric}});
  }
  return {.text = code.text, .document = {{"code", code.text}, {"functions", functions}}};
}

Answer formula(const FormulaArguments& arguments) {
  if (arguments.standalone && arguments.as != "latex") {
    throw Error("--standalone needs --as latex");
  }
  const bool written = arguments.as == "text" || arguments.as == "latex";
  if (arguments.all && !written) throw Error("--all needs --as text or --as latex");
  const Arm arm = arguments.arm.read(arguments.unit);
  const SymbolicArm symbolic = symbolic_arm(arm, {.angle_tolerance = arguments.angle_tolerance});
  const FormulaContent content = content_of(arguments, arm, symbolic);
  Answer answer = written ? written_formulas(arguments, symbolic, content)
                          : generated_code(arguments, symbolic, content);
  if (!arguments.out.empty()) {
    refuse_overwriting(arguments.out, arguments.arm.inputs());
    write_file(arguments.out, answer.text);
    answer.text = fmt::format("formulas of {} written: {}\n", arm.name(), arguments.out);
    answer.document.add("out", arguments.out);
  }
  return answer;
}

std::vector<Option> formula_options(FormulaArguments& arguments) {
  return {Option("--of LIST",
                 "What is derived: forward (the transform of each link and the pose of the tool), "
                 "links (the transforms alone), jacobian, derivative (of the Jacobian, by time), "
                 "determinant (with the singularities that it shows), inverse (kinematics of a "
                 "planar arm, in steps), or all; several with commas between.",
                 &arguments.of, {.choices = known_names(), .other_values = true}),
          Option("--all", "Also the pose of every link in the base.", &arguments.all),
          Option("--as FORM", "How the formulas are written: text, latex, python, c++ or c.",
                 &arguments.as, {.choices = {"text", "latex", "python", "c++", "c"}}),
          Option("--numbers", "Lengths and constant angles as numbers, not as symbols.",
                 &arguments.numbers),
          Option("--standalone", "With --as latex: a document that compiles by itself.",
                 &arguments.standalone),
          Option("--angle-tolerance RAD",
                 "Constant angles within this distance of a multiple of 15 degrees are taken as "
                 "exact; the answer says by how much they changed.",
                 &arguments.angle_tolerance, {.range = {.lowest = 0, .highest = 0.01}}),
          Option("--out FILE", "Write the formulas to this file.", &arguments.out)};
}

}  // namespace

Verb formula_verb() {
  const auto arguments = std::make_shared<FormulaArguments>();
  return {
      .name = "formula",
      .summary = "Derive the formulas of an arm: kinematics in symbols",
      .description =
          "Derives formulas of an arm in symbols, as a textbook writes them: the transform of each "
          "link and the pose of the tool, the Jacobian and its time derivative, the determinant of "
          "a square Jacobian with the singularities that it shows, and the inverse kinematics of a "
          "planar arm in steps. Joints with parallel axes turn by a sum of angles: c12 is cos(q1 + "
          "q2). Dimensions have the names of Denavit-Hartenberg parameters or of planar links "
          "where the arm fits them, otherwise names of the joints' offsets; a list gives their "
          "values. Constant angles that are multiples of 15 degrees are exact. The formulas are "
          "compared with the arm's kinematics at random configurations before they are printed.\n\n"
          "With --as python, c++ or c the answer is code in one file that needs the language's "
          "mathematics alone: without branches, each common subexpression computed once. In C and "
          "C++ a macro, BEELINE_FORMULA_FUNCTION, precedes each function; for CUDA define it as "
          "__host__ __device__.",
      .arguments = {arguments->arm.argument()},
      .options = joined({formula_options(*arguments), arguments->unit.options(),
                         arguments->jacobian.options(), arguments->arm.options()}),
      .examples = {{"The planar arm with three revolute joints: eq. 1.2 of the chapter",
                    "beeline formula rrr"},
                   {"The RP arm of the chapter's exercise, with its numbers",
                    "beeline formula rp --numbers"},
                   {"The chapter's Jacobian, eq. 1.7, and the inverse kinematics in steps",
                    "beeline formula rrr --of jacobian,inverse"},
                   {"Where a UR5 is singular", "beeline formula ur5 --of determinant"},
                   {"Everything about a Puma 560 as a LaTeX document",
                    "beeline formula puma560 --of all --as latex --standalone --out puma.tex"},
                   {"C++ code for the pose and the Jacobian of a Panda",
                    "beeline formula panda --of forward,jacobian --as c++ --out panda.h"}},
      .run = [arguments] { return formula(*arguments); }};
}

}  // namespace beeline::command
