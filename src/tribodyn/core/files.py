"""Reading files that somebody named: regular files of limited size, TOML from strangers, tables of numbers.

A pipe keeps its reader waiting, a device never ends, and either may stand behind a link. So a file is opened
without waiting, and what was opened is looked at before anything is read from it.
"""

import errno
import os
import re
import stat
import tomllib
from typing import Any, BinaryIO, Final

_FLAGS: Final = os.O_RDONLY | sum(
    getattr(os, name, 0) for name in ("O_NONBLOCK", "O_NOCTTY", "O_CLOEXEC", "O_BINARY")
)
ARCHIVES: Final = (b"PK\x03\x04", b"\xd0\xcf\x11\xe0")  #: Beginnings of workbooks and documents of offices.
_UNITS: Final = ((10**9, "GB"), (10**6, "MB"), (10**3, "kB"), (1, "bytes"))


def open_regular(path: str | os.PathLike[str], most: int) -> BinaryIO:
    """Open a regular file for reading.

    ``path``: its name; links are followed; ``most``: size that it may have [bytes]. Returns the open file;
    the caller closes it. Raises OSError if there is no such file, it is no regular one, it is too large, or
    it cannot be opened; ``strerror`` says which.
    """
    try:
        # Asked first because to open a device may act upon it; asked again because names can change hands.
        _refuse(os.stat(path), most)
        stream = os.fdopen(os.open(path, _FLAGS), "rb")
    except ValueError as error:
        raise FileNotFoundError(errno.ENOENT, str(error)) from None
    except OSError as error:
        if error.errno != errno.ENAMETOOLONG:
            raise
        raise FileNotFoundError(errno.ENOENT, error.strerror) from None
    try:
        _refuse(os.fstat(stream.fileno()), most)
    except OSError:
        stream.close()
        raise
    return stream


def read_regular(path: str | os.PathLike[str], most: int) -> bytes:
    """Return the content of a regular file; parameters and errors are those of :func:`open_regular`."""
    with open_regular(path, most) as stream:
        size = os.fstat(stream.fileno()).st_size
        content = stream.read(size + 1)
    if len(content) > size:
        raise OSError(errno.EBUSY, "the file grows while it is read")
    return content


def text_of(content: bytes, start: int = 0) -> str:
    """Return the text of a file, UTF-8 with or without its mark.

    ``content``: of the file, from byte ``start`` on; ``start``: place of its beginning. Raises ValueError if
    it is no such text; the message says what it is, or where it ends to be one, and what to do.
    """
    if content.startswith(ARCHIVES):
        raise ValueError("this is a workbook or a document of an office program: save the sheet as CSV")
    try:
        return content.decode("utf-8-sig" if start == 0 else "utf-8")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        where = f"byte {start + error.start}" + ("" if start else f", line {line}")
        raise ValueError(f"the file is not UTF-8 text ({where}); save it with the encoding UTF-8") from None


def _refuse(found: os.stat_result, most: int) -> None:
    if stat.S_ISDIR(found.st_mode):
        raise IsADirectoryError(errno.EISDIR, "this is a directory")
    if not stat.S_ISREG(found.st_mode):
        raise OSError(errno.EINVAL, "this is a pipe, a device or a socket, not a regular file")
    if found.st_size > most:
        raise _too_large(most)


def _too_large(most: int) -> OSError:
    size, unit = next((size, unit) for size, unit in _UNITS if most >= size)
    return OSError(errno.EFBIG, f"the file is larger than {most / size:g} {unit}")


SEPARATORS: Final = (";", "\t", ",")  #: Separators of the fields of a line; the first one that occurs counts.
#: Beginning of a comment line.
_COMMENTS: Final = ("#", "%", "//")


def is_comment(text: str) -> bool:
    """Tell whether a line holds no numbers but says something."""
    return text.lstrip().startswith(_COMMENTS)


def separator_of(text: str) -> str:
    """Return the separator of the fields of a line."""
    return next((mark for mark in SEPARATORS if mark in text), ",")


def with_points(text: str, separator: str) -> str:
    """Return a line with points for commas, which are decimal commas where they do not separate fields."""
    return text if separator == "," else text.replace(",", ".")


def named(cell: str) -> tuple[str, str | None] | None:
    """Return name and unit of a column as its header gives them, None where it cannot be one.

    Examples
    --------
    >>> named('"Position (mm)"'), named("torque (net) [N m]"), named("x")
    (('Position', 'mm'), ('torque (net)', 'N m'), ('x', None))
    """
    # Not by a regular expression: one that leaves blanks to three parts tries all divisions among them.
    text = cell.strip().removeprefix('"').removesuffix('"').rstrip()
    name, unit = text, None
    if text.endswith("]"):
        name, _, unit = text[:-1].partition("[")
    elif text.endswith(")"):
        before, opened, inside = text[:-1].rpartition("(")
        name, unit = (before, inside) if opened and inside and ")" not in inside else (text, None)
    if unit == "" or any(mark in name for mark in '[]"') or (text.endswith("]") and "]" in text[:-1]):
        return None
    return name.strip(), None if unit is None else unit.strip()


#: Length of a text that is parsed, at most; a case with all its comments has 15,000 characters.
LARGEST: Final = 1_000_000
DEEPEST: Final = 20  #: Depth of tables, arrays and dotted keys, each at most; cases are four deep.
#: Dots, brackets, commas, equals signs and lines, at most: a table costs up to a kilobyte for each.
_MOST_MARKS: Final = 100_000

_MARKS: Final = re.compile(
    r'''
    """(?>[^"\\]*+(?:(?:\\.|"{1,2}(?!"))[^"\\]*+)*)"{3,5}
    | \'\'\'(?>[^']*+(?:'{1,2}(?!')[^']*+)*)'{3,5}
    | "(?!"")(?>[^"\\\n]*+(?:\\.[^"\\\n]*+)*)"
    | '(?!'')[^'\n]*+'
    | \#[^\n]*+
    | (?P<open>[\[{]) | (?P<close>[\]}]) | (?P<dot>\.) | (?P<next>[,=\n]) | (?P<broken>["'])
    ''',
    re.VERBOSE | re.DOTALL,
)


def parse(text: str) -> dict[str, Any]:
    """Return the tables of a TOML text.

    ``text``: whatever somebody wrote. Raises ValueError if it is not valid TOML, too long, too deep or has
    too many entries; the message says which.
    """
    if len(text) > LARGEST:
        raise ValueError(f"longer than {LARGEST} characters")
    _refuse_depth(text)
    return tomllib.loads(text)


def _refuse_depth(text: str) -> None:
    """Refuse a text that would cost the parser much time or memory; linear in the length of the text."""
    depth = dots = marks = 0
    for match in _MARKS.finditer(text):
        kind = match.lastgroup
        if kind is None:
            continue
        if kind == "broken":
            return
        depth += (kind == "open") - (kind == "close")
        dots = dots + 1 if kind == "dot" else 0
        marks += 1
        if max(depth, dots) >= DEEPEST:
            raise ValueError(f"nested too deeply, more than {DEEPEST} levels")
        if marks > _MOST_MARKS:
            raise ValueError("too many entries")


def in_braces(error: str) -> str:
    """Return the message on a table in braces that is continued elsewhere; empty for any other error."""
    if not error.startswith("Cannot declare ("):
        return ""
    *above, last = re.findall(r"'([^']*)'", error)
    table = ".".join(above)
    words = (
        f"{above[-1] if above else last} = {{...}} is closed by its brace, so [{table}.{last}] cannot follow"
    )
    return f"{words}; write [{table}] with a line for each key instead of the braces"
