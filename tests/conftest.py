"""What the Python tests share: where the sources and the build are, and the seed."""

import os
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
SEED = int(os.environ.get("BEELINE_SEED", "20240229"))


def pytest_collection_modifyitems(items):
    """Under a sanitizer, which takes up to 50 times as long, every third of a test's parameters will do."""
    if "-fsanitize" not in os.environ.get("BEELINE_CXX_FLAGS", ""):
        return
    seen = {}
    kept = []
    for item in items:
        name = getattr(item, "originalname", item.name), item.path
        seen[name] = seen.get(name, -1) + 1
        if seen[name] % 3 == 0:
            kept.append(item)
    items[:] = kept


def pytest_report_header():
    return f"BEELINE_SEED={SEED}"


@pytest.fixture(scope="session")
def root() -> Path:
    return ROOT


@pytest.fixture(scope="session")
def build() -> Path:
    """The build that is tested: BEELINE_BUILD, set by ctest."""
    return Path(os.environ.get("BEELINE_BUILD", ROOT / "build")).resolve()


@pytest.fixture(scope="session")
def seed() -> int:
    return SEED
