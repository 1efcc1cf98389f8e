"""Functions that machine code is made of, as Python calls them.

An ``entry`` is in the library that the build makes, with the layouts that its annotations say. Other kernels
are compiled into those that call them; called from Python, as tests do, they are compiled by themselves, and
so is everything where sources are newer than the library: this takes the extra ``compile``, and seconds.
With ``NUMBA_DISABLE_JIT`` set, the decorators return the Python functions.
"""

from __future__ import annotations

import ctypes
import functools
import importlib
import itertools
import os
import pkgutil
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final, NamedTuple

import numpy as np

from mebdf.compiled.layouts import Layouts, annotated, digest, layout_of
from mebdf.compiled.library import NoMachineCode, Sources, library

#: Whether kernels run as Python.
UNCOMPILED: Final = os.environ.get("NUMBA_DISABLE_JIT", "0") not in ("", "0")
RESULT: Final = 8  #: Words at the beginning of a call that take the result.
RETURNED: Final = (0, -2)  #: Values that compiled code returns where it raised nothing.
ENTRIES: Final[dict[str, Kernel]] = {}  #: All entries of the modules that are imported, by their names.


#: Ways to read a result, by its kind.
_READ: Final[dict[str, Callable[[Any, int], Any]]] = {
    "none": lambda words, place: None,
    "int64": lambda words, place: words[place],
    "bool": lambda words, place: bool(words[place] & 1),
    "float64": lambda words, place: ctypes.c_double.from_buffer(words, 8 * place).value,
}


class CompiledForm:
    """A compiled function for arguments of certain layouts.

    What was taken apart in the last call is not taken apart again: data of a problem are the same objects in
    all calls.
    """

    def __init__(self, layouts: Layouts, address: int, result: str, *, unlocked: bool) -> None:
        self.layouts, self.result = layouts, result
        kind = ctypes.CFUNCTYPE if unlocked else ctypes.PYFUNCTYPE
        self._call = kind(ctypes.c_int32, ctypes.c_void_p)(address)
        places = np.cumsum([RESULT, *(layout.size for layout in layouts)]).tolist()
        self._places = tuple(slice(*ends) for ends in itertools.pairwise(places))
        self._block = ctypes.c_int64 * places[-1]
        self._last: tuple[tuple[Any, ...], Any] = ((self,) * len(layouts), self._block())

    def __call__(self, arguments: tuple[Any, ...]) -> Any:
        """Return the result for arguments; the lock of Python is kept but by functions that take long."""
        before, last = self._last
        words = self._block.from_buffer_copy(last)  # another thread may call it, too
        for value, known, layout, place in zip(arguments, before, self.layouts, self._places, strict=True):
            if value is not known:
                words[place] = layout.words(value)
        self._last = arguments, words
        if (status := self._call(words)) not in RETURNED:
            raise RuntimeError(f"compiled code failed with {status}")
        return self._value(words)

    def _value(self, words: Any) -> Any:
        kinds = self.result.split(",")
        numbers = tuple(_READ[kind](words, place) for place, kind in enumerate(filter(None, kinds)))
        return numbers if len(kinds) > 1 else numbers[0]


