#!/usr/bin/env python3
"""Operations of the tool's pose: Beeline's formulas and code beside SymPy's after simplify, SymPy's cse,
and published formulas.

Usage: operations.py BEELINE [ARM...] [--limit SECONDS of simplify]. Needs SymPy."""

import argparse
import json
import multiprocessing
import re
import subprocess
import time

try:
    import sympy
except ImportError:
    raise SystemExit(print("Left out: SymPy is not installed"))

SUBSCRIPT = str.maketrans("₀₁₂₃₄₅₆₇₈₉ₜ−", "0123456789t-")
# Products and sums as printed in: Craig, "Introduction to Robotics", 3rd edition, eq. 3.14; the function
# forward() of ur_kinematics (ros-industrial/universal_robot, 0290bd2).
PUBLISHED = {"puma560": ("Craig eq. 3.14", 84, 33), "ur5": ("ur_kinematics", 69, 28)}


def derived(beeline, arm, *options):
    run = subprocess.run([beeline, "formula", arm, "--json", *options], check=True,
                         capture_output=True, text=True)
    return json.loads(run.stdout)


def printed_operations(cells):
    """Products and sums of formulas as they are printed."""
    products = sums = 0
    for text in (cell for row in cells for cell in row):
        before = ""
        for token in re.findall(r"[cs][\d₋]+|[a-z]\d*t?|\d+|[-+/()²]", text.translate(SUBSCRIPT)):
            sums += token in "+-" and before not in ("", "(")
            products += token[0] not in "+-/)²" and before not in ("", "+", "-", "(")
            before = token
    return products, sums


def sympy_pose(links):
    """The product of the links' transforms, as SymPy has it."""
    product = sympy.eye(4)
    for link in links:
        cells = [[re.sub(r"([cs])(\d)", lambda m: f"{'cos' if m[1] == 'c' else 'sin'}(q{m[2]})",
                         re.sub(r"([a-z]\d)(?=[a-z(])", r"\1*", cell.translate(SUBSCRIPT)))
                  for cell in row] for row in link["cells"]]
        matrix = sympy.Matrix([[sympy.sympify(cell) for cell in row] for row in cells])
        if matrix.shape == (3, 3):
            plane = sympy.eye(4)
            plane[:2, :2], plane[:2, 3] = matrix[:2, :2], matrix[:2, 2]
            matrix = plane
        product = product * matrix
    return product


def counted(expressions):
    """(products, sums, cosines and sines); a power counts as products, a sign as nothing."""
    products = sums = trigonometric = 0
    for expression in expressions:
        for node in sympy.preorder_traversal(expression):
            if node.is_Mul:
                products += len([a for a in node.args if a not in (1, -1)]) - 1
            elif node.is_Add:
                sums += len(node.args) - 1
            elif node.is_Pow and node.exp.is_Integer:
                products += int(node.exp) - 1
            elif isinstance(node, (sympy.cos, sympy.sin)):
                trigonometric += 1
    return products, sums, trigonometric


def simplify(links, queue):
    begin = time.perf_counter()
    result = sympy_pose(links).applyfunc(sympy.simplify)
    queue.put((counted(result), time.perf_counter() - begin))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("beeline")
    parser.add_argument("arms", nargs="*", default=["puma560", "ur5", "panda"])
    parser.add_argument("--limit", type=float, default=300)
    arguments = parser.parse_args()
    print("| arm | formula | products | sums | cosines and sines | s |\n|---|---|---|---|---|---|")
    for arm in arguments.arms:
        begin = time.perf_counter()
        document = derived(arguments.beeline, arm)
        seconds = time.perf_counter() - begin
        links = document["links"]["formulas"]
        products, sums = printed_operations(document["tool"]["formulas"][0]["cells"])
        print(f"| {arm} | Beeline, as printed | {products} | {sums} | | {seconds:.3f} |")
        if arm in PUBLISHED:
            print("| {} | {}, as printed | {} | {} | | |".format(arm, *PUBLISHED[arm]))
        queue = multiprocessing.Queue()
        process = multiprocessing.Process(target=simplify, args=(links, queue))
        process.start()
        try:
            (products, sums, _), seconds = queue.get(timeout=arguments.limit)
            print(f"| {arm} | SymPy after simplify, as printed | {products} | {sums} | | {seconds:.1f} |")
        except Exception:
            print(f"| {arm} | SymPy after simplify | | | | > {arguments.limit:.0f} |")
        process.terminate()
        code = derived(arguments.beeline, arm, "--as", "c", "--of", "forward")["functions"][0]
        print(f"| {arm} | Beeline's code | {code['multiplications']} | {code['additions']} | "
              f"{code['trigonometric']} | |")
        begin = time.perf_counter()
        parts, outputs = sympy.cse(list(sympy_pose(links)[:3, :]))
        products, sums, trigonometric = counted([right for _, right in parts] + outputs)
        print(f"| {arm} | SymPy's cse | {products} | {sums} | {trigonometric} | "
              f"{time.perf_counter() - begin:.1f} |", flush=True)


if __name__ == "__main__":
    main()
