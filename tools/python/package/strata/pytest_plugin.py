"""A fixture for pytest: matches_reference(candidate, reference) stores pictures of a difference under the name of the test.

    def test_my_port(matches_reference):
        matches_reference(my_pixels, "reference.exr", color=1)

The folder is --strata-pictures, or else strata-pictures in the folder that pytest was started in.
"""
from __future__ import annotations

import os
import pathlib
from typing import Any, Callable, Iterator

import pytest

import strata


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--strata-pictures", metavar="FOLDER", default="strata-pictures", help="where pictures of failed comparisons are left")


@pytest.fixture
def matches_reference(request: pytest.FixtureRequest) -> Iterator[Callable[..., None]]:
    folder = pathlib.Path(request.config.getoption("--strata-pictures")).absolute()
    before = os.environ.get("STRATA_PICTURES")
    os.environ["STRATA_PICTURES"] = str(folder)
    compared = 0

    def matches(candidate: strata.Comparable, reference: strata.Comparable, **tolerances: Any) -> None:
        nonlocal compared
        __tracebackhide__ = True
        compared += 1
        name = request.node.name if compared == 1 else f"{request.node.name}.{compared}"
        strata.assert_matches(candidate, reference, name=name, **tolerances)

    yield matches
    if before is None:
        del os.environ["STRATA_PICTURES"]
    else:
        os.environ["STRATA_PICTURES"] = before
