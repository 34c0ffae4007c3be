"""How many random cases a test runs."""

import os


def cases(n):
    """Of the n cases of a thorough run (`make test CASES=3`) a third, at least one, times BEELINE_CASES."""
    return max(1, int(n * float(os.environ.get("BEELINE_CASES") or 1) / 3))
