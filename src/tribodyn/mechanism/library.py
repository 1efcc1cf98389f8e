"""Files of mechanisms: built-in cases, and templates that ``tribodyn new`` copies.

Comments before the first key say what the mechanism is. Files of the gallery also name a ``Question``
and the key ``Results`` that answer it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.resources import files
from typing import Final

from tribodyn.core import toml


@dataclass(frozen=True)
class Template:
    """A file of a mechanism.

    Attributes
    ----------
    text
        Its content.
    """

    text: str

    @property
    def title(self) -> str:
        """Heading of figures and report."""
        return str(toml.parse(self.text)["title"])

    @property
    def description(self) -> str:
        """Description of the mechanism, from its comments."""
        return " ".join(line for line in self._comments() if not re.match(r"(Question|Results): ", line))

    @property
    def question(self) -> str:
        """Question that the gallery answers with it; empty where the gallery does not show it."""
        return self._entry("Question")

    @property
    def results(self) -> tuple[str, ...]:
        """Names of the key results that answer the question."""
        return tuple(self._entry("Results").split(", ")) if self.question else ()

    def _comments(self) -> Iterator[str]:
        for line in self.text.splitlines():
            if not line.startswith("#"):
                return
            yield line.removeprefix("#").strip()

    def _entry(self, name: str) -> str:
        found = (line.removeprefix(f"{name}: ") for line in self._comments() if line.startswith(f"{name}: "))
        return next(found, "")


def _files(folder: str) -> dict[str, Template]:
    """Return the files of a folder beside this one, by their names without the ending."""
    found = sorted(files(__package__).joinpath(folder).iterdir(), key=lambda file: file.name)
    return {file.name.removesuffix(".toml"): Template(file.read_text(encoding="utf-8")) for file in found}


BUILT_IN: Final = _files("built_in")
"""Cases that run by name."""
TEMPLATES: Final = {**_files("templates"), **BUILT_IN}
"""All files."""
GALLERY: Final = {name: template for name, template in TEMPLATES.items() if template.question}
"""Those that the manual shows, by name."""
