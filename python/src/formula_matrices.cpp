#include <algorithm>

#include "formula_entries.h"

namespace beeline::python {
namespace {

/// An entry, or a part of the matrix, by an index as numpy's arrays take.
nb::object part_of(const NamedMatrix& self, nb::handle index) {
  const nb::object numbers =
      formulas().attr("indices")(nb::make_tuple(self.value.rows, self.value.columns), index);
  const auto entry = [&](nb::handle number) -> const Expression& {
    return self.value.entries.at(nb::cast<std::size_t>(number));
  };
  if (!nb::isinstance<nb::list>(numbers)) {
    return nb::cast(NamedExpression{self.arm, entry(numbers)});
  }
  NamedMatrix part{self.arm, {.rows = nb::len(numbers)}};
  for (nb::handle row : numbers) {
    part.value.columns = nb::len(row);
    for (nb::handle number : row) part.value.entries.push_back(entry(number));
  }
  return nb::cast(std::move(part));
}

nb::list cells_of(const NamedMatrix& self, bool latex) {
  nb::list rows;
  for (std::size_t i = 0; i < self.value.rows; ++i) {
    nb::list row;
    for (std::size_t k = 0; k < self.value.columns; ++k) {
      row.append(
          Value<std::string>::to(written(self.value(i, k), self.arm->symbolic, {.latex = latex})));
    }
    rows.append(row);
  }
  return rows;
}

void bind_state(nb::class_<NamedMatrix>& bound) {
  bound.def(
      "__getstate__",
      [](const NamedMatrix& self) {
        nb::list entries;
        for (const Expression& entry : self.value.entries) entries.append(terms_of(entry));
        return nb::make_tuple(self.arm, self.value.rows, self.value.columns, entries);
      },
      nb::sig("def __getstate__(self) -> tuple[object, ...]"));
  bound.def(
      "__setstate__",
      [](NamedMatrix& self, const nb::tuple& given) {
        const nb::tuple state = state_tuple(given, 4);
        const SharedArm arm = named_arm(state[0], "pickle");
        ExpressionMatrix matrix{Value<std::size_t>::from(state[1], "rows"),
                                Value<std::size_t>::from(state[2], "columns")};
        for (nb::handle terms : nb::cast<nb::list>(nb::object(state[3]))) {
          matrix.entries.push_back(expression_from(*arm, terms));
        }
        if (matrix.columns == 0 || matrix.entries.size() % matrix.columns != 0 ||
            matrix.entries.size() / matrix.columns != matrix.rows) {
          throw Error("the pickled matrix has another number of entries");
        }
        new (&self) NamedMatrix{arm, std::move(matrix)};
      },
      nb::sig("def __setstate__(self, state: tuple[object, ...], /) -> None"));
}

void bind_text(nb::class_<NamedMatrix>& bound) {
  bound.def(
      "__str__",
      [](const NamedMatrix& self) { return formulas().attr("matrix_text")(cells_of(self, false)); },
      nb::sig("def __str__(self) -> str"));
  bound.def(
      "__repr__", [](nb::handle_t<NamedMatrix> self) { return nb::str(self); },
      nb::sig("def __repr__(self) -> str"));
  bound.def_prop_ro(
      "latex",
      [](const NamedMatrix& self) { return formulas().attr("matrix_latex")(cells_of(self, true)); },
      getter("latex", "str"), "The matrix as LaTeX, for mathematics mode.");
  bound.def(
      "_repr_latex_",
      [](nb::handle_t<NamedMatrix> self) {
        return nb::str("$\\displaystyle ") + self.attr("latex") + nb::str("$");
      },
      nb::sig("def _repr_latex_(self) -> str"));
}

}  // namespace

nb::object values_of(const NamedArm& arm, const std::vector<const Expression*>& entries,
                     std::vector<Index> inner, nb::handle q, nb::handle dq) {
  const InputArray at(q, "q");
  const bool with_rates = !dq.is_none();
  std::optional<InputArray> rates;
  if (with_rates) rates.emplace(dq, "dq");
  if (at.dimensions() < 1 || at.dimensions() > 2 ||
      at.shape()[at.dimensions() - 1] != arm.arm.dof()) {
    throw Error("q has the shape " + shape_text(at.shape()) + "; expected (" +
                std::to_string(arm.arm.dof()) + ",) or (N, " + std::to_string(arm.arm.dof()) + ")");
  }
  if (with_rates && !std::ranges::equal(rates->shape(), at.shape())) {
    throw Error("dq has the shape " + shape_text(rates->shape()) + "; expected the shape of q, " +
                shape_text(at.shape()));
  }
  const Index n = arm.arm.dof(), count = at.rows(1);
  if (at.dimensions() == 2) inner.insert(inner.begin(), count);
  NewArray result(inner);
  double* next = result.data();
  for (Index i = 0; i < count; ++i) {
    const auto row = [&](const InputArray& array) {
      return ConfigurationRef(std::span(array.data() + i * n, static_cast<std::size_t>(n)));
    };
    const std::vector<double> symbols = with_rates
                                            ? symbol_values(arm.symbolic, row(at), row(*rates))
                                            : symbol_values(arm.symbolic, row(at));
    for (const Expression* entry : entries) *next++ = entry->value(symbols);
  }
  return result.release();
}

void bind_matrices(nb::module_& m) {
  nb::class_<NamedMatrix> bound(m, "ExpressionMatrix",
                                "A matrix of expressions. `matrix[i, k]` is an entry, `matrix[:3, "
                                ":]` or `matrix[[0, 1, 5]]` a part of it.");
  bind_common(bound, "typing.Any", [](const NamedMatrix& self) { return self.value; });
  bound.def_prop_ro(
      "shape",
      [](const NamedMatrix& self) { return nb::make_tuple(self.value.rows, self.value.columns); },
      getter("shape", "tuple[int, int]"), "Rows and columns.");
  bound.def(
      "__getitem__",
      [](const NamedMatrix& self, const nb::tuple& index) {
        const bool entry = nb::len(index) == 2 && PyIndex_Check(nb::object(index[0]).ptr()) &&
                           PyIndex_Check(nb::object(index[1]).ptr());
        if (!entry) throw nb::next_overload();
        return part_of(self, index);
      },
      nb::sig("def __getitem__(self, index: tuple[int, int], /) -> Expression"));
  bound.def("__getitem__", &part_of,
            nb::sig("def __getitem__(self, index: typing.Any, /) -> ExpressionMatrix"));
  bind_text(bound);
  Signature value("value", array_type,
                  "Returns the numbers, (rows, columns) or (N, rows, columns).");
  value.takes("self")
      .takes("q", array_like, q_doc)
      .takes("dq", std::string(array_like) + " | None", dq_doc, "None");
  define(
      bound,
      [](const NamedMatrix& self, nb::handle q, nb::handle dq) {
        std::vector<const Expression*> entries;
        for (const Expression& entry : self.value.entries) entries.push_back(&entry);
        return values_of(
            *self.arm, entries,
            {static_cast<Index>(self.value.rows), static_cast<Index>(self.value.columns)}, q, dq);
      },
      value, nb::arg("q"), nb::arg("dq") = nb::none());
  bind_state(bound);
}

}  // namespace beeline::python
