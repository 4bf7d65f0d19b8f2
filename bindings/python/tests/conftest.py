# SPDX-License-Identifier: MIT
import pathlib

import hypothesis
import numpy as np
import pytest


@pytest.fixture
def random():
    return np.random.default_rng(2026)


@pytest.fixture(scope="session")
def root():
    """The top of the source tree."""
    return pathlib.Path(__file__).resolve().parents[3]


@pytest.fixture
def points(random):
    """10^5 directions of any length."""
    return random.normal(size=(3, 100_000)) * random.choice([1e-200, 1.0, 1e200], 100_000)


def pytest_addoption(parser):
    parser.addoption("--long", action="store_true", help="a raster of 20 GB instead of 200 MB")

# no test is timed: machines are noisy; and the same inputs each time
hypothesis.settings.register_profile("untimed", deadline=None, derandomize=True)
hypothesis.settings.load_profile("untimed")
