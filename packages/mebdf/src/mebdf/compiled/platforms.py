"""Operating systems and machines for which libraries of machine code are made."""

from typing import Final, NamedTuple


class Platform(NamedTuple):
    """An operating system on a machine."""

    triple: str  #: Its name for LLVM.
    #: Processors that code is made for, by levels. Features are none: numba would add those of this one.
    processors: dict[str, str]
    linker: str  #: Its name for a linker that makes libraries of other systems.
    tag: str  #: What names of wheels end with. Any Python: the library is called by its addresses.
    flags: tuple[str, ...] = ("-nostdlib",)  #: Options of the linker.


#: By the names that Python gives system and machine.
PLATFORMS: Final = {
    "linux-x86_64": Platform(
        "x86_64-unknown-linux-gnu",
        {"v3": "x86-64-v3", "baseline": "x86-64-v2"},
        "x86_64-linux-gnu.2.17",
        "py3-none-manylinux_2_17_x86_64",
        ("-nostdlib", "-Wl,--build-id=none"),
    ),
    "linux-aarch64": Platform(
        "aarch64-unknown-linux-gnu",
        {"baseline": "generic"},
        "aarch64-linux-gnu.2.17",
        "py3-none-manylinux_2_17_aarch64",
    ),
    "darwin-arm64": Platform(
        "arm64-apple-macosx11.0.0",
        {"baseline": "apple-m1"},
        "aarch64-macos.11.0",
        "py3-none-macosx_11_0_arm64",
    ),
    "win32-AMD64": Platform(
        "x86_64-pc-windows-gnu", {"baseline": "x86-64-v2"}, "x86_64-windows-gnu", "py3-none-win_amd64", ()
    ),
}
