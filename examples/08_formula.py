"""
Formulas
========

Eq. 1.2 and 1.7 of Dellaert, *Serial Link Manipulators*, in symbols; the determinant of a UR5; code for it.
"""

import beeline

rrr = beeline.arms.rrr()
print(beeline.formula_document(rrr, jacobian=True))

beeline.draw(rrr, [0.6, 0.7, 0.5], frames=True).save("08_formula.svg")

# %%
# The determinant of the Jacobian, and the singularities that it shows.
ur5 = beeline.arms.ur5()
print(beeline.formula_document(ur5, links=False, tool=False, determinant=True))

# %%
# Code, each common subexpression computed once.
code = beeline.formula_code(rrr, "python", jacobian=True)
for function in code.functions:
    print(function.name, function.multiplications, "multiplications", function.additions, "additions")
