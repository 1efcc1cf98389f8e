"""Errors that nobody foresaw, and packages that are too old."""

import pytest

from tribodyn.core import platforms


def test_an_error_that_nobody_foresaw_is_to_be_reported() -> None:
    assert platforms.unexpected(KeyError("a")) == "internal error, please report it: KeyError: 'a'"


@pytest.mark.parametrize(
    ("required", "said"),
    [
        ("numpy>=99", '"numpy>=99"; install that one'),
        ("no-such-package", 'no no-such-package is installed, tribodyn needs "no-such-package"'),
        ("numpy>=99; sys_platform == 'elsewhere'", ""),
        ("numpy>=99; extra == 'all'", ""),
        ("numpy>=1", ""),
    ],
)
def test_packages_that_are_too_old_are_named_instead(
    monkeypatch: pytest.MonkeyPatch, required: str, said: str
) -> None:
    monkeypatch.setattr("importlib.metadata.requires", lambda name: [required])
    message = platforms.unexpected(AttributeError("trapezoid"))
    assert said in message
    assert message.startswith("internal error") == (not said)
