"""How the tables look."""

import pytest


def pytest_configure(config: pytest.Config) -> None:
    config.option.benchmark_columns = ["median", "iqr", "rounds"]
    # The command line would not take the median.
    config.option.benchmark_sort = "median"
