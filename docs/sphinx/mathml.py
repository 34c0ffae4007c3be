"""Formulas as MathML, which browsers draw without a script and without the network."""

from docutils.utils.math.latex2mathml import tex2mathml
from sphinx.util.math import get_node_equation_number


def visit_inline(writer, node):
    writer.body.append(tex2mathml(node.astext()))
    raise_skip()


def visit_block(writer, node):
    writer.body.append(writer.starttag(node, "div", CLASS="math"))
    if number := node["number"] and get_node_equation_number(writer, node):
        writer.body.append(f'<span class="eqno">({number})</span>')
    writer.body.append(tex2mathml(node.astext(), as_block=True))
    writer.body.append("</div>")
    raise_skip()


def raise_skip():
    from docutils import nodes

    raise nodes.SkipNode


def setup(app):
    app.add_html_math_renderer("mathml", (visit_inline, None), (visit_block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
