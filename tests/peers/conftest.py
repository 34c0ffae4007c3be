"""At the end of a run with -v: how far Beeline and its peer were apart, for every file of arms."""

import pytest

WORST = []


@pytest.fixture(scope="session")
def worst_differences():
    return WORST


def pytest_terminal_summary(terminalreporter):
    if terminalreporter.verbosity < 1:
        return
    files = {}
    for name, pose, jacobian in WORST:
        files.setdefault(name, []).append((pose, jacobian))
    for name, rows in files.items():
        pose, jacobian = (max(column) for column in zip(*rows))
        terminalreporter.write_line(
            f"{name:60} {len(rows):3} chains   pose {pose:.1e}   Jacobian {jacobian:.1e}"
        )
