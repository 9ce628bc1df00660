"""What the tests share: where recordings and numbers are; skipped (or failed: PALPATE_REQUIRE_DATA=1) without."""
import csv
import os
import sys
from pathlib import Path

import pytest

sys.dont_write_bytecode = True
SOURCE = Path(os.environ["PALPATE_SOURCE"])
CORPUS = Path(os.environ["PALPATE_CORPUS"])


@pytest.hookimpl(tryfirst=True)
def pytest_configure(config):
    """Writes the report that scripts/count_tests reads, one per file of tests."""
    folder = os.environ.get("PALPATE_TEST_REPORTS")
    if folder and len(config.args) == 1:
        config.option.xmlpath = str(Path(folder) / f"python.{Path(config.args[0]).stem}.xml")


def shared(variable, default):
    folder = Path(os.environ.get(variable, SOURCE.parent / "shared" / default))
    if not folder.is_dir():
        if os.environ.get("PALPATE_REQUIRE_DATA") == "1":
            pytest.fail(f"shared data is missing: set {variable}")
        pytest.skip(f"shared data is missing: set {variable}")
    return folder


@pytest.fixture(scope="session")
def recordings():
    return shared("PALPATE_RECORDINGS", "data/recordings")


@pytest.fixture(scope="session")
def golden():
    return shared("PALPATE_GOLDEN", "golden")


@pytest.fixture(scope="session")
def whole():
    return CORPUS / "palpate" / "whole.palpate"


def rows_of(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))
