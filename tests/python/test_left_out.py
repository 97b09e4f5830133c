# SPDX-License-Identifier: BSD-3-Clause
"""What is not installed is skipped at a desk, and fails in CI."""

import pytest
from left_out import in_ci

pytest_plugins = ("pytester",)

TESTS = {
    "module": "import pytest\npytest.importorskip('no_such_module')\ndef test(): pass\n",
    "function": "import pytest\ndef test():\n    pytest.importorskip('no_such_module')\n",
    "browser": "import pytest\ndef test():\n    pytest.skip('needs chromium and chromedriver')\n",
    "does_not_apply": "import pytest\ndef test():\n    pytest.skip('no signals here')\n",
    "wrong": "import pytest\n@pytest.mark.xfail(strict=True)\ndef test():\n    assert False\n",
}


@pytest.mark.parametrize(
    ("variable", "wanted"),
    [
        ("", {"skipped": 4, "xfailed": 1}),
        ("CI", {"errors": 1, "failed": 2, "skipped": 1, "xfailed": 1}),
    ],
)
def test_what_is_not_installed_fails_in_ci_only(
    variable: str,
    wanted: dict[str, int],
    pytester: pytest.Pytester,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    for name in ("CI", "FLEXACT_CI"):
        monkeypatch.delenv(name, raising=False)
    if variable:
        monkeypatch.setenv(variable, "true")
    pytester.makepyfile(**{f"test_{name}": text for name, text in TESTS.items()})
    options = ("-p", "left_out", "-p", "no:hypothesispytest", "--continue-on-collection-errors")
    found = pytester.runpytest_inprocess(*options, "-Wignore").parseoutcomes()
    assert found == wanted


@pytest.mark.parametrize(
    ("environment", "wanted"),
    [({}, False), ({"CI": "true"}, True), ({"CI": "false"}, False), ({"FLEXACT_CI": "1"}, True)],
)
def test_ci_is_told_by_the_environment(environment: dict[str, str], wanted: bool) -> None:
    assert in_ci(environment) is wanted