class Kernel:
    """A function that machine code is made of.

    Attributes
    ----------
    py_func
        The function in Python.
    name
        Its name with that of its module.
    targetoptions
        Options of numba.
    stamp
        Returns what its machine code depends on beside the sources of the package.
    unlocked
        Whether it takes so long that other threads of the process should go on meanwhile.
    """

    def __init__(
        self,
        function: Callable[..., Any],
        sources: Sources,
        *,
        inlined: bool = False,
        unlocked: bool = False,
        layouts: Layouts | None = None,
        stamp: Callable[[], str] = str,
    ) -> None:
        functools.update_wrapper(self, function)
        self.py_func, self.sources, self.unlocked, self.stamp = function, sources, unlocked, stamp
        self.name = f"{function.__module__}.{function.__qualname__}"
        self.targetoptions = {"inline": "always"} if inlined else {}
        if layouts is not None:
            self.layouts = layouts
        self._listed: CompiledForm | None = None
        self._others: dict[Layouts, CompiledForm] = {}

    def __call__(self, *arguments: Any) -> Any:
        """Call the machine code.

        Raises TypeError if arguments do not fit it; NoMachineCode if there is none, and numba is not
        installed.
        """
        if self.name in ENTRIES:
            if self._listed is None:
                self._listed = self._form(self.layouts)
            form = self._listed
        else:
            layouts = tuple(map(layout_of, arguments))
            form = self._others.get(layouts) or self._others.setdefault(layouts, self._form(layouts))
        if len(arguments) != len(form.layouts):
            raise TypeError(f"{self.name} takes {len(form.layouts)} arguments, not {len(arguments)}")
        return form(arguments)

    def __reduce__(self) -> str:
        """Tell pickle that it is found by its name."""
        return self.__qualname__

    __qualname__: str

    @functools.cached_property
    def layouts(self) -> Layouts:
        """Layouts of the arguments of an entry."""
        return annotated(self.py_func)

    def digest(self, layouts: Layouts) -> str:
        """Return a hash of all that its machine code depends on beside the sources of the package."""
        return digest(layouts, self.stamp())

    def _form(self, layouts: Layouts) -> CompiledForm:
        address, result = self.code(layouts)
        return CompiledForm(layouts, address, result, unlocked=self.unlocked)

    def code(self, layouts: Layouts, suffix: str = "") -> tuple[int, str]:
        """Return address and kind of result of the machine code for arguments of some layouts."""
        known = library(self.sources)
        found = (
            known.find(self.name, self.digest(layouts), suffix) if known and self.name in ENTRIES else None
        )
        if found is not None:
            return found
        try:
            jit: Any = importlib.import_module("mebdf.compiled.jit")
        except ImportError as missing:
            why = "has changed since it was built" if known is None else f"lacks {self.name}"
            words = f"the machine code of {self.sources.package.name} is missing or {why}"
            raise NoMachineCode(f"{words}; install numba (the extra `compile`) or a new build") from missing
        found = jit.machine_code(self, layouts, suffix)
        return found


@dataclass(frozen=True)
class Instruction:
    """A function that is an instruction in compiled code."""

    uncompiled: Callable[..., Any]  #: The same in Python.
    #: Where its code generator is, which needs numba; behind an underscore.
    module: str
    name: str

    def __call__(self, *arguments: Any) -> Any:
        """Return the result in Python."""
        return self.uncompiled(*arguments)

    def generator(self) -> Any:
        """Return its code generator."""
        return getattr(importlib.import_module(self.module), f"_{self.name}")


def enlisted(kernel: Kernel) -> Kernel:
    """Return a kernel, which is an entry if it belongs to the package and not to a plug-in."""
    if kernel.py_func.__module__.split(".")[0] == kernel.sources.package.name:
        ENTRIES[kernel.name] = kernel
    return kernel


def entries(sources: Sources) -> list[Kernel]:
    """Return all entries of a package, in the order of their names."""
    for package in map(importlib.import_module, sources.listing):
        for module in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
            if not module.name.endswith("instructions"):
                importlib.import_module(module.name)
    start = f"{sources.package.name}."
    return [kernel for name, kernel in sorted(ENTRIES.items()) if name.startswith(start)]


class Decorators(NamedTuple):
    """Decorators of the functions that a package compiles."""

    entry: Any  #: A function that Python calls, which may be decorated as ``inlined`` before.
    kernel: Any  #: Any other function.
    #: As ``kernel``, for a few lines in a loop, and for levels that only pass arguments on: numba compiles
    #: into each function all that it calls, again at every level.
    inlined: Any


def decorators(sources: Sources) -> Decorators:
    """Return the decorators of a package, whose machine code is made from ``sources``."""
    if UNCOMPILED:
        return Decorators(*(lambda function: function,) * 3)

    def decorator(*, listed: bool = False, inlined: bool = False) -> Any:
        def decorate(function: Callable[..., Any]) -> Kernel:
            made = function if isinstance(function, Kernel) else Kernel(function, sources, inlined=inlined)
            return enlisted(made) if listed else made

        return decorate

    return Decorators(entry=decorator(listed=True), kernel=decorator(), inlined=decorator(inlined=True))
